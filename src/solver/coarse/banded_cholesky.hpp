#pragma once
// Cholesky factor of a symmetric positive definite band matrix, in float: a preconditioner needs no more.
// Same bits whatever the vector width: every sum has its order written down.

#include "fascicle/base/bytes_of.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace fascicle::solver {

class BandedCholesky {
public:
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
    /// Solves L L^T x = b in place.
    void solve(std::span<float> b) const;
    std::size_t bytes() const { return bytes_of(values_); }

private:
    std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(stride_) +
               static_cast<std::size_t>(i - j);
    }
    void eliminate(int first, int end);
    void forward(std::span<float> b) const;
    void backward(std::span<float> b) const;
    static std::size_t place(int i) { return static_cast<std::size_t>(i); }

    int n_ = 0, band_ = 0, stride_ = 1;
    std::vector<float> values_; ///< column j: rows j .. j + band, contiguous, then some zeros
};

} // namespace fascicle::solver
