#include "render/drawing.hpp"

#include <catch2/catch.hpp>

using namespace fascicle::render;
using namespace fascicle::test;

namespace {

constexpr Rgba red{0.75f, 0.2f, 0.18f, 1.0f}, green_cap{0.1f, 0.6f, 0.2f, 1.0f};

DrawList list_of(std::vector<SurfaceItem> items, bool orthographic = true) {
    DrawList list;
    list.camera = front_camera(1.0f, orthographic);
    list.surfaces = std::move(items);
    return list;
}

SurfaceItem capped_sphere(std::uint64_t id = 1) {
    SurfaceItem item = sphere(id, red);
    item.cap = green_cap;
    return item;
}

bool reddish(const std::array<int, 4>& c) {
    return c[0] > c[1] + 40 && c[0] > c[2] + 40;
}
bool greenish(const std::array<int, 4>& c) {
    return c[1] > c[0] + 40 && c[1] > c[2] + 40;
}
bool bluish(const std::array<int, 4>& c) {
    return c[2] > c[0] + 40;
}

constexpr double disc = 3.14159265 * 0.45 * 0.45; ///< share of the picture that a ball of radius 1 covers

} // namespace

TEST_CASE("A section takes half of a ball away", "[render][section]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    for (const bool wireframe : {false, true}) {
        DrawList list = list_of({capped_sphere()});
        list.surfaces[0].wireframe = wireframe;
        const Image whole = draw(renderer, list, 200, 200);
        list.section = {-1, 0, 0, 0}; // x <= 0 stays
        const Image half = draw(renderer, list, 200, 200);
        const auto covered = [](const Image& image) {
            return share(image, [](const auto& c) { return reddish(c) || (c[0] > c[2] && c[0] < 120); });
        };
        if (!wireframe) {
            CHECK(covered(whole) == Approx(disc).margin(0.01));
            CHECK(covered(half) == Approx(disc / 2).margin(0.01));
        }
        CHECK(pixel(half, 60, 100) == pixel(whole, 60, 100));
        CHECK(std::abs(pixel(half, 150, 100)[0] - pixel(half, 150, 100)[1]) < 8); // the background
        list.section = {1, 0, 0, 0};
        CHECK(pixel(draw(renderer, list, 200, 200), 150, 100) == pixel(whole, 150, 100));
    }
}

TEST_CASE("A cut solid shows its cut, flat and in its own colour", "[render][section]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    for (const bool orthographic : {true, false}) {
        DrawList list = list_of({capped_sphere()}, orthographic);
        list.section = {0, 0, -1, 0}; // the near half is gone: the cut is the whole disc
        const Image image = draw(renderer, list, 200, 200);
        CHECK(share(image, greenish) == Approx(disc).margin(0.012));
        CHECK(share(image, reddish) < 0.01);
        const auto middle = pixel(image, 100, 100);
        for (const auto& [x, y] : {std::pair{60, 100}, {100, 150}, {130, 70}})
            CHECK(std::abs(pixel(image, x, y)[1] - middle[1]) < 30); // no light and shade but the stripes
        list.section = {0, 0, 1, 0}; // the far half is gone: the ball looks as before
        CHECK(share(draw(renderer, list, 200, 200), greenish) == 0);
        list.section = {0, 0, -1, -3}; // all is gone
        CHECK(share(draw(renderer, list, 200, 200),
                    [](const auto& c) { return reddish(c) || greenish(c); }) == 0);
        list.section = {0, 0, -1, 3}; // nothing is
        CHECK(share(draw(renderer, list, 200, 200), greenish) == 0);
    }
}

