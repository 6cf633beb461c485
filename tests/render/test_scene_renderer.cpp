#include "render/drawing.hpp"
#include "render/gl_functions.hpp"

#include <catch2/catch.hpp>

using namespace fascicle::render;
using namespace fascicle::test;

namespace {

constexpr Rgba red{0.75f, 0.2f, 0.18f, 1.0f}, blue{0.15f, 0.3f, 0.85f, 1.0f}, black{0, 0, 0, 1};

DrawList empty_list() {
    DrawList list;
    list.camera = front_camera();
    return list;
}

bool reddish(const std::array<int, 4>& c) {
    return c[0] > c[1] + 40 && c[0] > c[2] + 40;
}
bool bluish(const std::array<int, 4>& c) {
    return c[2] > c[0] + 40 && c[2] > c[1] + 20;
}
bool dark(const std::array<int, 4>& c) {
    return c[0] < 40 && c[1] < 40 && c[2] < 40;
}

std::shared_ptr<const std::vector<Vec3f>> points(std::vector<Vec3f> values) {
    return std::make_shared<const std::vector<Vec3f>>(std::move(values));
}

} // namespace

TEST_CASE("The background runs from the bottom to the top colour", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.background_top = {1.0f, 0.0f, 0.0f, 1.0f};
    list.background_bottom = {0.0f, 0.0f, 1.0f, 1.0f};
    const Image image = draw(renderer, list, 20, 100);
    CHECK(pixel(image, 10, 0)[0] > 250);
    CHECK(pixel(image, 10, 99)[2] > 250);
    CHECK(std::abs(pixel(image, 10, 50)[0] - 127) <= 3);
}

TEST_CASE("A surface covers the pixels it should", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    for (const bool orthographic : {false, true}) {
        list.camera = front_camera(1.0f, orthographic);
        list.surfaces = {rectangle(1, red, 0.5f, 0.5f)};
        const Image image = draw(renderer, list, 200, 200);
        CHECK(reddish(pixel(image, 100, 100)));
        // 90 pixels of 200 a side
        CHECK(share(image, reddish) == Approx(0.45 * 0.45).margin(0.005));
        list.surfaces[0].model = translation(0.5f, 0.5f, 0.0f, 0.5f);
        const Image moved = draw(renderer, list, 200, 200);
        CHECK(reddish(pixel(moved, 145, 55)));
        CHECK_FALSE(reddish(pixel(moved, 100, 101)));
    }
}

TEST_CASE("Nearer surfaces hide farther ones, whatever the order", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    for (const bool swapped : {false, true}) {
        DrawList list = empty_list();
        list.surfaces = {rectangle(1, red, 0.5f, 0.5f), rectangle(2, blue, 0.5f, 0.5f)};
        list.surfaces[0].model = translation(0, 0, 0.5f);
        if (swapped)
            std::swap(list.surfaces[0], list.surfaces[1]);
        CHECK(reddish(pixel(draw(renderer, list, 100, 100), 50, 50)));
    }
}

TEST_CASE("A grey facing the light keeps its sRGB order and a black one stays dark",
          "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    int last = -1;
    for (const float grey : {0.0f, 0.25f, 0.5f, 0.75f}) {
        DrawList list = empty_list();
        list.surfaces = {rectangle(1, {grey, grey, grey, 1}, 0.5f, 0.5f)};
        list.surfaces[0].gloss = 0.0f;
        const int shown = pixel(draw(renderer, list, 64, 64), 32, 32)[0];
        CHECK(shown > last);
        // Facing the camera the light is near 1, so a colour comes out near what was asked for.
        CHECK(std::abs(shown - static_cast<int>(255.0f * grey)) < 30);
        last = shown;
    }
}

TEST_CASE("Both sides of a surface are drawn, the inside darker", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.surfaces = {rectangle(1, red, 0.5f, 0.5f)};
    const auto front = pixel(draw(renderer, list, 64, 64), 32, 32);
    list.surfaces[0].triangles = std::make_shared<const std::vector<std::array<std::uint32_t, 3>>>(
        std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 3, 2}});
    list.surfaces[0].normals = std::make_shared<const std::vector<Vec3f>>(4, Vec3f{0, 0, -1});
    const auto back = pixel(draw(renderer, list, 64, 64), 32, 32);
    CHECK(back[0] < front[0] - 10);
    CHECK(back[0] > 60);
    // A mirroring model matrix turns the winding round once more, not the outside.
    list.surfaces[0].model[10] = -1.0f;
    CHECK(pixel(draw(renderer, list, 64, 64), 32, 32) == front);
}

