#pragma once
// Generalised winding number of a triangle surface: how many times it is wound around a point.

#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Signed solid angle of the triangle abc seen from the origin, in (-2 pi, 2 pi]; positive when the origin is
/// on its inner side (the corners run clockwise seen from the origin). tan(O/2) = det(a, b, c) /
/// (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|) by atan2 (van Oosterom & Strackee 1983). 0 for a triangle
/// without area and for a point at a corner.
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c);

/// w(p) = 1/(4 pi) sum of solid angles (Jacobson, Kavan, Sorkine-Hornung 2013). 1 inside a closed surface
/// with outward triangles, 0 outside, fractions near holes, sums for overlapping parts; jumps by 1 across the
/// surface. Copies the corners; queries are const, allocate nothing and may run on several threads.
class WindingNumber {
public:
    WindingNumber() = default;
    WindingNumber(const Points& points, const std::vector<Tri>& triangles);
    explicit WindingNumber(const TriMesh& mesh) : WindingNumber(mesh.positions, mesh.triangles) {}

    /// Sum over all triangles, in their order: O(T), the reference.
    double exact(const Vec3& p) const;

    /// A group of triangles that lies within radius r of its area-weighted centroid c counts, from farther
    /// than beta r, by the first two terms of its expansion (Barill, Dickson, Schmidt, Levin, Jacobson 2018,
    /// "Fast winding numbers for soups and clouds"): with d = c - p, area vectors a_t and centroids c_t of
    /// its triangles, A = sum a_t, M = sum a_t (c_t - c)^T,
    ///   4 pi w = A . d / |d|^3 + tr(M) / |d|^3 - 3 d^T M d / |d|^5.
    /// Nearer groups are opened, down to the triangles' solid angles. beta >= 2. Largest error seen on bones,
    /// test shapes: 0.07 at beta = 2, 0.0003 at 6.
    double fast(const Vec3& p, double beta = 2.0) const;

    /// Whether w(p) > 0.5: by fast(p, 2) unless that is within 0.1 of 0.5, then by exact(p).
    bool inside(const Vec3& p) const;

    int triangle_count() const { return static_cast<int>(corners_.size()); }

private:
    struct Group {
        Vec3 centre = Vec3::Zero();
        Vec3 area = Vec3::Zero();   ///< sum of area vectors
        Mat3 moment = Mat3::Zero(); ///< M above
        double radius = 0;
        int begin = 0, end = 0; ///< slots
        int node = -1;          ///< -1: a leaf
    };
    struct Node {
        std::array<Group, 4> groups;
        int count = 0;
    };
    void fit_group(Group& group) const;

    std::vector<Node> nodes_;
    std::vector<std::array<Vec3, 3>> corners_; ///< by slot
    std::vector<int> slot_of_;                 ///< slot of a triangle
};

} // namespace fascicle
