#pragma once
// What happens to every vertex once a substep, for any width of lanes: volume gradient, contact, prediction.

#include "solver/fast/kernels_constraints.hpp"

namespace fascicle::solver::fast {

/// m x + t with m | t row-major 3 x 4.
template <class L>
inline Vec<L> affine(const float m[12], const Vec<L>& x) {
    const auto row = [&](int r) {
        return L::fma(
            L::splat(m[4 * r]), x.x,
            L::fma(L::splat(m[4 * r + 1]), x.y, L::fma(L::splat(m[4 * r + 2]), x.z, L::splat(m[4 * r + 3]))));
    };
    return {row(0), row(1), row(2)};
}

template <class L>
inline Vec<L> load_vec(const float (&a)[3][packet], std::size_t q) {
    return {L::load(a[0] + q), L::load(a[1] + q), L::load(a[2] + q)};
}
template <class L>
inline void store_vec(float (&a)[3][packet], std::size_t q, const Vec<L>& v) {
    L::store(a[0] + q, v.x);
    L::store(a[1] + q, v.y);
    L::store(a[2] + q, v.z);
}
template <class L>
inline Vec<L> select(typename L::I mask, const Vec<L>& yes, const Vec<L>& no) {
    return {mask ? yes.x : no.x, mask ? yes.y : no.y, mask ? yes.z : no.z};
}
template <class L>
inline double sum(typename L::V v) {
    double total = 0;
    for (int i = 0; i < L::width; ++i)
        total += static_cast<double>(v[i]);
    return total;
}

/// grad_i = 1/6 sum over the ring of p_j x p_(j+1), positions relative to the kernel's origin, and V = 1/3 sum x_i . grad_i
/// (methods notes 1.1: every triangle is met at each of its corners). The part of a gradient that would push a touching vertex
/// into its solid is left out of the weight: growing pushes along grad, shrinking against it.
template <class L>
void volume_gradients(const VertexArrays& v, std::size_t begin, std::size_t end, VolumeSums& sums) {
    using V = typename L::V;
    const V zero = L::splat(0.0f), sixth = L::splat(1.0f / 6.0f);
    V volume = zero, grow = zero, shrink = zero;
    for (std::size_t g = begin; g < end; ++g) {
        VertexGroup& group = v.groups[g];
        const float* base = v.records + std::size_t{4} * group.ring_base;
        const std::uint16_t* ring = v.rings + packet * std::size_t{group.ring_first};
        for (std::size_t q = 0; q < packet; q += L::width) {
            V x[4];
            L::load_row(v.records + 4 * (packet * g + q), x);
            L::transpose(x);
            Vec<L> total{zero, zero, zero};
            if (group.ring_length > 0) {
                V r[4];
                L::load_records(base, ring + q, r);
                L::transpose(r);
                Vec<L> last{r[0], r[1], r[2]};
                for (std::size_t k = 1; k < group.ring_length; ++k) {
                    L::load_records(base, ring + packet * k + q, r);
                    L::transpose(r);
                    const Vec<L> next{r[0], r[1], r[2]};
                    const Vec<L> c = cross<L>(last, next);
                    total = {total.x + c.x, total.y + c.y, total.z + c.z};
                    last = next;
                }
            }
            const Vec<L> gradient{sixth * total.x, sixth * total.y, sixth * total.z};
            store_vec<L>(group.gradient, q, gradient);
            volume = L::fma(x[0], gradient.x, L::fma(x[1], gradient.y, L::fma(x[2], gradient.z, volume)));
            const V square = dot(gradient, gradient);
            V square_grow = square, square_shrink = square;
            if (group.touched != 0) {
                const V along = dot(gradient, load_vec<L>(group.normal, q));
                const V free = L::fnma(along, along, square);
                square_grow = along < zero ? free : square;
                square_shrink = along > zero ? free : square;
            }
            grow = L::fma(x[3], square_grow, grow);
            shrink = L::fma(x[3], square_shrink, shrink);
        }
    }
    sums.volume = sum<L>(volume) / 3.0;
    sums.weight_grow = sum<L>(grow);
    sums.weight_shrink = sum<L>(shrink);
}

/// Trilinear value and gradient (per spacing) of a solid's grid at the grid coordinates p; outside of the grid the saturation and
/// zero, as DistanceGrid::sample.
template <class L>
inline void sample_grid(const SolidStep& solid, const Vec<L>& p, typename L::V& value, Vec<L>& gradient) {
    using V = typename L::V;
    const V zero = L::splat(0.0f);
    const auto inside = (p.x >= zero) & (p.y >= zero) & (p.z >= zero) &
                        (p.x < L::splat(static_cast<float>(solid.cells[0]))) &
                        (p.y < L::splat(static_cast<float>(solid.cells[1]))) &
                        (p.z < L::splat(static_cast<float>(solid.cells[2])));
    value = L::splat(solid.saturation);
    gradient = {zero, zero, zero};
    if (!L::any(inside))
        return;
    const Vec<L> q = select<L>(inside, p, {zero, zero, zero});
    const auto i = L::truncate(q.x), j = L::truncate(q.y), k = L::truncate(q.z);
    const V x = q.x - L::to_float(i), y = q.y - L::to_float(j), z = q.z - L::to_float(k);
    const auto corner = i + j * L::splat_int(solid.step_y) + k * L::splat_int(solid.step_z);
    const float* base = solid.values;
    const V a0 = L::gather(base, corner), a1 = L::gather(base + 1, corner);
    const V a2 = L::gather(base + solid.step_y, corner), a3 = L::gather(base + solid.step_y + 1, corner);
    base += solid.step_z;
    const V a4 = L::gather(base, corner), a5 = L::gather(base + 1, corner);
    const V a6 = L::gather(base + solid.step_y, corner), a7 = L::gather(base + solid.step_y + 1, corner);
    const V d00 = a1 - a0, d10 = a3 - a2, d01 = a5 - a4, d11 = a7 - a6;
    const V v00 = L::fma(x, d00, a0), v10 = L::fma(x, d10, a2), v01 = L::fma(x, d01, a4),
            v11 = L::fma(x, d11, a6);
    const V e0 = v10 - v00, e1 = v11 - v01;
    const V v0 = L::fma(y, e0, v00), v1 = L::fma(y, e1, v01);
    const V f0 = L::fma(y, d10 - d00, d00), f1 = L::fma(y, d11 - d01, d01);
    value = inside ? L::fma(z, v1 - v0, v0) : value;
    gradient = select<L>(inside, {L::fma(z, f1 - f0, f0), L::fma(z, e1 - e0, e0), v1 - v0}, gradient);
}

inline constexpr int contact_passes = 4;         ///< as ContactSettings::passes
inline constexpr float contact_rounding = 1e-3f; ///< of the offset
inline constexpr float least_gradient = 0.3f;    ///< below, a gradient says nothing about the way out

/// Puts the free lanes of x out of all solids, as resolve_contact does; a solid is looked up only where the slack is used up.
/// slack: of this group, lanes q on, a row of 16 per solid.
template <class L>
inline void resolve_contacts(const SolidStep* solids, const StepSettings& s, typename L::I free,
                             const Vec<L>& start, float* slack, std::size_t q, Vec<L>& x, Vec<L>& normal,
                             typename L::I& touched, typename L::I& unsettled, ContactSums& sums) {
    using V = typename L::V;
    using I = typename L::I;
    const V zero = L::splat(0.0f), one = L::splat(1.0f), offset = L::splat(s.offset);
    const V close_enough = L::splat(contact_rounding * s.offset); // else rounding asks for pass after pass
    I trapped = L::splat_int(0);
    for (int pass = 0; pass < contact_passes; ++pass) {
        I moved = L::splat_int(0);
        trapped = L::splat_int(0);
        for (int b = 0; b < s.solids; ++b) {
            float* left = slack + packet * static_cast<std::size_t>(b) + q;
            if (!L::any((L::load(left) < zero) & free))
                continue;
            const SolidStep& solid = solids[b];
            V value;
            Vec<L> g;
            sample_grid<L>(solid, affine<L>(solid.to_grid, x), value, g);
            const V depth = offset - value;
            const I near = (depth > (pass == 0 ? zero : close_enough)) & free;
            L::store(left, L::splat(-solid.per_slope) * depth);
            if (!L::any(near))
                continue;
            moved |= near;
            const auto turned = [&](int r) {
                const float* m = solid.turn + 3 * r;
                return L::fma(L::splat(m[0]), g.x, L::fma(L::splat(m[1]), g.y, L::splat(m[2]) * g.z));
            };
            Vec<L> n{turned(0), turned(1), turned(2)};
            const V norm = L::sqrt(dot(n, n));
            const I lost = near & (norm < L::splat(least_gradient));
            const V per_norm = one / (norm > zero ? norm : one);
            n = {per_norm * n.x, per_norm * n.y, per_norm * n.z};
            const V push = (near & ~lost) ? depth * per_norm : zero;
            const Vec<L> before = x;
            x = {L::fma(push, n.x, x.x), L::fma(push, n.y, x.y), L::fma(push, n.z, x.z)};
            normal = select<L>(near & ~lost, n, normal);
            trapped |= (near & ~lost) & (depth >= L::splat(0.5f) * offset);
            if (L::any(lost) || s.friction > 0.0f) {
                const Vec<L> d = affine<L>(solid.carry, start);
                const Vec<L> with{start.x + d.x, start.y + d.y, start.z + d.z};
                if (s.friction > 0.0f && pass == 0) {
                    Vec<L> slip = x - with;
                    const V out = dot(slip, n);
                    slip = {L::fnma(out, n.x, slip.x), L::fnma(out, n.y, slip.y), L::fnma(out, n.z, slip.z)};
                    const V length = L::sqrt(dot(slip, slip));
                    V share = L::splat(s.friction) * push / (length > zero ? length : one);
                    share = share < one ? share : one;
                    share = (near & ~lost) ? share : zero;
                    x = {L::fnma(share, slip.x, x.x), L::fnma(share, slip.y, x.y),
                         L::fnma(share, slip.z, x.z)};
                }
                // No direction to trust: it was outside before, so where the solid would have taken it is outside.
                x = select<L>(lost, with, x);
                trapped |= lost; // unless the next pass finds it outside
            }
            const Vec<L> shift = x - before;
            const V way = L::sqrt(dot(shift, shift));
            for (int o = 0; o < s.solids; ++o)
                if (o != b) {
                    float* other = slack + packet * static_cast<std::size_t>(o) + q;
                    L::store(other, L::load(other) - way);
                }
        }
        touched |= moved;
        unsettled = moved; // of the last pass: nobody has looked where they are now
        if (!L::any(moved))
            break;
    }
    sums.contacts += L::count(touched);
    sums.unresolved += L::count(trapped);
}

/// The larger of `most` and all lanes; NaN counts as nothing.
template <class L>
inline float largest(typename L::V v, float most) {
    for (int i = 0; i < L::width; ++i)
        most = v[i] > most ? v[i] : most;
    return most;
}

/// Solids whose slack at the start of a substep is remembered until its end; of others the hard bound is taken.
inline constexpr int remembered_solids = 4;

/// The lanes of which it is not certain that they have stayed `least` away from the solid on their straight way as it sees them: with s
/// the slack at the start and at the end and l the length of the way, (s0 + s1 - l) / 2 bounds the slack between from below. Where that is not
/// enough, three points between are looked up.
template <class L>
inline typename L::I suspects_of(const SolidStep& solid, const StepSettings& s, const Vec<L>& start,
                                 const Vec<L>& x, typename L::V way, typename L::V s0, typename L::V s1,
                                 typename L::I free) {
    using V = typename L::V;
    using I = typename L::I;
    const V lowest = L::splat((s.least - s.offset) * solid.per_slope), twice = lowest + lowest;
    I bad = free & ((s1 < lowest) | (s0 + s1 - way < twice));
    if (!L::any(bad))
        return bad;
    Vec<L> with = start;
    if (solid.moves) {
        const Vec<L> d = affine<L>(solid.carry, start);
        with = {start.x + d.x, start.y + d.y, start.z + d.z};
    }
    const V quarter = L::splat(0.25f) * way;
    V last = s0;
    I still = s1 < lowest;
    for (int k = 1; k <= 3; ++k) {
        const V t = L::splat(0.25f * static_cast<float>(k));
        const Vec<L> p{L::fma(t, x.x - with.x, with.x), L::fma(t, x.y - with.y, with.y),
                       L::fma(t, x.z - with.z, with.z)};
        V value;
        Vec<L> gradient;
        sample_grid<L>(solid, affine<L>(solid.to_grid, p), value, gradient);
        const V here = (value - L::splat(s.offset)) * L::splat(solid.per_slope);
        still |= (here < lowest) | (last + here - quarter < twice);
        last = here;
    }
    still |= last + s1 - quarter < twice;
    return bad & still;
}

/// The end of a substep: volume correction, contact, and nothing that is not finite gets through.
template <class L>
void finish_substep(const VertexArrays& v, std::size_t begin, std::size_t end, const SolidStep* solids,
                    const StepSettings& s, ContactSums& sums, float* travel) {
    using V = typename L::V;
    using I = typename L::I;
    const V zero = L::splat(0.0f), gain = L::splat(s.volume_gain);
    for (std::size_t g = begin; g < end; ++g) {
        VertexGroup& group = v.groups[g];
        I any_touched = L::splat_int(0);
        std::uint32_t suspects = 0;
        for (std::size_t q = 0; q < packet; q += L::width) {
            V r[4];
            L::load_row(v.records + 4 * (packet * g + q), r);
            L::transpose(r);
            const I free = r[3] > zero;
            Vec<L> gradient = load_vec<L>(group.gradient, q);
            if (group.touched != 0) {
                const Vec<L> n = load_vec<L>(group.normal, q);
                V along = dot(gradient, n);
                const I against = L::splat(-s.volume_error) * along < zero;
                along = against ? along : zero;
                gradient = {L::fnma(along, n.x, gradient.x), L::fnma(along, n.y, gradient.y),
                            L::fnma(along, n.z, gradient.z)};
            }
            const V step = r[3] * gain;
            Vec<L> x{L::fma(step, gradient.x, r[0]), L::fma(step, gradient.y, r[1]),
                     L::fma(step, gradient.z, r[2])};
            const Vec<L> start = load_vec<L>(group.start, q);
            Vec<L> normal{zero, zero, zero};
            I touched = L::splat_int(0), unsettled = L::splat_int(0), used_up = L::splat_int(0);
            float* const slack = v.slack + packet * g * static_cast<std::size_t>(s.solids) + q;
            const auto way_to = [&](int b) {
                Vec<L> way = x - start;
                if (solids[b].moves) {
                    const Vec<L> d = affine<L>(solids[b].carry, start);
                    way = way - d;
                }
                return L::sqrt(dot(way, way));
            };
            V before[remembered_solids];
            for (int b = 0; b < s.solids; ++b) {
                const V way = way_to(b);
                travel[b] = largest<L>(way, travel[b]);
                float* left = slack + packet * static_cast<std::size_t>(b);
                const V old = L::load(left);
                if (b < remembered_solids)
                    before[b] = old;
                L::store(left, old - way);
                used_up |= old - way < zero;
            }
            if (L::any(used_up & free)) {
                resolve_contacts<L>(solids, s, free, start, slack - q, q, x, normal, touched, unsettled,
                                    sums);
                I bad = unsettled;
                for (int b = 0; b < s.solids; ++b) {
                    const V way = way_to(b);
                    travel[b] = largest<L>(way, travel[b]);
                    const V s0 = b < remembered_solids ? before[b]
                                                       : L::splat((s.least - s.offset) * solids[b].per_slope);
                    bad |= suspects_of<L>(solids[b], s, start, x, way, s0,
                                          L::load(slack + packet * static_cast<std::size_t>(b)), free);
                }
                suspects |= L::mask_bits(bad & free) << q;
            }
            store_vec<L>(group.normal, q, normal);
            any_touched |= touched;
            const V check = (x.x - x.x) + (x.y - x.y) + (x.z - x.z); // zero, or NaN
            const I bad = free & ~(check == zero);
            if (L::any(bad)) {
                sums.non_finite += L::count(bad);
                x = select<L>(bad, start, x);
                store_vec<L>(group.carried, q, select<L>(bad, start, load_vec<L>(group.carried, q)));
                suspects |= L::mask_bits(bad) << q; // its slack is not finite either
            }
            r[0] = free ? x.x : r[0];
            r[1] = free ? x.y : r[1];
            r[2] = free ? x.z : r[2];
            L::transpose(r);
            L::store_row(v.records + 4 * (packet * g + q), r);
        }
        group.touched = L::any(any_touched) ? 1u : 0u;
        group.suspects = suspects;
    }
}

/// The beginning of a substep: x = start + carry + keep (x - carried), for free vertices.
template <class L>
void predict_substep(const VertexArrays& v, std::size_t begin, std::size_t end, const SolidStep* solids,
                     const StepSettings& s) {
    using V = typename L::V;
    const V zero = L::splat(0.0f), keep = L::splat(s.keep);
    for (std::size_t g = begin; g < end; ++g) {
        VertexGroup& group = v.groups[g];
        for (std::size_t q = 0; q < packet; q += L::width) {
            V r[4];
            L::load_row(v.records + 4 * (packet * g + q), r);
            L::transpose(r);
            const Vec<L> start{r[0], r[1], r[2]};
            Vec<L> way = start - load_vec<L>(group.carried, q);
            Vec<L> carried = start;
            if (v.carry != nullptr)
                for (int b = 0; b < s.solids; ++b)
                    if (solids[b].moves) {
                        const V share = L::load(
                            v.carry +
                            packet * (g * static_cast<std::size_t>(s.solids) + static_cast<std::size_t>(b)) +
                            q);
                        const Vec<L> d = affine<L>(solids[b].carry, start);
                        carried = {L::fma(share, d.x, carried.x), L::fma(share, d.y, carried.y),
                                   L::fma(share, d.z, carried.z)};
                    }
            store_vec<L>(group.start, q, start);
            store_vec<L>(group.carried, q, carried);
            const auto free = r[3] > zero;
            r[0] = free ? L::fma(keep, way.x, carried.x) : r[0];
            r[1] = free ? L::fma(keep, way.y, carried.y) : r[1];
            r[2] = free ? L::fma(keep, way.z, carried.z) : r[2];
            L::transpose(r);
            L::store_row(v.records + 4 * (packet * g + q), r);
        }
    }
}

/// Fixed vertices go where their solid takes them.
template <class L>
void place_fixed(const VertexArrays& v, const FixedGroup* fixed, std::size_t count, const SolidStep* solids) {
    using V = typename L::V;
    for (std::size_t f = 0; f < count; ++f)
        for (std::size_t q = 0; q < packet; q += L::width) {
            const Vec<L> x = affine<L>(solids[fixed[f].solid].place, load_vec<L>(fixed[f].rest, q));
            const auto mask = L::mask_from_bits(fixed[f].mask, static_cast<int>(q));
            float* records = v.records + 4 * (packet * fixed[f].group + q);
            V r[4];
            L::load_row(records, r);
            L::transpose(r);
            r[0] = mask ? x.x : r[0];
            r[1] = mask ? x.y : r[1];
            r[2] = mask ? x.z : r[2];
            L::transpose(r);
            L::store_row(records, r);
        }
}

} // namespace fascicle::solver::fast
