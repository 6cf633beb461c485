#include "bench/machine_limits.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace fascicle::bench {

namespace {

constexpr int chains = 12; ///< enough to hide a latency of 4 cycles on two units, few enough for 16 registers

/// `count` steps of all chains; returns something that depends on every one of them.
using MultiplyAdd = float (*)(std::int64_t count);
/// Sum of table[index[i]] over n indices, a multiple of 64.
using Gather = float (*)(const float* table, const std::int32_t* index, std::size_t n);

float multiply_add_1(std::int64_t count) {
    float x[chains];
    for (int k = 0; k < chains; ++k)
        x[k] = float(k);
    for (std::int64_t i = 0; i < count; ++i)
        for (float& value : x)
            value = value * 0.999f + 0.001f;
    float sum = 0;
    for (const float value : x)
        sum += value;
    return sum;
}

float gather_1(const float* table, const std::int32_t* index, std::size_t n) {
    float sum[4] = {};
    for (std::size_t i = 0; i < n; i += 4)
        for (std::size_t k = 0; k < 4; ++k)
            sum[k] += table[index[i + k]];
    return sum[0] + sum[1] + sum[2] + sum[3];
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] float multiply_add_8(std::int64_t count) {
    const __m256 a = _mm256_set1_ps(0.999f), b = _mm256_set1_ps(0.001f);
    __m256 x[chains];
    for (int k = 0; k < chains; ++k)
        x[k] = _mm256_set1_ps(float(k));
    for (std::int64_t i = 0; i < count; ++i)
#pragma GCC unroll 12
        for (int k = 0; k < chains; ++k)
            x[k] = _mm256_fmadd_ps(x[k], a, b);
    for (int k = 1; k < chains; ++k)
        x[0] = _mm256_add_ps(x[0], x[k]);
    return _mm256_cvtss_f32(x[0]);
}

[[gnu::target("avx512f")]] float multiply_add_16(std::int64_t count) {
    const __m512 a = _mm512_set1_ps(0.999f), b = _mm512_set1_ps(0.001f);
    __m512 x[chains];
    for (int k = 0; k < chains; ++k)
        x[k] = _mm512_set1_ps(float(k));
    for (std::int64_t i = 0; i < count; ++i)
#pragma GCC unroll 12
        for (int k = 0; k < chains; ++k)
            x[k] = _mm512_fmadd_ps(x[k], a, b);
    for (int k = 1; k < chains; ++k)
        x[0] = _mm512_add_ps(x[0], x[k]);
    return _mm512_cvtss_f32(x[0]);
}

[[gnu::target("avx2,fma")]] float gather_8(const float* table, const std::int32_t* index, std::size_t n) {
    __m256 s0 = _mm256_setzero_ps(), s1 = s0;
    for (std::size_t i = 0; i < n; i += 16) {
        const auto* at = reinterpret_cast<const __m256i*>(index + i);
        s0 = _mm256_add_ps(s0, _mm256_i32gather_ps(table, _mm256_loadu_si256(at), 4));
        s1 = _mm256_add_ps(s1, _mm256_i32gather_ps(table, _mm256_loadu_si256(at + 1), 4));
    }
    return _mm256_cvtss_f32(_mm256_add_ps(s0, s1));
}

// Masked with all lanes on: the plain gather of g++ 12's header draws a false warning about its undefined start.
[[gnu::target("avx512f")]] float gather_16(const float* table, const std::int32_t* index, std::size_t n) {
    const __m512 zero = _mm512_setzero_ps();
    __m512 s0 = zero, s1 = zero;
    for (std::size_t i = 0; i < n; i += 32) {
        const __m512i at0 = _mm512_loadu_si512(index + i), at1 = _mm512_loadu_si512(index + i + 16);
        s0 = _mm512_add_ps(s0, _mm512_mask_i32gather_ps(zero, 0xffff, at0, table, 4));
        s1 = _mm512_add_ps(s1, _mm512_mask_i32gather_ps(zero, 0xffff, at1, table, 4));
    }
    return _mm512_cvtss_f32(_mm512_add_ps(s0, s1));
}
#else
constexpr MultiplyAdd multiply_add_8 = multiply_add_1, multiply_add_16 = multiply_add_1;
constexpr Gather gather_8 = gather_1, gather_16 = gather_1;
#endif

template <typename F>
F by_lanes(int lanes, F scalar, F eight, F sixteen) {
    FASCICLE_ASSERT(can_run_lanes(lanes));
    return lanes == 16 ? sixteen : lanes == 8 ? eight : scalar;
}

/// Where results go, so that nothing is left out as unused.
volatile float sink = 0;

} // namespace

bool can_run_lanes(int lanes) {
#if defined(__x86_64__)
    if (lanes == 16)
        return __builtin_cpu_supports("avx512f") != 0;
    if (lanes == 8)
        return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#endif
    return lanes == 1;
}

double multiply_add_gigaflops(int threads, int lanes, double effort) {
    const MultiplyAdd kernel = by_lanes<MultiplyAdd>(lanes, multiply_add_1, multiply_add_8, multiply_add_16);
    const auto count = std::max<std::int64_t>(10000, static_cast<std::int64_t>(3e8 * effort));
    std::vector<float> results(static_cast<std::size_t>(threads));
    const double seconds =
        run_together(threads, [&](int thread) { results[static_cast<std::size_t>(thread)] = kernel(count); });
    sink = results.front();
    return 2e-9 * chains * lanes * double(count) * threads / seconds;
}

double gather_nanoseconds(int threads, int lanes, std::size_t bytes, double effort) {
    const Gather kernel = by_lanes<Gather>(lanes, gather_1, gather_8, gather_16);
    const std::size_t size = std::max<std::size_t>(64, bytes / sizeof(float));
    const std::size_t n = 4096; // indices stay in L1 beside the table
    const std::vector<float> table(size, 1.0f);
    std::vector<std::int32_t> index(n * std::max<std::size_t>(1, size / n));
    std::uint32_t random = 1;
    for (std::int32_t& i : index) { // Numerical Recipes' linear congruence: any spread will do
        random = random * 1664525u + 1013904223u;
        i = static_cast<std::int32_t>((random >> 8) % size);
    }
    const std::size_t blocks = std::max<std::size_t>(2, static_cast<std::size_t>(2e9 * effort) / n);
    std::vector<float> results(static_cast<std::size_t>(threads));
    const double seconds = run_together(threads, [&](int thread) {
        float sum = 0;
        for (std::size_t block = 0; block < blocks; ++block)
            sum += kernel(table.data(), index.data() + (block * n) % index.size(), n);
        results[static_cast<std::size_t>(thread)] = sum;
    });
    sink = results.front();
    return 1e9 * seconds / (double(blocks) * double(n));
}

} // namespace fascicle::bench
