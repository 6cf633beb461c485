#pragma once
// Spheres fitted to points, and the centre of a ball joint between bone surfaces.

#include "fascicle/geometry/tri_mesh.hpp"

#include <optional>

namespace fascicle {

struct Sphere {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};

/// Sphere that minimises sum (|x - c| - r)^2: Gauss-Newton from the linear fit |x|^2 = 2 c.x + (r^2 - |c|^2)
/// (Coope 1993). None for fewer than 4 points or points of a plane, where no sphere is best.
std::optional<Sphere> fit_sphere(const Points& points);

/// How well a joint's head is a ball.
struct JointFit {
    Sphere head;
    double rms = 0;       ///< of | |x - c| - r | over the vertices used, scene units
    int vertices = 0;     ///< used
    double coverage = 0;  ///< their area over that of the sphere
    double clearance = 0; ///< smallest distance of the moving bone to the fixed ones
};

/// Centre of the ball (the head) by which `moving` sits in a socket of `fixed`: starts from the moving bone's vertices
/// nearest to the fixed bones, then alternates between a sphere through the patch and the patch of vertices around
/// it that lie within 6 % of the radius with a normal within 25 degrees of the radial direction (the head without the
/// neck), until it settles. None when that ends in no ball: fewer than 50 vertices, rms above 3 % of the radius, less
/// than 15 % of the sphere covered, or a radius above half the bone's size.
std::optional<JointFit> fit_joint_centre(const TriMesh& moving, const std::vector<const TriMesh*>& fixed);

} // namespace fascicle
