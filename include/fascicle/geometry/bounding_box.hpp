#pragma once
// Axis-aligned bounding box in the unit of its points.

#include "fascicle/base/types.hpp"

#include <limits>

namespace fascicle {

/// Starts empty (min > max); every add() makes it larger. Non-finite points must not be added.
struct BoundingBox {
    Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

    bool empty() const { return !(min.x() <= max.x()); }
    void add(const Vec3& p) {
        min = min.cwiseMin(p);
        max = max.cwiseMax(p);
    }
    void add(const BoundingBox& other) {
        min = min.cwiseMin(other.min);
        max = max.cwiseMax(other.max);
    }
    /// max - min; zero when empty.
    Vec3 size() const { return empty() ? Vec3::Zero() : Vec3(max - min); }
    /// Length of the space diagonal, >= 0; zero when empty.
    double diagonal() const { return size().norm(); }
    /// Middle of the box; the origin when empty.
    Vec3 center() const { return empty() ? Vec3::Zero() : Vec3(0.5 * (min + max)); }
    /// Whether `other` lies inside, borders included. An empty box lies inside every box.
    bool contains(const BoundingBox& other) const {
        return other.empty() ||
               ((min.array() <= other.min.array()).all() && (other.max.array() <= max.array()).all());
    }
};

/// Box of all points; empty for no points.
BoundingBox bounding_box(const Points& points);

/// Box of the points that triangles use: an unused vertex far away does not count.
BoundingBox bounding_box(const Points& points, const std::vector<Tri>& triangles);

} // namespace fascicle
