#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/anatomy/fibre_problem.hpp"
#include "fascicle/io/png.hpp"
#include "render/osmesa_context.hpp"
#include "support/fibres.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

constexpr int t_key = fascicle::editor::key_t; // <sys/types.h> has a key_t, too

/// Two fibres straight through the muscle of small_scene(), along x, 8 mm above each other.
FibreModelPtr two_fibres(const Scene& scene) {
    auto model = std::make_shared<FibreModel>();
    const Vec3 middle(40, 10, 20);
    model->rest = test::straight_fibres({{middle + Vec3(-12, 0, -4), middle + Vec3(12, 0, -4)},
                                         {middle + Vec3(-12, 0, 4), middle + Vec3(12, 0, 4)}},
                                        6);
    const TriMesh& mesh = *scene.muscles[0].mesh;
    model->carrier = bind_inside(mesh, MeshTopology(mesh.vertex_count(), mesh.triangles), model->rest.points);
    return model;
}

/// Seen from the front, with frames and fibres.
void start(Driver& d) {
    d.frame(3);
    d.run()->recording()->set_fibres({two_fibres(d.document().scene())});
    d.run()->compute(61);
    d.run()->finish();
    d.key(key_pad_0 + 1);
    d.frame(3);
}

ImVec2 place_of(Driver& d, const Vec3& point) {
    const Rect view = d.rect("viewport");
    const auto p = d.state().camera.project(point, {double(view.width()), double(view.height())});
    REQUIRE(p);
    return {view.min.x + static_cast<float>(p->x()), view.min.y + static_cast<float>(p->y())};
}

/// Place on a widget, by share of its width.
ImVec2 at(const Rect& r, float share) {
    return {r.min.x + r.width() * share, (r.min.y + r.max.y) / 2};
}

void open_display(Driver& d) {
    d.frame(3);
    if (!d.has("display/colouring"))
        d.click("tab/display");
    REQUIRE(d.has("display/colouring"));
}

} // namespace

TEST_CASE("The display panel opens by its tab, the toolbar and D", "[editor][ui][display]") {
    Driver d;
    open_display(d);
    d.click("toolbar/display");
    CHECK(d.state().side_panel == "parameters");
    d.key(key_d);
    CHECK(d.state().side_panel == "display");
    d.state().layout.show_right = false;
    d.key(key_d);
    CHECK(d.state().layout.show_right);
    CHECK(d.state().side_panel == "display");
}

TEST_CASE("Every switch of the display panel works and goes back", "[editor][ui][display]") {
    Driver d;
    open_display(d);
    EditorState& state = d.state();
    const std::pair<const char*, bool*> switches[] = {
        {"display/attachments", &state.attachments}, {"display/occlusion", &state.occlusion},
        {"display/wireframe", &state.wireframe},     {"display/ghost", &state.rest_ghost},
        {"display/fibres", &state.fibres},           {"display/line_muscles", &state.line_muscles},
        {"display/axis", &state.joint_axis}};
    for (const auto& [name, value] : switches) {
        INFO(name);
        const bool before = *value;
        CHECK_FALSE(d.has(std::string(name) + "/reset"));
        d.click(name);
        CHECK(*value == !before);
        d.click(std::string(name) + "/reset");
        CHECK(*value == before);
    }
    d.key(key_l);
    CHECK_FALSE(state.occlusion);
    d.click("display/reset_all");
    CHECK(state.occlusion);
}

TEST_CASE("Every colouring is chosen in the display panel, its range dragged, typed and reset",
          "[editor][ui][display]") {
    Driver d;
    open_display(d);
    for (const view::ColouringRow& row : view::colourings()) {
        INFO(row.key);
        d.click("display/colouring");
        d.click(std::string("display/colouring/") + row.key);
        CHECK(d.state().colouring == row.colouring);
        const view::ColourScale& scale = d.state().colour_scales[row.colouring];
        const ImVec2 high = d.middle("display/range/max");
        d.drag(high, {high.x - 12, high.y});
        if (!row.has_scale()) {
            CHECK_FALSE(d.has("display/range/reset"));
            continue;
        }
        CHECK(scale.high < row.scale.high);
        CHECK(scale.high > scale.low);
        d.double_click("display/range/min");
        d.key(key_a, {.ctrl = true});
        d.type("0.9");
        d.key(key_enter);
        CHECK(scale.low == Approx(std::min(0.9, scale.middle.value_or(0.9))).margin(0.1));
        d.click("display/range/reset");
        CHECK(scale == row.scale);
    }
    d.click("display/colouring/reset");
    CHECK(d.state().colouring == view::Colouring::anatomy);
}

