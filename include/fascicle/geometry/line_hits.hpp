#pragma once
// Where a straight line meets a closed triangle surface, and which parts of it lie inside.

#include "fascicle/geometry/bvh.hpp"

#include <vector>

namespace fascicle {

/// Part of a line between two crossings, positions along the line in units of its direction's length; begin < end.
struct LineInterval {
    double begin = 0;
    double end = 0;
};

/// Turns crossings into the parts where the line is inside: positions where the sum of entering crossings (+1) minus
/// leaving ones (-1) is positive, in ascending order. Crossings at the same position (within `same`, as on an edge that
/// two triangles share) and of the same sense count once. Sorts `hits`; appends nothing for an empty or one-sided list.
void inside_intervals(std::vector<LineHit>& hits, double same, std::vector<LineInterval>& intervals);

} // namespace fascicle
