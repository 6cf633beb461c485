#include "solver/rivals/lines/lines_solver.hpp"

#include "solver/rivals/lines/line_binding.hpp"
#include "solver/rivals/rbf/rbf_attachments.hpp"
#include "solver/rivals/rival_body.hpp"

namespace fascicle::solver {

namespace {

class LinesSolver final : public RivalBody {
public:
    explicit LinesSolver(const SoftBodyProblem& problem)
        : RivalBody(problem), shares_(end_shares(problem, topology())),
          sheaf_(problem, topology(), shares_, contact(), problem.parameters.get_int("lines.count"),
                 problem.parameters.get_int("lines.via")),
          binding_(problem, topology(), shares_, sheaf_.lines()) {
        find_loose_parts();
        shares_ = {}; // the binding has what it needs
    }
    bool uses_threads() const override { return true; }
    /// The lines know no past but their side of the solids, which they find from rest.
    bool set_state(const Points& positions, const Points&) override {
        x() = positions;
        return true;
    }
    std::size_t state_bytes() const override {
        std::size_t sum = RivalBody::state_bytes() + sheaf_.bytes() + binding_.bytes();
        for (const std::vector<int>& part : loose_parts_)
            sum += bytes_of(part);
        return sum;
    }

private:
    void deform(double) override {
        sheaf_.move(solids(), problem().threads);
        binding_.place(sheaf_.lines(), solids(), problem().threads, inverse_mass(), x());
        for (const std::vector<int>& part : loose_parts_)
            fit(part);
    }
    void find_loose_parts();
    void fit(const std::vector<int>& part);

    EndShares shares_;
    LineSheaf sheaf_;
    LineBinding binding_;
    std::vector<std::vector<int>> loose_parts_; ///< vertices that neither a line nor a solid holds
    Points from_, to_;
};

void LinesSolver::find_loose_parts() {
    if (!sheaf_.lines().empty())
        return; // they go with the lines of other parts
    std::vector<std::vector<int>> parts(static_cast<std::size_t>(topology().component_count()));
    std::vector<char> held(parts.size(), 0);
    for (std::size_t v = 0; v < rest().size(); ++v)
        if (const int part = topology().vertex_component(static_cast<int>(v)); part >= 0) {
            parts[static_cast<std::size_t>(part)].push_back(static_cast<int>(v));
            if (problem().body_of_vertex[v] >= 0)
                held[static_cast<std::size_t>(part)] = 1;
        }
    for (std::size_t p = 0; p < parts.size(); ++p)
        if (held[p] == 0)
            loose_parts_.push_back(std::move(parts[p]));
}

/// A part that nothing holds keeps its shape, where contact and carrying have left it.
void LinesSolver::fit(const std::vector<int>& part) {
    from_.clear();
    to_.clear();
    for (const int v : part) {
        from_.push_back(rest()[static_cast<std::size_t>(v)]);
        to_.push_back(x()[static_cast<std::size_t>(v)]);
    }
    if (from_ == to_)
        return;
    const Pose motion = best_motion(from_, to_, Pose{});
    for (std::size_t k = 0; k < part.size(); ++k)
        x()[static_cast<std::size_t>(part[k])] = motion.apply(from_[k]);
}

} // namespace

std::unique_ptr<SoftBodySolver> make_lines_solver(const SoftBodyProblem& problem) {
    return std::make_unique<LinesSolver>(problem);
}

} // namespace fascicle::solver
