#include "fascicle/metrics/muscle_overlap.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr std::size_t chunk = 64;

std::vector<int> used_vertices(const TriMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const Tri& t : mesh.triangles)
        for (const int v : t)
            used[static_cast<std::size_t>(v)] = true;
    std::vector<int> list;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v])
            list.push_back(static_cast<int>(v));
    return list;
}

/// The value listed for a vertex, 0 when there is none.
double at_vertex(const std::vector<std::pair<int, double>>& list, int vertex) {
    const auto it = std::lower_bound(list.begin(), list.end(), vertex,
                                     [](const auto& entry, int v) { return entry.first < v; });
    return it != list.end() && it->first == vertex ? it->second : 0.0;
}

} // namespace

MuscleOverlapMeasure::MuscleOverlapMeasure(ScenePtr scene, const Frame& rest, int threads)
    : scene_(std::move(scene)), threads_(threads) {
    const std::size_t count = scene_->muscles.size();
    if (count < 2)
        return;
    surfaces_.resize(count);
    for (const Muscle& muscle : scene_->muscles)
        used_.push_back(used_vertices(*muscle.mesh));
    take(rest);
    rest_.resize(count);
    for (std::size_t m = 0; m < count; ++m)
        for (std::size_t other = 0; other < count; ++other)
            rest_[m].push_back(m == other ? Depths{} : depths(m, other));
}

void MuscleOverlapMeasure::take(const Frame& frame) {
    FASCICLE_ASSERT(frame.muscle_positions.size() == surfaces_.size());
    for (std::size_t m = 0; m < surfaces_.size(); ++m) {
        Surface& surface = surfaces_[m];
        surface.points = *frame.muscle_positions[m];
        FASCICLE_ASSERT(surface.points.size() == scene_->muscles[m].mesh->positions.size());
        surface.box = {};
        surface.winding.reset();
        const bool finite = std::all_of(surface.points.begin(), surface.points.end(),
                                        [](const Vec3& p) { return p.allFinite(); });
        if (finite)
            surface.box = bounding_box(surface.points, scene_->muscles[m].mesh->triangles);
    }
}

void MuscleOverlapMeasure::prepare(std::size_t muscle) {
    Surface& surface = surfaces_[muscle];
    if (surface.winding)
        return;
    const std::vector<Tri>& triangles = scene_->muscles[muscle].mesh->triangles;
    surface.winding.emplace(surface.points, triangles);
    if (surface.has_tree)
        surface.tree.refit(surface.points);
    else
        surface.tree = TriangleBvh(surface.points, triangles);
    surface.has_tree = true;
}

MuscleOverlapMeasure::Depths MuscleOverlapMeasure::depths(std::size_t muscle, std::size_t other) {
    const Points& points = surfaces_[muscle].points;
    const BoundingBox box = surfaces_[other].box;
    Depths result;
    for (const int v : used_[muscle]) {
        const Vec3& p = points[static_cast<std::size_t>(v)]; // NaN compares false
        if ((p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all())
            result.emplace_back(v, 0.0);
    }
    if (result.empty())
        return result;
    prepare(other);
    const Surface& surface = surfaces_[other];
    parallel_for(threads_, result.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3& p = points[static_cast<std::size_t>(result[i].first)];
            int hint = -1;
            if (surface.winding->inside(p))
                result[i].second = std::sqrt(
                    surface.tree.closest_squared_distance(p, std::numeric_limits<double>::infinity(), hint));
        }
    });
    std::erase_if(result, [](const auto& entry) { return !(entry.second > 0.0); });
    return result;
}

std::vector<double> MuscleOverlapMeasure::measure(const Frame& frame) {
    std::vector<double> largest(scene_->muscles.size(), 0.0);
    if (surfaces_.empty())
        return largest;
    take(frame);
    for (std::size_t m = 0; m < surfaces_.size(); ++m)
        for (std::size_t other = 0; other < surfaces_.size(); ++other) {
            if (m == other)
                continue;
            for (const auto& [v, depth] : depths(m, other))
                largest[m] = std::max(largest[m], depth - at_vertex(rest_[m][other], v));
        }
    for (double& value : largest)
        value *= millimetres_per_unit(scene_->unit);
    return largest;
}

} // namespace fascicle
