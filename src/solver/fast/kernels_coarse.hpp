#pragma once
// The parts of the coarse step that visit every constraint or vertex, for any width of lanes: forces, their sums over clusters, and
// the displacement that follows from the clusters' motion.

#include "solver/fast/kernels_samples.hpp"

namespace fascicle::solver::fast {

/// Adds the elastic forces of edges, f_a = -s C n and f_b = s C n.
template <class L>
void edge_forces(const float* records, float* forces, const EdgePacket* packets, std::size_t count) {
    using V = typename L::V;
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const EdgePacket& e = packets[p];
            V a[4], b[4], d[4], g[4];
            L::load_records(records, e.p[0] + q, a);
            L::load_records(records, e.p[1] + q, b);
            for (int k = 0; k < 4; ++k)
                d[k] = L::without_w(a[k] - b[k]);
            edge_pull<L>(d, L::load(e.rest + q), L::load(e.stiffness + q), g);
            L::load_records(forces, e.p[0] + q, a);
            L::load_records(forces, e.p[1] + q, b);
            for (int k = 0; k < 4; ++k) {
                a[k] = L::fma(g[k], d[k], a[k]);
                b[k] = L::fnma(g[k], d[k], b[k]);
            }
            L::store_records(forces, e.p[0] + q, a);
            L::store_records(forces, e.p[1] + q, b);
        }
}

/// Angle error and gradients of 4 corners of hinges, as project_hinges has them: grad p0 = k0 n1, grad p1 = k1 n2, grad p2 = v0 g0 +
/// v1 g1, grad p3 = -(u0 g0 + u1 g1).
template <class L>
struct HingeState {
    Vec<L> g0, g1;
    typename L::V u0, u1, v0, v1;
    typename L::V error;  ///< limited; zero where the pair is a sliver
    typename L::V square; ///< sum of |grad|^2 over the four corners
};

template <class L>
inline HingeState<L> hinge_state(const float* records, const HingePacket& h, std::size_t q) {
    using V = typename L::V;
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
    const auto usable = (s1 >= least) & (s2 >= least) & (e2 > zero) & (e2 < L::splat(1e18f));
    const V length = usable ? L::sqrt(e2) : zero;
    const V cos0 = L::load(h.cosine + q), sin0 = L::load(h.sine + q);
    const V sine = length * dot(n1, b);
    const V error = limited_angle<L>(L::fnma(n12, sin0, sine * cos0), L::fma(n12, cos0, sine * sin0));
    const V per_s1 = usable ? one / s1 : zero, per_s2 = usable ? one / s2 : zero,
            per_e2 = usable ? one / e2 : zero;
    HingeState<L> state;
    state.u0 = dot(a, e) * per_e2;
    state.u1 = dot(b, e) * per_e2;
    state.v0 = state.u0 - one;
    state.v1 = state.u1 - one;
    const V k0 = length * per_s1, k1 = length * per_s2;
    state.g0 = {k0 * n1.x, k0 * n1.y, k0 * n1.z};
    state.g1 = {k1 * n2.x, k1 * n2.y, k1 * n2.z};
    state.error = usable ? error : zero;
    const V mixed = L::splat(2.0f) * n12 * per_s1 * per_s2;
    const V g2 =
        L::fma(state.v0 * state.v0, per_s1, L::fma(state.v1 * state.v1, per_s2, state.v0 * state.v1 * mixed));
    const V g3 =
        L::fma(state.u0 * state.u0, per_s1, L::fma(state.u1 * state.u1, per_s2, state.u0 * state.u1 * mixed));
    state.square = length * length * (per_s1 + per_s2 + g2 + g3);
    return state;
}

/// Stiffness of a hinge. From some gradient on it falls with it: there the angle is far from linear.
template <class L>
inline typename L::V hinge_stiffness(typename L::V compliance, typename L::V square,
                                     const HingeSprings& springs) {
    const typename L::V thin = L::splat(springs.thin) * square;
    const typename L::V least = compliance > thin ? compliance : thin;
    return least > L::splat(0.0f) ? L::splat(springs.share) / least : L::splat(0.0f);
}

