#pragma once
// A symmetric sparse matrix of 3 x 3 blocks with a pattern that stays: one block row and column per node of a lattice.

#include "fascicle/base/types.hpp"

#include <Eigen/SparseCore>

namespace fascicle::solver {

/// Both halves are stored. Blocks that may be filled: the diagonal and every pair of nodes with a common tetrahedron.
class BlockMatrix {
public:
    BlockMatrix() = default;
    /// starts: N + 1, neighbours: ascending per node (EmbeddingLattice).
    BlockMatrix(const std::vector<int>& starts, const std::vector<int>& neighbours);

    void clear();
    /// Place of block (row, column), to be handed to add(); the pair must be in the pattern.
    int place(int row, int column) const;
    /// += block; column: that of the place.
    void add(int place, int column, const Eigen::Ref<const Mat3>& block);
    /// Rows and columns of fixed unknowns become those of the identity times the mean of the diagonal.
    void fix(const std::vector<std::uint8_t>& fixed);
    void add_to_diagonal(double shift);
    double mean_diagonal() const;
    const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

private:
    std::vector<int> starts_, rows_; ///< of each block column its block rows, ascending, the diagonal in it
    Eigen::SparseMatrix<double> matrix_;
};

} // namespace fascicle::solver
