#include "geometry/funnel.hpp"

#include <algorithm>

namespace fascicle {
namespace {

/// Twice the signed area of the triangle: positive when c lies left of a -> b.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

struct Corner {
    std::size_t gate; ///< gates.size() for the end
    double share;     ///< 0: left, 1: right
    Vec2 place;
};

} // namespace

std::vector<double> funnel_shares(const Vec2& start, const std::vector<FunnelGate>& gates, const Vec2& end) {
    const std::size_t n = gates.size();
    const auto left_of = [&](std::size_t i) { return i < n ? gates[i].left : end; };
    const auto right_of = [&](std::size_t i) { return i < n ? gates[i].right : end; };
    std::vector<Corner> corners;
    Vec2 apex = start, left = start, right = start;
    std::size_t left_at = 0, right_at = 0;
    bool open = false; // left and right are sides of a gate, not the apex itself
    std::size_t steps = 0;
    const std::size_t most_steps = 4 * (n + 2) * (n + 2);
    for (std::size_t i = 0; i <= n && steps < most_steps; ++i, ++steps) {
        const Vec2 new_left = left_of(i), new_right = right_of(i);
        if (!open) {
            left = new_left;
            right = new_right;
            left_at = right_at = i;
            open = true;
            continue;
        }
        // Narrow the right side; when it passes the left one, the line bends at the left.
        if (turn(apex, right, new_right) >= 0.0) {
            if (right == apex || turn(apex, left, new_right) < 0.0) {
                right = new_right;
                right_at = i;
            } else {
                corners.push_back({left_at, 0.0, left});
                apex = left;
                i = left_at;
                open = false;
                continue;
            }
        }
        if (turn(apex, left, new_left) <= 0.0) {
            if (left == apex || turn(apex, right, new_left) > 0.0) {
                left = new_left;
                left_at = i;
            } else {
                corners.push_back({right_at, 1.0, right});
                apex = right;
                i = right_at;
                open = false;
                continue;
            }
        }
    }
    corners.erase(
        std::remove_if(corners.begin(), corners.end(), [&](const Corner& c) { return c.gate >= n; }),
        corners.end());

    std::vector<double> shares(n, 0.0);
    Vec2 from = start;
    std::size_t next = 0;
    for (std::size_t i = 0; i < n; ++i) {
        while (next < corners.size() && corners[next].gate < i)
            from = corners[next++].place;
        if (next < corners.size() && corners[next].gate == i) {
            shares[i] = corners[next].share;
            continue;
        }
        const Vec2 to = next < corners.size() ? corners[next].place : end;
        const double l = turn(from, to, gates[i].left), r = turn(from, to, gates[i].right);
        shares[i] = l - r > 0.0 ? std::clamp(l / (l - r), 0.0, 1.0) : 0.5;
    }
    return shares;
}

} // namespace fascicle
