#include "bench/machine_limits.hpp"

#include <algorithm>

namespace fascicle::bench {

namespace {

struct Arrays {
    std::vector<float> a, b, c;
    explicit Arrays(std::size_t n) : a(n, 0.0f), b(n, 1.0f), c(n, 2.0f) {}
};

// Kept out of the loop over repeats: the compiler must not see that every repeat does the same.
[[gnu::noinline]] void triad(float* __restrict a, const float* __restrict b, const float* __restrict c,
                             float s, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + s * c[i];
}

#if defined(__x86_64__)
[[gnu::noinline, gnu::target("avx2")]] void triad_wide(float* __restrict a, const float* __restrict b,
                                                       const float* __restrict c, float s, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + s * c[i];
}
#endif

} // namespace

double triad_gigabytes(int threads, std::size_t bytes, double effort) {
    const std::size_t n = std::max<std::size_t>(1024, bytes / (3 * sizeof(float)));
    // 20 GB a thread at full effort.
    const double traffic = 20e9 * effort;
    const int repeats = std::max(2, static_cast<int>(traffic / (12.0 * double(n))));
    std::vector<Arrays> arrays;
    for (int t = 0; t < threads; ++t)
        arrays.emplace_back(n);
    const bool wide = can_run_lanes(8);
    const double seconds = run_together(threads, [&](int thread) {
        Arrays& own = arrays[static_cast<std::size_t>(thread)];
        for (int r = 0; r < repeats; ++r) {
            const float s = 1.0f + float(r & 7);
#if defined(__x86_64__)
            if (wide) {
                triad_wide(own.a.data(), own.b.data(), own.c.data(), s, n);
                continue;
            }
#endif
            triad(own.a.data(), own.b.data(), own.c.data(), s, n);
        }
    });
    static_cast<void>(wide); // unused where there is only the plain loop
    return 12e-9 * double(n) * repeats * threads / seconds;
}

} // namespace fascicle::bench
