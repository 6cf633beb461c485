#include "fascicle/anatomy/harmonic_field.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <cmath>

namespace fascicle {

namespace {

/// Cotangent weight per edge of the topology.
std::vector<double> edge_weights(const TriMesh& mesh, const MeshTopology& topology) {
    const std::size_t count = topology.edges().size();
    std::vector<double> weights(count, 0.0);
    for (std::size_t e = 0; e < count; ++e)
        for (const int half_edge : topology.edge_half_edges(static_cast<int>(e))) {
            const Tri& t = mesh.triangles[static_cast<std::size_t>(half_edge / 3)];
            const int corner = half_edge % 3;
            const auto at = [&](int k) {
                return mesh.positions[static_cast<std::size_t>(t[std::size_t(k % 3)])];
            };
            const Vec3 u = at(corner) - at(corner + 2), v = at(corner + 1) - at(corner + 2);
            weights[e] += 0.5 * u.dot(v) / u.cross(v).norm();
        }
    double sum = 0;
    std::size_t positive = 0;
    for (const double w : weights)
        if (std::isfinite(w) && w > 0.0) {
            sum += w;
            ++positive;
        }
    const double floor = positive > 0 ? 1e-6 * sum / double(positive) : 1.0;
    for (double& w : weights)
        if (!std::isfinite(w) || w < floor)
            w = floor;
    return weights;
}

} // namespace

std::vector<double> solve_harmonic(const TriMesh& mesh, const MeshTopology& topology,
                                   const std::vector<bool>& fixed, const std::vector<double>& values,
                                   int fields) {
    const std::size_t n = mesh.positions.size();
    const auto columns = static_cast<std::size_t>(fields);
    FASCICLE_ASSERT(fixed.size() == n && values.size() == n * columns);
    std::vector<bool> component_held(static_cast<std::size_t>(topology.component_count()), false);
    for (std::size_t i = 0; i < n; ++i)
        if (const int c = topology.vertex_component(static_cast<int>(i)); fixed[i] && c >= 0)
            component_held[static_cast<std::size_t>(c)] = true;
    std::vector<int> unknown(n, -1);
    int unknowns = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const int c = topology.vertex_component(static_cast<int>(i));
        if (!fixed[i] && c >= 0 && component_held[static_cast<std::size_t>(c)])
            unknown[i] = unknowns++;
    }
    std::vector<double> result = values;
    if (unknowns == 0)
        return result;

    const std::vector<double> weights = edge_weights(mesh, topology);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(topology.edges().size() * 4);
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, fields);
    for (std::size_t e = 0; e < weights.size(); ++e) {
        const auto a = static_cast<std::size_t>(topology.edges()[e].a);
        const auto b = static_cast<std::size_t>(topology.edges()[e].b);
        for (const auto& [i, j] : {std::pair{a, b}, std::pair{b, a}}) {
            if (unknown[i] < 0)
                continue;
            entries.emplace_back(unknown[i], unknown[i], weights[e]);
            if (unknown[j] >= 0)
                entries.emplace_back(unknown[i], unknown[j], -weights[e]);
            else
                for (std::size_t c = 0; c < columns; ++c)
                    right(unknown[i], static_cast<Eigen::Index>(c)) += weights[e] * values[j * columns + c];
        }
    }
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
    if (factor.info() != Eigen::Success)
        throw_error("harmonic field", "the system of " + std::to_string(unknowns) + " unknowns is singular",
                    "a connected surface with attachments");
    const Eigen::MatrixXd solution = factor.solve(right);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < columns && unknown[i] >= 0; ++c)
            result[i * columns + c] = solution(unknown[i], static_cast<Eigen::Index>(c));
    return result;
}

Points triangle_gradients(const TriMesh& mesh, const std::vector<double>& field) {
    FASCICLE_ASSERT(field.size() == mesh.positions.size());
    Points gradients(mesh.triangles.size(), Vec3::Zero());
    for (std::size_t t = 0; t < gradients.size(); ++t) {
        const auto a = static_cast<std::size_t>(mesh.triangles[t][0]);
        const auto b = static_cast<std::size_t>(mesh.triangles[t][1]);
        const auto c = static_cast<std::size_t>(mesh.triangles[t][2]);
        const Vec3 &pa = mesh.positions[a], &pb = mesh.positions[b], &pc = mesh.positions[c];
        const Vec3 normal = (pb - pa).cross(pc - pa);
        const double squared = normal.squaredNorm();
        if (squared == 0.0)
            continue;
        // grad = n x sum_i u_i e_i / |n|^2 with e_i the side opposite of vertex i and |n| twice the area.
        gradients[t] =
            normal.cross(field[a] * (pc - pb) + field[b] * (pa - pc) + field[c] * (pb - pa)) / squared;
    }
    return gradients;
}

} // namespace fascicle
