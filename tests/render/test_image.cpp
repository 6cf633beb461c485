#include "render/drawing.hpp"

#include <catch2/catch.hpp>

using namespace fascicle::render;
using namespace fascicle::test;

namespace {

Image filled(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a = 255) {
    Image image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width * height))};
    const std::array<std::uint8_t, 4> colour{r, g, b, a};
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        image.rgba[i] = colour[i % 4];
    return image;
}

} // namespace

TEST_CASE("differing_share counts pixels beyond the tolerance", "[render][image]") {
    const Image a = filled(10, 10, 100, 100, 100);
    Image b = a;
    CHECK(differing_share(a, b, 0) == 0.0);
    b.rgba[0] = 105;  // pixel 0, red
    b.rgba[1] = 120;  // pixel 0 again, green
    b.rgba[42] = 103; // pixel 10
    CHECK(differing_share(a, b, 2) == Approx(0.02));
    CHECK(differing_share(a, b, 3) == Approx(0.01));
    CHECK(differing_share(a, b, 20) == 0.0);
    CHECK(differing_share(a, filled(10, 9, 100, 100, 100), 255) == 1.0);
    CHECK(differing_share({}, {}, 0) == 0.0);
}

TEST_CASE("film_strip puts pictures side by side with gaps", "[render][image]") {
    const Image strip = film_strip({filled(3, 2, 255, 0, 0), filled(2, 4, 0, 255, 0)}, 1, {0, 0, 1, 1});
    REQUIRE(strip.width == 6);
    REQUIRE(strip.height == 4);
    CHECK(pixel(strip, 2, 1) == std::array{255, 0, 0, 255});
    CHECK(pixel(strip, 3, 1) == std::array{0, 0, 255, 255}); // gap
    CHECK(pixel(strip, 4, 3) == std::array{0, 255, 0, 255});
    CHECK(pixel(strip, 0, 2) == std::array{0, 0, 255, 255}); // below the lower one
    CHECK(film_strip({}).rgba.empty());
}

TEST_CASE("downsample averages blocks weighted by alpha", "[render][image]") {
    Image image = filled(5, 4, 40, 80, 120);
    image.rgba[0] = 80;
    const Image half = downsample(image, 2);
    REQUIRE(half.width == 2);
    REQUIRE(half.height == 2);
    CHECK(pixel(half, 0, 0) == std::array{50, 80, 120, 255});
    CHECK(pixel(half, 1, 1) == std::array{40, 80, 120, 255});
    Image see_through = filled(2, 2, 200, 0, 0);
    for (int i = 1; i < 4; ++i)
        for (int c = 0; c < 4; ++c)
            see_through.rgba[static_cast<std::size_t>(4 * i + c)] = 0;
    CHECK(pixel(downsample(see_through, 2), 0, 0) == std::array{200, 0, 0, 64});
    CHECK(downsample(image, 1).rgba == image.rgba);
}
