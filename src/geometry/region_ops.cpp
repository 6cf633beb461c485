#include "fascicle/geometry/region_ops.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/region_measure.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

bool at_border(const SurfaceGraph& graph, const SurfaceRegion& region, int v) {
    for (const int n : graph.topology().vertex_neighbours(v))
        if (region.contains(n) != region.contains(v))
            return true;
    return false;
}

/// Vertices outside of the region up to a distance from its border, which runs through the middles of edges.
std::vector<int> reached_outside(GeodesicSearch& search, const SurfaceRegion& region, double distance) {
    const SurfaceGraph& graph = search.graph();
    FASCICLE_ASSERT(region.vertex_count() == graph.vertex_count() && distance >= 0.0);
    std::vector<SurfacePoint> border;
    region.for_each([&](int v) {
        const auto neighbours = graph.topology().vertex_neighbours(v);
        const auto edges = graph.vertex_edges(v);
        for (std::size_t k = 0; k < neighbours.size(); ++k)
            if (!region.contains(neighbours[k]))
                for (const int half_edge : graph.topology().edge_half_edges(edges[k])) {
                    border.emplace_back();
                    border.back().triangle = half_edge / 3;
                    border.back().point = 0.5 * (graph.position(v) + graph.position(neighbours[k]));
                }
    });
    GeodesicLimits limits;
    limits.distance = distance;
    limits.passes = [&](int t) {
        const Tri& tri = graph.triangle(t);
        return !region.contains(tri[0]) || !region.contains(tri[1]) || !region.contains(tri[2]);
    };
    search.run(border, limits, WaveFront::plane);
    std::vector<int> outside;
    for (const int v : search.reached())
        if (!region.contains(v))
            outside.push_back(v);
    return outside;
}

} // namespace

SurfaceRegion grow_ring(const SurfaceGraph& graph, const SurfaceRegion& region) {
    SurfaceRegion result = region;
    region.for_each([&](int v) { result.insert(graph.topology().vertex_neighbours(v)); });
    return result;
}

SurfaceRegion shrink_ring(const SurfaceGraph& graph, const SurfaceRegion& region) {
    SurfaceRegion result = region;
    region.for_each([&](int v) {
        if (at_border(graph, region, v))
            result.erase(v);
    });
    return result;
}

SurfaceRegion grow(GeodesicSearch& search, const SurfaceRegion& region, double distance) {
    SurfaceRegion result = region;
    result.insert(reached_outside(search, region, distance));
    return result;
}

SurfaceRegion shrink(GeodesicSearch& search, const SurfaceRegion& region, double distance) {
    if (distance == 0.0)
        return region;
    SurfaceRegion result = region;
    result.erase(reached_outside(search, region.complement(), distance));
    return result;
}

SurfaceRegion connected_part(const SurfaceGraph& graph, const SurfaceRegion& region, int vertex) {
    FASCICLE_ASSERT(region.vertex_count() == graph.vertex_count());
    FASCICLE_ASSERT(vertex >= 0 && vertex < graph.vertex_count());
    const bool inside = region.contains(vertex);
    SurfaceRegion part(graph.vertex_count());
    part.insert(vertex);
    std::vector<int> list{vertex};
    for (std::size_t k = 0; k < list.size(); ++k)
        for (const int n : graph.topology().vertex_neighbours(list[k]))
            if (region.contains(n) == inside && !part.contains(n)) {
                part.insert(n);
                list.push_back(n);
            }
    return part;
}

SurfaceRegion bucket_fill(const SurfaceGraph& graph, const SurfaceRegion& region, int vertex) {
    return region | connected_part(graph, region, vertex);
}

SurfaceRegion bucket_erase(const SurfaceGraph& graph, const SurfaceRegion& region, int vertex) {
    return region.contains(vertex) ? region - connected_part(graph, region, vertex) : region;
}

SurfaceRegion keep_largest(const SurfaceGraph& graph, const SurfaceRegion& region) {
    const auto parts = region_parts(graph, region);
    double most = -1.0;
    const std::vector<int>* largest = nullptr;
    for (const auto& part : parts) {
        double area = 0;
        for (const int v : part)
            area += graph.vertex_area(v);
        if (area > most) {
            most = area;
            largest = &part;
        }
    }
    SurfaceRegion result(graph.vertex_count());
    if (largest != nullptr)
        result.insert(*largest);
    return result;
}

SurfaceRegion fill_holes(const SurfaceGraph& graph, const SurfaceRegion& region, double largest_area) {
    SurfaceRegion result = region;
    for (const auto& hole : region_holes(graph, region)) {
        double area = 0;
        for (const int v : hole)
            area += graph.vertex_area(v);
        if (area <= largest_area)
            result.insert(hole);
    }
    return result;
}

SurfaceRegion smart_fill(const SurfaceGraph& graph, const SmartFill& fill) {
    FASCICLE_ASSERT(fill.triangle >= 0 && fill.triangle < graph.mesh().triangle_count());
    FASCICLE_ASSERT(fill.barrier == nullptr || fill.barrier->vertex_count() == graph.vertex_count());
    SurfaceRegion result(graph.vertex_count());
    const double least_cosine = std::cos(std::clamp(fill.crease_rad, 0.0, 3.141592653589793)) - 1e-12;
    const auto open = [&](int t) {
        bool near = false;
        for (const int v : graph.triangle(t)) {
            if (fill.barrier != nullptr && fill.barrier->contains(v))
                return false;
            near = near || (graph.position(v) - fill.centre).norm() <= fill.reach;
        }
        return near;
    };
    SurfaceRegion seen(graph.mesh().triangle_count()); // of triangles
    std::vector<int> list{fill.triangle};
    seen.insert(fill.triangle);
    for (std::size_t k = 0; k < list.size(); ++k) {
        const int t = list[k];
        result.insert(graph.triangle(t));
        for (const int e : graph.triangle_edges(t)) {
            if (e < 0)
                continue;
            for (const int half_edge : graph.topology().edge_half_edges(e)) {
                const int other = half_edge / 3;
                const bool flat = graph.normal(t).isZero(0) || graph.normal(other).isZero(0) ||
                                  graph.normal(t).dot(graph.normal(other)) >= least_cosine;
                if (!seen.contains(other) && flat && open(other)) {
                    seen.insert(other);
                    list.push_back(other);
                }
            }
        }
    }
    return result;
}

} // namespace fascicle
