#pragma once
// Long waves at once: an implicit Euler step of the elastic energy in the space of a ClusterBasis, before the sweep.
// A sweep moves a wave of a hundred edges by a thousandth of what it lacks; this moves it all the way. With y the
// predicted positions, f = -grad E(y) (edges, hinges) and g = grad V:
//   (P^T (1 + H) P) q + P^T g p' = P^T (f + p g),   g . P q = -(V - V_wanted),   x = y + omega P q,
// H = sum (share / alpha') grad C grad C^T, p the pressure carried from substep to substep. Forces of points in contact
// lose what pushes them into the solid: there the solid holds against them. The matrix is kept in frames that turn with
// the clusters and made anew when they have turned far or the step must be shortened much; omega makes the step end where
// the quadratic model along it is least, so a matrix of an older shape cannot make the energy grow. It changes where
// the iteration is, not where it rests. Sources: multigrid for elasticity, Brandt 1977; corotated matrices, Mueller,
// Gross 2004; rigid modes of aggregates, Vanek, Mandel, Brezina 1996.

#include "solver/coarse/coarse_matrix.hpp"

#include <cstdint>

namespace fascicle::solver {

class VolumeConstraint;

class CoarseCorrection {
public:
    CoarseCorrection() = default;
    CoarseCorrection(const Points& rest, const MeshTopology& topology,
                     const std::vector<double>& inverse_mass, int clusters, int substeps);

    bool empty() const { return matrix_.empty(); }
    const ClusterBasis& basis() const { return matrix_.basis(); }

    /// One step from x, in place; points with inverse mass 0 stay. normals: V unit normals of the last substep's
    /// contacts, zero where there was none, or empty.
    void correct(Points& x, const ElasticTerms& terms, VolumeConstraint& volume,
                 const std::vector<double>& inverse_mass, const Points& normals);

    /// The displacement of the last step, V.
    const Points& displacement() const { return u_; }
    std::int64_t assemblies() const { return assemblies_; }
    std::size_t bytes() const { return matrix_.bytes() + bytes_of(force_, gradient_, u_, q_, r_, qg_, g_); }

private:
    double curvature(const Points& x, const ElasticTerms& terms) const;

    CoarseMatrix matrix_;
    Points force_, gradient_, u_;
    std::vector<float> q_, r_, qg_, g_; ///< solution and right-hand side, of forces and of the volume
    double pressure_ = 0;               ///< p, times h^2
    bool stale_ = true;
    int age_ = 0; ///< steps since the matrix was made
    std::int64_t steps_ = 0, assemblies_ = 0;
};

} // namespace fascicle::solver
