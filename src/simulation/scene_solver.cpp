#include "fascicle/simulation/scene_solver.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/solver/active_strain.hpp"
#include "simulation/attachment_guard.hpp"
#include "simulation/clean_up.hpp"
#include "simulation/muscle_contact.hpp"
#include "simulation/muscle_slack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

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
    total.unconverged += part.unconverged;
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
        around_.add(bounding_box(muscle.problem.surface->positions, muscle.problem.surface->triangles));
        SoftBodyProblem problem = muscle.problem;
        problem.threads = many ? 1 : threads;
        solvers_.push_back(prepared.method->make(problem));
        side_by_side_ = side_by_side_ || !solvers_.back()->uses_threads();
        if (method_->needs_grid) {
            guards_.emplace_back(problem, sweep_clearance_mm / problem.unit_mm);
            problems_.push_back(std::move(problem));
        }
    }
    tone_ = method_->needs_grid ? scene.parameters.get("solver.tone") : 0.0;
    for (std::size_t m = 0; m < prepared.muscles.size() && tone_ > 0.0; ++m)
        slacks_.emplace_back(scene, prepared.muscles[m]);
    active_length_.assign(slacks_.size(), 1.0);
    if (solvers_.size() > 1 && solvers_.front()->takes_planes())
        contact_ = std::make_unique<MuscleContact>(scene, prepared);
    for (const auto& solver : solvers_)
        positions_.push_back(&solver->positions());
}

SceneSolver::~SceneSolver() = default;

int frame_parts(std::span<const Pose> from, std::span<const Pose> to, const BoundingBox& near) {
    constexpr double most_turn = 0.15, most_way = 0.1; // rad, share of the box's diagonal
    double parts = 1.0;
    const double diagonal = near.diagonal();
    for (std::size_t b = 0; b < from.size(); ++b) {
        const Pose move = to[b].after(from[b].inverse());
        parts = std::max(parts, std::abs(Eigen::AngleAxisd(move.rotation).angle()) / most_turn);
        for (int corner = 0; corner < 8 && diagonal > 0.0; ++corner) {
            const Vec3 p(corner & 1 ? near.max.x() : near.min.x(), corner & 2 ? near.max.y() : near.min.y(),
                         corner & 4 ? near.max.z() : near.min.z());
            parts = std::max(parts, (move.apply(p) - p).norm() / (most_way * diagonal));
        }
    }
    constexpr double most_parts = 1000.0;
    return static_cast<int>(std::ceil(std::min(parts - 1e-9, most_parts)));
}

void SceneSolver::advance(std::span<const Pose> from, std::span<const Pose> to) {
    // The published method is repeated literally: a frame is a frame.
    const int parts = method_->needs_grid ? frame_parts(from, to, around_) : 1;
    if (parts == 1)
        return advance_part(from, to);
    part_from_.assign(from.begin(), from.end());
    part_to_.resize(to.size());
    for (int part = 1; part <= parts; ++part) {
        for (std::size_t b = 0; b < to.size(); ++b)
            part_to_[b] = part == parts ? to[b] : screw_between(from[b], to[b], double(part) / parts);
        advance_part(part_from_, part_to_);
        part_from_.swap(part_to_);
    }
}

void SceneSolver::advance_part(std::span<const Pose> from, std::span<const Pose> to) {
    release_attachments(to);
    for (std::size_t m = 0; m < slacks_.size(); ++m)
        if (const double share =
                std::clamp(1.0 + tone_ * (slacks_[m].length(to) - 1.0), least_active_length, 1.0);
            share != active_length_[m]) {
            solvers_[m]->set_active_length(share);
            active_length_[m] = share;
        }
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
        if (m < active_length_.size())
            next->set_active_length(active_length_[m]);
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
