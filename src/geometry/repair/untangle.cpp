#include "fascicle/geometry/mesh_topology.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>

namespace fascicle::detail {

namespace {

/// The corners of the triangles and what is within `rings` edges of them.
std::vector<int> neighbourhood(const TriMesh& mesh, const MeshTopology& topology,
                               const std::vector<int>& triangles, int rings) {
    std::vector<char> listed(mesh.positions.size(), 0);
    std::vector<int> list;
    const auto add = [&](int v) {
        if (!listed[at(v)])
            list.push_back(v);
        listed[at(v)] = 1;
    };
    for (const int t : triangles)
        for (const int v : mesh.triangles[at(t)])
            add(v);
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
        const std::size_t end = list.size();
        for (; begin < end; ++begin)
            for (const int u : topology.vertex_neighbours(list[begin]))
                add(u);
    }
    return list;
}

} // namespace

CrossingReport untangle(RepairMesh& m, CrossingReport crossings, int threads, const JobControl& control) {
    constexpr int most_rounds = 12, steps = 4;
    // Crossings all over the surface are not knots to be smoothed out.
    constexpr double most_triangles = 0.05;
    if (crossings.pairs == 0 ||
        static_cast<double>(crossings.triangles.size()) > most_triangles * m.mesh.triangle_count())
        return crossings;
    const MeshTopology topology(m.mesh.vertex_count(), m.mesh.triangles);
    TriMesh trial = m.mesh;
    CrossingReport now = crossings;
    for (int round = 0; round < most_rounds && now.pairs > 0; ++round) {
        control.checkpoint("untangle", static_cast<double>(round) / most_rounds);
        const std::vector<int> around = neighbourhood(trial, topology, now.triangles, round / 3);
        Points next(around.size());
        for (int step = 0; step < steps; ++step) {
            for (std::size_t i = 0; i < around.size(); ++i) {
                const auto ring = topology.vertex_neighbours(around[i]);
                Vec3 mean = Vec3::Zero();
                for (const int u : ring)
                    mean += trial.positions[at(u)];
                next[i] = 0.5 * (trial.positions[at(around[i])] + mean / static_cast<double>(ring.size()));
            }
            for (std::size_t i = 0; i < around.size(); ++i)
                trial.positions[at(around[i])] = next[i];
        }
        now = find_crossings(trial, threads, control, std::max<std::size_t>(10, crossings.first.size()));
        if (now.pairs < crossings.pairs) {
            crossings = now;
            m.mesh.positions = trial.positions;
        }
    }
    return crossings;
}

} // namespace fascicle::detail
