#include "editor/driver.hpp"

#include <catch2/catch.hpp>
#include <tuple>

namespace fascicle::test {

namespace ed = fascicle::editor;

Driver::Driver(Scene scene, float width, float height, float scale, bool still,
               std::filesystem::path user_folder)
    : width_(width), height_(height), host_(scale) {
    const auto start = [this](ScenePtr head) -> std::unique_ptr<ed::Run> {
        auto run = std::make_unique<HandRun>(std::move(head));
        run_ = run.get();
        ++runs_started_;
        return run;
    };
    editor_ = std::make_unique<ed::Editor>(host_, Document(std::move(scene)), start,
                                           ed::EditorOptions{true, still, std::move(user_folder)});
    ed::set_item_recorder(&recorder_);
}

Driver::~Driver() {
    ed::set_item_recorder(nullptr);
}

void Driver::frame(int count) {
    for (int i = 0; i < count; ++i)
        editor_->draw_frame(width_, height_, 1.0 / 60);
}

void Driver::settle() {
    frame(static_cast<int>(ed::RunManager::settle_seconds * 60) + 3);
}

void Driver::wait(double seconds) {
    editor_->draw_frame(width_, height_, seconds);
}

ed::Rect Driver::rect(const std::string& name) const {
    const ed::Rect* found = recorder_.find(name);
    INFO("widget " << name);
    REQUIRE(found != nullptr);
    return *found;
}

ImVec2 Driver::middle(const std::string& name) const {
    const ed::Rect r = rect(name);
    return {(r.min.x + r.max.x) / 2, (r.min.y + r.max.y) / 2};
}

void Driver::move_to(ImVec2 point) {
    editor_->input().mouse_move(point.x, point.y);
    frame(2); // the second frame knows what is under the pointer
}

void Driver::press(int button) {
    editor_->input().mouse_button(button, true);
    frame();
}

void Driver::release(int button) {
    editor_->input().mouse_button(button, false);
    frame(2);
}

void Driver::click(const std::string& name, int button) {
    move_to(middle(name));
    press(button);
    release(button);
    frame(20); // far enough from the next click to be no double-click
}

void Driver::double_click(const std::string& name) {
    move_to(middle(name));
    for (int i = 0; i < 2; ++i) {
        press();
        editor_->input().mouse_button(0, false);
        frame();
    }
    frame(20);
}

void Driver::drag(ImVec2 from, ImVec2 to, int button) {
    move_to(from);
    press(button);
    for (int i = 1; i <= 4; ++i) {
        const float s = static_cast<float>(i) / 4;
        editor_->input().mouse_move(from.x + (to.x - from.x) * s, from.y + (to.y - from.y) * s);
        frame();
    }
    release(button);
}

void Driver::wheel(const std::string& name, float steps) {
    move_to(middle(name));
    editor_->input().wheel(0, steps);
    frame(2);
}

void Driver::key(int code, ed::Modifiers modifiers) {
    const std::pair<bool, int> held[] = {{modifiers.ctrl, ed::key_left_ctrl},
                                         {modifiers.shift, ed::key_left_shift},
                                         {modifiers.alt, ed::key_left_alt}};
    const auto send = [&](int key, bool down, ed::Modifiers with) {
        editor_->input().key(key, down, with);
        frame();
    };
    for (const auto& [used, key] : held)
        if (used)
            send(key, true, modifiers);
    send(code, true, modifiers);
    send(code, false, modifiers);
    for (const auto& [used, key] : held)
        if (used)
            send(key, false, {});
    frame();
}

void Driver::hold(ed::Modifiers modifiers) {
    const std::tuple<bool, bool, int> keys[] = {{held_.ctrl, modifiers.ctrl, ed::key_left_ctrl},
                                                {held_.shift, modifiers.shift, ed::key_left_shift},
                                                {held_.alt, modifiers.alt, ed::key_left_alt}};
    held_ = modifiers;
    for (const auto& [was, is, key] : keys)
        if (was != is) {
            editor_->input().key(key, is, modifiers);
            frame();
        }
}

void Driver::type(const std::string& text) {
    for (const char c : text)
        editor_->input().text(static_cast<unsigned char>(c));
    frame(2);
}

} // namespace fascicle::test
