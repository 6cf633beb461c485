#pragma once
// The posture of a model in which its bodies stand to each other as they do in a scene.

#include "fascicle/geometry/tri_mesh.hpp"
#include "fascicle/motion/skeleton.hpp"

namespace fascicle {

/// Least squares over the coordinates that are not locked: places of the used bodies against the first of them, measured at
/// four points of each body (middle of `points`, and 0.1 m from it along the axes). Gauss-Newton, damped, from the
/// values given; coordinates that move nothing stay. used, points (own frames, metres), rest (metres): one per body.
void fit_posture(const Skeleton& skeleton, const std::vector<char>& used, const std::vector<Points>& points,
                 const std::vector<Pose>& rest, std::vector<double>& values);

} // namespace fascicle
