#include "solver/rivals/lattice_body.hpp"

#include "fascicle/base/assert.hpp"
#include "solver/rivals/lattice_fibres.hpp"
#include "solver/rivals/lattice_fields.hpp"
#include "solver/rivals/tet_statics.hpp"

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

LatticeOptions lattice_options(const SoftBodyProblem& problem, double spacing_mm) {
    LatticeOptions options;
    options.spacing = spacing_mm / problem.unit_mm;
    options.threads = problem.threads;
    return options;
}

} // namespace

LatticeBody::LatticeBody(const SoftBodyProblem& problem, double spacing_mm)
    : RivalBody(problem),
      lattice_(make_embedding_lattice(*problem.surface, lattice_options(problem, spacing_mm))),
      nodes_(lattice_.nodes), areas_(rest().size(), 0.0) {
    for (const Tri& t : problem.surface->triangles) {
        const Vec3 &a = rest()[at(t[0])], &b = rest()[at(t[1])], &c = rest()[at(t[2])];
        for (const int v : t)
            areas_[at(v)] += (b - a).cross(c - a).norm() / 6.0;
    }
    if (!problem.carry_weights.empty())
        node_shares_ = node_values(lattice_, problem.carry_weights, problem.solids.size(),
                                   std::vector<double>(rest().size(), 1.0), 0);
    const auto squares = edge_squares(problem, topology().edges().size());
    fibres_.assign(lattice_.tets.size(), Vec3::Zero());
    if (!squares.empty())
        fibres_ = lattice_fibres(lattice_, vertex_fibre_matrices(*problem.surface, topology(), squares));
}

std::size_t LatticeBody::state_bytes() const {
    return RivalBody::state_bytes() + lattice_.bytes() + bytes_of(nodes_, node_shares_, fibres_, areas_);
}

bool LatticeBody::set_state(const Points& positions, const Points&) {
    FASCICLE_ASSERT(positions.size() == x().size());
    if (positions == x())
        return true;
    constexpr double stiff = 1000.0; // as attached vertices (fem_body.hpp), with a Young's modulus of 1
    StaticsSettings settings;
    settings.force_scale = lattice_.spacing * lattice_.spacing;
    settings.tolerance = 1e-3;
    settings.most_steps = 30;
    settings.threads = problem().threads;
    TetStatics fit(lattice_.nodes, lattice_.tets, lattice_.fill, {}, material_from(1.0, 0.4), settings);
    std::vector<double> moves, counts(positions.size(), 0.0);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 move = positions[i] - rest()[i];
        moves.insert(moves.end(), {move.x(), move.y(), move.z()});
        if (lattice_.bindings[i].tet < 0)
            continue;
        counts[i] = 1.0;
        fit.pulls().push_back({lattice_.bindings[i], positions[i], stiff * areas_[i] / lattice_.spacing});
    }
    const std::vector<double> node_moves = node_values(lattice_, moves, 3, counts, 0);
    Points nodes = lattice_.nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n)
        nodes[n] += Vec3(node_moves[3 * n], node_moves[3 * n + 1], node_moves[3 * n + 2]);
    fit.solve(nodes);
    for (const Vec3& p : nodes)
        if (!p.allFinite())
            return false;
    nodes_ = std::move(nodes);
    x() = positions;
    return true;
}

void LatticeBody::carry_nodes() {
    if (node_shares_.empty())
        return;
    const std::size_t count = solids().size();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        Vec3 shift = Vec3::Zero();
        for (std::size_t b = 0; b < count; ++b)
            if (const double w = node_shares_[n * count + b]; w != 0.0)
                shift += w * (solids()[b].now.apply(solids()[b].before.apply_inverse(nodes_[n])) - nodes_[n]);
        nodes_[n] += shift;
    }
}

void LatticeBody::skin() {
    for (std::size_t i = 0; i < x().size(); ++i)
        if (is_free(i))
            x()[i] = lattice_.bound_point(i, nodes_);
}

std::vector<std::uint8_t> LatticeBody::loose_nodes() const {
    const std::vector<int> part = lattice_parts(lattice_);
    std::vector<std::uint8_t> held(part.size(), 0), loose(part.size(), 0); // held: by part
    for (std::size_t i = 0; i < rest().size(); ++i)
        if (problem().body_of_vertex[i] >= 0 && lattice_.bindings[i].tet >= 0)
            held[at(part[at(lattice_.tets[at(lattice_.bindings[i].tet)][0])])] = 1;
    for (std::size_t n = 0; n < part.size(); ++n)
        loose[n] = held[at(part[n])] != 0 ? 0 : 1;
    return loose;
}

} // namespace fascicle::solver
