#pragma once
// A small animation for tests of files: a muscle that deforms, its fibres, two bones of which one turns by more than half a turn.

#include "fascicle/io/animation.hpp"

namespace fascicle::test {

/// count frames, numbered first, first + step, ...; a frame lasts 0.01 s.
Animation moving_bodies(int count, int first = 0, int step = 1);

/// Largest distance between two bodies' points over all frames.
double largest_difference(const AnimatedBody& a, const AnimatedBody& b, std::size_t frames);

} // namespace fascicle::test
