#include "editor/input_queue.hpp"

#include <algorithm>
#include <imgui.h>

namespace fascicle::editor {

void InputQueue::map_keys(ImGuiIO& io) {
    const std::pair<int, int> keys[] = {{ImGuiKey_Tab, key_tab},
                                        {ImGuiKey_LeftArrow, key_left},
                                        {ImGuiKey_RightArrow, key_right},
                                        {ImGuiKey_UpArrow, key_up},
                                        {ImGuiKey_DownArrow, key_down},
                                        {ImGuiKey_PageUp, key_page_up},
                                        {ImGuiKey_PageDown, key_page_down},
                                        {ImGuiKey_Home, key_home},
                                        {ImGuiKey_End, key_end},
                                        {ImGuiKey_Insert, key_insert},
                                        {ImGuiKey_Delete, key_delete},
                                        {ImGuiKey_Backspace, key_backspace},
                                        {ImGuiKey_Space, key_space},
                                        {ImGuiKey_Enter, key_enter},
                                        {ImGuiKey_Escape, key_escape},
                                        {ImGuiKey_KeyPadEnter, key_pad_enter},
                                        {ImGuiKey_A, key_a},
                                        {ImGuiKey_C, key_c},
                                        {ImGuiKey_V, key_v},
                                        {ImGuiKey_X, key_x},
                                        {ImGuiKey_Y, key_y},
                                        {ImGuiKey_Z, key_z}};
    for (const auto& [imgui_key, native] : keys)
        io.KeyMap[imgui_key] = native;
}

void InputQueue::mouse_move(float x, float y) {
    events_.push_back({Kind::move, x, y});
}

void InputQueue::mouse_button(int button, bool down) {
    if (button >= 0 && button < 3)
        events_.push_back({Kind::button, 0, 0, button, down});
}

void InputQueue::wheel(float dx, float dy) {
    events_.push_back({Kind::wheel, dx, dy});
}

void InputQueue::key(int key, bool down, Modifiers modifiers, bool repeat) {
    if (key > 0 && key < 512)
        events_.push_back({Kind::key, 0, 0, key, down, repeat, modifiers});
}

void InputQueue::text(unsigned code_point) {
    events_.push_back({Kind::text, 0, 0, static_cast<int>(code_point)});
}

void InputQueue::focus(bool focused) {
    events_.push_back({Kind::focus, 0, 0, 0, focused});
}

void InputQueue::feed(ImGuiIO& io) {
    presses_.clear();
    if (events_.empty())
        return;
    const Kind kind = events_.front().kind;
    const bool merges = kind == Kind::move || kind == Kind::wheel || kind == Kind::text;
    do {
        apply(events_.front(), io);
        events_.pop_front();
        // Typed characters come right behind their key: the two are no separate changes.
    } while (!events_.empty() && ((merges && events_.front().kind == kind) ||
                                  (kind == Kind::key && events_.front().kind == Kind::text)));
}

void InputQueue::apply(const Event& event, ImGuiIO& io) {
    switch (event.kind) {
    case Kind::move:
        io.MousePos = ImVec2(event.x, event.y);
        break;
    case Kind::button:
        io.MouseDown[event.code] = event.down;
        break;
    case Kind::wheel:
        io.MouseWheelH += event.x;
        io.MouseWheel += event.y;
        break;
    case Kind::text:
        io.AddInputCharacter(static_cast<unsigned>(event.code));
        break;
    case Kind::focus:
        if (!event.down) {
            std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
            std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
            io.KeyCtrl = io.KeyShift = io.KeyAlt = false;
        }
        break;
    case Kind::key: {
        if (event.down)
            presses_.push_back({{event.code, event.modifiers}, event.repeat});
        io.KeysDown[event.code] = event.down;
        const auto held = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
        io.KeyCtrl = event.modifiers.ctrl || held(key_left_ctrl, key_right_ctrl);
        io.KeyShift = event.modifiers.shift || held(key_left_shift, key_right_shift);
        io.KeyAlt = event.modifiers.alt || held(key_left_alt, key_right_alt);
        break;
    }
    }
}

} // namespace fascicle::editor
