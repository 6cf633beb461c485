#include "solver/classic/classic_state.hpp"

#include "fascicle/base/assert.hpp"

namespace fascicle::classic {

ClassicState make_state(const Points& rest, const std::vector<int>& body, bool meant) {
    FASCICLE_ASSERT(body.size() == rest.size());
    ClassicState state;
    state.position = rest;
    state.candidate = rest;
    state.velocity.assign(rest.size(), Vec3::Zero());
    state.force.assign(rest.size(), Vec3::Zero());
    state.body = body;
    // Published: "fixed" only stops the write-back, so a fixed vertex swallows its half of every correction
    // (notes 1.3). Meant: it weighs infinitely much.
    state.inverse_mass.assign(rest.size(), 1.0);
    if (meant) {
        for (std::size_t i = 0; i < rest.size(); ++i) {
            if (state.fixed(i))
                state.inverse_mass[i] = 0.0;
        }
    }
    return state;
}

void predict(ClassicState& state, double velocity_factor) {
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.velocity[i] += state.inverse_mass[i] * time_step_s * state.force[i];
        state.velocity[i] *= velocity_factor;
        state.candidate[i] = state.position[i] + time_step_s * state.velocity[i];
    }
}

std::int64_t accept(ClassicState& state) {
    std::int64_t refused = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (state.fixed(i))
            continue;
        const Vec3 velocity = (state.candidate[i] - state.position[i]) / time_step_s;
        if (!velocity.allFinite()) {
            state.velocity[i].setZero();
            ++refused;
            continue;
        }
        state.velocity[i] = velocity;
        state.position[i] = state.candidate[i];
    }
    return refused;
}

} // namespace fascicle::classic
