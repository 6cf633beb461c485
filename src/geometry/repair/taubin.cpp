#include "fascicle/geometry/repair/taubin.hpp"

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle {

void taubin_smooth(TriMesh& mesh, const TaubinOptions& options, const JobControl& control) {
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<char> stays(mesh.positions.size(), 0);
    for (int e = 0; e < static_cast<int>(topology.edges().size()); ++e)
        if (topology.edge_half_edges(e).size() != 2)
            for (const int v : {topology.edges()[static_cast<std::size_t>(e)].a,
                                topology.edges()[static_cast<std::size_t>(e)].b})
                stays[static_cast<std::size_t>(v)] = 1;
    Points next(mesh.positions.size());
    for (int pass = 0; pass < options.passes; ++pass) {
        control.checkpoint("smooth", static_cast<double>(pass) / options.passes);
        for (const double factor : {options.lambda, options.mu}) {
            for (std::size_t v = 0; v < next.size(); ++v) {
                const auto around = topology.vertex_neighbours(static_cast<int>(v));
                next[v] = mesh.positions[v];
                if (around.empty() || stays[v])
                    continue;
                Vec3 mean = Vec3::Zero();
                for (const int u : around)
                    mean += mesh.positions[static_cast<std::size_t>(u)];
                next[v] += factor * (mean / static_cast<double>(around.size()) - mesh.positions[v]);
            }
            mesh.positions.swap(next);
        }
    }
}

} // namespace fascicle
