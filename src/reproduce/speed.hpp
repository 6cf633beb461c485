#pragma once
// The speed table of the paper: frames a second of solving alone against triangles.

#include "fascicle/base/blob_store.hpp"
#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/scene.hpp"
#include "reproduce/results.hpp"

namespace fascicle::reproduce {

struct SpeedObject {
    std::string name;
    Scene scene; ///< with one muscle, and no method's parameters yet
    bool real = false;
};

/// The program's own method and the published one, each on 1 thread and, where it uses them, on `threads`: the median over the first
/// `frames` frames of the motion. cache: for distance grids, may be null. Throws Cancelled; a run that fails leaves no row.
SpeedResult measure_speed(const std::vector<SpeedObject>& objects, const std::vector<std::string>& methods,
                          int threads, int frames, const std::shared_ptr<BlobStore>& cache,
                          const JobControl& control);

/// Correlations of rows of the same method and threads.
std::vector<SpeedResult::Correlation> speed_correlations(const std::vector<SpeedRow>& rows);

} // namespace fascicle::reproduce
