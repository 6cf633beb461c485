#pragma once
// Cost against size: the same muscle on finer and finer meshes of exactly the same shape.

#include "bench/frame_bench.hpp"

namespace fascicle::bench {

/// The problem on the subdivided surface: a new vertex is fixed where both ends of its edge are fixed to the same solid,
/// follows the solids by the mean of its ends' shares, and an edge has the softness of the old edge it lies on or is
/// parallel to.
SoftBodyProblem refined(const SoftBodyProblem& problem);

/// Levels 0 .. levels of one prepared muscle, each with every number of threads. One solver per measurement goes on
/// through the scene's frames, run after run: making one for a million triangles takes longer than its frames.
/// Ratios are left to add_ratios(). Throws Cancelled.
std::vector<ScalingRow> measure_scaling(const Scene& scene, const PreparedScene& prepared,
                                        const std::vector<Variant>& variants, int levels,
                                        const RunSettings& settings, const JobControl& control);

} // namespace fascicle::bench
