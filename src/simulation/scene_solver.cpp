#include "fascicle/simulation/scene_solver.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"
#include "simulation/attachment_guard.hpp"
#include "simulation/clean_up.hpp"
#include "simulation/muscle_contact.hpp"

#include <algorithm>

namespace fascicle {

std::vector<Pose> bone_poses(const Scene& scene, int frame) {
    std::vector<Pose> poses;
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        poses.push_back(scene.timeline.bone_pose(static_cast<int>(b), frame));
    return poses;
}

namespace {

void add(StepReport& total, const StepReport& part) {
    total.contacts += part.contacts;
    total.unresolved += part.unresolved;
    total.non_finite += part.non_finite;
    total.slid += part.slid;
    total.ejected += part.ejected;
    total.impossible += part.impossible;
    total.samples_pushed += part.samples_pushed;
    total.samples_held += part.samples_held;
    for (const auto& [stage, seconds] : part.stage_seconds)
        total.stage_seconds[stage] += seconds;
}

} // namespace

SceneSolver::SceneSolver(const Scene& scene, const PreparedScene& prepared, int threads)
    : threads_(threads), method_(prepared.method), released_(prepared.muscles.size()) {
    FASCICLE_ASSERT(prepared.method != nullptr && prepared.muscles.size() == scene.muscles.size());
    // Enough muscles keep all threads busy by themselves; a few of unlike size do not.
    const bool many = prepared.muscles.size() >= 2 * static_cast<std::size_t>(std::max(threads, 1));
    side_by_side_ = many;
    for (const PreparedMuscle& muscle : prepared.muscles) {
        SoftBodyProblem problem = muscle.problem;
        problem.threads = many ? 1 : threads;
        solvers_.push_back(prepared.method->make(problem));
        side_by_side_ = side_by_side_ || !solvers_.back()->uses_threads();
        if (method_->needs_grid) {
            guards_.emplace_back(problem, sweep_clearance_mm / problem.unit_mm);
            problems_.push_back(std::move(problem));
        }
    }
    if (solvers_.size() > 1 && solvers_.front()->takes_planes())
        contact_ = std::make_unique<MuscleContact>(scene, prepared);
    for (const auto& solver : solvers_)
        positions_.push_back(&solver->positions());
}

SceneSolver::~SceneSolver() = default;

void SceneSolver::advance(std::span<const Pose> from, std::span<const Pose> to) {
    release_attachments(to);
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

void SceneSolver::release_attachments(std::span<const Pose> to) {
    for (std::size_t m = 0; m < guards_.size(); ++m) {
        const std::vector<int>& found = guards_[m].find(to);
        if (found.empty())
            continue;
        for (const int vertex : found) {
            problems_[m].body_of_vertex[static_cast<std::size_t>(vertex)] = -1;
            if (contact_ != nullptr)
                contact_->release(m, vertex);
        }
        auto next = method_->make(problems_[m]);
        if (!next->set_state(solvers_[m]->positions(), solvers_[m]->last_step()))
            continue;
        add(retired_, solvers_[m]->report());
        solvers_[m] = std::move(next);
        positions_[m] = &solvers_[m]->positions();
        released_[m].insert(released_[m].end(), found.begin(), found.end());
    }
}

StepReport SceneSolver::report() const {
    StepReport total = retired_;
    for (const auto& solver : solvers_)
        add(total, solver->report());
    return total;
}

std::size_t SceneSolver::state_bytes() const {
    std::size_t bytes = 0;
    for (const auto& solver : solvers_)
        bytes += solver->state_bytes();
    return bytes;
}

} // namespace fascicle
