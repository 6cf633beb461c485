#pragma once
// Volume, area and centroid of triangle surfaces. Units: those of the points (mm, mm^2, mm^3 for a scene in
// mm). Every function takes V points and T index triples into them; indices must be in range.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// V = 1/6 sum over triangles (a - c) . ((b - c) x (d - c)), with c the mean of the triangles' corners, so
/// that a surface far from the origin loses no digits (divergence theorem; methods.md 1.1, volume). Positive
/// for a closed surface whose triangles are counter-clockwise seen from outside, negative inside out, zero
/// for no triangles. For a surface with holes it is the volume of the cones from c, which has no meaning of
/// its own.
double signed_volume(const Points& points, const std::vector<Tri>& triangles);

/// Gradient of the volume of a closed surface: grad_i = 1/6 sum over triangles (i, j, k) of (x_j - c) x (x_k
/// - c); V vectors (unit: area), resized by the call; zero at vertices without triangles. They sum to zero on
/// a closed surface, where c drops out. On a surface with holes: the gradient with c held fixed.
void volume_gradient(const Points& points, const std::vector<Tri>& triangles, Points& gradient);

/// Sum of the triangles' areas, >= 0.
double surface_area(const Points& points, const std::vector<Tri>& triangles);

/// Area-weighted centroid of the surface. Zero area: the mean of the triangles' corners; no triangles: the
/// mean of the points; no points: the origin.
Vec3 surface_centroid(const Points& points, const std::vector<Tri>& triangles);

/// Generalised winding number of the surface at x: 1/(4 pi) sum of the triangles' solid angles
/// (Jacobson, Kavan, Sorkine-Hornung 2013; solid angle by van Oosterom & Strackee 1983). About 1 inside a
/// closed surface, 0 outside, in between near holes. Brute force over all triangles: for single points and as
/// an oracle.
double winding_number(const Points& points, const std::vector<Tri>& triangles, const Vec3& x);

} // namespace fascicle
