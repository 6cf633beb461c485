#pragma once
// The global step's linear system, (L + D) x = b for the free vertices, factored once and again only when D changes.
// L: the weighted Laplacian of eq. 9 of Sorkine & Alexa 2007, columns of held vertices on the right side. D: a diagonal, >= 0, of
// penalties towards a place. Symmetric and positive definite when each part of the surface has a held vertex or a penalty.

#include "solver/rivals/arap/arap_cells.hpp"

#include <Eigen/SparseCholesky>

namespace fascicle::solver {

class ArapSystem {
public:
    /// free: V, 0 for held vertices and for those of no triangle. penalties: V, of free vertices.
    ArapSystem(const ArapCells& cells, const std::vector<std::uint8_t>& free,
               const std::vector<double>& penalties);

    /// Factors anew, in the same elimination order. Throws Error when the matrix is not positive definite.
    void set_penalties(const std::vector<double>& penalties);
    /// Replaces x of free vertices by the solution; x of the others is what they are held at. b: V, with the penalties' own part.
    /// Along with it, y = (L + D)^-1 f for free vertices, zero for the others: how they give way to forces f (V).
    void solve(const Points& b, const Points& f, Points& x, Points& y);

    std::size_t unknowns() const { return vertex_.size(); }
    std::size_t bytes() const;

private:
    const ArapCells* cells_;
    std::vector<int> vertex_;  ///< of an unknown
    std::vector<int> unknown_; ///< of a vertex, -1 held
    Eigen::SparseMatrix<double> matrix_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
    using Two = Eigen::Matrix<double, 3, 2>;
    std::vector<Two> work_;
};

} // namespace fascicle::solver
