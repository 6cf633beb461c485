#pragma once
// Edges and hinges in packets of 16, for any width of lanes. Included once per instruction set; keeps away from the standard
// library, whose inline functions must not be compiled for a processor that is not there.

#include "solver/fast/layout.hpp"

namespace fascicle::solver::fast {

template <class L>
struct Vec {
    typename L::V x, y, z;
};

template <class L>
inline typename L::V dot(const Vec<L>& a, const Vec<L>& b) {
    return L::fma(a.x, b.x, L::fma(a.y, b.y, a.z * b.z));
}
template <class L>
inline Vec<L> cross(const Vec<L>& a, const Vec<L>& b) {
    return {L::fnma(a.z, b.y, a.y * b.z), L::fnma(a.x, b.z, a.z * b.x), L::fnma(a.y, b.x, a.x * b.y)};
}
template <class L>
inline Vec<L> operator-(const Vec<L>& a, const Vec<L>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// The pull of edges whose record differences are d (w zero): (rest - |d|) / |d| times `strength`, spread over each record. Zero for
/// coincident points, which have no direction, and where the length is not finite.
template <class L>
inline void edge_pull(const typename L::V d[4], typename L::V rest, typename L::V strength,
                      typename L::V g[4]) {
    using V = typename L::V;
    V t[4] = {d[0], d[1], d[2], d[3]};
    L::transpose(t);
    const V length = L::sqrt(L::fma(t[0], t[0], L::fma(t[1], t[1], t[2] * t[2])));
    V f = (rest - length) * strength / length;
    f = (length > rest * L::splat(1e-9f)) & (length < L::splat(1e18f)) ? f : L::splat(0.0f);
    g[0] = L::template spread<0>(f);
    g[1] = L::template spread<1>(f);
    g[2] = L::template spread<2>(f);
    g[3] = L::template spread<3>(f);
}

/// Distance constraints, XPBD with one sweep: dx_a = -wa n C g, dx_b = wb n C g, with C = |d| - rest, n = d / |d| and
/// g = 1 / max(wa + wb + alpha~, kappa alpha~).
template <class L>
void project_edges(float* records, const EdgePacket* packets, std::size_t count) {
    using V = typename L::V;
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const EdgePacket& e = packets[p];
            V a[4], b[4], d[4], g[4];
            L::load_records(records, e.p[0] + q, a);
            L::load_records(records, e.p[1] + q, b);
            for (int k = 0; k < 4; ++k)
                d[k] = L::without_w(a[k] - b[k]);
            // A pull that is not finite would spoil the records' weights, by which finish_substep refuses points.
            edge_pull<L>(d, L::load(e.rest + q), L::load(e.gain + q), g);
            for (int k = 0; k < 4; ++k) {
                a[k] = L::fma(L::template spread<3>(a[k]) * g[k], d[k], a[k]);
                b[k] = L::fnma(L::template spread<3>(b[k]) * g[k], d[k], b[k]);
            }
            L::store_records(records, e.p[0] + q, a);
            L::store_records(records, e.p[1] + q, b);
        }
}

/// atan(s / c) limited to +-0.5 rad, the largest angle that one projection corrects; c <= 0 counts as out of the limit.
/// Error below 1e-7 rad: odd polynomial of degree 11, fitted at Chebyshev points of |s / c| <= tan 0.5.
template <class L>
inline typename L::V limited_angle(typename L::V s, typename L::V c) {
    using V = typename L::V;
    const V limit = L::splat(0.5f), tan_limit = L::splat(0.54630249f);
    const V zero = L::splat(0.0f);
    const V size = s < zero ? -s : s;
    const auto within = size < c * tan_limit;
    const V t = within ? s / (within ? c : L::splat(1.0f)) : zero;
    const V u = t * t;
    V p = L::splat(-0.051364663f);
    p = L::fma(p, u, L::splat(0.10209738f));
    p = L::fma(p, u, L::splat(-0.14195956f));
    p = L::fma(p, u, L::splat(0.19996784f));
    p = L::fma(p, u, L::splat(-0.33333315f));
    const V angle = L::fma(p * u, t, t);
    return within ? angle : (s < zero ? -limit : limit);
}

/// Dihedral constraints. With a = p0 - p2, b = p1 - p2, e = p3 - p2: N1 = e x a, N2 = b x e, and the angle has sine
/// |e| (N1 . b) and cosine N1 . N2 up to a common positive factor (methods notes 1.1; Bridson et al. 2003). The difference
/// to the rest angle comes from the sum formulas, so it needs no wrapping. Gradients: grad p0 = |e| N1 / |N1|^2, grad p1 =
/// |e| N2 / |N2|^2, and with u0 = a.e / e.e, u1 = b.e / e.e: grad p3 = -(u0 g0 + u1 g1), grad p2 = (u0 - 1) g0 + (u1 - 1) g1.
/// Slivers, |N|^2 < 1e-4 |e|^4, are left alone. dlambda = -C / max(relax alpha~, sum w |grad|^2 + alpha~): with relax = 1 plain XPBD.
template <class L>
void project_hinges(float* records, const HingePacket* packets, std::size_t count, float relax) {
    using V = typename L::V;
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const HingePacket& h = packets[p];
            V r0[4], r1[4], r2[4], r3[4];
            L::load_records(records, h.p[0] + q, r0);
            L::load_records(records, h.p[1] + q, r1);
            L::load_records(records, h.p[2] + q, r2);
            L::load_records(records, h.p[3] + q, r3);
            L::transpose(r0);
            L::transpose(r1);
            L::transpose(r2);
            L::transpose(r3);
            const Vec<L> origin{r2[0], r2[1], r2[2]};
            const Vec<L> a = Vec<L>{r0[0], r0[1], r0[2]} - origin, b = Vec<L>{r1[0], r1[1], r1[2]} - origin,
                         e = Vec<L>{r3[0], r3[1], r3[2]} - origin;
            const Vec<L> n1 = cross(e, a), n2 = cross(b, e);
            const V e2 = dot(e, e), s1 = dot(n1, n1), s2 = dot(n2, n2), n12 = dot(n1, n2);
            const V least = L::splat(1e-4f) * e2 * e2;
            const V zero = L::splat(0.0f), one = L::splat(1.0f);
            const auto usable = (s1 >= least) & (s2 >= least) & (e2 > zero);
            const V length = L::sqrt(e2);
            const V sine = length * dot(n1, b);
            const V cos0 = L::load(h.cosine + q), sin0 = L::load(h.sine + q);
            const V error = limited_angle<L>(L::fnma(n12, sin0, sine * cos0), L::fma(n12, cos0, sine * sin0));

            const V per_s1 = one / s1, per_s2 = one / s2, per_e2 = one / e2;
            const V u0 = dot(a, e) * per_e2, u1 = dot(b, e) * per_e2;
            const V v0 = u0 - one, v1 = u1 - one;
            // e2 times: |g0|^2 = 1 / s1, |g1|^2 = 1 / s2, g0 . g1 = n12 / (s1 s2)
            const V mixed = L::splat(2.0f) * n12 * per_s1 * per_s2;
            const V g2 = L::fma(v0 * v0, per_s1, L::fma(v1 * v1, per_s2, v0 * v1 * mixed));
            const V g3 = L::fma(u0 * u0, per_s1, L::fma(u1 * u1, per_s2, u0 * u1 * mixed));
            const V sum = L::fma(r0[3], per_s1, L::fma(r1[3], per_s2, L::fma(r2[3], g2, r3[3] * g3)));
            const V compliance = L::load(h.compliance + q), least_weight = L::splat(relax) * compliance;
            V weight = L::fma(e2, sum, compliance);
            weight = weight > least_weight ? weight : least_weight;
            V m = -error * length / weight;
            m = usable & (weight > zero) ? m : zero;
            const V m1 = usable ? m * per_s1 : zero, m2 = usable ? m * per_s2 : zero;
            const Vec<L> d0{m1 * n1.x, m1 * n1.y, m1 * n1.z}, d1{m2 * n2.x, m2 * n2.y, m2 * n2.z};
            const V q0 = r2[3] * (usable ? v0 : zero), q1 = r2[3] * (usable ? v1 : zero);
            const V t0 = r3[3] * (usable ? u0 : zero), t1 = r3[3] * (usable ? u1 : zero);
            r0[0] = L::fma(r0[3], d0.x, r0[0]);
            r0[1] = L::fma(r0[3], d0.y, r0[1]);
            r0[2] = L::fma(r0[3], d0.z, r0[2]);
            r1[0] = L::fma(r1[3], d1.x, r1[0]);
            r1[1] = L::fma(r1[3], d1.y, r1[1]);
            r1[2] = L::fma(r1[3], d1.z, r1[2]);
            r2[0] = L::fma(q0, d0.x, L::fma(q1, d1.x, r2[0]));
            r2[1] = L::fma(q0, d0.y, L::fma(q1, d1.y, r2[1]));
            r2[2] = L::fma(q0, d0.z, L::fma(q1, d1.z, r2[2]));
            r3[0] = L::fnma(t0, d0.x, L::fnma(t1, d1.x, r3[0]));
            r3[1] = L::fnma(t0, d0.y, L::fnma(t1, d1.y, r3[1]));
            r3[2] = L::fnma(t0, d0.z, L::fnma(t1, d1.z, r3[2]));
            L::transpose(r0);
            L::transpose(r1);
            L::transpose(r2);
            L::transpose(r3);
            L::store_records(records, h.p[0] + q, r0);
            L::store_records(records, h.p[1] + q, r1);
            L::store_records(records, h.p[2] + q, r2);
            L::store_records(records, h.p[3] + q, r3);
        }
}

} // namespace fascicle::solver::fast
