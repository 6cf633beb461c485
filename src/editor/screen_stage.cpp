#include "editor/screen_stage.hpp"

#include "editor/features.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"

#include <imgui.h>
#include <thread>

namespace fascicle::editor {

namespace {

/// A run that is over before it begins.
class DoneRun : public Run {
public:
    explicit DoneRun(RecordingPtr recording) : recording_(std::move(recording)) {}
    RecordingPtr recording() const override { return recording_; }
    void cancel() override {}
    bool done() const override { return true; }
    std::pair<std::string, double> progress() const override { return {"solve", 1.0}; }

private:
    RecordingPtr recording_;
};

} // namespace

ScreenStage::ScreenStage(std::vector<RecordingPtr> runs, const ScreenOptions& options)
    : runs_(std::move(runs)), options_(options), host_(options.scale),
      editor_(host_, Document(runs_.at(0)->scene()),
              [this](ScenePtr scene) -> std::unique_ptr<Run> {
                  if (!same_bodies(*scene, runs_.front()->scene()) || fresh_runs_)
                      return simulate_on_thread()(std::move(scene));
                  const std::size_t which = std::min(next_run_++, runs_.size() - 1);
                  return std::make_unique<DoneRun>(runs_[which]);
              },
              {options.dark, true, {}}),
      target_(options.width, options.height) {
    editor_.use_gl();
    set_item_recorder(&recorder_);
    frames(4);
}

ScreenStage::~ScreenStage() {
    set_item_recorder(nullptr);
}

void ScreenStage::run(Command command) {
    editor_.run(command);
    frames(2);
}

void ScreenStage::frames(int count) {
    for (int i = 0; i < count; ++i) {
        editor_.metrics().finish();
        editor_.apply_look();
        renderer_.new_frame();
        editor_.draw_frame(static_cast<float>(options_.width), static_cast<float>(options_.height), 1.0 / 60);
        if (editor_.next_redraw() && i > 2) // something is under way on another thread
            std::this_thread::sleep_for(std::chrono::milliseconds(4));
    }
}

Rect ScreenStage::rect(const std::string& widget) const {
    const Rect* found = recorder_.find(widget);
    return found == nullptr ? Rect{} : *found;
}

void ScreenStage::move(ImVec2 to) {
    editor_.input().mouse_move(to.x, to.y);
    frames(2);
}

void ScreenStage::hover(const std::string& widget) {
    const Rect r = rect(widget);
    move({(r.min.x + r.max.x) / 2, (r.min.y + r.max.y) / 2});
}

void ScreenStage::click(const std::string& widget) {
    hover(widget);
    editor_.input().mouse_button(0, true);
    frames(1);
    editor_.input().mouse_button(0, false);
    frames(2);
}

void ScreenStage::drag(ImVec2 from, ImVec2 to) {
    move(from);
    editor_.input().mouse_button(0, true);
    frames(1);
    for (int i = 1; i <= 8; ++i) {
        const float t = static_cast<float>(i) / 8;
        move({from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t});
    }
    editor_.input().mouse_button(0, false);
    frames(2);
}

void ScreenStage::type(const std::string& text) {
    for (const char c : text)
        editor_.input().text(static_cast<unsigned char>(c));
    frames(2);
}

void ScreenStage::tab(const char* id) {
    state().side_panel = id;
    frames(2);
}

void ScreenStage::wait(double most_seconds) {
    for (int i = 0; i < static_cast<int>(most_seconds * 100); ++i) {
        frames(4);
        const bool busy = editor_.runs().running() || editor_.runs().outdated() || editor_.metrics().behind();
        if (!busy && !editor_.next_redraw())
            return;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

void ScreenStage::second_run() {
    actions::use_parameters(editor_.document(), runs_.back()->scene().parameters, "Other parameters");
    frames(static_cast<int>(RunManager::settle_seconds * 60) + 6);
}

void ScreenStage::start_lesson(const std::string& id) {
    editor_.features().lessons.start(id);
    frames(2);
}

render::Image ScreenStage::picture() {
    target_.bind();
    renderer_.draw(ImGui::GetDrawData());
    target_.resolve();
    return target_.read_back();
}

} // namespace fascicle::editor