TEST_CASE("Vertex colours win over the flat colour and missing normals are flat",
          "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.surfaces = {rectangle(1, red, 0.5f, 0.5f)};
    const auto with_normals = pixel(draw(renderer, list, 64, 64), 32, 32);
    list.surfaces[0].normals = nullptr;
    CHECK(pixel(draw(renderer, list, 64, 64), 32, 32) == with_normals);
    list.surfaces[0].vertex_colours =
        std::make_shared<const std::vector<Rgba>>(std::vector<Rgba>{blue, blue, red, red});
    const Image image = draw(renderer, list, 64, 64);
    CHECK(bluish(pixel(image, 32, 44)));
    CHECK(reddish(pixel(image, 32, 20)));
    list.surfaces[0].vertex_colours = nullptr;
    CHECK(pixel(draw(renderer, list, 64, 64), 32, 32) == with_normals);
}

TEST_CASE("A transparent surface shows what is behind it, not its own far side", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.background_top = list.background_bottom = {1, 1, 1, 1};
    Rgba glass = red;
    glass[3] = 0.5f;
    list.surfaces = {sphere(2, glass), rectangle(1, blue, 0.3f, 0.3f)};
    const Image one = draw(renderer, list, 200, 200);
    const auto over_blue = pixel(one, 100, 100), over_white = pixel(one, 100, 150);
    CHECK(over_blue[2] > over_blue[1] + 30); // blue shines through
    CHECK(over_blue[0] > 80);                // and red lies over it
    CHECK(over_white[1] > over_blue[1] + 20);
    list.surfaces[0].colour[3] = 0.05f;
    CHECK(bluish(pixel(draw(renderer, list, 200, 200), 100, 100)));
    list.surfaces[0].colour[3] = 0.0f;
    CHECK(pixel(draw(renderer, list, 200, 200), 100, 150) == std::array{255, 255, 255, 255});
}

TEST_CASE("Farther transparent surfaces are drawn first", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    Rgba near_red = red, far_blue = blue;
    near_red[3] = far_blue[3] = 0.8f;
    Image images[2];
    for (const int swapped : {0, 1}) {
        DrawList list = empty_list();
        list.surfaces = {rectangle(1, near_red, 0.5f, 0.5f), rectangle(2, far_blue, 0.5f, 0.5f)};
        list.surfaces[0].model = translation(0, 0, 0.5f);
        if (swapped == 1)
            std::swap(list.surfaces[0], list.surfaces[1]);
        images[swapped] = draw(renderer, list, 64, 64);
        CHECK(reddish(pixel(images[swapped], 32, 32)));
    }
    CHECK(images[0].rgba == images[1].rgba);
}

TEST_CASE("The wireframe darkens edges only", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.surfaces = {rectangle(1, red, 0.8f, 0.8f)};
    const Image plain = draw(renderer, list, 200, 200);
    list.surfaces[0].wireframe = true;
    const Image wired = draw(renderer, list, 200, 200);
    const auto on_diagonal = pixel(wired, 100, 100), inside = pixel(wired, 130, 120);
    CHECK(on_diagonal[0] < pixel(plain, 100, 100)[0] - 20);
    CHECK(inside == pixel(plain, 130, 120));
    // Two sides of 144 pixels, the diagonal of 204, about a pixel and a half wide each: 2 % of 40,000 pixels
    CHECK(differing_share(plain, wired, 10) > 0.01);
    CHECK(differing_share(plain, wired, 10) < 0.06);
}

TEST_CASE("Lines have the asked width and hide behind surfaces unless on top", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    for (const int supersampling : {1, 2}) {
        DrawList list = empty_list();
        LineItem line;
        line.points = points({{-1.0f, 0.0f, -0.5f}, {1.0f, 0.0f, -0.5f}});
        line.width_px = 6.0f;
        line.colour = black;
        list.lines = {line};
        const Image free = draw(renderer, list, 100, 100, supersampling);
        int thick = 0;
        for (int y = 0; y < 100; ++y)
            thick += dark(pixel(free, 50, y)) ? 1 : 0;
        CHECK(thick >= 5);
        CHECK(thick <= 7);

        list.surfaces = {rectangle(1, red, 0.5f, 0.5f)};
        CHECK(reddish(pixel(draw(renderer, list, 100, 100, supersampling), 50, 50)));
        list.lines[0].on_top = true;
        CHECK(dark(pixel(draw(renderer, list, 100, 100, supersampling), 50, 50)));
    }
}

