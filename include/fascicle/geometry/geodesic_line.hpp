#pragma once
// The shortest line on a surface between two points of it.

#include "fascicle/geometry/geodesic_search.hpp"

namespace fascicle {

/// A point of a line, in order of preference: on a vertex (vertex >= 0), where it crosses an edge (edge >= 0, at
/// a + share (b - a)), or inside a triangle (the two ends; both -1). triangle: the one between this point and the next; of the
/// last point its own.
struct LinePoint {
    int vertex = -1;
    int edge = -1;
    int triangle = -1;
    double share = 0;
    Vec3 point = Vec3::Zero();
};

/// points empty: no way within the limit. length: of the polyline, scene units.
struct GeodesicLine {
    std::vector<LinePoint> points;
    double length = 0;
};

/// The shortest path along edges (Dijkstra), then straightened: the path runs through a strip of triangles, in whose
/// unfolding the shortest line is found by the funnel algorithm (Lee & Preparata 1984); where it bends round a vertex with
/// less than pi on the other side, the strip is led round that side, until no vertex is left that could be passed better
/// (Xin & Wang, "Efficiently determining a locally exact shortest path on polyhedral surfaces", CAD 39, 2007).
/// So it is exact among the ways close to the shortest edge path. Vertices where triangles do not form one fan stay.
/// limit: longest edge path tried, scene units. Both points need a triangle (FASCICLE_ASSERT).
GeodesicLine geodesic_line(GeodesicSearch& search, const SurfacePoint& from, const SurfacePoint& to,
                           double limit = std::numeric_limits<double>::infinity());

} // namespace fascicle
