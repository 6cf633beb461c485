#pragma once
// From a scene to solver problems: attachments resolved, bones turned into distance grids, muscles cleaned up.

#include "fascicle/base/blob_store.hpp"
#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/recording.hpp"
#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle {

struct PreparedMuscle {
    SoftBodyProblem problem;
    std::vector<Attachment> attachments;
    /// V x B, how much of each bone's motion a vertex feels: harmonic between the attachments; empty without them.
    std::vector<double> bone_shares;
    FibreModelPtr fibres; ///< null when fibres.method is "none"
};

struct PreparedScene {
    const SolverMethod* method = nullptr;
    std::vector<PreparedMuscle> muscles; ///< one per muscle of the scene
    std::vector<std::string> notes;
    /// Seconds per stage: "trees" (search trees of the bones, grids found in the cache), "grids" (those made), "overlaps" (bones inside
    /// each other), "muscles" (attachments, fields).
    std::map<std::string, double> stage_seconds;
};

/// Error when the scene has no muscle, a muscle encloses no volume, or its attachments leave no vertex free.
/// `cache` may be null: see SimulationOptions.
PreparedScene prepare_scene(const Scene& scene, int threads, const JobControl& control,
                            BlobStore* cache = nullptr);

} // namespace fascicle
