#pragma once
// Colours and packets: constraints of a set are dealt into groups of 16 that share no vertex.

#include "solver/fast/layout.hpp"

#include <span>
#include <vector>

namespace fascicle::solver::fast {

/// corners: vertices of each constraint, `arity` in a row, as record numbers. Returns constraint numbers in rows of 16, -1 for
/// padding: the constraints of a row share no vertex, and rows of one colour come together. A vertex of inverse mass 0 never
/// changes, so it may be shared: `movable` by record. Colours are filled evenly, each constraint (in the order given) going to
/// the emptiest one that it may join. Empty when a vertex has too many constraints for that (more than max_colours would be
/// needed).
inline constexpr std::size_t max_colours = 1024;
bool pack(std::span<const int> corners, std::size_t arity, const std::vector<bool>& movable,
          std::vector<int>& rows);

} // namespace fascicle::solver::fast
