#pragma once
// The plane that a view is cut open with.

#include "fascicle/base/types.hpp"

namespace fascicle::view {

/// What has normal . p <= position is kept; the side that the normal points to is taken away.
struct SectionPlane {
    Vec3 normal = Vec3::UnitX(); ///< unit length
    double position = 0;         ///< scene units along the normal, from the origin

    bool keeps(const Vec3& p) const { return normal.dot(p) <= position; }
    bool operator==(const SectionPlane& other) const {
        return normal == other.normal && position == other.position;
    }
};

} // namespace fascicle::view
