#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/region_ops.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

/// Vertices up to `rings` edges from an edge of the border, ascending.
std::vector<int> border_band(const SurfaceGraph& graph, const SurfaceRegion& region, int rings) {
    SurfaceRegion band(graph.vertex_count());
    std::vector<int> list;
    const auto add = [&](int v) {
        if (!band.contains(v)) {
            band.insert(v);
            list.push_back(v);
        }
    };
    region.for_each([&](int v) {
        for (const int n : graph.topology().vertex_neighbours(v))
            if (!region.contains(n)) {
                add(v);
                add(n);
            }
    });
    std::size_t ring = 0;
    for (int r = 1; r < rings; ++r)
        for (const std::size_t end = list.size(); ring < end; ++ring)
            for (const int n : graph.topology().vertex_neighbours(list[ring]))
                add(n);
    std::sort(list.begin(), list.end());
    return list;
}

} // namespace

SurfaceRegion smooth_border(const SurfaceGraph& graph, const SurfaceRegion& region, int passes,
                            const SurfaceRegion* within) {
    FASCICLE_ASSERT(region.vertex_count() == graph.vertex_count() && passes >= 0);
    FASCICLE_ASSERT(within == nullptr || within->vertex_count() == graph.vertex_count());
    if (passes == 0)
        return region;
    const std::vector<int> band = border_band(graph, region, passes);
    std::vector<int> place(static_cast<std::size_t>(graph.vertex_count()), -1); // in the band
    for (std::size_t i = 0; i < band.size(); ++i)
        place[static_cast<std::size_t>(band[i])] = static_cast<int>(i);
    std::vector<double> value, next(band.size());
    for (const int v : band)
        value.push_back(region.contains(v) ? 1.0 : 0.0);
    const double shortest = std::max(1e-6 * graph.mean_edge_length(), 1e-300);
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < band.size(); ++i) {
            const auto neighbours = graph.topology().vertex_neighbours(band[i]);
            const auto edges = graph.vertex_edges(band[i]);
            double sum = 0, weights = 0;
            for (std::size_t k = 0; k < neighbours.size(); ++k) {
                const int at = place[static_cast<std::size_t>(neighbours[k])];
                const double u = at >= 0                          ? value[static_cast<std::size_t>(at)]
                                 : region.contains(neighbours[k]) ? 1.0
                                                                  : 0.0;
                const double weight = 1.0 / std::max(graph.edge_length(edges[k]), shortest);
                sum += weight * u;
                weights += weight;
            }
            next[i] = 0.5 * value[i] + 0.5 * sum / weights; // band vertices have neighbours
        }
        value.swap(next);
    }

    struct Candidate {
        double value;
        bool inside;
        int vertex;
    };
    std::vector<Candidate> candidates;
    double area = 0;
    for (std::size_t i = 0; i < band.size(); ++i) {
        if (within != nullptr && !within->contains(band[i]))
            continue;
        candidates.push_back({value[i], region.contains(band[i]), band[i]});
        area += candidates.back().inside ? graph.vertex_area(band[i]) : 0.0;
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
        if (x.value != y.value)
            return x.value > y.value;
        return x.inside != y.inside ? x.inside : x.vertex < y.vertex;
    });
    SurfaceRegion result = region;
    double kept = 0;
    for (const Candidate& c : candidates) {
        const double half = 0.5 * graph.vertex_area(c.vertex);
        if (kept + half <= area * (1.0 + 1e-12)) {
            result.insert(c.vertex);
            kept += 2.0 * half;
        } else {
            result.erase(c.vertex);
            kept += 2.0 * half; // no smaller vertex behind a larger one slips in
        }
    }
    return result;
}

} // namespace fascicle
