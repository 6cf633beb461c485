#include "view/colour_map.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle::view;

namespace {

// Relative luminance (IEC 61966-2-1).
double luminance(const Rgba& c) {
    const auto linear = [](double v) {
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(static_cast<double>(c[0])) + 0.7152 * linear(static_cast<double>(c[1])) +
           0.0722 * linear(static_cast<double>(c[2]));
}

void check_near(const Rgba& colour, int r, int g, int b, double margin) {
    CHECK(static_cast<double>(colour[0]) == Approx(r / 255.0).margin(margin));
    CHECK(static_cast<double>(colour[1]) == Approx(g / 255.0).margin(margin));
    CHECK(static_cast<double>(colour[2]) == Approx(b / 255.0).margin(margin));
}

} // namespace

TEST_CASE("The maps hit published colours", "[view][colour_map]") {
    check_near(map_colour(ColourMap::viridis, 0.0), 68, 1, 84, 0.003);
    check_near(map_colour(ColourMap::viridis, 0.25), 59, 82, 139, 0.01);
    check_near(map_colour(ColourMap::viridis, 0.5), 33, 145, 140, 0.01);
    check_near(map_colour(ColourMap::viridis, 1.0), 253, 231, 37, 0.003);
    check_near(map_colour(ColourMap::cividis, 0.0), 0, 34, 78, 0.003);
    check_near(map_colour(ColourMap::cividis, 1.0), 254, 232, 56, 0.003);
    check_near(map_colour(ColourMap::diverging, 0.0), 59, 76, 192, 0.003);
    check_near(map_colour(ColourMap::diverging, 0.5), 221, 221, 221, 0.003);
    check_near(map_colour(ColourMap::diverging, 1.0), 180, 4, 38, 0.003);
}

TEST_CASE("Sequential maps only get lighter, the diverging one is lightest in the middle",
          "[view][colour_map]") {
    for (int i = 1; i <= 100; ++i) {
        const double before = (i - 1) / 100.0, t = i / 100.0;
        CHECK(luminance(map_colour(ColourMap::viridis, t)) >
              luminance(map_colour(ColourMap::viridis, before)));
        CHECK(luminance(map_colour(ColourMap::cividis, t)) >
              luminance(map_colour(ColourMap::cividis, before)));
        const double step = luminance(map_colour(ColourMap::diverging, t)) -
                            luminance(map_colour(ColourMap::diverging, before));
        CHECK((t <= 0.5) == (step > 0));
    }
}

TEST_CASE("Values outside the map take its ends, NaN is told apart", "[view][colour_map]") {
    CHECK(map_colour(ColourMap::viridis, -5.0) == map_colour(ColourMap::viridis, 0.0));
    CHECK(map_colour(ColourMap::viridis, 1e300) == map_colour(ColourMap::viridis, 1.0));
    CHECK(map_colour(ColourMap::viridis, std::nan("")) == Rgba{1, 0, 1, 1});
    const ColourScale scale{ColourMap::diverging, 0.8, 1.2};
    CHECK(scale.colour(1.0) == map_colour(ColourMap::diverging, 0.5));
    CHECK(scale.colour(0.0) == map_colour(ColourMap::diverging, 0.0));
    CHECK(ColourScale{ColourMap::viridis, 1.0, 1.0}.colour(3.0) == map_colour(ColourMap::viridis, 0.5));
}

TEST_CASE("A scale with a middle is linear on both sides of it, either way round", "[view][colour_map]") {
    const ColourScale scale{ColourMap::diverging, -1.0, 5.0, 0.0};
    CHECK(scale.colour(-1.0) == map_colour(ColourMap::diverging, 0.0));
    CHECK(scale.colour(-0.5) == map_colour(ColourMap::diverging, 0.25));
    CHECK(scale.colour(0.0) == map_colour(ColourMap::diverging, 0.5));
    CHECK(scale.colour(2.5) == map_colour(ColourMap::diverging, 0.75));
    CHECK(scale.colour(9.0) == map_colour(ColourMap::diverging, 1.0));
    ColourScale other = scale;
    other.reversed = true;
    CHECK_FALSE(other == scale);
    CHECK(other.colour(-7.0) == map_colour(ColourMap::diverging, 1.0));
    CHECK(other.colour(0.0) == map_colour(ColourMap::diverging, 0.5));
    CHECK(other.colour(2.5) == map_colour(ColourMap::diverging, 0.25));
    CHECK(other.colour(std::nan("")) == Rgba{1, 0, 1, 1});
}

TEST_CASE("Legend ticks are round, inside and in order", "[view][colour_map]") {
    const auto labels = [](double low, double high, int most) {
        std::vector<std::string> result;
        for (const LegendTick& tick : legend_ticks({ColourMap::viridis, low, high}, most)) {
            CHECK(tick.value == Approx(low + tick.position * (high - low)).margin(1e-9 * (high - low)));
            result.push_back(tick.label);
        }
        return result;
    };
    using Labels = std::vector<std::string>;
    CHECK(labels(0.75, 1.25, 6) == Labels{"0.8", "0.9", "1.0", "1.1", "1.2"});
    CHECK(labels(0.0, 100.0, 6) == Labels{"0", "20", "40", "60", "80", "100"});
    CHECK(labels(-1.0, 1.0, 5) == Labels{"-1.0", "-0.5", "0.0", "0.5", "1.0"});
    CHECK(labels(0.0, 3e-4, 4) == Labels{"0.0000", "0.0001", "0.0002", "0.0003"});
    for (const double high : {0.1, 0.3, 1.7, 9.99, 12345.0})
        for (const int most : {2, 3, 6, 11}) {
            const auto ticks = legend_ticks({ColourMap::viridis, 0.0, high}, most);
            CHECK(static_cast<int>(ticks.size()) <= most);
            CHECK(ticks.size() >= 1);
        }
    CHECK(legend_ticks({ColourMap::viridis, 1.0, 1.0}).empty());
    CHECK(legend_ticks({ColourMap::viridis, 2.0, 1.0}).empty());
}
