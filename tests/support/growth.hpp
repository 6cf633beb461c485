#pragma once
// How the work of something grows with its size, on a machine that does other things, too.

#include <algorithm>
#include <ctime>

namespace fascicle::test {

/// Processor time of work(4 n) by that of work(n): 4 for what is linear, 16 for what is quadratic. The best of two runs each.
template <typename Work>
double growth(int n, const Work& work) {
    const auto seconds = [&](int size) {
        double best = 1e9;
        for (int i = 0; i < 2; ++i) {
            const std::clock_t start = std::clock();
            work(size);
            best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
        }
        return best;
    };
    const double small = std::max(seconds(n), 1e-3);
    return seconds(4 * n) / small;
}

} // namespace fascicle::test
