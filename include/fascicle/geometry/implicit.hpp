#pragma once
// Solids as signed functions: negative inside, zero on the surface, positive outside, in length units. Close
// to the surface they measure distance; far away some are only estimates, which is all that meshing needs.
// Formulas: J. C. Hart, "Sphere tracing" (1996) for distance bounds; I. Quilez, "Distance functions" (notes
// on the web) for the round cone, capped torus, ellipsoid estimate and the polynomial smooth minimum.

#include "fascicle/base/types.hpp"

#include <functional>
#include <vector>

namespace fascicle {

/// Value at a point. Must be a pure function: it is called from several threads at once.
using Implicit = std::function<double(const Vec3&)>;

/// A solid and a ball around it, so that a union can leave out what is too far away to matter.
struct ImplicitShape {
    Implicit value;
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;

    double operator()(const Vec3& p) const { return value(p); }
};

/// Ball; exact. radius > 0.
ImplicitShape sphere_shape(const Vec3& centre, double radius);

/// Hull of two balls (tapered capsule); exact. Where one ball holds the other it is the larger ball.
ImplicitShape round_cone_shape(const Vec3& a, const Vec3& b, double radius_a, double radius_b);

/// Ellipsoid; estimate k0 (k0 - 1) / k1 with k0 = |p / r|, k1 = |p / r^2|: exact to first order at the
/// surface, -min r at the centre. radii: half axes > 0; axes: columns are the unit directions of the half
/// axes.
ImplicitShape ellipsoid_shape(const Vec3& centre, const Vec3& radii, const Mat3& axes = Mat3::Identity());

/// Arc of a ring with round ends; exact. axis: unit normal of the ring's plane; middle: unit direction from
/// the centre to the middle of the arc, perpendicular to axis; half_angle in (0, pi] (pi: the whole ring).
ImplicitShape ring_shape(const Vec3& centre, const Vec3& axis, const Vec3& middle, double half_angle,
                         double ring_radius, double tube_radius);

/// Box with rounded edges; exact outside. half: half sizes including the rounding, each > rounding >= 0.
ImplicitShape box_shape(const Vec3& centre, const Vec3& half, double rounding = 0.0,
                        const Mat3& axes = Mat3::Identity());

/// Polynomial smooth minimum: min(a, b) - h^2 k / 4 with h = max(k - |a - b|, 0) / k. Equal to min(a, b)
/// where the two differ by at least k; never larger than it. k > 0 is the width of the blend, k <= 0 gives
/// the plain minimum.
double smooth_min(double a, double b, double k);
/// -smooth_min(-a, -b, k): never smaller than max(a, b).
double smooth_max(double a, double b, double k);

/// Union of parts, each blended into those before it over its own width. The result does not depend on the
/// balls as long as they hold the parts: a part is left out only where it cannot change the value.
class ImplicitUnion {
public:
    /// blend: width of the smooth minimum with what is there already (0: a sharp crease).
    ImplicitUnion& add(ImplicitShape shape, double blend);
    double operator()(const Vec3& p) const;

private:
    std::vector<ImplicitShape> shapes_;
    std::vector<double> blends_;
};

/// Gradient of f at p by forward differences along the four corners of a regular tetrahedron, step h (4
/// calls).
Vec3 implicit_gradient(const Implicit& f, const Vec3& p, double h);

} // namespace fascicle
