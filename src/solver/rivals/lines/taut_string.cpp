#include "solver/rivals/lines/taut_string.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle::solver {

namespace {

constexpr int sweeps_between_looks = 8;
/// After so many, steps are no longer beyond the middle: on the kinks of a grid a node would swing for ever.
constexpr int fast_sweeps = 200;

/// The factor of successive over-relaxation that is best for a straight string of n segments.
double best_factor(std::size_t segments) {
    return 2.0 / (1.0 + std::sin(std::numbers::pi / double(std::max<std::size_t>(segments, 2))));
}

} // namespace

double length_of(const Points& nodes) {
    double sum = 0;
    for (std::size_t k = 1; k < nodes.size(); ++k)
        sum += (nodes[k] - nodes[k - 1]).norm();
    return sum;
}

int tighten(Points& nodes, const StringHolds& holds, const Points& before,
            std::span<const ContactSolid> solids, const ContactSettings& contact,
            const StringSettings& settings) {
    FASCICLE_ASSERT(holds.held.size() == nodes.size() && before.size() == nodes.size());
    FASCICLE_ASSERT(holds.clearance.empty() || holds.clearance.size() == nodes.size());
    const auto is_held = [&](std::size_t k) { return k == 0 || k + 1 == nodes.size() || holds.held[k] != 0; };
    std::size_t longest = 0, since = 0;
    for (std::size_t k = 1; k < nodes.size(); ++k) {
        ++since;
        if (is_held(k)) {
            longest = std::max(longest, since);
            since = 0;
        }
    }
    if (longest < 2)
        return 0;
    ContactSettings apart = contact;
    const auto wanted = [&](std::size_t k, double factor) {
        Vec3 x = nodes[k] + factor * (0.5 * (nodes[k - 1] + nodes[k + 1]) - nodes[k]);
        if (!holds.clearance.empty())
            apart.offset = holds.clearance[k];
        if (!solids.empty())
            resolve_contact(x, before[k], solids, apart);
        return x;
    };
    const auto looseness = [&] {
        double most = 0;
        for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
            if (!is_held(k))
                most = std::max(most, (wanted(k, 1.0) - nodes[k]).norm());
        return most;
    };
    int sweeps = 0;
    double enough = settings.tolerance;
    while (sweeps < settings.most_sweeps && looseness() > enough) {
        enough = 0.5 * settings.tolerance; // so that what has just become tight stays as it is
        const double factor = sweeps < fast_sweeps ? best_factor(longest) : 1.0;
        for (int n = 0; n < sweeps_between_looks; ++n, ++sweeps)
            for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
                if (!is_held(k))
                    nodes[k] = wanted(k, factor);
    }
    return sweeps;
}

} // namespace fascicle::solver
