#include "fascicle/geometry/float_rounding.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace fascicle;

namespace {

/// The nearest float by the definition alone: a and b are the floats on both sides.
bool is_nearest_float(double rounded, double x) {
    const volatile float f = static_cast<float>(rounded);
    if (static_cast<double>(f) != rounded)
        return false;
    const double above = std::nextafter(f, std::numeric_limits<float>::infinity()),
                 below = std::nextafter(f, -std::numeric_limits<float>::infinity());
    return std::abs(rounded - x) <= std::abs(above - x) && std::abs(rounded - x) <= std::abs(below - x);
}

} // namespace

TEST_CASE("All three coordinates of points are rounded to floats, far from the origin, too",
          "[geometry][unit]") {
    // The unit in the last place of a float at 1e6 is 1/16, at 1e9 it is 64.
    for (const double offset : {0.0, 0.1, 1e3, 1e6, 1e9, -1e9, 1e30}) {
        Points points;
        for (int i = 0; i < 1001; ++i) // odd: also the rest of a loop in vectors
            points.emplace_back(offset + 0.1 * i, offset * (1 + 1e-9 * i) - 0.3, -offset + i / 7.0);
        Points rounded = points;
        round_to_floats(rounded);
        REQUIRE(rounded.size() == points.size());
        int wrong = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
            for (int k = 0; k < 3; ++k)
                wrong += is_nearest_float(rounded[i][k], points[i][k]) ? 0 : 1;
        INFO("offset " << offset);
        CHECK(wrong == 0);
        Points again = rounded;
        round_to_floats(again);
        CHECK(again == rounded);
    }
}

TEST_CASE("Rounding to floats of what no float holds", "[geometry][unit]") {
    CHECK(rounded_to_float(1e39) == std::numeric_limits<double>::infinity());
    CHECK(rounded_to_float(-1e39) == -std::numeric_limits<double>::infinity());
    CHECK(std::isnan(rounded_to_float(std::nan(""))));
    CHECK(rounded_to_float(1e-60) == 0);
    CHECK(std::signbit(rounded_to_float(-1e-60)));
    CHECK(rounded_to_float(1 + std::pow(2.0, -24)) == 1); // ties to even
    CHECK(rounded_to_float(1 + 3 * std::pow(2.0, -24)) == 1 + std::pow(2.0, -22));
}
