#pragma once
// Local shape: signed dihedral constraints C = wrap(theta - theta0) on pairs of triangles, XPBD, one sweep
// per substep. Sources: Bridson, Marino, Fedkiw 2003; Grinspun et al. 2003 (angle and gradients:
// geometry/dihedral_angle.hpp).

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/geometry/mesh_topology.hpp"

#include <optional>

namespace fascicle::solver {

struct DihedralConstraint {
    std::array<int, 4> p{}; ///< wings p0, p1 and edge p2 -> p3, as Dihedral
    double rest_rad = 0;    ///< theta0
    double compliance = 0;  ///< alpha, s^2 / scene unit^2 (unit masses)
};

/// Largest angle that one projection corrects: the gradient of a strongly bent pair is good for small steps
/// only.
inline constexpr double max_correction_rad = 0.5;

/// theta - theta0, wrapped and limited to max_correction_rad, with its gradients.
struct HingeValue {
    double error_rad = 0;
    std::array<Vec3, 4> gradient;
};
/// Nothing when the pair is degenerate now (a sliver: |N|^2 < 1e-4 l^4).
std::optional<HingeValue> hinge_value(const DihedralConstraint& hinge, const Points& x);

class DihedralConstraints {
public:
    /// stiffness k in [0, 1] of one projection at the reference substep, for every pair alike: each
    /// compliance is scaled by the pair's own W = sum |grad_i theta|^2 at rest. Pairs that are degenerate at
    /// rest are left out.
    DihedralConstraints(const Points& rest, const std::vector<Dihedral>& dihedrals, double stiffness);

    std::size_t size() const { return items_.size(); }
    std::size_t bytes() const { return bytes_of(items_); }
    const std::vector<DihedralConstraint>& items() const { return items_; }

    /// One Gauss-Seidel sweep; kappa as in DistanceConstraints::project. Pairs that are degenerate now (a sliver: |N|^2 < 1e-4 l^4) are skipped and
    /// counted.
    std::size_t project(Points& x, const std::vector<double>& inverse_mass, double substep_s,
                        double kappa = 1.0) const;

private:
    std::vector<DihedralConstraint> items_;
};

} // namespace fascicle::solver
