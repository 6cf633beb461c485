#pragma once
// Vertices inside a polygon drawn on the screen.

#include "fascicle/geometry/surface_graph.hpp"
#include "fascicle/geometry/surface_region.hpp"

#include <optional>

namespace fascicle {

/// 4 x 4, column vectors: (x, y, depth, w) = matrix * (p, 1); the place on the screen is (x / w, y / w), any unit. A point with
/// w <= 0 is behind the eye and never taken. Depth grows away from the eye (as in OpenGL's clip space).
using ScreenMatrix = Eigen::Matrix4d;

/// visible: faces the eye and nothing of the surface hides it. front: faces the eye. through: all.
enum class LassoReach { visible, front, through };

/// polygon: N x 2 places on the screen, closed by itself, may cross itself (even-odd rule); fewer than 3 take nothing.
/// A vertex faces the eye when one of its triangles does.
SurfaceRegion lasso(const SurfaceGraph& graph, const ScreenMatrix& world_to_screen,
                    const std::vector<Vec2>& polygon, LassoReach reach = LassoReach::visible);

/// The eye of a view, from the matrix alone: the point with x = y = w = 0. Parallel views have a direction towards the eye
/// instead. Nothing for a matrix without either (rank too low).
struct ScreenEye {
    bool parallel = false;
    Vec3 place = Vec3::Zero(); ///< a position, or a unit direction when parallel
};
std::optional<ScreenEye> screen_eye(const ScreenMatrix& world_to_screen);

/// Whether the triangle's outer side, or the vertex's outermost triangle, faces the eye.
bool faces_eye(const SurfaceGraph& graph, int triangle, const ScreenEye& eye);
bool vertex_faces_eye(const SurfaceGraph& graph, int vertex, const ScreenEye& eye);
/// Whether no triangle lies between the vertex and the eye; its own triangles, and what is nearer than 1/100 of the mean
/// edge, do not count.
bool vertex_visible(const SurfaceGraph& graph, int vertex, const ScreenEye& eye);

} // namespace fascicle
