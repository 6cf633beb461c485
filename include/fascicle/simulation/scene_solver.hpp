#pragma once
// The muscles of a prepared scene, advanced frame by frame: what a run solves, without recording anything.

#include "fascicle/simulation/prepare.hpp"

namespace fascicle {

/// Pose of every bone of the scene at a frame, from its rest pose.
std::vector<Pose> bone_poses(const Scene& scene, int frame);

class MuscleContact;

class SceneSolver {
public:
    /// Makes one solver per muscle, at rest. `prepared` is only read: it may serve several solvers. Many muscles, or
    /// those of a method that works on one thread, run side by side; a few run one after the other on all threads.
    SceneSolver(const Scene& scene, const PreparedScene& prepared, int threads);

    ~SceneSolver();

    /// Advances all muscles by one frame; B poses each, one per bone, from rest.
    void advance(std::span<const Pose> from, std::span<const Pose> to);

    std::size_t muscle_count() const { return solvers_.size(); }
    const SoftBodySolver& muscle(std::size_t m) const { return *solvers_[m]; }
    /// Sums over the muscles.
    StepReport report() const;
    std::size_t state_bytes() const;

private:
    int threads_;
    std::unique_ptr<MuscleContact> contact_; ///< null with one muscle, or when the method knows no planes
    std::vector<const Points*> positions_;
    bool side_by_side_ = false;
    std::vector<std::unique_ptr<SoftBodySolver>> solvers_;
};

} // namespace fascicle
