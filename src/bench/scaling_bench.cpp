#include "bench/scaling_bench.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/subdivide.hpp"

#include <algorithm>
#include <chrono>

namespace fascicle::bench {

namespace {

using Clock = std::chrono::steady_clock;

std::size_t edge_index(const MeshTopology& topology, int a, int b) {
    const auto& edges = topology.edges();
    const std::pair<int, int> key{std::min(a, b), std::max(a, b)};
    const auto it = std::lower_bound(edges.begin(), edges.end(), key, [](const Edge& edge, const auto& k) {
        return std::pair(edge.a, edge.b) < k;
    });
    FASCICLE_ASSERT(it != edges.end() && it->a == key.first && it->b == key.second);
    return static_cast<std::size_t>(it - edges.begin());
}

/// The old edge that an edge between the middles of two old edges is parallel to: the third side of their triangle.
std::size_t third_side(const MeshTopology& old, const Edge& p, const Edge& q) {
    const int shared = p.a == q.a || p.a == q.b ? p.a : p.b;
    return edge_index(old, p.a == shared ? p.b : p.a, q.a == shared ? q.b : q.a);
}

std::vector<double> refined_softness(const MeshTopology& old, const MeshTopology& fine,
                                     const std::vector<double>& softness) {
    std::vector<double> result;
    result.reserve(fine.edges().size());
    const auto middle_of = [&](int v) { return static_cast<std::size_t>(v - old.vertex_count()); };
    for (const Edge& edge : fine.edges()) // a < b, so only b is new, or both are
        result.push_back(
            softness[edge.a < old.vertex_count()
                         ? middle_of(edge.b)
                         : third_side(old, old.edges()[middle_of(edge.a)], old.edges()[middle_of(edge.b)])]);
    return result;
}

/// Frames of one run: enough of them on small meshes that a clock can tell.
int frames_at(int level) {
    return std::max(3, 40 >> (2 * level));
}

ScalingRow measure(const Scene& scene, const PreparedScene& prepared, const Variant& variant, int level,
                   const RunSettings& settings, const JobControl& control) {
    const SoftBodyProblem& problem = prepared.muscles.front().problem;
    ScalingRow row;
    row.method = variant.name;
    row.level = level;
    row.triangles = problem.surface->triangle_count();
    row.threads = variant.threads;
    const std::string stage = "scaling: " + std::to_string(row.triangles) + " triangles, " + variant.name +
                              ", threads " + std::to_string(variant.threads);
    control.checkpoint(stage, 0.0);
    const std::unique_ptr<BenchBody> body = scene_body(scene, prepared, variant)();
    int frame = 0;
    const auto advance = [&](int count) {
        std::vector<std::vector<Pose>> poses;
        for (int k = 0; k <= count; ++k)
            poses.push_back(bone_poses(scene, frame + k));
        frame += count;
        const auto start = Clock::now();
        for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
            if (control.cancelled())
                throw Cancelled();
            body->advance(poses[k], poses[k + 1]);
        }
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    advance(1);
    const int frames = settings.frames > 0 ? std::min(settings.frames, frames_at(level)) : frames_at(level);
    std::vector<double> ns;
    for (int r = 0; r < settings.runs; ++r) {
        control.checkpoint(stage, double(r) / settings.runs);
        ns.push_back(1e9 * advance(frames) / (double(frames) * variant.passes * row.triangles));
    }
    row.ns = spread_of(ns);
    if (const auto bytes = body->state_bytes())
        row.bytes_per_triangle = double(*bytes) / row.triangles;
    return row;
}

} // namespace

SoftBodyProblem refined(const SoftBodyProblem& problem) {
    const TriMesh& mesh = *problem.surface;
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    Subdivision fine = subdivide(mesh, topology);
    SoftBodyProblem result = problem;
    result.body_of_vertex = subdivided_labels(fine, problem.body_of_vertex);
    if (!problem.carry_weights.empty())
        result.carry_weights = subdivided_values(fine, problem.carry_weights, problem.solids.size());
    if (!problem.edge_softness.empty())
        result.edge_softness = refined_softness(
            topology, MeshTopology(fine.mesh.vertex_count(), fine.mesh.triangles), problem.edge_softness);
    result.surface = std::make_shared<TriMesh>(std::move(fine.mesh));
    return result;
}

std::vector<ScalingRow> measure_scaling(const Scene& scene, const PreparedScene& prepared,
                                        const std::vector<Variant>& variants, int levels,
                                        const RunSettings& settings, const JobControl& control) {
    FASCICLE_ASSERT(prepared.muscles.size() == 1);
    std::vector<ScalingRow> rows;
    PreparedScene current = prepared;
    for (int level = 0; level <= levels; ++level) {
        if (level > 0)
            current.muscles.front().problem = refined(current.muscles.front().problem);
        for (const Variant& variant : variants)
            rows.push_back(measure(scene, current, variant, level, settings, control));
    }
    return rows;
}

} // namespace fascicle::bench
