#include "anatomy/fibres/mean_value.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace fascicle;

namespace {

std::vector<double> weights_of(const std::vector<Vec2>& polygon, const Vec2& x) {
    std::vector<double> weights(polygon.size());
    mean_value_weights(polygon, x, weights);
    return weights;
}

Vec2 blend(const std::vector<Vec2>& polygon, const std::vector<double>& weights) {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += weights[i] * polygon[i];
    return sum;
}

const std::vector<Vec2> convex{{0, 0}, {3, -1}, {5, 1}, {4, 4}, {1, 3}};
const std::vector<Vec2> notched{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};

} // namespace

TEST_CASE("mean value coordinates: sum to one and reproduce every point, also outside and in a notch",
          "[anatomy][fibres]") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-6, 8);
    for (const auto& polygon : {convex, notched})
        for (int k = 0; k < 300; ++k) {
            const Vec2 x(coordinate(random), coordinate(random));
            const std::vector<double> weights = weights_of(polygon, x);
            double sum = 0;
            for (const double w : weights)
                sum += w;
            REQUIRE(sum == Approx(1.0).margin(1e-12));
            REQUIRE((blend(polygon, weights) - x).norm() < 1e-8);
        }
}

TEST_CASE("mean value coordinates: agree with the angle formula, whichever way the polygon runs",
          "[anatomy][fibres]") {
    const Vec2 x(2, 1.5);
    std::vector<double> expected;
    double sum = 0;
    for (std::size_t i = 0; i < convex.size(); ++i) {
        const auto angle = [&](std::size_t a, std::size_t b) {
            const Vec2 u = convex[a] - x, v = convex[b] - x;
            return std::acos(u.dot(v) / (u.norm() * v.norm()));
        };
        const std::size_t before = (i + 4) % 5, after = (i + 1) % 5;
        expected.push_back((std::tan(0.5 * angle(before, i)) + std::tan(0.5 * angle(i, after))) /
                           (convex[i] - x).norm());
        sum += expected.back();
    }
    const std::vector<double> weights = weights_of(convex, x);
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(weights[i] == Approx(expected[i] / sum));
    const std::vector<double> reversed = weights_of({convex.rbegin(), convex.rend()}, x);
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(reversed[4 - i] == Approx(weights[i]));
}

TEST_CASE("mean value coordinates: corners, edges and inside of a convex polygon", "[anatomy][fibres]") {
    CHECK(weights_of(convex, convex[2]) == std::vector<double>{0, 0, 1, 0, 0});
    const std::vector<double> edge = weights_of(convex, 0.25 * convex[3] + 0.75 * convex[4]);
    CHECK(edge[3] == Approx(0.25));
    CHECK(edge[4] == Approx(0.75));
    CHECK(edge[0] + edge[1] + edge[2] == 0.0);
    for (const double w : weights_of(convex, Vec2(3.9, 3.8)))
        CHECK(w > 0.0);
    // Right up to the edge nothing jumps.
    const Vec2 near_edge = 0.5 * (convex[0] + convex[1]) + Vec2(1e-7, 3e-7);
    CHECK(weights_of(convex, near_edge)[0] == Approx(0.5).margin(1e-5));
}

TEST_CASE("mean value coordinates: doubled corners and a polygon without extent", "[anatomy][fibres]") {
    const std::vector<Vec2> doubled{{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<double> weights = weights_of(doubled, Vec2(0.3, 0.6));
    CHECK((blend(doubled, weights) - Vec2(0.3, 0.6)).norm() < 1e-12);
    CHECK(weights_of({Vec2(2, 2), Vec2(2, 2), Vec2(2, 2), Vec2(2, 2)}, Vec2(5, 5)) ==
          std::vector<double>(4, 0.25));
}