TEST_CASE("A cut is where the solid is: rings stay rings and what is behind the plane stays behind",
          "[render][section]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    // A ball in a hollow ball: the inner surface is turned inside out, so only the shell is solid.
    SurfaceItem shell = capped_sphere(1), hollow = sphere(2, red);
    auto positions = *shell.positions;
    auto triangles = *shell.triangles;
    const auto count = static_cast<std::uint32_t>(positions.size());
    for (const Vec3f& p : *hollow.positions)
        positions.push_back({0.6f * p[0], 0.6f * p[1], 0.6f * p[2]});
    for (const auto& t : *hollow.triangles)
        triangles.push_back({t[0] + count, t[2] + count, t[1] + count});
    shell.positions = std::make_shared<const std::vector<Vec3f>>(std::move(positions));
    shell.triangles = std::make_shared<const std::vector<std::array<std::uint32_t, 3>>>(std::move(triangles));
    shell.normals = nullptr;
    DrawList list = list_of({shell});
    list.section = {0, 0, -1, 0};
    const Image ring = draw(renderer, list, 200, 200);
    CHECK(share(ring, greenish) == Approx(disc * (1 - 0.36)).margin(0.012));
    CHECK(greenish(pixel(ring, 100 + 72, 100)));
    CHECK_FALSE(greenish(pixel(ring, 100, 100)));

    // A plate in front of the plane is cut away, one behind it is hidden by the cut.
    list = list_of({capped_sphere(), rectangle(3, {0.15f, 0.3f, 0.85f, 1}, 0.4f, 0.4f)});
    list.section = {0, 0, -1, 0};
    for (const float z : {0.5f, -0.5f}) {
        list.surfaces[1].model = translation(0, 0, z);
        CHECK(share(draw(renderer, list, 200, 200), bluish) == 0);
    }
}

TEST_CASE("What is no solid is cut without a cap, and lines are cut", "[render][section]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = list_of({sphere(1, red)});
    list.section = {0, 0, -1, 0};
    const Image open = draw(renderer, list, 200, 200);
    CHECK(reddish(pixel(open, 100, 100))); // the inside of the far half, lit
    CHECK(share(open, greenish) == 0);

    list.surfaces.clear();
    LineItem line;
    line.points = std::make_shared<const std::vector<Vec3f>>(std::vector<Vec3f>{{-1, 0, 0}, {1, 0, 0}});
    line.width_px = 6;
    for (const bool on_top : {false, true}) {
        line.on_top = on_top;
        list.lines = {line};
        list.section = {-1, 0, 0, 0.5f}; // x <= 0.5
        const Image image = draw(renderer, list, 200, 200);
        CHECK(pixel(image, 140, 100)[0] < 60);
        CHECK(pixel(image, 150, 100)[0] > 120);
        CHECK(pixel(image, 20, 100)[0] < 60);
    }
}

TEST_CASE("A transparent solid is cut, too, and its cut lets through what is behind", "[render][section]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = list_of({capped_sphere()});
    list.background_top = list.background_bottom = {1, 1, 1, 1};
    list.surfaces[0].colour[3] = 0.4f;
    list.section = {0, 0, -1, 0};
    const auto seen = pixel(draw(renderer, list, 200, 200), 100, 100);
    CHECK(seen[1] > seen[0] + 15);
    CHECK(seen[0] > 100); // white comes through
}

TEST_CASE("Occlusion darkens where surfaces are near and nothing else", "[render][occlusion]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    for (const bool orthographic : {true, false})
        for (const int supersampling : {1, 2}) {
            // A ball half sunk into a plate that faces the eye.
            DrawList list =
                list_of({sphere(1, red), rectangle(2, {0.7f, 0.7f, 0.7f, 1}, 1.0f, 1.0f)}, orthographic);
            list.surfaces[0].model = translation(0, 0, 0, 0.5f);
            const Image plain = draw(renderer, list, 200, 200, supersampling);
            list.occlusion_radius = 0.4f;
            const Image shaded = draw(renderer, list, 200, 200, supersampling);
            const auto change = [&](int x, int y) { return pixel(plain, x, y)[0] - pixel(shaded, x, y)[0]; };
            CHECK(change(152, 100) > 5); // on the plate, at the ball
            CHECK(change(100, 152) > 5);
            CHECK(std::abs(change(185, 185)) <= 3); // on the plate, far from it
            CHECK(std::abs(change(100, 100)) <= 3); // on the ball, towards the eye
            CHECK(change(2, 2) == 0);               // the background
            CHECK(change(98, 5) == 0);
        }
    // A plate at a slant does not shade itself.
    DrawList list = list_of({rectangle(2, {0.7f, 0.7f, 0.7f, 1}, 1.0f, 1.0f)});
    list.surfaces[0].model = {0.5f, 0, 0.866f, 0, 0, 1, 0, 0, -0.866f, 0, 0.5f, 0, 0, 0, 0, 1};
    const Image plain = draw(renderer, list, 200, 200);
    list.occlusion_radius = 0.4f;
    const Image shaded = draw(renderer, list, 200, 200);
    CHECK(std::abs(pixel(plain, 100, 100)[0] - pixel(shaded, 100, 100)[0]) <= 3);
}
