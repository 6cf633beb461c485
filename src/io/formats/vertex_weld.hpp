#pragma once
// Equal points become one vertex: for formats that have corners instead of vertices.

#include "fascicle/base/types.hpp"

#include <vector>

namespace fascicle::io {

/// Numbers points in the order in which each is first seen; equal coordinates (0 and -0 are equal) give the same number. A hash
/// table without deletion, so that the time does not depend on how many points coincide.
class VertexWeld {
public:
    /// Number of the point; it is the last one of points() when it is new.
    int add(const Vec3& p);
    const Points& points() const { return points_; }
    Points take() { return std::move(points_); }

private:
    void grow();

    Points points_;
    std::vector<int> slots_; ///< numbers of points, -1 where empty; a power of two
};

} // namespace fascicle::io
