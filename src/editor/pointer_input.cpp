#include "editor/pointer_input.hpp"

namespace fascicle::editor {

PointerInput pointer_input(const EditorContext& context, const Rect& area, bool inside) {
    const ImGuiIO& io = ImGui::GetIO();
    PointerInput input;
    input.x = double(io.MousePos.x - area.min.x);
    input.y = double(io.MousePos.y - area.min.y);
    input.dx = double(io.MouseDelta.x);
    input.dy = double(io.MouseDelta.y);
    // Some systems turn Shift+wheel into a sideways wheel.
    input.wheel = double(io.MouseWheel != 0 ? io.MouseWheel : io.MouseWheelH);
    input.ctrl = io.KeyCtrl;
    input.shift = io.KeyShift;
    input.alt = io.KeyAlt;
    input.camera_held = io.KeysDown[key_v];
    input.navigation = context.state.navigation;
    input.inside = inside;
    for (int button = 0; button < 3; ++button) {
        if (inside && ImGui::IsMouseClicked(button))
            input.pressed = button;
        if (ImGui::IsMouseReleased(button))
            input.released = button;
    }
    return input;
}

} // namespace fascicle::editor
