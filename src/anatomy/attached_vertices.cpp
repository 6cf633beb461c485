#include "fascicle/anatomy/attached_vertices.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/region_ops.hpp"

#include <cmath>

namespace fascicle {
namespace {

bool lies_in(const SurfaceRegion& region, const SurfaceGraph& graph, const SurfacePoint& at) {
    double inside = 0;
    const Tri& tri = graph.triangle(at.triangle);
    for (std::size_t k = 0; k < 3; ++k)
        inside += region.contains(tri[k]) ? at.weights[static_cast<Eigen::Index>(k)] : 0.0;
    return inside >= 0.5 - 1e-9;
}

} // namespace

std::vector<AttachedVertex> attached_vertices(const SurfaceRegion& area, GeodesicSearch& bone,
                                              const TriMesh& muscle, const AttachRules& rules) {
    const SurfaceGraph& graph = bone.graph();
    FASCICLE_ASSERT(area.vertex_count() == graph.vertex_count());
    std::vector<AttachedVertex> attached;
    if (area.empty())
        return attached;
    const SurfaceRegion wider = grow(bone, area, rules.border);
    int hint = -1;
    for (int v = 0; v < muscle.vertex_count(); ++v) {
        const SurfacePoint foot = graph.tree().closest(muscle.positions[static_cast<std::size_t>(v)],
                                                       rules.bone * (1.0 + 1e-12), hint);
        if (foot.triangle < 0)
            continue;
        hint = foot.triangle;
        const bool inside = lies_in(area, graph, foot);
        if (inside || lies_in(wider, graph, foot))
            attached.push_back({v, std::sqrt(foot.squared_distance), foot.point, !inside});
    }
    return attached;
}

std::vector<int> vertices_of(const std::vector<AttachedVertex>& attached) {
    std::vector<int> vertices;
    for (const AttachedVertex& a : attached)
        vertices.push_back(a.vertex);
    return vertices;
}

} // namespace fascicle