TEST_CASE("A line on a surface wins over it, one just behind does not", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.surfaces = {rectangle(1, red, 0.5f, 0.5f)};
    LineItem line;
    line.width_px = 6.0f;
    line.colour = black;
    for (const bool orthographic : {false, true})
        for (const float far_plane : {20.0f, 20000.0f}) { // the depth range must not matter
            list.camera = front_camera(1.0f, orthographic);
            const float near_plane = 0.5f, depth = far_plane - near_plane;
            list.camera.projection[10] = orthographic ? -2.0f / depth : -(far_plane + near_plane) / depth;
            list.camera.projection[14] =
                orthographic ? -(far_plane + near_plane) / depth : -2.0f * far_plane * near_plane / depth;
            line.points = points({{-1.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}});
            list.lines = {line};
            CHECK(dark(pixel(draw(renderer, list, 100, 100), 50, 50)));
            // A pixel spans 0.022 units here: this is five pixels behind
            line.points = points({{-1.0f, 0.0f, -0.11f}, {1.0f, 0.0f, -0.11f}});
            list.lines = {line};
            CHECK(reddish(pixel(draw(renderer, list, 100, 100), 50, 50)));
        }
}

TEST_CASE("A line through the eye is cut at the near plane, and point colours blend",
          "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    LineItem line;
    // From the picture's centre to a point behind the eye, to the right: it leaves by the right border.
    line.points = points({{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 10.0f}});
    line.width_px = 8.0f;
    line.point_colours = std::make_shared<const std::vector<Rgba>>(std::vector<Rgba>{red, blue});
    list.lines = {line};
    const Image image = draw(renderer, list, 100, 100);
    CHECK(reddish(pixel(image, 52, 50)));
    CHECK(share(image, [](const auto& c) { return reddish(c) || bluish(c); }) < 0.12);
    list.lines[0].points = points({{0.0f, 0.0f, 6.0f}, {1.0f, 0.0f, 10.0f}}); // wholly behind
    CHECK(draw(renderer, list, 100, 100).rgba == draw(renderer, empty_list(), 100, 100).rgba);
}

TEST_CASE("Arrays are sent to the GPU only when they are others", "[render][mesh_buffer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.surfaces = {sphere(7, red), rectangle(8, blue, 0.1f, 0.1f)};
    draw(renderer, list, 32, 32);
    CHECK(renderer.uploads() == 6); // positions, normals, triangles of each
    draw(renderer, list, 32, 32);
    CHECK(renderer.uploads() == 0);
    std::vector<Vec3f> smaller = *list.surfaces[0].positions;
    for (Vec3f& p : smaller)
        p = {0.5f * p[0], 0.5f * p[1], 0.5f * p[2]};
    const Image large = draw(renderer, list, 64, 64);
    list.surfaces[0].positions = points(smaller);
    const Image small = draw(renderer, list, 64, 64);
    CHECK(renderer.uploads() == 1);
    CHECK(share(small, reddish) < 0.5 * share(large, reddish));
    // Another mesh under the same id, with fewer vertices
    list.surfaces[0] = rectangle(7, red, 0.5f, 0.5f);
    CHECK(share(draw(renderer, list, 64, 64), reddish) == Approx(0.2).margin(0.02));
}

