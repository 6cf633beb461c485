#include "fascicle/simulation/scene_solver.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"
#include "simulation/muscle_contact.hpp"

#include <algorithm>

namespace fascicle {

std::vector<Pose> bone_poses(const Scene& scene, int frame) {
    std::vector<Pose> poses;
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        poses.push_back(scene.timeline.bone_pose(static_cast<int>(b), frame));
    return poses;
}

SceneSolver::SceneSolver(const Scene& scene, const PreparedScene& prepared, int threads) : threads_(threads) {
    FASCICLE_ASSERT(prepared.method != nullptr && prepared.muscles.size() == scene.muscles.size());
    // Enough muscles keep all threads busy by themselves; a few of unlike size do not.
    const bool many = prepared.muscles.size() >= 2 * static_cast<std::size_t>(std::max(threads, 1));
    side_by_side_ = many;
    for (const PreparedMuscle& muscle : prepared.muscles) {
        SoftBodyProblem problem = muscle.problem;
        problem.threads = many ? 1 : threads;
        solvers_.push_back(prepared.method->make(problem));
        side_by_side_ = side_by_side_ || !solvers_.back()->uses_threads();
    }
    if (solvers_.size() > 1 && solvers_.front()->takes_planes())
        contact_ = std::make_unique<MuscleContact>(scene, prepared);
    for (const auto& solver : solvers_)
        positions_.push_back(&solver->positions());
}

SceneSolver::~SceneSolver() = default;

void SceneSolver::advance(std::span<const Pose> from, std::span<const Pose> to) {
    if (contact_ != nullptr) {
        const auto& planes = contact_->planes(positions_, from, to, threads_);
        for (std::size_t m = 0; m < solvers_.size(); ++m)
            solvers_[m]->set_planes(planes[m]);
    }
    parallel_for(side_by_side_ ? threads_ : 1, solvers_.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m)
            solvers_[m]->advance(from, to);
    });
}

StepReport SceneSolver::report() const {
    StepReport total;
    for (const auto& solver : solvers_) {
        const StepReport& part = solver->report();
        total.contacts += part.contacts;
        total.unresolved += part.unresolved;
        total.non_finite += part.non_finite;
        for (const auto& [stage, seconds] : part.stage_seconds)
            total.stage_seconds[stage] += seconds;
    }
    return total;
}

std::size_t SceneSolver::state_bytes() const {
    std::size_t bytes = 0;
    for (const auto& solver : solvers_)
        bytes += solver->state_bytes();
    return bytes;
}

} // namespace fascicle
