#include "solver/fast/grid_slope.hpp"

#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace fascicle::solver::fast {

namespace {

float square(float x) {
    return x * x;
}

} // namespace

double largest_slope(const DistanceGrid& grid, int threads) {
    const auto [nx, ny, nz] = grid.nodes();
    if (nx < 2 || ny < 2 || nz < 2)
        return 1.0;
    const float* values = grid.values().data();
    const auto row = static_cast<std::size_t>(nx), layer = row * static_cast<std::size_t>(ny);
    const auto layers = static_cast<std::size_t>(nz - 1);
    std::vector<float> largest(layers, 0.0f); // squared, per layer of cells
    parallel_for(threads, layers, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            float most = 0.0f;
            for (std::size_t j = 0; j + 1 < static_cast<std::size_t>(ny); ++j) {
                const float *a = values + layer * k + row * j, *b = a + row, *c = a + layer, *d = c + row;
                for (std::size_t i = 0; i + 1 < row; ++i) {
                    const float x = std::max(std::max(square(a[i + 1] - a[i]), square(b[i + 1] - b[i])),
                                             std::max(square(c[i + 1] - c[i]), square(d[i + 1] - d[i])));
                    const float y = std::max(std::max(square(b[i] - a[i]), square(b[i + 1] - a[i + 1])),
                                             std::max(square(d[i] - c[i]), square(d[i + 1] - c[i + 1])));
                    const float z = std::max(std::max(square(c[i] - a[i]), square(c[i + 1] - a[i + 1])),
                                             std::max(square(d[i] - b[i]), square(d[i + 1] - b[i + 1])));
                    most = std::max(most, x + y + z);
                }
            }
            largest[k] = most;
        }
    });
    const float most = *std::max_element(largest.begin(), largest.end());
    return std::max(1.0, 1.0001 * std::sqrt(static_cast<double>(most)) / grid.spacing());
}

} // namespace fascicle::solver::fast
