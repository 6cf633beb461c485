#include "solver/contact/grid_slope.hpp"

#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fascicle::solver {

namespace {

#if defined(__GNUC__) && !defined(__clang__)
#define FASCICLE_FINITE                                                                                      \
    __attribute__((optimize("O3", "no-trapping-math", "finite-math-only", "no-signed-zeros")))
#else
#define FASCICLE_FINITE
#endif

/// Largest dx^2 + dy^2 + dz^2 of a row of cells whose edges along x lie on the rows a, b, c, d of `nodes` nodes. Grid values are
/// finite, which the compiler may know here: then it takes maxima of many cells at once.
FASCICLE_FINITE float steepest_cell(const float* a, const float* b, const float* c, const float* d,
                                    std::size_t nodes) {
    const auto square = [](float x) { return x * x; };
    const auto larger = [](float x, float y) { return x > y ? x : y; };
    float most = 0.0f;
    for (std::size_t i = 0; i + 1 < nodes; ++i) {
        const float x = larger(larger(square(a[i + 1] - a[i]), square(b[i + 1] - b[i])),
                               larger(square(c[i + 1] - c[i]), square(d[i + 1] - d[i])));
        const float y = larger(larger(square(b[i] - a[i]), square(b[i + 1] - a[i + 1])),
                               larger(square(d[i] - c[i]), square(d[i + 1] - c[i + 1])));
        const float z = larger(larger(square(c[i] - a[i]), square(c[i + 1] - a[i + 1])),
                               larger(square(d[i] - b[i]), square(d[i + 1] - b[i + 1])));
        most = larger(most, x + y + z);
    }
    return most;
}

} // namespace

double largest_slope(const DistanceGrid& grid, int threads) {
    const auto [nx, ny, nz] = grid.nodes();
    if (nx < 2 || ny < 2 || nz < 2)
        return 1.0;
    const float* values = grid.values().data();
    const auto row = static_cast<std::size_t>(nx), layer = row * static_cast<std::size_t>(ny);
    const auto layers = static_cast<std::size_t>(nz - 1), rows = static_cast<std::size_t>(ny - 1);
    std::vector<float> largest(layers, 0.0f); // squared, per layer of cells
    parallel_for(threads, layers, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            float most = 0.0f;
            for (std::size_t j = 0; j < rows; ++j) {
                const float* a = values + layer * k + row * j;
                most = std::max(most, steepest_cell(a, a + row, a + layer, a + layer + row, row));
            }
            largest[k] = most;
        }
    });
    const float most = *std::max_element(largest.begin(), largest.end());
    return std::max(1.0, 1.0001 * std::sqrt(static_cast<double>(most)) / grid.spacing());
}

} // namespace fascicle::solver
