#pragma once
// Dihedral angles in the form of Mueller et al. 2007 (paper eq. 4), unsigned: C = acos(n1.n2) - (pi - phi0).

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"
#include "solver/classic/classic_state.hpp"

#include <optional>

namespace fascicle::classic {

/// Two triangles at the edge p1-p2 with wings p3, p4. rest_rad: phi0 = acos(nA.nB) of the outward normals at
/// rest, 0 = flat, in [0, pi].
struct BendingPair {
    int p1, p2, p3, p4;
    double rest_rad;
};

/// Pairs in the program's order: triangle by triangle and corner by corner, each pair at its later triangle.
/// Where more than two triangles share an edge, a triangle is paired with the first other one. The acos is
/// clamped (the program takes acos of 1 + rounding and gets NaN); triangles without area make no pair.
std::vector<BendingPair> bending_pairs(const TriMesh& mesh, const MeshTopology& topology);

/// Mueller's quantities for p1 at the origin, n1 = p2 x p3/|.|, n2 = p2 x p4/|.| (flat: opposite, d = -1):
/// cosine d = n1.n2, angle acos d in (0, pi), and q_i with grad_i(acos d) = q_i / sqrt(1 - d^2).
struct BendingTerms {
    double cosine, angle_rad;
    Vec3 q1, q2, q3, q4;
};
/// Nothing when a wing has no area (|N|^2 < 1e-12 l^4), or when |d| > 1 - 1e-10: flat or folded, where the
/// form is 0/0.
std::optional<BendingTerms> bending_terms(const Vec3& p1, const Vec3& p2, const Vec3& p3, const Vec3& p4);

/// published (notes 1.3): r = -4 sqrt(1-d^2) C bending / (max(1e-4, sum|q|^2) sum w), dp_i = r w_i q_i, and
/// only when 0.1 <= r <= 10. r has the unit of an area, so the window depends on unit and mesh; r < 0
/// (flatter than at rest) is never corrected. sum w = 4, because fixed vertices count as movable. meant: dp_i
/// = -bending w_i sqrt(1-d^2) C q_i / sum_j w_j |q_j|^2, both ways, no window, with |C| <= 0.5 rad in
/// one projection (no unit in it).
void project_bending(ClassicState& state, const std::vector<BendingPair>& pairs, double bending, bool meant);

} // namespace fascicle::classic
