#pragma once
// The muscles of a prepared scene, advanced frame by frame: what a run solves, without recording anything.

#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/simulation/prepare.hpp"

namespace fascicle {

/// Pose of every bone of the scene at a frame, from its rest pose.
std::vector<Pose> bone_poses(const Scene& scene, int frame);

class AttachmentGuard;
class MuscleContact;
class MuscleSlack;

/// Parts that a frame is solved in, so that no bone moves further in one than the solver's linear steps bear: a turn of 0.15
/// rad, and of any point of the box that `near` spans a tenth of its diagonal. From 1 to 1000; 1 for anything that a
/// body does at 60 frames a second.
int frame_parts(std::span<const Pose> from, std::span<const Pose> to, const BoundingBox& near);

class SceneSolver {
public:
    /// Makes one solver per muscle, at rest. `prepared` is only read: it may serve several solvers. Many muscles, or
    /// those of a method that works on one thread, run side by side; a few run one after the other on all threads.
    SceneSolver(const Scene& scene, const PreparedScene& prepared, int threads);

    ~SceneSolver();

    /// Advances all muscles by one frame; B poses each, one per bone, from rest. Attached vertices that another bone would
    /// come nearer to than 0.5 mm in this frame are released before it and are free from then on: the muscle goes on with a
    /// new solver from where it is.
    void advance(std::span<const Pose> from, std::span<const Pose> to);

    /// Vertices of a muscle released so far, in the order of release.
    const std::vector<int>& released(std::size_t m) const { return released_[m]; }

    std::size_t muscle_count() const { return solvers_.size(); }
    const SoftBodySolver& muscle(std::size_t m) const { return *solvers_[m]; }
    /// Sums over the muscles.
    StepReport report() const;
    std::size_t state_bytes() const;

private:
    void advance_part(std::span<const Pose> from, std::span<const Pose> to);
    void release_attachments(std::span<const Pose> to);

    int threads_;
    BoundingBox around_; ///< of all muscles at rest
    std::vector<Pose> part_from_, part_to_;
    const SolverMethod* method_;
    std::vector<SoftBodyProblem> problems_; ///< of methods that can be taken over; else empty
    std::vector<AttachmentGuard> guards_;
    double tone_ = 0;
    std::vector<MuscleSlack> slacks_;   ///< empty without tone
    std::vector<double> active_length_; ///< by slack: what its solver was told last
    std::vector<std::vector<int>> released_;
    StepReport retired_;                     ///< what solvers reported that were replaced
    std::unique_ptr<MuscleContact> contact_; ///< null with one muscle, or when the method knows no planes
    std::vector<const Points*> positions_;
    bool side_by_side_ = false;
    std::vector<std::unique_ptr<SoftBodySolver>> solvers_;
};

} // namespace fascicle
