#pragma once
// How long a step of a paint stroke takes on a large bone.

#include "bench/report.hpp"
#include "fascicle/base/job_control.hpp"

namespace fascicle::bench {

/// Strokes of 8 mm radius, 2 mm a step, over a blade of 150 x 120 x 4 mm of 305,280 triangles (`is_short`: 19,080), one thread:
/// a step by itself, the slowest one, and area, centroid, islands and border of what is painted then. Throws Cancelled.
std::vector<LimitRow> measure_paint(int runs, bool is_short, const JobControl& control);

} // namespace fascicle::bench
