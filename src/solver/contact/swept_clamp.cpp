#include "solver/contact/swept_clamp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace fascicle::solver {

namespace {

constexpr int most_events = 4;
constexpr double least_gradient = 0.3; // below, a gradient says nothing about the way out

/// Lifts p, in the grid's frame, to the offset as far as a few steps along the gradient do.
void lift(const DistanceGrid& grid, Vec3& p, double offset) {
    for (int k = 0; k < 4; ++k) {
        const DistanceSample s = grid.sample(p);
        const double squared = s.gradient.squaredNorm();
        if (s.value >= 0.99 * offset || squared < least_gradient * least_gradient)
            return;
        p += (offset - s.value) / squared * s.gradient;
    }
}

/// Climbs from x until all solids are at the offset. Whether it arrived at the hard bound.
bool climb(Vec3& x, std::span<const ContactSolid> solids, const ContactSettings& settings) {
    for (int k = 0; k < 40; ++k) {
        const NearestSolid near = nearest_solid(x, solids);
        if (near.solid < 0 || near.value >= 0.99 * settings.offset)
            break;
        const ContactSolid& solid = solids[static_cast<std::size_t>(near.solid)];
        const DistanceSample s = solid.grid->sample(solid.now.apply_inverse(x));
        const double squared = s.gradient.squaredNorm();
        if (squared < least_gradient * least_gradient)
            break;
        x += (settings.offset - s.value) / squared * (solid.now.rotation * s.gradient);
    }
    return x.allFinite() && nearest_solid(x, solids).value >= settings.least;
}

/// The nearest of the places around x, on spheres whose radii grow by a fifth, that is outside of all solids.
bool search(Vec3& x, std::span<const ContactSolid> solids, const ContactSettings& settings) {
    const double reach = 4.0 * solids[0].grid->saturation();
    constexpr int directions = 64;
    constexpr double golden = 2.39996322972865332; // angle of a Fibonacci sphere
    for (double radius = 2.0 * settings.offset + 1e-3 * reach; radius < reach; radius *= 1.2)
        for (int k = 0; k < directions; ++k) {
            const double z = 1.0 - (2.0 * k + 1.0) / directions, r = std::sqrt(1.0 - z * z);
            const Vec3 p = x + radius * Vec3(r * std::cos(golden * k), r * std::sin(golden * k), z);
            if (nearest_solid(p, solids).value >= settings.offset) {
                x = p;
                return true;
            }
        }
    return false;
}

ClampResult eject(Vec3& x, const Vec3& before, std::span<const ContactSolid> solids,
                  const ContactSettings& settings) {
    Vec3 best = before;
    double value = -std::numeric_limits<double>::infinity();
    const auto consider = [&](const Vec3& p) {
        const double v = p.allFinite() ? nearest_solid(p, solids).value : value;
        if (v > value) {
            value = v;
            best = p;
        }
        return v >= settings.least;
    };
    // Where a solid takes it, it is outside of that solid.
    for (const ContactSolid& solid : solids) {
        const Vec3 carried = solid.now.apply(solid.before.apply_inverse(before));
        if (consider(carried)) {
            x = carried;
            return ClampResult::ejected;
        }
    }
    Vec3 p = x.allFinite() ? x : before;
    if (climb(p, solids, settings) || (consider(p), p = before, climb(p, solids, settings)) ||
        (consider(p), p = best, search(p, solids, settings))) {
        x = p;
        return ClampResult::ejected;
    }
    x = best;
    return ClampResult::impossible;
}

} // namespace

NearestSolid nearest_solid(const Vec3& x, std::span<const ContactSolid> solids) {
    NearestSolid near{std::numeric_limits<double>::infinity(), -1};
    for (std::size_t b = 0; b < solids.size(); ++b)
        if (const double v = solids[b].grid->value(solids[b].now.apply_inverse(x)); v < near.value)
            near = {v, static_cast<int>(b)};
    return near;
}

double free_share(const DistanceGrid& grid, const Vec3& a, const Vec3& b, double least, double offset,
                  double slope) {
    const Vec3 way = b - a;
    const double length = way.norm();
    if (!(grid.value(a) >= least))
        return 0.0;
    if (!(length > 0.0))
        return 1.0;
    // Outside of the grid's box is nothing, however long the way there.
    double enter = 0.0, leave = 1.0;
    for (Eigen::Index k = 0; k < 3; ++k) {
        const double low = grid.low()[k],
                     high = low + grid.spacing() * (grid.nodes()[static_cast<std::size_t>(k)] - 1);
        if (way[k] == 0.0) {
            if (a[k] < low || a[k] > high)
                return 1.0;
            continue;
        }
        const double t0 = (low - a[k]) / way[k], t1 = (high - a[k]) / way[k];
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    if (!(enter <= leave))
        return 1.0;
    const double shortest = std::max(0.01 * offset, 1e-3 * grid.spacing());
    double share = enter, value = grid.value(a + enter * way);
    while (share < leave) {
        const double next = std::min(1.0, share + std::max((value - least) / slope, shortest) / length);
        value = grid.value(a + next * way);
        if (!(value >= least))
            return share;
        share = next;
    }
    return grid.value(b) >= least ? 1.0 : share;
}

ClampResult clamp_motion(Vec3& x, const Vec3& before, std::span<const ContactSolid> solids,
                         const ContactSettings& settings) {
    thread_local std::vector<Vec3> from; // where the way left to look at begins, in each solid's frame
    const std::size_t count = solids.size();
    from.resize(count);
    for (std::size_t b = 0; b < count; ++b)
        from[b] = solids[b].before.apply_inverse(before);
    bool slid = false;
    for (int event = 0; event <= most_events && x.allFinite(); ++event) {
        double least_share = 1.0;
        std::size_t hit = count;
        for (std::size_t b = 0; b < count; ++b) {
            const Vec3 to = solids[b].now.apply_inverse(x);
            const double share =
                free_share(*solids[b].grid, from[b], to, settings.least, settings.offset, solids[b].slope);
            // Inside at the start: where it ends is all that counts.
            if (share == 0.0 && solids[b].grid->value(from[b]) < settings.least) {
                if (solids[b].grid->value(to) < settings.least)
                    return eject(x, before, solids, settings);
                continue;
            }
            if (share < least_share) {
                least_share = share;
                hit = b;
            }
        }
        if (hit == count)
            return slid ? ClampResult::slid : ClampResult::clear;
        if (event == most_events)
            break;
        const ContactSolid& solid = solids[hit];
        const Vec3 to = solid.now.apply_inverse(x), stop = from[hit] + least_share * (to - from[hit]);
        const Vec3 gradient = solid.grid->sample(stop).gradient;
        Vec3 rest = to - stop;
        if (const double norm = gradient.norm(); norm > 0.0)
            rest -= std::min(0.0, rest.dot(gradient / norm)) * (gradient / norm);
        else
            rest.setZero();
        Vec3 q = stop + rest;
        lift(*solid.grid, q, settings.offset);
        from[hit] = stop;
        x = solid.now.apply(q);
        slid = true;
    }
    return eject(x, before, solids, settings);
}

} // namespace fascicle::solver
