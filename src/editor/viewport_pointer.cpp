#include "editor/viewport_pointer.hpp"

#include <cmath>

namespace fascicle::editor {

/// Of the button that went down; the table of interaction conventions, one column a preset.
PointerAction ViewportPointer::action(const PointerInput& input) {
    using A = PointerAction;
    int button = input.pressed;
    if (input.navigation == Navigation::blender) {
        if (button == 0 && (input.alt || input.camera_held))
            button = 2; // who has no middle button
        if (button != 2)
            return A::none;
        return input.ctrl ? A::zoom : input.shift ? A::pan : A::orbit;
    }
    const bool paraview = input.navigation == Navigation::paraview;
    switch (button) {
    case 0:
        return input.ctrl ? A::zoom : input.shift ? A::pan : A::orbit;
    case 1:
        return paraview ? A::zoom : A::pan;
    case 2:
        return paraview || input.shift ? A::pan : A::orbit;
    default:
        return A::none;
    }
}

ViewportPointer::Result ViewportPointer::update(const PointerInput& input, const view::ViewSize& size,
                                                double scale, view::Camera& camera) {
    Result result;
    if (input.pressed >= 0 && button_ < 0) {
        button_ = input.pressed;
        action_ = action(input);
        dragged_ = false;
        press_x_ = input.x;
        press_y_ = input.y;
    }
    if (button_ >= 0) {
        double dx = input.dx, dy = input.dy;
        const double reach = std::hypot(input.x - press_x_, input.y - press_y_);
        if (!dragged_ && reach >= click_reach * scale) {
            dragged_ = true; // the way so far counts too: what was grabbed stays under the pointer
            dx = input.x - press_x_;
            dy = input.y - press_y_;
        }
        if (dragged_ && (dx != 0 || dy != 0)) {
            if (action_ == PointerAction::orbit)
                camera.orbit(dx, dy, size);
            else if (action_ == PointerAction::pan)
                camera.pan(dx, dy, size);
            else if (action_ == PointerAction::zoom)
                camera.zoom(std::exp(dy * 0.008 / scale), size.width / 2, size.height / 2, size);
        }
        if (input.released == button_) {
            if (!dragged_)
                result.clicked = button_;
            button_ = -1;
        }
    }
    if (input.inside && input.wheel != 0)
        camera.zoom(std::pow(0.88, input.wheel), input.x, input.y, size);
    return result;
}

} // namespace fascicle::editor
