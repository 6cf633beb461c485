#pragma once
// How the fibres of a muscle run, as rational Bezier curves in the unit cube (after Blemker & Delp 2005).

#include "fascicle/base/types.hpp"

#include <string>

namespace fascicle {

/// Control polygon at one place across the muscle: 2 to 8 points (x, y) in the unit square, from origin to insertion.
/// The end points have weight 1, the inner ones `weight` > 0.
struct FibrePolygon {
    double s = 0; ///< in [0, 1]
    std::vector<Vec2> points;
    double weight = 1;
};

/// Axes of the cube: x across the muscle, y along it from origin (0) to insertion (1), z its depth. front: polygons at
/// z = 0, back: at z = 1, each with s ascending from 0 to 1, and two or more of them; back empty: the same as front.
struct FibreTemplate {
    std::string key, label, meaning;
    std::vector<FibrePolygon> front, back;

    /// Point of the fibre (r, s) at t, all in [0, 1]: P(t) = sum w_i B_i(t) P_i / sum w_i B_i(t), B_i the Bernstein
    /// polynomials; points and weights blended linearly in s between neighbouring polygons, then front to back with
    /// r, and z = r. Of two polygons blended, the one with a point less has its middle point doubled.
    Vec3 point(double r, double s, double t) const;
};

/// Throws an Error naming `where` and the first fault: too few polygons, s not ascending from 0 to 1, polygons whose
/// numbers of points differ by more than one, a coordinate outside [0, 1], a weight that is not in (0, 1e6].
void check_template(const FibreTemplate& fibre_template, const std::string& where);

/// Straight fibres along y: what a method uses when it was given no template.
const FibreTemplate& parallel_template();

} // namespace fascicle
