#include "solver/coarse/banded_cholesky.hpp"

#include "fascicle/base/assert.hpp"
#include "solver/coarse/wide.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

/// What the columns right of column j lose when it is eliminated.
FASCICLE_WIDE void eliminate(const float* column, float* next, int count, int stride) {
    for (int k = 1; k < count; ++k, next += stride) {
        const float factor = column[k];
        if (factor == 0.0F)
            continue;
        const float* const from = column + k;
        const int length = count - k;
        for (int i = 0; i < length; ++i)
            next[i] -= factor * from[i];
    }
}

FASCICLE_WIDE void forward(const float* values, int n, int band, int stride, float* b0, float* b1) {
    for (int j = 0; j < n; ++j) {
        const float* const column = values + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride);
        const float x0 = b0[j] / column[0], x1 = b1[j] / column[0];
        b0[j] = x0;
        b1[j] = x1;
        const int count = std::min(band, n - 1 - j);
        for (int i = 1; i <= count; ++i) {
            b0[j + i] -= column[i] * x0;
            b1[j + i] -= column[i] * x1;
        }
    }
}

/// The lower half of v v^T, six rows and columns a cluster; to each column go eight values, the last two zero, which is quicker than six.
/// step: from one column of the band to the same row of the next.
FASCICLE_WIDE void add_lower(float* values, std::size_t stride, const int* cluster,
                             const BandedCholesky::Six* row, int count) {
    for (int k = 0; k < count; ++k) {
        const float* const a = row[k].data();
        for (int l = 0; l < count; ++l) {
            if (cluster[k] < cluster[l])
                continue;
            const float* const b = row[l].data();
            float* to = values + static_cast<std::size_t>(6 * cluster[l]) * stride +
                        static_cast<std::size_t>(6 * (cluster[k] - cluster[l]));
            if (k == l) {
                for (int j = 0; j < 6; ++j, to += stride)
                    for (int i = j; i < 6; ++i)
                        to[i - j] += a[i] * b[j];
                continue;
            }
            for (int j = 0; j < 6; ++j, to += stride - 1)
                for (int i = 0; i < 8; ++i)
                    to[i] += a[i] * b[j];
        }
    }
}

constexpr int lanes = 16; ///< partial sums of a scalar product, added in order

FASCICLE_WIDE void backward(const float* values, int n, int band, int stride, float* b0, float* b1) {
    for (int j = n - 1; j >= 0; --j) {
        const float* const column = values + static_cast<std::size_t>(j) * static_cast<std::size_t>(stride);
        const int count = std::min(band, n - 1 - j);
        float s0[lanes] = {}, s1[lanes] = {};
        int i = 1;
        for (; i + lanes <= count + 1; i += lanes)
            for (int k = 0; k < lanes; ++k) {
                s0[k] += column[i + k] * b0[j + i + k];
                s1[k] += column[i + k] * b1[j + i + k];
            }
        float sum0 = 0, sum1 = 0;
        for (; i <= count; ++i) {
            sum0 += column[i] * b0[j + i];
            sum1 += column[i] * b1[j + i];
        }
        for (int k = 0; k < lanes; ++k) {
            sum0 += s0[k];
            sum1 += s1[k];
        }
        b0[j] = (b0[j] - sum0) / column[0];
        b1[j] = (b1[j] - sum1) / column[0];
    }
}

} // namespace

void BandedCholesky::reset(int n, int band) {
    n_ = n;
    band_ = band;
    stride_ = band + 1;
    values_.assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(stride_) + 2,
                   0.0F); // add_outer writes eight
}

void BandedCholesky::add_outer(const int* cluster, const Six* row, int count) {
    add_lower(values_.data(), static_cast<std::size_t>(stride_), cluster, row, count);
}

void BandedCholesky::add(const BandedCholesky& other) {
    FASCICLE_ASSERT(other.values_.size() == values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i)
        values_[i] += other.values_[i];
}

int BandedCholesky::factor() {
    int refused = 0;
    for (int j = 0; j < n_; ++j) {
        float* const column = &at(j, j);
        const int count = std::min(band_, n_ - 1 - j) + 1;
        if (!(column[0] > 0.0F)) {
            column[0] = 1e30F;
            ++refused;
        }
        const float pivot = std::sqrt(column[0]);
        column[0] = pivot;
        for (int i = 1; i < count; ++i)
            column[i] /= pivot;
        eliminate(column, column + stride_, count, stride_);
    }
    return refused;
}

void BandedCholesky::solve(std::span<float> b0, std::span<float> b1) const {
    FASCICLE_ASSERT(b0.size() == static_cast<std::size_t>(n_) && b1.size() == b0.size());
    forward(values_.data(), n_, band_, stride_, b0.data(), b1.data());
    backward(values_.data(), n_, band_, stride_, b0.data(), b1.data());
}

} // namespace fascicle::solver
