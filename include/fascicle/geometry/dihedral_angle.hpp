#pragma once
// Angle between the two triangles at an edge, signed and unsigned, with gradients.
//
// Vertex order (the one of MeshTopology): wings p0, p1; edge p2 -> p3; triangles (p0, p2, p3) and (p1, p3,
// p2), so
//   N1 = (p2 - p0) x (p3 - p0),  N2 = (p3 - p1) x (p2 - p1)
// both point outwards when triangles are counter-clockwise seen from outside. With e = p3 - p2, l = |e|, n =
// N/|N|:
//   theta = atan2( -(n1 x n2) . e / l,  n1 . n2 )
// Unit rad, range [-pi, pi]. Zero: flat. Negative over a ridge (convex: every edge of a cube has -pi/2),
// positive in a valley; so a crease that turns inside out changes sign. Unchanged by swapping (p0 with p1 and
// p2 with p3). Sources: Bridson, Marino, Fedkiw 2003, "Simulation of clothing with folds and wrinkles";
// Grinspun, Hirani, Desbrun, Schroeder 2003, "Discrete shells"; notes block 1.1 "Dihedral, atan2 form".
//
// Degenerate: a wing triangle with |N|^2 < 1e-12 l^4 (or l = 0) has no normal, and the functions return
// nothing: the caller skips the hinge. The rule has no unit. At a complete fold (+-pi) angle and gradient are
// finite, but the sign may flip between neighbouring states: compare angles with wrap_angle(theta - theta0).

#include "fascicle/base/types.hpp"

#include <optional>

namespace fascicle {

struct DihedralAngle {
    double angle_rad = 0;
    /// d theta / d p0 .. d p3, rad per length unit. They sum to zero, and no rigid motion changes theta.
    std::array<Vec3, 4> gradient{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

/// Signed angle; nothing when degenerate (see top).
std::optional<double> signed_dihedral_angle(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3);

/// Signed angle and its gradient. With a = N1/|N1|^2, b = N2/|N2|^2:
///   grad0 = l a,  grad2 = ((p0-p3).e/l) a + ((p1-p3).e/l) b,
///   grad1 = l b,  grad3 = ((p2-p0).e/l) a + ((p2-p1).e/l) b.
/// Nothing when degenerate.
std::optional<DihedralAngle> dihedral_angle_with_gradient(const Vec3& p0, const Vec3& p1, const Vec3& p2,
                                                          const Vec3& p3);

/// acos(n1 . n2), clamped, in [0, pi], 0 = flat: the absolute value of the signed angle, as Cervenka & Kohout
/// 2020 plot it. Cannot tell a ridge from a valley. Nothing when degenerate.
std::optional<double> unsigned_dihedral_angle(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3);

/// The same angle in (-pi, pi]. For finite input.
double wrap_angle(double angle_rad);

} // namespace fascicle