/// Adds the elastic forces of hinges, -s C grad C.
template <class L>
void hinge_forces(const float* records, float* forces, const HingePacket* packets, std::size_t count,
                  const HingeSprings& springs) {
    using V = typename L::V;
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const HingePacket& h = packets[p];
            const HingeState<L> s = hinge_state<L>(records, h, q);
            const V f = -s.error * hinge_stiffness<L>(L::load(h.compliance + q), s.square, springs);
            const Vec<L> d0{f * s.g0.x, f * s.g0.y, f * s.g0.z}, d1{f * s.g1.x, f * s.g1.y, f * s.g1.z};
            const V zero = L::splat(0.0f);
            const auto add = [&](const std::uint16_t* index, V x, V y, V z) {
                V d[4] = {x, y, z, zero}, r[4];
                L::transpose(d);
                L::load_records(forces, index, r);
                for (int k = 0; k < 4; ++k)
                    r[k] = r[k] + d[k];
                L::store_records(forces, index, r);
            };
            add(h.p[0] + q, d0.x, d0.y, d0.z);
            add(h.p[1] + q, d1.x, d1.y, d1.z);
            add(h.p[2] + q, L::fma(s.v0, d0.x, s.v1 * d1.x), L::fma(s.v0, d0.y, s.v1 * d1.y),
                L::fma(s.v0, d0.z, s.v1 * d1.z));
            add(h.p[3] + q, -L::fma(s.u0, d0.x, s.u1 * d1.x), -L::fma(s.u0, d0.y, s.u1 * d1.y),
                -L::fma(s.u0, d0.z, s.u1 * d1.z));
        }
}

/// Sum over every `stride`-th packet of s (grad C . u)^2: the stiffness of the displacement u.
template <class L>
double edge_stiffness_along(const float* records, const float* moves, const EdgePacket* packets,
                            std::size_t count, std::size_t stride) {
    using V = typename L::V;
    V total = L::splat(0.0f);
    for (std::size_t p = 0; p < count; p += stride)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const EdgePacket& e = packets[p];
            V a[4], b[4], d[4], u[4];
            L::load_records(records, e.p[0] + q, a);
            L::load_records(records, e.p[1] + q, b);
            for (int k = 0; k < 4; ++k)
                d[k] = a[k] - b[k];
            L::load_records(moves, e.p[0] + q, a);
            L::load_records(moves, e.p[1] + q, b);
            for (int k = 0; k < 4; ++k)
                u[k] = a[k] - b[k];
            L::transpose(d);
            L::transpose(u);
            const V square = L::fma(d[0], d[0], L::fma(d[1], d[1], d[2] * d[2]));
            const V along = L::fma(d[0], u[0], L::fma(d[1], u[1], d[2] * u[2]));
            const V part = L::load(e.stiffness + q) * along * along / square;
            total = total + (square > L::splat(0.0f) ? part : L::splat(0.0f));
        }
    return sum<L>(total);
}

template <class L>
double hinge_stiffness_along(const float* records, const float* moves, const HingePacket* packets,
                             std::size_t count, std::size_t stride, const HingeSprings& springs) {
    using V = typename L::V;
    V total = L::splat(0.0f);
    for (std::size_t p = 0; p < count; p += stride)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const HingePacket& h = packets[p];
            const HingeState<L> s = hinge_state<L>(records, h, q);
            V u[4][4];
            for (std::size_t k = 0; k < 4; ++k) {
                L::load_records(moves, h.p[k] + q, u[k]);
                L::transpose(u[k]);
            }
            const auto combined = [&](int d) { return L::fma(s.v0, u[2][d], u[0][d]) - s.u0 * u[3][d]; };
            const auto combined1 = [&](int d) { return L::fma(s.v1, u[2][d], u[1][d]) - s.u1 * u[3][d]; };
            const V along = dot(s.g0, Vec<L>{combined(0), combined(1), combined(2)}) +
                            dot(s.g1, Vec<L>{combined1(0), combined1(1), combined1(2)});
            total = total + along * along * hinge_stiffness<L>(L::load(h.compliance + q), s.square, springs);
        }
    return sum<L>(total);
}

