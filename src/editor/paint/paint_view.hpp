#pragma once
// From the pointer to a place on a bone, wherever the bone is in the shown frame. All results are in the bone's own (rest)
// coordinates, in which areas are painted.

#include "fascicle/base/pose.hpp"
#include "fascicle/geometry/lasso.hpp"
#include "view/camera.hpp"

namespace fascicle::editor {

/// How a bone is looked at.
struct PaintView {
    view::Camera camera;
    view::ViewSize size;
    Pose pose; ///< of the bone

    /// Front of the bone under a place of the picture; triangle == -1: none.
    SurfacePoint pick(const SurfaceGraph& graph, double x, double y) const;
    /// The eye, in the bone's coordinates; very far away for a parallel view.
    Vec3 eye() const;
    double units_per_pixel(const Vec3& point) const;
    /// Bone coordinates to pixels.
    ScreenMatrix matrix() const;
    std::optional<Vec2> project(const Vec3& point) const { return camera.project(pose.apply(point), size); }
};

/// Stadium round the way from a to b, in pixels: what a circle sweeps.
std::vector<Vec2> swept_circle(const Vec2& a, const Vec2& b, double radius);

} // namespace fascicle::editor
