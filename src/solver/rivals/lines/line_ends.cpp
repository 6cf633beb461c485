#include "solver/rivals/lines/line_ends.hpp"

#include "solver/rivals/rbf/spread_points.hpp"

#include <utility>

namespace fascicle::solver {

namespace {

constexpr int lloyd_rounds = 8;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// Of `chosen`, the one nearest to a point; of equals the first.
std::size_t nearest_of(const Points& points, const std::vector<int>& chosen, const Vec3& p) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < chosen.size(); ++k)
        if ((points[at(chosen[k])] - p).squaredNorm() < (points[at(chosen[best])] - p).squaredNorm())
            best = k;
    return best;
}

} // namespace

std::vector<int> even_vertices(const Points& points, const std::vector<double>& areas,
                               std::span<const int> vertices, int count) {
    std::vector<int> chosen;
    spread_points(points, vertices, at(count), 0.0, chosen);
    std::vector<std::size_t> part(vertices.size());
    for (int round = 0; round < lloyd_rounds; ++round) {
        Points middle(chosen.size(), Vec3::Zero());
        std::vector<double> area(chosen.size(), 0.0);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            part[i] = nearest_of(points, chosen, points[at(vertices[i])]);
            middle[part[i]] += areas[at(vertices[i])] * points[at(vertices[i])];
            area[part[i]] += areas[at(vertices[i])];
        }
        std::vector<int> next = chosen;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const std::size_t k = part[i];
            if (area[k] > 0.0 && (points[at(vertices[i])] - middle[k] / area[k]).squaredNorm() <
                                     (points[at(next[k])] - middle[k] / area[k]).squaredNorm())
                next[k] = vertices[i];
        }
        if (next == chosen)
            break;
        chosen = std::move(next);
    }
    return chosen;
}

void pair_ends(const Points& points, std::span<const int> from, std::vector<int>& to) {
    const auto gain = [&](std::size_t i, std::size_t k) {
        // |a_i - b_i|^2 + |a_k - b_k|^2 against the same with b_i and b_k changed
        return 2.0 * (points[at(from[i])] - points[at(from[k])]).dot(points[at(to[k])] - points[at(to[i])]);
    };
    constexpr double rounding = 1e-12;
    double size = 0;
    for (std::size_t i = 0; i < to.size(); ++i)
        size += (points[at(from[i])] - points[at(to[i])]).squaredNorm();
    // Every swap lowers the sum, so it ends; the rounds are a bound against rounding.
    bool swapped = true;
    for (std::size_t round = 0; swapped && round < 100 + to.size() * to.size(); ++round) {
        swapped = false;
        for (std::size_t i = 0; i < to.size(); ++i)
            for (std::size_t k = i + 1; k < to.size(); ++k)
                if (gain(i, k) > rounding * size) {
                    std::swap(to[i], to[k]);
                    swapped = true;
                }
    }
}

} // namespace fascicle::solver
