#pragma once
// What the mouse does to the camera. Decides click or drag by distance, so that a slip of the
// hand is no drag.

#include "editor/navigation.hpp"
#include "view/camera.hpp"

#include <optional>

namespace fascicle::editor {

/// One frame of the pointer, in pixels of the viewport.
struct PointerInput {
    double x = 0, y = 0, dx = 0, dy = 0;
    double wheel = 0;
    int pressed =
        -1; ///< button that went down in this frame over the view (0 left, 1 right, 2 middle), or -1
    int released = -1; ///< button that came up in this frame, or -1
    bool ctrl = false, shift = false, alt = false;
    /// The key that gives the pointer to the camera (V): some desktops keep Alt for themselves.
    bool camera_held = false;
    bool inside = false; ///< the pointer is over the view, and nothing is in front
    Navigation navigation = Navigation::fascicle;
};

enum class PointerAction { none, orbit, pan, zoom };

class ViewportPointer {
public:
    /// Pixels (at scale 1) below which a press is a click.
    static constexpr double click_reach = 4;

    struct Result {
        std::optional<int> clicked; ///< button of a finished click
    };
    /// Moves the camera. A drag that began in the view keeps it until release, wherever the pointer goes.
    Result update(const PointerInput& input, const view::ViewSize& size, double scale, view::Camera& camera);
    bool dragging() const { return button_ >= 0 && dragged_; }

private:
    static PointerAction action(const PointerInput& input);

    int button_ = -1;
    bool dragged_ = false;
    double press_x_ = 0, press_y_ = 0;
    PointerAction action_ = PointerAction::none;
};

} // namespace fascicle::editor
