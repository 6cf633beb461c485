#include "fascicle/geometry/bounding_box.hpp"

namespace fascicle {

BoundingBox bounding_box(const Points& points) {
    BoundingBox box;
    for (const Vec3& p : points)
        box.add(p);
    return box;
}

BoundingBox bounding_box(const Points& points, const std::vector<Tri>& triangles) {
    BoundingBox box;
    for (const Tri& t : triangles)
        for (const int v : t)
            box.add(points[static_cast<std::size_t>(v)]);
    return box;
}

} // namespace fascicle