TEST_CASE("Opacities follow their sliders, and T makes muscles transparent and opaque",
          "[editor][ui][display]") {
    Driver d;
    open_display(d);
    for (const bool bone : {false, true}) {
        const std::string name = bone ? "display/bone_opacity" : "display/muscle_opacity";
        const float& value = bone ? d.state().bone_opacity : d.state().muscle_opacity;
        const Rect slider = d.rect(name);
        d.drag(at(slider, 0.95f), at(slider, 0.4f));
        CHECK(value == Approx(0.43).margin(0.03));
        d.drag(at(slider, 0.5f), {slider.min.x - 40, at(slider, 0).y});
        CHECK(value == Approx(0.05));
        d.drag(at(slider, 0.5f), {slider.max.x + 40, at(slider, 0).y});
        CHECK(value == 1.0f);
    }
    d.key(t_key);
    CHECK(d.state().muscle_opacity == Approx(0.35));
    const Rect slider = d.rect("display/muscle_opacity");
    d.drag(at(slider, 0.4f), at(slider, 0.6f));
    const float chosen = d.state().muscle_opacity;
    d.click("toolbar/see_through");
    CHECK(d.state().muscle_opacity == 1.0f);
    d.key(t_key);
    CHECK(d.state().muscle_opacity == chosen); // what was chosen last comes back
    d.click("display/muscle_opacity/reset");
    CHECK(d.state().muscle_opacity == 1.0f);
    CHECK(d.document().history().steps().size() == 1); // looking is no change of the scene
}

TEST_CASE("The section plane is switched, turned, moved and flipped", "[editor][ui][section]") {
    Driver d;
    start(d);
    open_display(d);
    const Section& section = d.state().section;
    CHECK_FALSE(section_plane(section));
    d.click("display/section/position"); // nothing to move yet
    CHECK_FALSE(section.on);
    d.key(key_s);
    REQUIRE(section.on);
    CHECK((section.normal - d.state().camera.backward()).norm() < 1e-12);
    const Vec3 middle(40, 10, 20); // of the muscle
    CHECK(section_plane(section)->keeps(middle - d.state().camera.backward()));
    CHECK_FALSE(section_plane(section)->keeps(middle + d.state().camera.backward()));

    const std::pair<const char*, Vec3> axes[] = {{"Sagittal", {1, 0, 0}},
                                                 {"Coronal", {0, -1, 0}}, // LPS: +y posterior
                                                 {"Axial", {0, 0, 1}}};
    for (const auto& [name, normal] : axes) {
        INFO(name);
        d.click(std::string("display/section/") + name);
        CHECK((section.normal - normal).norm() < 1e-12);
        // The side that faces the eye goes.
        CHECK(section_plane(section)->normal.dot(d.state().camera.backward()) >= -1e-12);
    }
    // Axial: the slider covers the scene from bottom to top
    const Rect slider = d.rect("display/section/position");
    d.drag(at(slider, 0.5f), {slider.max.x + 30, at(slider, 0).y});
    CHECK(section.position == Approx(d.state().scene_box.max.z()));
    d.drag(at(slider, 0.5f), {slider.min.x - 30, at(slider, 0).y});
    CHECK(section.position == Approx(d.state().scene_box.min.z()));
    d.click("display/section/position/reset");
    CHECK(section.position == Approx((d.state().scene_box.min.z() + d.state().scene_box.max.z()) / 2));

    d.key(key_s, {.shift = true});
    CHECK(section.flipped);
    CHECK(section_plane(section)->normal == Vec3(0, 0, -1));
    d.click("display/section/flip");
    CHECK_FALSE(section.flipped);
    const view::Camera before = d.state().camera;
    const double place = section.position;
    d.move_to(d.middle("viewport"));
    d.editor().input().key(key_left_ctrl, true, {.ctrl = true});
    d.frame();
    d.editor().input().wheel(0, 3);
    d.frame(2);
    d.editor().input().key(key_left_ctrl, false, {});
    d.frame(2);
    CHECK(section.position > place);
    CHECK(d.state().camera.distance() == before.distance()); // the wheel did not zoom as well
    d.wheel("viewport", 2);
    CHECK(d.state().camera.distance() < before.distance());

    d.click("toolbar/section");
    CHECK_FALSE(section.on);
    d.key(key_s, {.shift = true});
    CHECK_FALSE(section.flipped); // nothing to flip
    d.key(key_s);
    CHECK(section.axis == SectionAxis::axial); // the axis is kept
    d.click("display/reset_all");
    CHECK_FALSE(section.on);
}