/// Turns forces into what the coarse step balances: the volume's pressure added, and the part that presses a touching vertex into its solid
/// left out. `gradients` becomes the volume gradient as records, without its part along contact normals. Vertices that cannot
/// move get nothing.
template <class L>
void gather_loads(const VertexArrays& v, std::size_t begin, std::size_t end, float pressure, float* forces,
                  float* gradients) {
    using V = typename L::V;
    const V zero = L::splat(0.0f), p = L::splat(pressure);
    for (std::size_t g = begin; g < end; ++g) {
        const VertexGroup& group = v.groups[g];
        for (std::size_t q = 0; q < packet; q += L::width) {
            V x[4], f[4];
            L::load_row(v.records + 4 * (packet * g + q), x);
            L::load_row(forces + 4 * (packet * g + q), f);
            L::transpose(x);
            L::transpose(f);
            Vec<L> gradient = load_vec<L>(group.gradient, q);
            Vec<L> load{L::fma(p, gradient.x, f[0]), L::fma(p, gradient.y, f[1]),
                        L::fma(p, gradient.z, f[2])};
            if (group.touched != 0) {
                const Vec<L> n = load_vec<L>(group.normal, q);
                V into = dot(load, n);
                into = into < zero ? into : zero;
                load = {L::fnma(into, n.x, load.x), L::fnma(into, n.y, load.y), L::fnma(into, n.z, load.z)};
                const V along = dot(gradient, n);
                gradient = {L::fnma(along, n.x, gradient.x), L::fnma(along, n.y, gradient.y),
                            L::fnma(along, n.z, gradient.z)};
            }
            f[0] = x[3] * load.x;
            f[1] = x[3] * load.y;
            f[2] = x[3] * load.z;
            f[3] = zero;
            L::transpose(f);
            L::store_row(forces + 4 * (packet * g + q), f);
            x[0] = x[3] * gradient.x;
            x[1] = x[3] * gradient.y;
            x[2] = x[3] * gradient.z;
            x[3] = zero;
            L::transpose(x);
            L::store_row(gradients + 4 * (packet * g + q), x);
        }
    }
}

/// For loads t and s: out[0 .. 2] = sum of w t, out[3 .. 5] = sum of w (x - c) x t, out[6 .. 11] the same of s, over a cluster's members.
template <class L>
void sum_loads(const float* records, const float* first, const float* second, const CoarseMembers& m,
               const float centre[3], float out[12]) {
    using V = typename L::V;
    V total[12];
    for (V& t : total)
        t = L::splat(0.0f);
    const Vec<L> c{L::splat(centre[0]), L::splat(centre[1]), L::splat(centre[2])};
    for (std::size_t p = 0; p < m.count; ++p)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const MemberPacket& e = m.packets[p];
            V x[4], t[4];
            L::load_records(records + std::size_t{4} * e.base, e.index + q, x);
            L::transpose(x);
            const Vec<L> arm = Vec<L>{x[0], x[1], x[2]} - c;
            const V w = L::load(e.weight + q);
            for (int k = 0; k < 2; ++k) {
                L::load_records((k == 0 ? first : second) + std::size_t{4} * e.base, e.index + q, t);
                L::transpose(t);
                const Vec<L> f{w * t[0], w * t[1], w * t[2]};
                const Vec<L> turn = cross<L>(arm, f);
                V* sums = total + 6 * k;
                sums[0] = sums[0] + f.x;
                sums[1] = sums[1] + f.y;
                sums[2] = sums[2] + f.z;
                sums[3] = sums[3] + turn.x;
                sums[4] = sums[4] + turn.y;
                sums[5] = sums[5] + turn.z;
            }
        }
    for (int i = 0; i < 12; ++i)
        out[i] = static_cast<float>(sum<L>(total[i]));
}

