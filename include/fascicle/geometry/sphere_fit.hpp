#pragma once
// Least-squares spheres, and the ball of a ball-and-socket joint found without a guess.

#include "fascicle/geometry/tri_mesh.hpp"

#include <optional>
#include <string>

namespace fascicle {

struct Sphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};

struct SphereFit {
    Sphere sphere;
    double rms = 0; ///< weighted root mean square of |x - centre| - radius, scene units
};

/// The sphere that minimises sum w (|x - c| - r)^2: algebraic start (linear least squares of |x|^2 + a.x + b),
/// then Gauss-Newton. weights: one per point, >= 0, or empty for equal ones. Nothing for fewer than 4 points,
/// points in a plane or on a line, and when the iteration runs away.
std::optional<SphereFit> fit_sphere(const Points& points, const std::vector<double>& weights = {});

/// sphere: empty when there is no ball; reason then says in half a sentence why.
struct JointFit {
    std::optional<Sphere> sphere;
    double rms = 0;      ///< of the ball's vertices, scene units
    int vertices = 0;    ///< of the ball
    double coverage = 0; ///< share of the whole sphere that the ball's surface covers, 0 to 1
    bool ball_on_moving_bone = true;
    std::string reason;
};

/// The centre that a moving bone turns about in the fixed bones: the sphere fitted to the head of the moving
/// bone, or, when that has none, of a fixed bone. No guess and no unit needed:
/// 1. the part of the bone nearest to the others (0.5 % to 8 % of its surface, several starts) gives a sphere,
/// 2. its vertices within 0.065 r of the sphere whose normals point away from the centre, in one connected
///    patch, are fitted again, up to 60 times, until the set no longer changes (methods.md 5.3, whose 1.5 mm
///    are 0.065 r of a femoral head),
/// 3. it is a ball when the patch covers at least a quarter of the sphere and its rms is at most 0.03 r; of
///    several the one that covers most is taken.
/// Vertices weigh as much as the surface around them. Meshes must be usable.
JointFit fit_joint_centre(const TriMesh& moving, const std::vector<MeshPtr>& fixed);

} // namespace fascicle