TEST_CASE("A section cuts the picture of the editor, and off it is as before", "[editor][picture][section]") {
    const render::OsmesaContext gl;
    const test::TempDir folder;
    Driver d;
    d.editor().use_gl();
    start(d);
    const auto bone_pixels = [&] {
        d.state().wants_picture = folder.path() / "view.png";
        d.frame();
        const PngImage image = read_png(folder.path() / "view.png");
        int count = 0;
        for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4)
            count += image.rgba[i] > 110 && image.rgba[i + 2] + 12 < image.rgba[i];
        return count;
    };
    d.state().occlusion = false;
    d.state().hidden = {"muscle"};
    const int whole = bone_pixels();
    REQUIRE(whole > 20000);
    d.key(key_s);
    orient(d.state().section, SectionAxis::axial, d.state().camera, Vec3(0, 0, 20)); // half of 40 mm
    CHECK(bone_pixels() == Approx(whole / 2.0).epsilon(0.12));
    d.key(key_s);
    CHECK(bone_pixels() == whole);
}

TEST_CASE("The fibre under the pointer lights up and is told to the plots", "[editor][ui][fibre_hover]") {
    Driver d;
    start(d);
    const Vec3 upper(40, 10, 24), lower(40, 10, 16);
    d.move_to(place_of(d, upper));
    CHECK_FALSE(d.state().hover_fibre); // inside an opaque muscle nothing is to be seen
    d.key(t_key);
    d.frame(2);
    REQUIRE(d.state().hover_fibre);
    CHECK(*d.state().hover_fibre == FibreRef{"muscle", 1});
    CHECK(d.has("viewport/fibre/label"));
    CHECK(d.rect("viewport/fibre").width() > 50);
    d.move_to(place_of(d, lower));
    CHECK(d.state().hover_fibre == FibreRef{"muscle", 0});
    // Beside it, but within reach; then beyond
    ImVec2 near = place_of(d, lower);
    near.y += 4;
    d.move_to(near);
    CHECK(d.state().hover_fibre == FibreRef{"muscle", 0});
    near.y += 14;
    d.move_to(near);
    CHECK_FALSE(d.state().hover_fibre);
    CHECK_FALSE(d.has("viewport/fibre"));
    // Not of a hidden muscle, and not when fibres are off
    d.move_to(place_of(d, lower));
    d.state().fibres = false;
    d.frame(2);
    CHECK_FALSE(d.state().hover_fibre);
    d.state().fibres = true;
    d.state().hidden = {"muscle"};
    d.frame(2);
    CHECK_FALSE(d.state().hover_fibre);
    d.state().hidden.clear();
    // With the colouring of fibres the muscle is translucent by itself
    d.key(t_key);
    d.state().colouring = view::Colouring::fibres;
    d.frame(2);
    CHECK(d.state().hover_fibre == FibreRef{"muscle", 0});
    // A section takes the fibre away: nothing to point at
    d.key(key_s);
    d.state().section.position -= 1;
    d.frame(2);
    CHECK_FALSE(d.state().hover_fibre);
}

