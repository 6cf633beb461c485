#include "fascicle/geometry/region_measure.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

double area_of(const SurfaceGraph& graph, const std::vector<int>& vertices) {
    double sum = 0;
    for (const int v : vertices)
        sum += graph.vertex_area(v);
    return sum;
}

/// Island number of every vertex of the region, -1 elsewhere.
std::vector<int> island_numbers(const SurfaceGraph& graph, const std::vector<std::vector<int>>& islands) {
    std::vector<int> number(z(graph.vertex_count()), -1);
    for (std::size_t i = 0; i < islands.size(); ++i)
        for (const int v : islands[i])
            number[z(v)] = static_cast<int>(i);
    return number;
}

/// A part of the complement at the region's border; not complete: given up as too large.
struct OuterPart {
    std::vector<int> vertices;
    double area = 0;
    bool complete = true;
    double bound = 0; ///< area of the islands that it touches
};

class HoleFinder {
public:
    HoleFinder(const SurfaceGraph& graph, const SurfaceRegion& region,
               const std::vector<std::vector<int>>& islands)
        : graph_(graph), region_(region), island_(island_numbers(graph, islands)),
          visited_(z(graph.vertex_count()), 0) {
        for (const auto& island : islands) {
            island_area_.push_back(area_of(graph, island));
            region_area_ += island_area_.back();
        }
    }

    std::vector<std::vector<int>> find() {
        std::vector<OuterPart> parts;
        std::vector<int> seeds;
        region_.for_each([&](int v) {
            for (const int n : graph_.topology().vertex_neighbours(v))
                if (!region_.contains(n))
                    seeds.push_back(n);
        });
        std::sort(seeds.begin(), seeds.end());
        for (const int seed : seeds)
            if (visited_[z(seed)] == 0)
                parts.push_back(flood(seed));
        // The outside of each component of the surface: a part that was given up, else the largest.
        const auto components = z(graph_.topology().component_count());
        std::vector<const OuterPart*> outside(components, nullptr);
        for (const OuterPart& part : parts) {
            const OuterPart*& most = outside[z(graph_.topology().vertex_component(part.vertices[0]))];
            if (most == nullptr || (most->complete && (!part.complete || part.area > most->area)))
                most = &part;
        }
        std::vector<std::vector<int>> holes;
        for (OuterPart& part : parts)
            if (part.complete && part.area < part.bound &&
                outside[z(graph_.topology().vertex_component(part.vertices[0]))] != &part) {
                std::sort(part.vertices.begin(), part.vertices.end());
                holes.push_back(part.vertices);
            }
        std::sort(holes.begin(), holes.end());
        return holes;
    }

private:
    OuterPart flood(int seed) {
        OuterPart part;
        part.vertices.assign(1, seed);
        visited_[z(seed)] = 1;
        std::vector<int> touched;
        for (std::size_t k = 0; k < part.vertices.size() && part.complete; ++k) {
            const int v = part.vertices[k];
            part.area += graph_.vertex_area(v);
            part.complete = part.area < region_area_;
            for (const int n : graph_.topology().vertex_neighbours(v))
                if (region_.contains(n)) {
                    touched.push_back(island_[z(n)]);
                } else if (visited_[z(n)] == 0) {
                    visited_[z(n)] = 1;
                    part.vertices.push_back(n);
                } else if (visited_[z(n)] == 2) {
                    part.complete = false; // the same part as one that was given up
                }
        }
        for (const int v : part.vertices)
            visited_[z(v)] = part.complete ? char(1) : char(2);
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        for (const int island : touched)
            part.bound += island_area_[z(island)];
        return part;
    }

    const SurfaceGraph& graph_;
    const SurfaceRegion& region_;
    std::vector<int> island_;
    std::vector<char> visited_; ///< 1: seen, 2: of a part that was given up
    std::vector<double> island_area_;
    double region_area_ = 0;
};

} // namespace

std::vector<std::vector<int>> region_parts(const SurfaceGraph& graph, const SurfaceRegion& region) {
    FASCICLE_ASSERT(region.vertex_count() == graph.vertex_count());
    SurfaceRegion left = region;
    std::vector<std::vector<int>> parts;
    region.for_each([&](int seed) {
        if (!left.contains(seed))
            return;
        std::vector<int> part{seed};
        left.erase(seed);
        for (std::size_t k = 0; k < part.size(); ++k)
            for (const int n : graph.topology().vertex_neighbours(part[k]))
                if (left.contains(n)) {
                    left.erase(n);
                    part.push_back(n);
                }
        std::sort(part.begin(), part.end());
        parts.push_back(std::move(part));
    });
    return parts;
}

std::vector<std::vector<int>> region_holes(const SurfaceGraph& graph, const SurfaceRegion& region) {
    return HoleFinder(graph, region, region_parts(graph, region)).find();
}

RegionMeasure measure_region(const SurfaceGraph& graph, const SurfaceRegion& region) {
    const auto islands = region_parts(graph, region);
    RegionMeasure measure;
    measure.islands = static_cast<int>(islands.size());
    Vec3 weighted = Vec3::Zero(), sum = Vec3::Zero();
    region.for_each([&](int v) {
        ++measure.vertices;
        measure.area += graph.vertex_area(v);
        weighted += graph.vertex_area(v) * graph.position(v);
        sum += graph.position(v);
    });
    if (measure.area > 0.0)
        measure.centroid = weighted / measure.area;
    else if (measure.vertices > 0)
        measure.centroid = sum / double(measure.vertices);
    measure.holes = static_cast<int>(HoleFinder(graph, region, islands).find().size());
    return measure;
}

} // namespace fascicle
