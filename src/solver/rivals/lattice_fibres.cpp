#include "solver/rivals/lattice_fibres.hpp"

#include "fascicle/geometry/vertex_normals.hpp"
#include "solver/rivals/lattice_fields.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

} // namespace

std::vector<double> edge_squares(const SoftBodyProblem& problem, std::size_t edges) {
    if (problem.edge_along.size() == edges)
        return problem.edge_along;
    const double exponent = problem.parameters.get("solver.anisotropy");
    if (problem.edge_softness.size() != edges || !(exponent > 0.0))
        return {};
    std::vector<double> squares;
    for (const double k : problem.edge_softness) {
        const double cosine = 1.0 - std::pow(k, 1.0 / exponent);
        squares.push_back(cosine * cosine);
    }
    return squares;
}

std::vector<Mat3> vertex_fibre_matrices(const TriMesh& surface, const MeshTopology& topology,
                                        const std::vector<double>& squares) {
    const Points normals = vertex_normals(surface.positions, surface.triangles);
    std::vector<std::vector<int>> edges_of(surface.positions.size());
    for (std::size_t e = 0; e < topology.edges().size(); ++e)
        for (const int v : {topology.edges()[e].a, topology.edges()[e].b})
            edges_of[at(v)].push_back(static_cast<int>(e));
    std::vector<Mat3> matrices(surface.positions.size(), Mat3::Zero());
    for (std::size_t v = 0; v < matrices.size(); ++v) {
        const Vec3& n = normals[v];
        if (n.isZero(0.0))
            continue;
        const Vec3 p = n.unitOrthogonal(), q = n.cross(p);
        Mat3 left = 1e-6 * Mat3::Identity();
        Vec3 right = Vec3::Zero();
        for (const int e : edges_of[v]) {
            const Edge& edge = topology.edges()[at(e)];
            const Vec3 u = surface.positions[at(edge.b)] - surface.positions[at(edge.a)];
            const Vec2 in_plane(u.dot(p), u.dot(q));
            if (!(in_plane.norm() > 1e-3 * u.norm()))
                continue;
            const Vec2 d = in_plane.normalized();
            const Vec3 row(d.x() * d.x(), 2.0 * d.x() * d.y(), d.y() * d.y());
            left += row * row.transpose();
            right += squares[at(e)] * row;
        }
        const Vec3 m = left.ldlt().solve(right);
        matrices[v] = m[0] * p * p.transpose() + m[1] * (p * q.transpose() + q * p.transpose()) +
                      m[2] * q * q.transpose();
    }
    return matrices;
}

std::vector<Vec3> lattice_fibres(const EmbeddingLattice& lattice, const std::vector<Mat3>& matrices) {
    constexpr int smoothing = 3;
    std::vector<double> values, counts;
    for (const Mat3& m : matrices) {
        values.insert(values.end(), m.data(), m.data() + 9);
        counts.push_back(m.isZero(1e-3) ? 0.0 : 1.0);
    }
    const std::vector<double> nodes = node_values(lattice, values, 9, counts, smoothing);
    std::vector<Vec3> fibres;
    for (const Tet& tet : lattice.tets) {
        Mat3 m = Mat3::Zero();
        for (const int node : tet)
            m += Eigen::Map<const Mat3>(nodes.data() + 9 * at(node));
        if (m.isZero(1e-6)) {
            fibres.push_back(Vec3::Zero());
            continue;
        }
        Vec3 axis = Eigen::SelfAdjointEigenSolver<Mat3>(m).eigenvectors().col(2);
        int largest = 0;
        axis.cwiseAbs().maxCoeff(&largest);
        fibres.push_back(axis[largest] < 0.0 ? Vec3(-axis) : axis);
    }
    return fibres;
}

} // namespace fascicle::solver
