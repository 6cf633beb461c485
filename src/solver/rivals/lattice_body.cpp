#include "solver/rivals/lattice_body.hpp"

#include "solver/rivals/lattice_fibres.hpp"
#include "solver/rivals/lattice_fields.hpp"

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