/// out[0 .. 2]: sum of w (x - c); out[3 .. 11]: sum of w (x - c) (r - d)^T, row-major, over a cluster's members, with c and d the
/// centres now and in the reference r.
template <class L>
void sum_shape(const float* records, const float* reference, const CoarseMembers& m, const float centres[6],
               float out[12]) {
    using V = typename L::V;
    V total[12];
    for (V& t : total)
        t = L::splat(0.0f);
    for (std::size_t p = 0; p < m.count; ++p)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const MemberPacket& e = m.packets[p];
            V x[4], r[4];
            L::load_records(records + std::size_t{4} * e.base, e.index + q, x);
            L::load_records(reference + std::size_t{4} * e.base, e.index + q, r);
            L::transpose(x);
            L::transpose(r);
            const V w = L::load(e.weight + q);
            for (int i = 0; i < 3; ++i) {
                const V d = w * (x[i] - L::splat(centres[i]));
                total[i] = total[i] + d;
                for (int j = 0; j < 3; ++j)
                    total[3 + 3 * i + j] = L::fma(d, r[j] - L::splat(centres[3 + j]), total[3 + 3 * i + j]);
            }
        }
    for (int i = 0; i < 12; ++i)
        out[i] = static_cast<float>(sum<L>(total[i]));
}

/// moves = sum over a vertex's clusters of w (u + omega x x), with u and omega as pairs of records per cluster. Returns sum |moves|^2.
template <class L>
double spread_motion(const VertexArrays& v, const CoarseShare* shares, std::size_t begin, std::size_t end,
                     const float* motion, float* moves) {
    using V = typename L::V;
    const V zero = L::splat(0.0f);
    V total = zero;
    for (std::size_t g = begin; g < end; ++g)
        for (std::size_t q = 0; q < packet; q += L::width) {
            V x[4];
            L::load_row(v.records + 4 * (packet * g + q), x);
            L::transpose(x);
            V u[4] = {zero, zero, zero, zero}, o[4] = {zero, zero, zero, zero};
            for (std::size_t k = 0; k < 4; ++k) {
                const V w = L::load(shares[g].weight[k] + q);
                V a[4], b[4];
                L::load_records(motion, shares[g].cluster[k] + q, a);
                L::load_records(motion + 4 * max_clusters, shares[g].cluster[k] + q, b);
                L::transpose(a);
                L::transpose(b);
                for (int d = 0; d < 3; ++d) {
                    u[d] = L::fma(w, a[d], u[d]);
                    o[d] = L::fma(w, b[d], o[d]);
                }
            }
            const Vec<L> turn = cross<L>(Vec<L>{o[0], o[1], o[2]}, Vec<L>{x[0], x[1], x[2]});
            V r[4] = {u[0] + turn.x, u[1] + turn.y, u[2] + turn.z, zero};
            total = L::fma(r[0], r[0], L::fma(r[1], r[1], L::fma(r[2], r[2], total)));
            L::transpose(r);
            L::store_row(moves + 4 * (packet * g + q), r);
        }
    return sum<L>(total);
}

/// x += share * moves.
template <class L>
void apply_motion(float* records, const float* moves, std::size_t begin, std::size_t end, float share) {
    for (std::size_t i = 4 * packet * begin; i < 4 * packet * end; i += L::width)
        L::store(records + i, L::fma(L::splat(share), L::load(moves + i), L::load(records + i)));
}

template <class L>
constexpr Kernels make_kernels(const char* name) {
    return {name,
            L::width,
            project_edges<L>,
            project_hinges<L>,
            volume_gradients<L>,
            finish_substep<L>,
            check_samples<L>,
            predict_substep<L>,
            place_fixed<L>,
            edge_forces<L>,
            hinge_forces<L>,
            edge_stiffness_along<L>,
            hinge_stiffness_along<L>,
            gather_loads<L>,
            sum_loads<L>,
            sum_shape<L>,
            spread_motion<L>,
            apply_motion<L>};
}

} // namespace fascicle::solver::fast
