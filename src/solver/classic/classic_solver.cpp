#include "solver/classic/classic_solver.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace fascicle {

std::unique_ptr<SoftBodySolver> make_classic_solver(const SoftBodyProblem& problem) {
    return std::make_unique<classic::ClassicSolver>(problem);
}

namespace classic {

namespace {

/// Adds the time until its end to a stage.
class StageClock {
public:
    StageClock(StepReport& report, const char* stage) : seconds_(report.stage_seconds[stage]) {}
    ~StageClock() {
        seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    double& seconds_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool is_meant(const SoftBodyProblem& problem) {
    return problem.parameters.get_choice("classic.equations") == "meant";
}

/// published: k as it is, every substep. meant: its share of one of n substeps.
double per_substep(double k, int substeps, bool meant) {
    return meant ? 1.0 - std::pow(1.0 - k, 1.0 / substeps) : k;
}

std::vector<VoxelObstacle> make_obstacles(const SoftBodyProblem& problem) {
    std::vector<VoxelObstacle> obstacles;
    obstacles.reserve(problem.solids.size());
    for (const SolidBody& solid : problem.solids)
        obstacles.emplace_back(*solid.mesh, is_meant(problem));
    return obstacles;
}

/// Attachments of the problem, or, when it brings none, every vertex in collision at rest (scenarios 1 and 6
/// of the program; notes 1.3): both solids' findings are written in order, so the last solid wins.
std::vector<int> fixed_to(const SoftBodyProblem& problem, const std::vector<VoxelObstacle>& obstacles,
                          const std::vector<bool>& used) {
    const Points& rest = problem.surface->positions;
    std::vector<int> body = problem.body_of_vertex;
    FASCICLE_ASSERT(body.empty() || body.size() == rest.size());
    if (std::any_of(body.begin(), body.end(), [](int b) { return b >= 0; }))
        return body;
    body.assign(rest.size(), -1);
    for (std::size_t b = 0; b < obstacles.size(); ++b) {
        for (std::size_t i = 0; i < rest.size(); ++i) {
            if (used[i] && obstacles[b].inside(rest[i]))
                body[i] = static_cast<int>(b);
        }
    }
    return body;
}

std::vector<bool> used_vertices(const TriMesh& mesh) {
    std::vector<bool> used(mesh.positions.size(), false);
    for (const Tri& t : mesh.triangles) {
        for (const int v : t)
            used[static_cast<std::size_t>(v)] = true;
    }
    return used;
}

} // namespace

ClassicSolver::ClassicSolver(const SoftBodyProblem& problem, Switches switches)
    : meant_(is_meant(problem)), switches_(switches), substeps_(passes_per_frame(problem.parameters)),
      velocity_factor_(std::exp(-problem.parameters.get("solver.damping") * time_step_s)),
      bending_(per_substep(problem.parameters.get("solver.bending"), substeps_, meant_)),
      rest_(problem.surface->positions), used_(used_vertices(*problem.surface)),
      obstacles_(make_obstacles(problem)),
      state_(make_state(rest_, fixed_to(problem, obstacles_, used_), meant_)),
      volume_(rest_, problem.surface->triangles, problem.parameters.get("solver.pressure"), meant_) {
    const MeshTopology topology(problem.surface->vertex_count(), problem.surface->triangles);
    edges_ = edge_sweep(*problem.surface, topology, problem.edge_softness,
                        problem.parameters.get("solver.stiffness"), meant_);
    for (DirectedEdge& edge : edges_)
        edge.factor = per_substep(edge.factor, substeps_, meant_);
    switches_.volume = switches_.volume && problem.parameters.get_choice("solver.volume") == "kept";
    pairs_ = bending_pairs(*problem.surface, topology);
}

void ClassicSolver::advance(std::span<const Pose> from, std::span<const Pose> to) {
    FASCICLE_ASSERT(from.size() == obstacles_.size() && to.size() == obstacles_.size());
    move_solids(from, to);
    for (int i = 0; i < substeps_; ++i)
        substep();
}

std::size_t ClassicSolver::state_bytes() const {
    return bytes_of(rest_, state_.position, state_.candidate, state_.velocity, state_.force,
                    state_.inverse_mass, state_.body, edges_, pairs_) +
           used_.capacity() / 8 + volume_.bytes();
}

// Solids jump to their new place once a frame, and what is fixed to them with them (notes 1.3). The program
// multiplies positions by the increment frame after frame; taking the pose from rest is the same without the
// rounding.
void ClassicSolver::move_solids(std::span<const Pose> from, std::span<const Pose> to) {
    for (std::size_t b = 0; b < obstacles_.size(); ++b)
        obstacles_[b].move(from[b], to[b]);
    for (std::size_t i = 0; i < state_.size(); ++i) {
        if (state_.fixed(i))
            state_.position[i] = to[static_cast<std::size_t>(state_.body[i])].apply(rest_[i]);
    }
}

void ClassicSolver::substep() {
    {
        const StageClock clock(report_, "predict");
        predict(state_, velocity_factor_);
    }
    if (switches_.edges) {
        const StageClock clock(report_, "edges");
        project_edges(state_, edges_);
    }
    if (switches_.volume) {
        const StageClock clock(report_, "volume");
        volume_.project(state_);
    }
    if (switches_.bending) {
        const StageClock clock(report_, "bending");
        project_bending(state_, pairs_, bending_, meant_);
    }
    if (switches_.contact) {
        const StageClock clock(report_, "contact");
        resolve_contacts();
    }
    const StageClock clock(report_, "accept");
    report_.non_finite += accept(state_);
}

// published: all solids look at the same x and p, their answers are written one over the other, so the last
// solid wins and may put a vertex into another one (finding 3, notes 1.3). meant: each solid in turn looks at
// what the ones before it left.
void ClassicSolver::resolve_contacts() {
    const Points proposed = meant_ ? Points() : state_.candidate;
    for (VoxelObstacle& obstacle : obstacles_) {
        for (std::size_t i = 0; i < state_.size(); ++i) {
            if (state_.fixed(i) || !used_[i])
                continue;
            const Vec3& wish = meant_ ? state_.candidate[i] : proposed[i];
            const auto answer = obstacle.respond(state_.position[i], wish);
            if (!answer)
                continue;
            state_.candidate[i] = *answer;
            ++report_.contacts;
        }
        obstacle.end_substep();
    }
}

} // namespace classic
} // namespace fascicle
