#include "editor/hand_run.hpp"
#include "output/frame_painter.hpp"
#include "render/image.hpp"
#include "render/osmesa_context.hpp"
#include "view/picture_tiles.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("Tiles cover a picture once", "[view][unit]") {
    for (const auto& [width, height, most] : {std::tuple{100, 50, 1280}, {2561, 1300, 1280}, {7, 5, 2}}) {
        std::vector<int> covered(static_cast<std::size_t>(width * height));
        for (const view::PictureTile& t : view::picture_tiles(width, height, most)) {
            CHECK(t.width <= most);
            CHECK(t.height <= most);
            for (int y = t.y; y < t.y + t.height; ++y)
                for (int x = t.x; x < t.x + t.width; ++x)
                    ++covered[static_cast<std::size_t>(y * width + x)];
        }
        CHECK(std::count(covered.begin(), covered.end(), 1) == width * height);
    }
}

TEST_CASE("A picture in tiles is the picture in one", "[view][picture]") {
    const render::OsmesaContext gl;
    const RecordingPtr recording = test::small_recording(10);
    const view::ViewSubject subject = view::subject_of(*recording, 9);
    const int width = 300, height = 200;
    view::Camera camera = view::picture_camera(subject, double(width) / height);
    for (const bool orthographic : {false, true}) {
        camera.set_orthographic(orthographic);
        view::DrawCache cache;
        const render::DrawList list =
            view::build_draw_list(subject, {}, camera.pose(double(width) / height), cache);
        render::SceneRenderer renderer;
        const auto draw = [&](const render::DrawList& what, int w, int h) {
            const render::OffscreenTarget target(w, h, 2);
            renderer.draw(what, target, 2);
            return target.read_back();
        };
        const render::Image one = draw(list, width, height);
        render::Image tiled{width, height, std::vector<std::uint8_t>(one.rgba.size())};
        const int margin = 5;
        for (const view::PictureTile& t : view::picture_tiles(width, height, 110)) {
            const render::Image part = draw(view::list_of_tile(list, width, height, t, margin),
                                            t.width + 2 * margin, t.height + 2 * margin);
            for (int y = 0; y < t.height; ++y)
                for (int x = 0; x < 4 * t.width; ++x)
                    tiled.rgba[static_cast<std::size_t>(4 * ((t.y + y) * width + t.x) + x)] =
                        part.rgba[static_cast<std::size_t>(4 * ((y + margin) * part.width + margin) + x)];
        }
        CHECK(render::differing_share(one, tiled, 6) < 0.004); // edges of triangles round differently
    }
}

TEST_CASE("A frame painter's steps give the picture of any size, with or without a background",
          "[output][picture]") {
    const render::OsmesaContext gl;
    const RecordingPtr recording = test::small_recording(3);
    const view::ViewSubject subject = view::subject_of(*recording, 2);
    output::FramePainter painter;
    output::PictureLook look;
    look.camera = view::picture_camera(subject, 2);
    look.width = 2 * output::FramePainter::tile_side;
    look.height = 60;
    painter.begin(subject, look);
    CHECK(painter.step());
    CHECK_FALSE(painter.complete());
    CHECK(painter.step());
    CHECK(painter.complete());
    CHECK_FALSE(painter.step());
    const render::Image wide = painter.take();
    CHECK(wide.width == look.width);
    CHECK(wide.rgba.size() == static_cast<std::size_t>(4 * look.width * look.height));
    look.width = 120;
    look.transparent = true;
    const render::Image clear = painter.paint(subject, look);
    CHECK(clear.rgba[3] == 0); // the corner
    CHECK(std::count(clear.rgba.begin(), clear.rgba.end(), 255) > 100);
}
