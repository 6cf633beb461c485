#pragma once
// Shortest path by brute force: a fine string, tightened point by point, kept out of a convex body by its nearest points.

#include "fascicle/base/types.hpp"

#include <cmath>
#include <functional>
#include <numbers>

namespace fascicle::test {

/// push_out: a point -> itself when outside of the body, else the nearest point of its surface. bend: moves the middle of the
/// first guess, to choose a side. Chords run below the surface: the result is too short, by about length (step angle)^2 / 24.
inline double string_length(const Vec3& p, const Vec3& q, const std::function<Vec3(const Vec3&)>& push_out,
                            const Vec3& bend = Vec3::Zero(), int levels = 7) {
    Points x{p, push_out((p + q) / 2 + bend), q};
    for (int level = 0; level < levels; ++level) {
        Points finer;
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            finer.push_back(x[i]);
            finer.push_back(push_out((x[i] + x[i + 1]) / 2));
        }
        finer.push_back(q);
        x = std::move(finer);
        const double n = static_cast<double>(x.size() - 1);
        const double omega = 2 / (1 + std::sin(std::numbers::pi / n));
        double moved = 1;
        for (int sweep = 0; sweep < 4000 && moved > 1e-9; ++sweep) {
            moved = 0;
            for (std::size_t i = 1; i + 1 < x.size(); ++i) {
                const Vec3 before = x[i];
                x[i] = push_out(before + omega * ((x[i - 1] + x[i + 1]) / 2 - before));
                moved = std::max(moved, (x[i] - before).norm());
            }
        }
    }
    double length = 0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
        length += (x[i + 1] - x[i]).norm();
    return length;
}

} // namespace fascicle::test
