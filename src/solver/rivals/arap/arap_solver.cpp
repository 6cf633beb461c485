#include "solver/rivals/arap/arap_solver.hpp"

#include "solver/rivals/arap/arap_contact.hpp"
#include "solver/rivals/arap/arap_system.hpp"
#include "solver/rivals/arap/cotangent_weights.hpp"
#include "solver/rivals/rival_body.hpp"

#include <cmath>

namespace fascicle::solver {

namespace {

/// Penalty of a vertex in a part of the surface that no attachment holds, towards where the solids carried it, as a share of its
/// cell's weight: fixes the part's place, which the energy leaves open, and yields to any contact.
constexpr double anchor = 1e-4;
/// Multipliers stay below so many mean edges: between solids that leave no room they would grow for ever.
constexpr double most_multiplier = 10.0;

class ArapSolver final : public RivalBody {
public:
    explicit ArapSolver(const SoftBodyProblem& problem);
    bool uses_threads() const override { return true; }
    /// The energy knows no past, so another solver's positions are all there is to take over.
    bool set_state(const Points& positions, const Points&) override {
        x() = positions;
        return true;
    }
    std::size_t state_bytes() const override {
        return RivalBody::state_bytes() + cells_.bytes() + system_->bytes() + contact_held_.bytes() +
               bytes_of(anchors_, penalties_, rotations_, right_, carried_, give_) + volume_.bytes();
    }

private:
    void deform(double seconds) override;
    void factor_again();
    void keep_volume_within();

    ArapCells cells_;
    std::vector<double> anchors_, penalties_; ///< V
    std::unique_ptr<ArapSystem> system_;
    ArapContact contact_held_;
    std::vector<Mat3> rotations_;
    Points right_, carried_, give_;
    VolumeConstraint volume_; ///< free where the volume is left to the step after
    int alternations_;
    bool anchored_ = false;
};

std::vector<double> edge_weights(const SoftBodyProblem& problem, const MeshTopology& topology) {
    std::vector<double> weights =
        cotangent_weights(problem.surface->positions, problem.surface->triangles, topology);
    for (std::size_t e = 0; e < problem.edge_softness.size(); ++e)
        weights[e] *= problem.edge_softness[e];
    return weights;
}

double mean_edge(const Points& rest, const MeshTopology& topology) {
    double sum = 0;
    for (const Edge& edge : topology.edges())
        sum += (rest[static_cast<std::size_t>(edge.a)] - rest[static_cast<std::size_t>(edge.b)]).norm();
    return topology.edges().empty() ? 0.0 : sum / double(topology.edges().size());
}

ArapSolver::ArapSolver(const SoftBodyProblem& problem)
    : RivalBody(problem), cells_(rest(), topology(), edge_weights(problem, topology())),
      anchors_(rest().size(), 0.0),
      contact_held_(rest().size(), param("arap.contact"), most_multiplier * mean_edge(rest(), topology()),
                    problem.threads),
      volume_(rest(), problem.surface->triangles, param("solver.pressure"),
              problem.parameters.get_choice("solver.volume") == "kept" &&
                  problem.parameters.get_choice("arap.volume") == "within"),
      alternations_(problem.parameters.get_int("arap.alternations")) {
    std::vector<std::uint8_t> held(static_cast<std::size_t>(topology().component_count()), 0);
    std::vector<std::uint8_t> free(rest().size(), 0);
    const auto part = [&](std::size_t i) { return topology().vertex_component(static_cast<int>(i)); };
    for (std::size_t i = 0; i < free.size(); ++i) {
        free[i] = is_free(i) ? 1 : 0;
        if (free[i] == 0 && part(i) >= 0)
            held[static_cast<std::size_t>(part(i))] = 1;
    }
    for (std::size_t i = 0; i < free.size(); ++i)
        if (free[i] != 0 && held[static_cast<std::size_t>(part(i))] == 0) {
            anchors_[i] = anchor * cells_.weight_at(i);
            anchored_ = true;
        }
    penalties_ = anchors_;
    system_ = std::make_unique<ArapSystem>(cells_, free, penalties_);
}

void ArapSolver::factor_again() {
    penalties_ = anchors_;
    contact_held_.add_penalties(cells_, penalties_);
    system_->set_penalties(penalties_);
}

void ArapSolver::deform(double) {
    if (anchored_)
        carried_ = x();
    for (int k = 0; k < alternations_; ++k) {
        // At first by where contact left them, then once more by where the shape wants them.
        if (k < 2 && contact_held_.choose(x(), inverse_mass(), solids(), contact(), k == 0))
            factor_again();
        cells_.fit(x(), rotations_, problem().threads);
        cells_.right_side(rotations_, right_, problem().threads);
        for (std::size_t i = 0; anchored_ && i < right_.size(); ++i)
            right_[i] += anchors_[i] * carried_[i];
        contact_held_.add_targets(x(), cells_, solids(), contact(), right_);
        volume_.evaluate(x());
        system_->solve(right_, volume_.gradient(), x(), give_);
        keep_volume_within();
    }
}

/// The shape of least energy at the wanted volume: stationary in E - p V, so x = x_0 + p (L + D)^-1 grad V up to a factor of p, V and its
/// gradient of the alternation before; p by Newton's method on the volume itself.
void ArapSolver::keep_volume_within() {
    constexpr int most_steps = 4;
    constexpr double enough = 1e-6;
    for (int step = 0; step < most_steps && volume_.kept(); ++step) {
        const double off = volume_.evaluate(x()) - volume_.wanted_volume();
        double slope = 0;
        for (std::size_t i = 0; i < give_.size(); ++i)
            slope += volume_.gradient()[i].dot(give_[i]);
        if (std::abs(off) <= enough * std::abs(volume_.rest_volume()) || !(slope > 0.0))
            return;
        for (std::size_t i = 0; i < give_.size(); ++i)
            x()[i] -= (off / slope) * give_[i];
    }
}

} // namespace

std::unique_ptr<SoftBodySolver> make_arap_solver(const SoftBodyProblem& problem) {
    return std::make_unique<ArapSolver>(problem);
}

} // namespace fascicle::solver
