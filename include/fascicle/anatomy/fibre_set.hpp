#pragma once
// Fibres of one muscle as plain data: the same number of points on each, so that they fit one array.

#include "fascicle/base/types.hpp"

#include <span>

namespace fascicle {

/// count F >= 0 fibres of `segments` R >= 1 segments. points: F x (R + 1), fibre-major, scene units; point 0 of a
/// fibre lies on an origin, point R on an insertion. Fibre f is the same fibre in every frame.
struct FibreSet {
    int count = 0;
    int segments = 1;
    Points points;

    std::size_t points_per_fibre() const { return static_cast<std::size_t>(segments) + 1; }
    std::span<const Vec3> fibre(int f) const {
        return {points.data() + static_cast<std::size_t>(f) * points_per_fibre(), points_per_fibre()};
    }
};

} // namespace fascicle