TEST_CASE("A fibre that a plot points at is drawn, and a rest in the view computes nothing anew",
          "[editor][ui][fibre_hover]") {
    Driver d;
    start(d);
    d.move_to({d.rect("viewport").min.x + 5, d.rect("viewport").min.y + 5});
    const auto hover = [&](int fibre) {
        d.state().next_hover_fibre = FibreRef{"muscle", fibre};
        d.frame();
    };
    hover(0);
    REQUIRE(d.has("viewport/fibre")); // also through an opaque muscle
    CHECK_FALSE(d.has("viewport/fibre/label"));
    const float low = d.rect("viewport/fibre").min.y;
    const int carried = d.editor().features().fibre_hover.carried(),
              projected = d.editor().features().fibre_hover.projected();
    hover(1);
    CHECK(d.rect("viewport/fibre").min.y < low);
    hover(0);
    CHECK(d.editor().features().fibre_hover.carried() == carried);
    CHECK(d.editor().features().fibre_hover.projected() == projected);
    // Another frame carries, another camera only projects
    d.key(key_pad_0 + 4);
    hover(0);
    CHECK(d.editor().features().fibre_hover.carried() == carried);
    CHECK(d.editor().features().fibre_hover.projected() == projected + 1);
    d.key(key_right);
    hover(0);
    CHECK(d.editor().features().fibre_hover.carried() == carried + 1);
    hover(7); // there is none
    CHECK_FALSE(d.has("viewport/fibre"));
    d.state().next_hover_fibre = FibreRef{"no such muscle", 0};
    d.frame();
    CHECK_FALSE(d.has("viewport/fibre"));
    d.editor().replace_document(Document(test::small_scene()));
    hover(0);
    CHECK_FALSE(d.has("viewport/fibre"));
}

TEST_CASE("The display panel draws an empty, a loading, a full and a failed scene at any size",
          "[editor][panels][display]") {
    struct Size {
        float width, height, scale;
    };
    for (const Size size : {Size{1280, 800, 1}, Size{320, 240, 1}, Size{2560, 1600, 2}})
        for (const bool empty : {true, false}) {
            if (empty && size.scale > 1)
                continue;
            Driver d(empty ? Scene{} : test::small_scene(), size.width, size.height, size.scale);
            d.state().side_panel = "display";
            d.frame(3);
            if (d.run() != nullptr)
                d.run()->compute(10);
            for (const view::ColouringRow& row : view::colourings()) {
                d.state().colouring = row.colouring;
                d.frame();
            }
            d.key(key_s);
            d.state().dark = false;
            d.frame(2);
            if (d.run() != nullptr)
                d.run()->recording()->finish(RunState::failed, "muscle: not closed");
            d.frame(2);
            if (size.width > 1000) {
                // Everything is inside of the column
                const Rect column = d.editor().layout().parameters;
                for (const char* name : {"display/colouring", "display/range/max", "display/section/Axial"}) {
                    INFO(name);
                    CHECK(d.rect(name).min.x >= column.min.x);
                    CHECK(d.rect(name).max.x <= column.max.x);
                }
            }
        }
}

TEST_CASE("Fields that are computed beside the interface come into the picture",
          "[editor][picture][display]") {
    const render::OsmesaContext gl;
    Driver d(test::small_scene(), 1280, 800, 1, false);
    d.editor().use_gl();
    d.frame(3);
    d.run()->compute(10);
    d.state().colouring = view::Colouring::harmonic;
    d.frame(2);
    for (int i = 0; i < 5000 && d.editor().view()->waiting(); ++i)
        d.frame();
    CHECK_FALSE(d.editor().view()->waiting());
    d.frame(40);
    CHECK_FALSE(d.editor().view()->refinement_pending());
    const int drawn = d.editor().view()->drawn();
    d.frame(20);
    CHECK(d.editor().view()->drawn() == drawn); // and then all rests
}
