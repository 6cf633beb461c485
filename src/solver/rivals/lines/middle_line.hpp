#pragma once
// The line through the middles of a muscle's cross-sections, from one end to the other.

#include "fascicle/base/types.hpp"

#include <span>
#include <vector>

namespace fascicle::solver {

struct MiddleLine {
    Points points;               ///< at least two
    std::vector<double> lengths; ///< from the first point to each
    double length() const { return lengths.back(); }
    /// share in [0, 1] of the length.
    Vec3 at(double share) const;
};

/// A polyline with its lengths.
MiddleLine with_lengths(Points points);

/// Cross-sections are contours of u, in [0, 1] per vertex, at 31 levels between 0 and 1; middle: that of the contour's length, each
/// triangle's part times the mean of its corners' weights (>= 0). Smoothed a little; a level without a contour is left out.
/// triangles: of the part of the surface; first, last: the ends, which are kept.
MiddleLine middle_line(const Points& rest, std::span<const Tri> triangles, const std::vector<double>& u,
                       const std::vector<double>& weights, const Vec3& first, const Vec3& last);

} // namespace fascicle::solver
