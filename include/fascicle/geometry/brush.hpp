#pragma once
// The brush of a paint tool: which vertices it touches.

#include "fascicle/geometry/geodesic_search.hpp"

#include <optional>

namespace fascicle {

/// connected: along the surface from the point under the pointer, so that the far side of a thin blade is as far as its
/// rim. sphere: everything within the radius in a straight line, whatever it hangs together with.
enum class BrushReach { connected, sphere };

/// radius: scene units, > 0 and finite (FASCICLE_ASSERT). eye: where the user looks from (very far for a parallel view), in
/// the surface's frame; given, only vertices with a triangle that faces it are touched, and a connected brush does not
/// cross triangles that face away. visible_only: with an eye, only vertices that nothing of the surface hides from it.
struct Brush {
    double radius = 0;
    BrushReach reach = BrushReach::connected;
    std::optional<Vec3> eye;
    bool visible_only = false;
};

/// Vertices under the brush at a point of the surface, ascending: those up to the radius along the surface
/// (WaveFront::round). When there is none, the nearest corner of the point's triangle, so that a click always does
/// something. Empty for a point with triangle == -1.
std::vector<int> brush_vertices(GeodesicSearch& search, const SurfacePoint& at, const Brush& brush);

/// A step of a stroke: vertices that the brush touches on its way from one point to the next, ascending. The way is the
/// geodesic line between them, the discs along it are less than a quarter of the radius apart and are found in one search
/// (sides straight to 2 % of the radius). When there is no way of at most three times the straight distance plus the radius
/// (another part, the far side of an edge), the brush jumps: the disc of `to` alone. from.triangle == -1: a click at `to`.
std::vector<int> stroke_vertices(GeodesicSearch& search, const SurfacePoint& from, const SurfacePoint& to,
                                 const Brush& brush);

} // namespace fascicle
