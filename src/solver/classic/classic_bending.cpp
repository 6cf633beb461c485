#include "solver/classic/classic_bending.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::classic {

namespace {

// Meant equations: the largest error that one projection takes on. The linearised constraint holds for small
// turns only; without a bound a stiffness of 0.9 and more blows the muscles up (measured, docs/classic.md),
// which is what the program's window hides.
constexpr double longest_turn_rad = 0.5;

/// Lowest triangle at a half-edge's edge that is not the half-edge's own, and its wing vertex; -1 when alone.
struct Neighbour {
    int triangle = -1;
    int wing = -1;
};

Neighbour neighbour_of(const TriMesh& mesh, const MeshTopology& topology, int edge, int triangle) {
    for (const int half_edge : topology.edge_half_edges(edge)) {
        if (half_edge / 3 == triangle)
            continue;
        const Tri& other = mesh.triangles[static_cast<std::size_t>(half_edge / 3)];
        return {half_edge / 3, other[static_cast<std::size_t>((half_edge + 2) % 3)]};
    }
    return {};
}

} // namespace

std::vector<BendingPair> bending_pairs(const TriMesh& mesh, const MeshTopology& topology) {
    std::vector<int> edge_of(3 * mesh.triangles.size(), -1);
    for (std::size_t e = 0; e < topology.edges().size(); ++e) {
        for (const int half_edge : topology.edge_half_edges(static_cast<int>(e)))
            edge_of[static_cast<std::size_t>(half_edge)] = static_cast<int>(e);
    }
    const auto point = [&](int v) -> const Vec3& { return mesh.positions[static_cast<std::size_t>(v)]; };
    const auto normal = [&](int triangle) {
        const Tri& t = mesh.triangles[static_cast<std::size_t>(triangle)];
        return Vec3((point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0])));
    };
    std::vector<BendingPair> pairs;
    for (int t = 0; t < mesh.triangle_count(); ++t) {
        const Tri& tri = mesh.triangles[static_cast<std::size_t>(t)];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            // Opposite to `corner` lies the half-edge that leaves the next corner.
            const std::size_t next = (corner + 1) % 3;
            const int edge = edge_of[3 * static_cast<std::size_t>(t) + next];
            if (edge < 0)
                continue;
            const Neighbour other = neighbour_of(mesh, topology, edge, t);
            if (other.triangle < 0 || other.triangle > t)
                continue;
            const Vec3 n1 = normal(t), n2 = normal(other.triangle);
            const double scale = n1.norm() * n2.norm();
            if (!(scale > 0.0))
                continue;
            const double rest = std::acos(std::clamp(n1.dot(n2) / scale, -1.0, 1.0));
            pairs.push_back({tri[next], tri[(corner + 2) % 3], other.wing, tri[corner], rest});
        }
    }
    return pairs;
}

std::optional<BendingTerms> bending_terms(const Vec3& p1, const Vec3& p2_abs, const Vec3& p3_abs,
                                          const Vec3& p4_abs) {
    const Vec3 p2 = p2_abs - p1, p3 = p3_abs - p1, p4 = p4_abs - p1;
    Vec3 n1 = p2.cross(p3), n2 = p2.cross(p4);
    const double least = 1e-12 * p2.squaredNorm() * p2.squaredNorm();
    if (!(n1.squaredNorm() >= least && n2.squaredNorm() >= least && least > 0.0))
        return std::nullopt;
    const double area3 = n1.norm(), area4 = n2.norm();
    n1 /= area3;
    n2 /= area4;
    const double d = n1.dot(n2);
    if (d > 1.0 - 1e-10 || d < -1.0 + 1e-10)
        return std::nullopt;
    BendingTerms terms;
    terms.cosine = d;
    terms.angle_rad = std::acos(d);
    terms.q3 = (p2.cross(n2) + d * n1.cross(p2)) / area3;
    terms.q4 = (p2.cross(n1) + d * n2.cross(p2)) / area4;
    terms.q2 = -(p3.cross(n2) + d * n1.cross(p3)) / area3 - (p4.cross(n1) + d * n2.cross(p4)) / area4;
    terms.q1 = -terms.q2 - terms.q3 - terms.q4;
    return terms;
}

void project_bending(ClassicState& state, const std::vector<BendingPair>& pairs, double bending, bool meant) {
    for (const BendingPair& pair : pairs) {
        const std::array<std::size_t, 4> index{
            static_cast<std::size_t>(pair.p1), static_cast<std::size_t>(pair.p2),
            static_cast<std::size_t>(pair.p3), static_cast<std::size_t>(pair.p4)};
        const auto terms = bending_terms(state.candidate[index[0]], state.candidate[index[1]],
                                         state.candidate[index[2]], state.candidate[index[3]]);
        if (!terms)
            continue;
        const std::array<Vec3, 4> q{terms->q1, terms->q2, terms->q3, terms->q4};
        double weights = 0.0, squares = 0.0, weighted_squares = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            weights += state.inverse_mass[index[i]];
            squares += q[i].squaredNorm();
            weighted_squares += state.inverse_mass[index[i]] * q[i].squaredNorm();
        }
        const double error = terms->angle_rad - (std::numbers::pi - pair.rest_rad);
        const double sine = std::sqrt(1.0 - terms->cosine * terms->cosine);
        double ratio = 0.0;
        if (meant) {
            const double turn = std::clamp(error, -longest_turn_rad, longest_turn_rad);
            ratio = -sine * turn * bending / weighted_squares;
            if (!std::isfinite(ratio)) // all four fixed
                continue;
        } else {
            ratio = -4.0 * sine * error * bending / (std::max(1e-4, squares) * weights);
            if (ratio < 0.1 || ratio > 10.0)
                continue;
        }
        for (std::size_t i = 0; i < 4; ++i)
            state.candidate[index[i]] += ratio * state.inverse_mass[index[i]] * q[i];
    }
}

} // namespace fascicle::classic
