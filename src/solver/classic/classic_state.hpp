#pragma once
// What the published program keeps for every point, and its two ends of a substep. Sources of this folder:
// Cervenka & Kohout 2020 ("the paper") and the program published with it, read for facts only; notes
// block 1.3 and docs/classic.md list every place where the two differ.

#include "fascicle/base/types.hpp"

#include <cstdint>

namespace fascicle::classic {

/// One entry per vertex. Lengths in scene units, time in s, masses without unit (all 1).
struct ClassicState {
    Points position;                  ///< x: end of the last substep
    Points candidate;                 ///< p: what the constraints work on
    Points velocity;                  ///< v, units per s
    Points force;                     ///< f; only the tetrahedron tests of the program push with one
    std::vector<double> inverse_mass; ///< as the constraints see it: published 1 for all, meant 0 when fixed
    std::vector<int> body;            ///< solid a vertex is fixed to, -1 free

    std::size_t size() const { return position.size(); }
    bool fixed(std::size_t i) const { return body[i] >= 0; }
};

ClassicState make_state(const Points& rest, const std::vector<int>& body, bool meant);

/// Every substep takes the full time step (notes 1.3: the "inner iterations" are real substeps).
constexpr double time_step_s = 1e-3;

/// v = (v + w f dt) * velocity_factor, p = x + v dt, for every vertex. The force comes before the damping.
void predict(ClassicState& state, double velocity_factor);

/// v = (p - x)/dt, x = p, for every vertex that is not fixed. Fixed ones are skipped here and only here in
/// the published equations: whatever the constraints did to their candidates is thrown away. Guard that the
/// program lacks: a candidate that is not finite is refused, the vertex stays with no velocity. Returns the
/// number of refused vertices.
std::int64_t accept(ClassicState& state);

} // namespace fascicle::classic
