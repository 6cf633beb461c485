#pragma once
// Which contact samples have come nearer to a solid than they may, for any width of lanes. What to do about them is not for
// lanes: they are few (sample_guard.hpp).

#include "solver/fast/kernels_vertices.hpp"

namespace fascicle::solver::fast {

/// Kernels::samples. A packet keeps, for each solid, how far its samples may still travel before one can violate its limit; a sample
/// lies between its corners, so it travels no further than the furthest of the vertices around them.
template <class L>
std::size_t check_samples(const float* records, const SamplePacket* packets, std::size_t begin,
                          std::size_t end, const SolidStep* solids, const StepSettings& s,
                          const float* travel, std::size_t stride, float* slack, std::uint16_t* violations) {
    using V = typename L::V;
    std::size_t found = 0;
    for (std::size_t n = begin; n < end; ++n) {
        const SamplePacket& e = packets[n];
        std::uint32_t mask = 0;
        for (int b = 0; b < s.solids; ++b) {
            float& left = slack[n * static_cast<std::size_t>(s.solids) + static_cast<std::size_t>(b)];
            float furthest = 0.0f;
            for (std::size_t c = e.first_chunk; c <= e.last_chunk; ++c) {
                const float t = travel[c * stride + static_cast<std::size_t>(b)];
                furthest = t > furthest ? t : furthest;
            }
            left -= 1.0001f * furthest; // summed up in floats
            if (left > 0.0f)
                continue;
            const V limit = L::splat(b == e.near_solid ? e.limit : s.least);
            float least = solids[b].saturation;
            for (std::size_t q = 0; q < packet; q += L::width) {
                V p[4] = {L::splat(0.0f), L::splat(0.0f), L::splat(0.0f), L::splat(0.0f)}, r[4];
                for (std::size_t k = 0; k < 3; ++k) {
                    const V w = L::splat(e.weight[k]);
                    L::load_records(records + std::size_t{4} * e.base, e.p[k] + q, r);
                    for (int i = 0; i < 4; ++i)
                        p[i] = L::fma(w, r[i], p[i]);
                }
                L::transpose(p);
                V value;
                Vec<L> gradient;
                sample_grid<L>(solids[b], affine<L>(solids[b].to_grid, Vec<L>{p[0], p[1], p[2]}), value,
                               gradient);
                const V room = (value - limit) * L::splat(solids[b].per_slope);
                mask |= L::mask_bits(~(room >= L::splat(0.0f))) << q; // NaN too
                for (int i = 0; i < L::width; ++i)
                    least = room[i] < least ? room[i] : least;
            }
            left = least;
        }
        mask &= (1u << e.count) - 1u;
        violations[n] = static_cast<std::uint16_t>(mask);
        found += mask != 0 ? 1 : 0;
    }
    return found;
}

} // namespace fascicle::solver::fast
