#include "editor/driver.hpp"
#include "editor/editor_picture.hpp"
#include "fascicle/io/png.hpp"
#include "render/drawing.hpp"
#include "render/imgui_renderer.hpp"
#include "render/osmesa_context.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;

namespace {

/// Without the driver's fonts a picture of text is another one.
bool has_fonts() {
    const render::ImguiHost host;
    return host.has_text_font() && host.has_icons();
}

} // namespace

TEST_CASE("Golden: the whole editor", "[editor][golden]") {
    if (!has_fonts()) {
        WARN("fascicle-skip: fonts are missing");
        return;
    }
    EditorPictureOptions options;
    options.width = 1280;
    options.height = 800;
    test::check_golden(render_editor_picture(test::small_recording(), 20, options), "editor");
    options.dark = false;
    options.colouring = view::Colouring::strain;
    test::check_golden(render_editor_picture(test::small_recording(41), 30, options), "editor_light_strain");
}

TEST_CASE("The editor draws at any size and scale", "[editor][picture]") {
    const RecordingPtr recording = test::small_recording();
    for (const auto& [width, height, scale] :
         {std::tuple{320, 240, 1.0f}, {2560, 1600, 2.0f}, {800, 600, 0.75f}}) {
        EditorPictureOptions options;
        options.width = width;
        options.height = height;
        options.scale = scale;
        const render::Image image = render_editor_picture(recording, 20, options);
        CHECK(image.width == width);
        CHECK(image.height == height);
        std::set<std::uint32_t> colours;
        for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
            colours.insert(image.rgba[i] * 65536u + image.rgba[i + 1] * 256u + image.rgba[i + 2]);
        CHECK(colours.size() > 200); // a shaded scene, not an empty plate
    }
}

TEST_CASE("The view is drawn again only when something changed", "[editor][picture]") {
    const render::OsmesaContext gl;
    test::Driver d;
    d.editor().use_gl();
    d.frame(3);
    d.run()->compute(10);
    d.frame(3);
    const int before = d.editor().view()->drawn();
    d.frame(5);
    CHECK(d.editor().view()->drawn() == before);
    d.key(key_w);
    CHECK(d.editor().view()->drawn() == before + 1);
    d.key(key_right);
    CHECK(d.editor().view()->drawn() == before + 2);
    const ImVec2 middle = d.middle("viewport");
    d.drag(middle, {middle.x + 60, middle.y});
    CHECK(d.editor().view()->drawn() > before + 2);
}

TEST_CASE("A slow picture is refined once nothing moves", "[editor][picture]") {
    const render::OsmesaContext gl;
    test::Driver d(test::small_scene(), 1280, 800, 1, false);
    d.editor().use_gl();
    d.frame(3);
    d.run()->compute(61);
    d.run()->finish();
    d.frame(60);
    CHECK_FALSE(d.editor().view()->refinement_pending());
    const int before = d.editor().view()->drawn();
    d.frame(30);
    CHECK(d.editor().view()->drawn() == before);
    d.editor().metrics().finish(); // they are measured in real time, the test's frames are not
    d.frame(3);
    CHECK_FALSE(d.editor().next_redraw()); // all rests
    d.key(key_w);
    d.frame(static_cast<int>(SceneView::refine_after_seconds * 60) + 3);
    CHECK_FALSE(d.editor().view()->refinement_pending());
    CHECK(d.editor().view()->drawn() <= before + 2); // at most a quick one and a fine one
}

TEST_CASE("F12 writes the view as a picture", "[editor][picture]") {
    const render::OsmesaContext gl;
    const test::TempDir folder;
    test::Driver d;
    d.editor().use_gl();
    d.frame(3);
    d.state().wants_picture = folder.path() / "view.png";
    d.frame();
    const PngImage image = read_png(folder.path() / "view.png");
    CHECK(image.width == static_cast<int>(d.editor().layout().viewport.width()));
    CHECK(image.height == static_cast<int>(d.editor().layout().viewport.height()));
    d.state().wants_picture = "/proc/view.png";
    d.frame();
    CHECK(d.editor().log().unseen_errors() == 1);
}