TEST_CASE("Of live colours only the changed range is sent", "[render][mesh_buffer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.surfaces = {sphere(7, red)};
    const auto live = std::make_shared<LiveColours>();
    const std::size_t count = list.surfaces[0].positions->size();
    live->colours.assign(count, red);
    list.surfaces[0].live_colours = live;
    CHECK(share(draw(renderer, list, 64, 64), reddish) > 0.3);
    CHECK(renderer.colours_sent() == count);
    draw(renderer, list, 64, 64);
    CHECK(renderer.colours_sent() == 0);
    for (std::size_t i = 0; i < count; ++i)
        live->colours[i] = blue;
    live->changes.push_back({++live->revision, 0, count / 2});
    draw(renderer, list, 64, 64);
    CHECK(renderer.uploads() == 1);
    CHECK(renderer.colours_sent() == count / 2);
    live->changes.push_back({++live->revision, count / 2, count - count / 2});
    CHECK(share(draw(renderer, list, 64, 64), bluish) > 0.3);
    CHECK(share(draw(renderer, list, 64, 64), reddish) == 0);
    live->changes.clear(); // a renderer that missed changes takes them all
    live->known_from = ++live->revision;
    live->colours.assign(count, red);
    CHECK(share(draw(renderer, list, 64, 64), reddish) > 0.3);
    CHECK(renderer.colours_sent() == count);
    list.surfaces[0].live_colours = nullptr;
    list.surfaces[0].colour = blue;
    CHECK(share(draw(renderer, list, 64, 64), bluish) > 0.3);
}

TEST_CASE("Empty items draw nothing and do no harm", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    const Image before = draw(renderer, list, 32, 32);
    SurfaceItem nothing;
    nothing.id = 3;
    list.surfaces = {nothing};
    nothing.positions = points({});
    nothing.triangles = std::make_shared<const std::vector<std::array<std::uint32_t, 3>>>();
    list.surfaces.push_back(nothing);
    list.lines.resize(2);
    list.lines[1].points = points({});
    CHECK(draw(renderer, list, 32, 32).rgba == before.rgba);
    CHECK(gl::GetError() == GL_NO_ERROR);
}

TEST_CASE("A transparent background stays transparent around the surface", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.background_top[3] = list.background_bottom[3] = 0.0f;
    list.surfaces = {sphere(1, red)};
    const Image image = draw(renderer, list, 100, 100);
    CHECK(pixel(image, 1, 1) == std::array{0, 0, 0, 0});
    CHECK(pixel(image, 50, 50)[3] == 255);
    // Half-covered border pixels keep the surface's colour instead of mixing in the background's
    CHECK(share(image, [](const auto& c) { return c[3] > 0 && c[3] < 255; }) > 0.001);
    CHECK(share(image, [](const auto& c) { return c[3] > 0 && c[3] < 255 && c[1] > c[0] + 5; }) == 0.0);
}

TEST_CASE("The picture follows the target's size", "[render][scene_renderer]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.surfaces = {rectangle(1, red, 0.5f, 0.5f)};
    for (const auto& [width, height] : {std::pair{200, 100}, {100, 200}, {64, 64}}) {
        list.camera = front_camera(static_cast<float>(width) / static_cast<float>(height));
        const Image image = draw(renderer, list, width, height);
        REQUIRE(image.width == width);
        // A square stays a square: 0.45 of the height on both sides
        const double side = 0.45 * height;
        CHECK(share(image, reddish) * width * height == Approx(side * side).epsilon(0.1));
    }
}

TEST_CASE("Golden: spheres, glass, wireframe, lines", "[render][golden]") {
    const OsmesaContext context;
    SceneRenderer renderer;
    DrawList list = empty_list();
    list.camera = front_camera(1.6f);
    const Rgba muscle{0.70f, 0.23f, 0.20f, 1.0f}, bone{0.93f, 0.89f, 0.78f, 1.0f};
    list.surfaces = {sphere(1, muscle), sphere(2, bone), sphere(3, {0.93f, 0.89f, 0.78f, 0.35f}),
                     sphere(4, {0.4f, 0.55f, 0.75f, 1.0f}, 8)};
    list.surfaces[0].model = translation(-1.0f, 0.45f, 0, 0.55f);
    list.surfaces[0].gloss = 0.5f;
    list.surfaces[1].model = translation(0.3f, 0.45f, 0, 0.55f);
    list.surfaces[2].model = translation(-0.6f, -0.3f, 0.8f, 0.45f);
    list.surfaces[3].model = translation(0.9f, -0.45f, 0.5f, 0.5f);
    list.surfaces[3].wireframe = true;
    LineItem axis;
    axis.points = points({{-1.6f, -0.9f, 0}, {1.6f, 0.9f, 0}});
    axis.width_px = 2.0f;
    axis.colour = {0.1f, 0.1f, 0.1f, 1.0f};
    list.lines = {axis};
    check_golden(draw(renderer, list, 320, 200), "items");
}
