#include "fascicle/geometry/region_overlap.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle {

RegionOverlap overlap_of(const SurfaceGraph& graph, const SurfaceRegion& first, const SurfaceRegion& second) {
    FASCICLE_ASSERT(first.vertex_count() == graph.vertex_count() &&
                    second.vertex_count() == graph.vertex_count());
    RegionOverlap result;
    first.for_each([&](int v) {
        result.first += graph.vertex_area(v);
        if (second.contains(v))
            result.both += graph.vertex_area(v);
    });
    second.for_each([&](int v) { result.second += graph.vertex_area(v); });
    return result;
}

} // namespace fascicle
