#pragma once
// Eight floats side by side (AVX2 with FMA). Two records to a register: half j of register k holds that of index 4 j + k.

#include <cstddef>
#include <cstdint>
#include <immintrin.h>

namespace fascicle::solver::fast {

struct LanesAvx2 {
    static constexpr int width = 8;
    using V = __m256;
    using I = std::int32_t __attribute__((vector_size(32)));

    static V splat(float x) { return _mm256_set1_ps(x); }
    static V load(const float* p) { return _mm256_load_ps(p); }
    static void store(float* p, V v) { _mm256_store_ps(p, v); }
    static V fma(V a, V b, V c) { return _mm256_fmadd_ps(a, b, c); }
    static V fnma(V a, V b, V c) { return _mm256_fnmadd_ps(a, b, c); }
    static V sqrt(V a) { return _mm256_sqrt_ps(a); }
    static int bits(I m) { return _mm256_movemask_ps(reinterpret_cast<__m256>(m)); }
    static std::uint32_t mask_bits(I m) { return static_cast<std::uint32_t>(bits(m)); }
    static bool any(I m) { return bits(m) != 0; }
    static int count(I m) { return __builtin_popcount(static_cast<unsigned>(bits(m))); }
    static I truncate(V a) { return reinterpret_cast<I>(_mm256_cvttps_epi32(a)); }
    static V to_float(I a) { return _mm256_cvtepi32_ps(reinterpret_cast<__m256i>(a)); }
    static I splat_int(std::int32_t x) { return reinterpret_cast<I>(_mm256_set1_epi32(x)); }
    static V gather(const float* base, I index) {
        return _mm256_i32gather_ps(base, reinterpret_cast<__m256i>(index), 4);
    }
    static I mask_from_bits(std::uint32_t mask, int from) {
        const __m256i bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        const __m256i all = _mm256_set1_epi32(static_cast<int>(mask >> from));
        return reinterpret_cast<I>(_mm256_cmpeq_epi32(_mm256_and_si256(all, bit), bit));
    }

    static void load_records(const float* base, const std::uint16_t* index, V r[4]) {
        for (int k = 0; k < 4; ++k)
            r[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(base + std::size_t{4} * index[k])),
                                        _mm_load_ps(base + std::size_t{4} * index[4 + k]), 1);
    }
    static void store_records(float* base, const std::uint16_t* index, const V r[4]) {
        for (int k = 0; k < 4; ++k) {
            _mm_store_ps(base + std::size_t{4} * index[k], _mm256_castps256_ps128(r[k]));
            _mm_store_ps(base + std::size_t{4} * index[4 + k], _mm256_extractf128_ps(r[k], 1));
        }
    }
    static void load_row(const float* base, V r[4]) {
        for (int k = 0; k < 4; ++k)
            r[k] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(base + 4 * k)),
                                        _mm_load_ps(base + 16 + 4 * k), 1);
    }
    static void store_row(float* base, const V r[4]) {
        for (int k = 0; k < 4; ++k) {
            _mm_store_ps(base + 4 * k, _mm256_castps256_ps128(r[k]));
            _mm_store_ps(base + 16 + 4 * k, _mm256_extractf128_ps(r[k], 1));
        }
    }
    static void transpose(V r[4]) {
        const V t0 = _mm256_unpacklo_ps(r[0], r[1]), t1 = _mm256_unpacklo_ps(r[2], r[3]);
        const V t2 = _mm256_unpackhi_ps(r[0], r[1]), t3 = _mm256_unpackhi_ps(r[2], r[3]);
        r[0] = _mm256_shuffle_ps(t0, t1, 0x44);
        r[1] = _mm256_shuffle_ps(t0, t1, 0xEE);
        r[2] = _mm256_shuffle_ps(t2, t3, 0x44);
        r[3] = _mm256_shuffle_ps(t2, t3, 0xEE);
    }
    template <int K>
    static V spread(V a) {
        return _mm256_permute_ps(a, K * 0x55);
    }
    static V without_w(V a) { return _mm256_blend_ps(a, _mm256_setzero_ps(), 0x88); }
};

} // namespace fascicle::solver::fast
