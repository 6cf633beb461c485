#include "solver/coarse/banded_cholesky.hpp"

#include "fascicle/base/assert.hpp"
#include "solver/coarse/wide.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace fascicle::solver {

namespace {

constexpr int panel =
    6; ///< columns eliminated together, so that the columns right of them are read and written once for all

/// to[i] -= sum over the panel of factor[p] from[p][i].
FASCICLE_WIDE void subtract(float* __restrict to, const float* const (&from)[panel],
                            const float (&factor)[panel], int count) {
    const float *f0 = from[0], *f1 = from[1], *f2 = from[2], *f3 = from[3], *f4 = from[4], *f5 = from[5];
    for (int i = 0; i < count; ++i)
        to[i] -= (factor[0] * f0[i] + factor[1] * f1[i] + factor[2] * f2[i]) +
                 (factor[3] * f3[i] + factor[4] * f4[i] + factor[5] * f5[i]);
}

constexpr int lanes = 8; ///< partial sums of a scalar product, added in order
using Lanes = float __attribute__((vector_size(32)));

/// sum[p] = from[p] . b over `count` rows.
FASCICLE_WIDE void dots(const float* const (&from)[panel], const float* b, int count, float (&sum)[panel]) {
    Lanes total[panel] = {};
    int i = 0;
    for (; i + lanes <= count; i += lanes) {
        Lanes x, f;
        std::memcpy(&x, b + i, sizeof x);
        for (int p = 0; p < panel; ++p) {
            std::memcpy(&f, from[p] + i, sizeof f);
            total[p] += f * x;
        }
    }
    for (int p = 0; p < panel; ++p) {
        sum[p] = 0;
        for (int k = i; k < count; ++k)
            sum[p] += from[p][k] * b[k];
        for (int k = 0; k < lanes; ++k)
            sum[p] += total[p][k];
    }
}

} // namespace

void BandedCholesky::reset(int n, int band) {
    n_ = n;
    band_ = band;
    stride_ = band + panel;
    values_.assign(static_cast<std::size_t>(n) * static_cast<std::size_t>(stride_), 0.0F);
}

int BandedCholesky::factor() {
    int refused = 0;
    for (int first = 0; first < n_; first += panel) {
        const int end = std::min(first + panel, n_);
        for (int j = first; j < end; ++j) {
            float* const column = &at(j, j);
            const int last = std::min(j + band_, n_ - 1);
            if (!(column[0] > 0.0F)) {
                column[0] = 1e30F;
                ++refused;
            }
            const float pivot = std::sqrt(column[0]);
            column[0] = pivot;
            for (int i = j + 1; i <= last; ++i)
                column[i - j] /= pivot;
            for (int k = j + 1; k < std::min(end, last + 1); ++k)
                for (int i = k; i <= last; ++i)
                    at(i, k) -= at(k, j) * at(i, j);
        }
        eliminate(first, end);
    }
    return refused;
}

/// What the columns right of a panel lose when it is eliminated. Rows beyond a column's band hold the zeros they were reset to, so all
/// columns of the panel reach down to the end of the last. Only the matrix' last panel can be narrower, and right of it is nothing.
void BandedCholesky::eliminate(int first, int end) {
    const int last = std::min(end - 1 + band_, n_ - 1);
    for (int k = end; k <= last; ++k) {
        const float* from[panel];
        float factor[panel];
        for (int p = 0; p < panel; ++p) {
            from[p] = &at(k, first + p);
            factor[p] = *from[p];
        }
        subtract(&at(k, k), from, factor, last - k + 1);
    }
}

void BandedCholesky::forward(std::span<float> b) const {
    for (int first = 0; first < n_; first += panel) {
        const int end = std::min(first + panel, n_), last = std::min(end - 1 + band_, n_ - 1);
        const float* from[panel];
        float x[panel];
        for (int j = first; j < end; ++j) {
            float value = b[place(j)];
            for (int i = first; i < j; ++i)
                value -= at(j, i) * x[i - first];
            x[j - first] = b[place(j)] = value / at(j, j);
        }
        if (last < end)
            continue;
        for (int p = 0; p < panel; ++p)
            from[p] = &values_[index(end, first + p)];
        subtract(&b[place(end)], from, x, last - end + 1);
    }
}

void BandedCholesky::backward(std::span<float> b) const {
    for (int first = (n_ - 1) / panel * panel; first >= 0; first -= panel) {
        const int end = std::min(first + panel, n_), last = std::min(end - 1 + band_, n_ - 1);
        float sum[panel] = {};
        if (last >= end) {
            const float* from[panel];
            for (int p = 0; p < panel; ++p)
                from[p] = &values_[index(end, first + p)];
            dots(from, &b[place(end)], last - end + 1, sum);
        }
        for (int j = end - 1; j >= first; --j) {
            float value = b[place(j)] - sum[j - first];
            for (int i = j + 1; i < end; ++i)
                value -= at(i, j) * b[place(i)];
            b[place(j)] = value / at(j, j);
        }
    }
}

void BandedCholesky::solve(std::span<float> b) const {
    FASCICLE_ASSERT(b.size() == static_cast<std::size_t>(n_));
    forward(b);
    backward(b);
}

} // namespace fascicle::solver
