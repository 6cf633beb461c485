#pragma once
// Isotropic remeshing: edge splits, collapses, flips and tangential relaxation towards equal edge lengths.
// After M. Botsch, L. Kobbelt, "A remeshing approach to multiresolution modeling" (SGP 2004), sections 4
// and 5.

#include "fascicle/geometry/tri_mesh.hpp"

#include <functional>

namespace fascicle {

struct RemeshOptions {
    /// Wanted number of triangles (> 0). Reached exactly when even, else one less, unless the topology
    /// forbids it.
    int triangles = 0;
    int rounds = 4;
    /// Moves a point near the surface onto it. Empty: points only move in their tangent plane.
    std::function<Vec3(const Vec3&)> project;
};

/// Remeshes a closed, manifold, oriented mesh (caller's duty; asserted). The result is closed, manifold and
/// oriented and has the same topology: collapses keep the link condition (Dey, Edelsbrunner et al. 1999),
/// flips make no double edge, and no step turns a triangle's normal by more than a right angle.
/// Deterministic: all loops run in index order. Vertices that no triangle uses are dropped.
TriMesh remesh(const TriMesh& mesh, const RemeshOptions& options);

} // namespace fascicle
