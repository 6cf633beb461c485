#include "solver/classic/classic_edges.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle::classic {

std::vector<DirectedEdge> edge_sweep(const TriMesh& mesh, const MeshTopology& topology,
                                     const std::vector<double>& softness, double stiffness, bool meant) {
    const auto& edges = topology.edges();
    FASCICLE_ASSERT(softness.empty() || softness.size() == edges.size());
    const auto projection = [&](int from, int to, std::size_t edge) {
        const Vec3& a = mesh.positions[static_cast<std::size_t>(from)];
        const Vec3& b = mesh.positions[static_cast<std::size_t>(to)];
        return DirectedEdge{from, to, (a - b).norm(), stiffness * (softness.empty() ? 1.0 : softness[edge])};
    };
    std::vector<DirectedEdge> sweep;
    if (meant) {
        for (std::size_t e = 0; e < edges.size(); ++e)
            sweep.push_back(projection(edges[e].a, edges[e].b, e));
        return sweep;
    }
    // Half-edge 3 t + c walks from corner c of triangle t to the next; sorted by its start, triangles in
    // order.
    std::vector<std::vector<DirectedEdge>> leaving(mesh.positions.size());
    std::vector<std::size_t> edge_of(3 * mesh.triangles.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (const int half_edge : topology.edge_half_edges(static_cast<int>(e)))
            edge_of[static_cast<std::size_t>(half_edge)] = e;
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Tri& tri = mesh.triangles[t];
        if (has_repeated_index(tri))
            continue;
        for (std::size_t c = 0; c < 3; ++c)
            leaving[static_cast<std::size_t>(tri[c])].push_back(
                projection(tri[c], tri[(c + 1) % 3], edge_of[3 * t + c]));
    }
    for (const auto& at_vertex : leaving)
        sweep.insert(sweep.end(), at_vertex.begin(), at_vertex.end());
    return sweep;
}

void project_edges(ClassicState& state, const std::vector<DirectedEdge>& sweep) {
    for (const DirectedEdge& edge : sweep) {
        const auto i = static_cast<std::size_t>(edge.from);
        const auto j = static_cast<std::size_t>(edge.to);
        const double weights = state.inverse_mass[i] + state.inverse_mass[j];
        if (weights < 1e-5)
            continue;
        const Vec3 along = state.candidate[i] - state.candidate[j];
        const double length = along.norm();
        if (!(length > 1e-9 * edge.rest_length))
            continue;
        const Vec3 correction = (1.0 - edge.rest_length / length) * edge.factor * along;
        state.candidate[i] -= state.inverse_mass[i] / weights * correction;
        state.candidate[j] += state.inverse_mass[j] / weights * correction;
    }
}

} // namespace fascicle::classic
