#pragma once
// Sixteen floats side by side (AVX-512 F, BW, DQ, VL). Quarter j of register k holds the record of index 4 j + k.

#include <cstddef>
#include <cstdint>
#include <immintrin.h>

namespace fascicle::solver::fast {

struct LanesAvx512 {
    static constexpr int width = 16;
    using V = __m512;
    using I = std::int32_t __attribute__((vector_size(64)));

    static V splat(float x) { return _mm512_set1_ps(x); }
    static V load(const float* p) { return _mm512_load_ps(p); }
    static void store(float* p, V v) { _mm512_store_ps(p, v); }
    static V fma(V a, V b, V c) { return _mm512_fmadd_ps(a, b, c); }
    static V fnma(V a, V b, V c) { return _mm512_fnmadd_ps(a, b, c); }
    static V sqrt(V a) { return _mm512_sqrt_ps(a); }
    static __mmask16 bits(I m) { return _mm512_movepi32_mask(reinterpret_cast<__m512i>(m)); }
    static std::uint32_t mask_bits(I m) { return bits(m); }
    static bool any(I m) { return bits(m) != 0; }
    static int count(I m) { return __builtin_popcount(bits(m)); }
    static I truncate(V a) { return reinterpret_cast<I>(_mm512_cvttps_epi32(a)); }
    static V to_float(I a) { return _mm512_cvtepi32_ps(reinterpret_cast<__m512i>(a)); }
    static I splat_int(std::int32_t x) { return reinterpret_cast<I>(_mm512_set1_epi32(x)); }
    static V gather(const float* base, I index) {
        return _mm512_i32gather_ps(reinterpret_cast<__m512i>(index), base, 4);
    }
    static I mask_from_bits(std::uint32_t mask, int from) {
        return reinterpret_cast<I>(_mm512_movm_epi32(static_cast<__mmask16>(mask >> from)));
    }

    static V four(const float* a, const float* b, const float* c, const float* d) {
        V r = _mm512_castps128_ps512(_mm_load_ps(a));
        r = _mm512_insertf32x4(r, _mm_load_ps(b), 1);
        r = _mm512_insertf32x4(r, _mm_load_ps(c), 2);
        return _mm512_insertf32x4(r, _mm_load_ps(d), 3);
    }
    static void load_records(const float* base, const std::uint16_t* index, V r[4]) {
        for (int k = 0; k < 4; ++k)
            r[k] = four(base + std::size_t{4} * index[k], base + std::size_t{4} * index[4 + k],
                        base + std::size_t{4} * index[8 + k], base + std::size_t{4} * index[12 + k]);
    }
    static void store_records(float* base, const std::uint16_t* index, const V r[4]) {
        for (int k = 0; k < 4; ++k) {
            const __m256 low = _mm512_castps512_ps256(r[k]), high = _mm512_extractf32x8_ps(r[k], 1);
            _mm_store_ps(base + std::size_t{4} * index[k], _mm256_castps256_ps128(low));
            _mm_store_ps(base + std::size_t{4} * index[4 + k], _mm256_extractf128_ps(low, 1));
            _mm_store_ps(base + std::size_t{4} * index[8 + k], _mm256_castps256_ps128(high));
            _mm_store_ps(base + std::size_t{4} * index[12 + k], _mm256_extractf128_ps(high, 1));
        }
    }
    /// A row is four whole registers; the 4 x 4 transposition of its quarters brings it into the order of load_records.
    static void turn_quarters(V r[4]) {
        const V t0 = _mm512_shuffle_f32x4(r[0], r[1], 0x44), t1 = _mm512_shuffle_f32x4(r[2], r[3], 0x44);
        const V t2 = _mm512_shuffle_f32x4(r[0], r[1], 0xEE), t3 = _mm512_shuffle_f32x4(r[2], r[3], 0xEE);
        r[0] = _mm512_shuffle_f32x4(t0, t1, 0x88);
        r[1] = _mm512_shuffle_f32x4(t0, t1, 0xDD);
        r[2] = _mm512_shuffle_f32x4(t2, t3, 0x88);
        r[3] = _mm512_shuffle_f32x4(t2, t3, 0xDD);
    }
    static void load_row(const float* base, V r[4]) {
        for (int k = 0; k < 4; ++k)
            r[k] = load(base + 16 * k);
        turn_quarters(r);
    }
    static void store_row(float* base, const V r[4]) {
        V t[4] = {r[0], r[1], r[2], r[3]};
        turn_quarters(t);
        for (int k = 0; k < 4; ++k)
            store(base + 16 * k, t[k]);
    }
    static void transpose(V r[4]) {
        const V t0 = _mm512_unpacklo_ps(r[0], r[1]), t1 = _mm512_unpacklo_ps(r[2], r[3]);
        const V t2 = _mm512_unpackhi_ps(r[0], r[1]), t3 = _mm512_unpackhi_ps(r[2], r[3]);
        r[0] = _mm512_shuffle_ps(t0, t1, 0x44);
        r[1] = _mm512_shuffle_ps(t0, t1, 0xEE);
        r[2] = _mm512_shuffle_ps(t2, t3, 0x44);
        r[3] = _mm512_shuffle_ps(t2, t3, 0xEE);
    }
    template <int K>
    static V spread(V a) {
        return _mm512_permute_ps(a, K * 0x55);
    }
    static V without_w(V a) { return _mm512_maskz_mov_ps(0x7777, a); }
};

} // namespace fascicle::solver::fast
