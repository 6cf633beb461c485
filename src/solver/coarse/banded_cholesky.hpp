#pragma once
// Cholesky factor of a symmetric positive definite band matrix, in float: a preconditioner needs no more.
// Same bits whatever the vector width: every sum has its order written down.

#include "fascicle/base/bytes_of.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace fascicle::solver {

class BandedCholesky {
public:
    /// Six numbers and room for two zeros.
    using Six = std::array<float, 8>;

    /// n rows; entries (i, j) with |i - j| > band are zero. Clears the matrix.
    void reset(int n, int band);
    int size() const { return n_; }
    int band() const { return band_; }
    /// Entry (i, j), 0 <= i - j <= band, of the matrix before factor(), of its factor after.
    float& at(int i, int j) { return values_[index(i, j)]; }
    float at(int i, int j) const { return values_[index(i, j)]; }
    /// A = L L^T in place, column by column. A pivot that is not positive is replaced by a huge one, which takes its
    /// unknown out of the problem; returns how many.
    int factor();
    /// Adds v v^T, where v has the six values row[k] at unknowns 6 cluster[k], zero elsewhere; clusters all differ and are near enough
    /// for the band.
    void add_outer(const int* cluster, const Six* row, int count);
    /// Adds a matrix of the same size and band.
    void add(const BandedCholesky& other);
    /// Solves L L^T x = b for two right-hand sides at once, in place: the factor is read once for both.
    void solve(std::span<float> b0, std::span<float> b1) const;
    std::size_t bytes() const { return bytes_of(values_); }

private:
    std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_) +
               static_cast<std::size_t>(i - j);
    }
    int n_ = 0, band_ = 0, stride_ = 1;
    std::vector<float> values_; ///< column j: rows j .. j + band, contiguous
};

} // namespace fascicle::solver
