#pragma once
// Where the fibres of a template start, how they run through the cube, and how the cube lies in a muscle.

#include "anatomy/fibres/contour_map.hpp"
#include "fascicle/anatomy/fibre_problem.hpp"

namespace fascicle {

/// count places (r, s) in the unit square: a k x k grid with half a step at the borders for count = k^2, else Sobol points.
std::vector<Vec2> fibre_seeds(int count);

/// segments + 1 points of fibre (r, s) in the cube at equal steps of length. Where the template's curve begins above
/// y = 0 or ends below y = 1 (on a side face) the fibre runs straight along that face to the end, as an aponeurosis.
Points fibre_in_cube(const FibreTemplate& fibre_template, double r, double s, int segments);

/// Of 80 frames about the line from the origin's to the insertion's middle (10 rotations of 90/11 degrees, by 4 quarter
/// turns, and mirrored), each with the box that holds the surface: the one whose template starts and ends lie nearest to
/// the attachments. Of equal ones the first.
TemplateFrame fit_template(const FibreProblem& problem, const FibreTemplate& fibre_template);

} // namespace fascicle
