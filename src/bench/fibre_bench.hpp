#pragma once
// How long it takes to make fibres, and to carry them through a frame.

#include "bench/report.hpp"
#include "fascicle/base/job_control.hpp"
#include "fascicle/simulation/prepare.hpp"

namespace fascicle::bench {

/// 100 fibres of 15 segments in every muscle of a prepared scene, by each method that it can do: all of the decomposition, the part
/// after the field, and carrying them at rest and with the bones where the timeline turns them furthest (3 substeps a frame on
/// the way there; `is_short`: the second frame). Milliseconds. Throws Cancelled.
std::vector<LimitRow> measure_fibres(const Scene& scene, const PreparedScene& prepared, int threads, int runs,
                                     bool is_short, const JobControl& control);

} // namespace fascicle::bench
