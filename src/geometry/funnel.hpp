#pragma once
// The shortest line through a strip of unfolded triangles.

#include "fascicle/base/types.hpp"

namespace fascicle {

/// An edge that the line must cross, in the plane of the unfolding: left and right as seen along the way.
struct FunnelGate {
    Vec2 left, right;
};

/// Where the line passes gate i: at left + share (right - left), share in [0, 1]; exactly 0 or 1 where it bends.
/// Funnel algorithm of Lee & Preparata 1984, in its incremental form: O(gates) but for strips that wind.
std::vector<double> funnel_shares(const Vec2& start, const std::vector<FunnelGate>& gates, const Vec2& end);

} // namespace fascicle
