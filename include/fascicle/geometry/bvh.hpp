#pragma once
// Bounding volume hierarchy over a triangle surface: exact closest points.

#include "fascicle/geometry/tri_mesh.hpp"

#include <limits>
#include <vector>

namespace fascicle {

/// triangle: number in the mesh, -1 when nothing lies within reach (the rest then has no meaning). weights:
/// barycentric, of the triangle's corners.
struct SurfacePoint {
    int triangle = -1;
    double squared_distance = std::numeric_limits<double>::infinity();
    Vec3 point = Vec3::Zero();
    Vec3 weights = Vec3::Zero();
};

/// One crossing of a line and a triangle: p = origin + position * direction. entering: the line runs against the outward
/// normal there.
struct LineHit {
    double position = 0;
    int triangle = -1;
    bool entering = false;
};

/// Where a ray meets a surface: origin + distance * direction. triangle == -1: nowhere.
struct RayHit {
    int triangle = -1;
    double distance = std::numeric_limits<double>::infinity(); ///< in lengths of the direction
};

/// Keeps its own copy of the corners. Queries are const, allocate nothing and may run on several threads.
class TriangleBvh {
public:
    TriangleBvh() = default;
    /// Indices must be in range and positions finite; triangles without area count as segments or points.
    TriangleBvh(const Points& points, const std::vector<Tri>& triangles);
    explicit TriangleBvh(const TriMesh& mesh) : TriangleBvh(mesh.positions, mesh.triangles) {}

    /// Same triangles, moved points: recomputes corners and boxes and keeps the grouping. Exact for any
    /// motion; slow only when neighbours part.
    void refit(const Points& points);

    /// Nearest surface point with squared_distance < max_distance^2; triangle == -1 when there is none (also
    /// for a p that is not finite). Of equally near triangles the one met first, which depends on p,
    /// max_distance and hint alone. hint: a triangle that is probably near (its distance bounds the search),
    /// or -1.
    SurfacePoint closest(const Vec3& p, double max_distance = std::numeric_limits<double>::infinity(),
                         int hint = -1) const;
    /// closest(...) without the foot: squared distance, and the triangle in `hint` (unchanged when nothing
    /// lies within reach, and max_distance^2 is returned). good_enough: as soon as a triangle is met within
    /// that distance the search ends with it, nearest or not.
    double closest_squared_distance(const Vec3& p, double max_distance, int& hint,
                                    double good_enough = 0.0) const;

    /// Appends every crossing of the whole line origin + t direction, t from -infinity to infinity, in no particular
    /// order. A crossing on the common edge of two triangles is found in at least one of them, so that no closed surface
    /// lets a line through (edge functions as in Woop, Benthin, Wald 2013, "Watertight ray/triangle intersection");
    /// it may be found in both. A triangle that the line lies in is passed over. direction: any length, not zero.
    void line_hits(const Vec3& origin, const Vec3& direction, std::vector<LineHit>& hits) const;
    /// First triangle that the ray meets with from < distance < to, from either side; of equally near ones the lowest.
    /// Triangles seen edge-on (determinant below 1e-12 of the product of the lengths) are missed.
    RayHit ray_hit(const Vec3& origin, const Vec3& direction, double from = 0.0,
                   double to = std::numeric_limits<double>::infinity()) const;
    /// Whether the ray meets any triangle with from < distance < to.
    bool blocked(const Vec3& origin, const Vec3& direction, double from, double to) const;

    int triangle_count() const { return static_cast<int>(slot_of_.size()); }
    std::size_t bytes() const;

private:
    /// Boxes of 4 children, coordinate by coordinate; boxes of absent children are inverted (infinitely far).
    /// child >= 0: a node; else leaf ~child.
    struct alignas(16) Node {
        std::array<std::array<double, 4>, 3> low;
        std::array<std::array<double, 4>, 3> high;
        std::array<int, 4> child;
    };
    /// 4 triangles side by side: [corner][coordinate][lane]; spare lanes repeat the last triangle.
    struct alignas(16) Leaf {
        std::array<std::array<std::array<double, 4>, 3>, 3> corners;
    };
    struct Nearest {
        double squared_distance;
        int slot; ///< 4 * leaf + lane, or -1
    };
    void search(const Vec3& p, double stop, Nearest& best) const;
    static void try_leaf(const Leaf& leaf, int number, const Vec3& p, Nearest& best);
    void fit_boxes();
    RayHit trace(const Vec3& origin, const Vec3& direction, double from, double to, bool any) const;

    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
    std::vector<Tri> slot_vertices_; ///< by slot, spare lanes too
    std::vector<int> slot_of_;       ///< triangle -> slot
    std::vector<int> triangle_of_;   ///< slot -> triangle
};

} // namespace fascicle
