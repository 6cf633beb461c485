#pragma once
// Sixteen floats, as one cache line.

#include "solver/fast/layout.hpp"

namespace fascicle::solver::fast {

struct alignas(64) Row {
    float v[packet];
};

} // namespace fascicle::solver::fast
