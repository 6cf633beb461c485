#pragma once
// Four floats side by side in the compiler's vector type: runs on every processor.

#include <cmath>
#include <cstdint>

namespace fascicle::solver::fast {

struct LanesPortable {
    static constexpr int width = 4;
    using V = float __attribute__((vector_size(16)));
    using I = std::int32_t __attribute__((vector_size(16)));

    static V splat(float x) { return V{x, x, x, x}; }
    static V load(const float* p) { return *reinterpret_cast<const V*>(p); }
    static void store(float* p, V v) { *reinterpret_cast<V*>(p) = v; }
    static V fma(V a, V b, V c) { return a * b + c; }
    static V fnma(V a, V b, V c) { return c - a * b; }
    static V sqrt(V a) { return V{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }
    static bool any(I m) { return (m[0] | m[1] | m[2] | m[3]) != 0; }
    static int count(I m) { return -(m[0] + m[1] + m[2] + m[3]); }
    static I truncate(V a) { return __builtin_convertvector(a, I); }
    static V to_float(I a) { return __builtin_convertvector(a, V); }
    static I splat_int(std::int32_t x) { return I{x, x, x, x}; }
    static V gather(const float* base, I index) {
        return V{base[index[0]], base[index[1]], base[index[2]], base[index[3]]};
    }
    /// Bit i: lane i of the mask.
    static std::uint32_t mask_bits(I m) {
        return (m[0] != 0 ? 1u : 0u) | (m[1] != 0 ? 2u : 0u) | (m[2] != 0 ? 4u : 0u) | (m[3] != 0 ? 8u : 0u);
    }
    /// Bits of `bits` from position `from` as a mask.
    static I mask_from_bits(std::uint32_t bits, int from) {
        return I{-static_cast<std::int32_t>(bits >> from & 1u),
                 -static_cast<std::int32_t>(bits >> (from + 1) & 1u),
                 -static_cast<std::int32_t>(bits >> (from + 2) & 1u),
                 -static_cast<std::int32_t>(bits >> (from + 3) & 1u)};
    }

    /// Record k of r is that of index k.
    static void load_records(const float* base, const std::uint16_t* index, V r[4]) {
        for (int k = 0; k < 4; ++k)
            r[k] = load(base + std::size_t{4} * index[k]);
    }
    static void store_records(float* base, const std::uint16_t* index, const V r[4]) {
        for (int k = 0; k < 4; ++k)
            store(base + std::size_t{4} * index[k], r[k]);
    }
    /// The same for consecutive records.
    static void load_row(const float* base, V r[4]) {
        for (int k = 0; k < 4; ++k)
            r[k] = load(base + 4 * k);
    }
    static void store_row(float* base, const V r[4]) {
        for (int k = 0; k < 4; ++k)
            store(base + 4 * k, r[k]);
    }
    /// From records to x, y, z, w and back.
    static void transpose(V r[4]) {
        const V t0 = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5),
                t1 = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
        const V t2 = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7),
                t3 = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
        r[0] = __builtin_shufflevector(t0, t1, 0, 1, 4, 5);
        r[1] = __builtin_shufflevector(t0, t1, 2, 3, 6, 7);
        r[2] = __builtin_shufflevector(t2, t3, 0, 1, 4, 5);
        r[3] = __builtin_shufflevector(t2, t3, 2, 3, 6, 7);
    }
    /// Element K of every record, in all four places of that record.
    template <int K>
    static V spread(V a) {
        return __builtin_shufflevector(a, a, K, K, K, K);
    }
    /// The fourth place of every record set to zero.
    static V without_w(V a) { return V{a[0], a[1], a[2], 0.0f}; }
};

} // namespace fascicle::solver::fast
