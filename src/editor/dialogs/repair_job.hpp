#pragma once
// One repair under way on a thread of its own.

#include "editor/dialogs/mesh_batch.hpp"
#include "fascicle/geometry/repair/repair.hpp"

#include <atomic>
#include <future>

namespace fascicle::editor {

/// What a repair would make of a mesh.
struct RepairOutcome {
    RepairResult result; ///< without its mesh, which is in `after`
    SurfaceFacts before, after;
};

class RepairJob {
public:
    RepairJob(MeshPtr mesh, const RepairOptions& options);
    ~RepairJob() { cancel(); } // and the future waits, for a moment
    RepairJob(const RepairJob&) = delete;
    RepairJob& operator=(const RepairJob&) = delete;

    bool ready() const { return future_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    /// Error of the repair; Cancelled. Once.
    RepairOutcome take() { return future_.get(); }
    void cancel() { cancel_ = true; }
    double fraction() const { return fraction_; }

private:
    std::atomic<bool> cancel_{false};
    std::atomic<double> fraction_{0};
    std::future<RepairOutcome> future_;
};

/// The facts of a mesh that was repaired, with the edges of crossing triangles.
SurfaceFacts repaired_facts(RepairResult& result);

} // namespace fascicle::editor
