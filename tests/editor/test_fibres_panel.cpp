#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/io/files.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

/// The small scene with an attachment over each end of the muscle.
Scene attached_scene() {
    Scene scene = test::small_scene();
    Muscle& muscle = scene.muscles[0];
    muscle.attachments = {{AttachmentKind::origin, 0, {}}, {AttachmentKind::insertion, 1, {}}};
    for (int v = 0; v < muscle.mesh->vertex_count(); ++v) {
        const double x = muscle.mesh->positions[static_cast<std::size_t>(v)].x() - 40;
        if (std::abs(x) > 10)
            muscle.attachments[x < 0 ? 0 : 1].vertices.push_back(v);
    }
    return scene;
}

/// Draws until the fibres are there.
const std::vector<MuscleFibres>& fibres(Driver& d) {
    const FibrePreview& preview = d.editor().features().fibres;
    d.frame();
    for (int i = 0; i < 4000 && !preview.current(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        d.frame();
    }
    REQUIRE(preview.current());
    return preview.muscles();
}

const ParamSet& parameters(Driver& d) {
    return d.document().scene().parameters;
}

} // namespace

TEST_CASE("A click on a template makes fibres at once, in one undo step", "[editor][ui][fibres]") {
    Driver d(attached_scene());
    d.frame(3);
    d.click("tab/fibres");
    CHECK(fibres(d).at(0).fibres == nullptr);
    d.click("fibres/template/parallel");
    REQUIRE(fibres(d).at(0).fibres != nullptr);
    const FibreModelPtr parallel = fibres(d)[0].fibres;
    CHECK(parallel->rest.count == 100);
    CHECK(fibres(d)[0].architecture.length_mean_mm > 5);
    CHECK(parameters(d).get_choice("fibres.method") == "kukacka");
    CHECK(d.state().colouring == view::Colouring::fibres);
    CHECK(d.document().history().steps().size() == 2);
    // For the view, until a run has its own.
    CHECK(d.editor().features().fibres.fibres_for(d.document().scene()).at(0) == parallel);
    CHECK(d.editor().features().fibres.fibres_for(Scene{}).empty());

    d.click("fibres/template/curved");
    CHECK(parameters(d).get_choice("fibres.template") == "curved");
    CHECK(fibres(d)[0].fibres->rest.points != parallel->rest.points);
    CHECK(d.has("fibres/muscle/muscle"));
    d.key(key_z, {.ctrl = true});
    CHECK(fibres(d)[0].fibres->rest.points == parallel->rest.points);
    d.key(key_z, {.ctrl = true});
    CHECK(fibres(d)[0].fibres == nullptr);
}

TEST_CASE("The newest wish for fibres wins, and sliders are followed", "[editor][ui][fibres]") {
    Driver d(attached_scene());
    d.frame(3);
    d.click("tab/fibres");
    d.click("fibres/template/parallel");
    const Rect slider = d.rect("parameter/fibres.count");
    const float y = (slider.min.y + slider.max.y) / 2;
    d.drag({slider.min.x + slider.width() * 0.1f, y}, {slider.min.x - 20, y});
    CHECK(parameters(d).get_int("fibres.count") == 1);
    CHECK(fibres(d)[0].fibres->rest.count == 1);
    // Asked for many times without waiting.
    for (const char* key : {"curved", "fanned", "pennate"})
        d.click(std::string("fibres/template/") + key);
    d.click("fibres/method/streamlines");
    CHECK(parameters(d).get_choice("fibres.method") == "streamlines");
    CHECK(fibres(d)[0].fibres != nullptr);
    CHECK(fibres(d)[0].fibres->rest.count == 1);
}

TEST_CASE("A method that no muscle can have is locked with the reason", "[editor][ui][fibres]") {
    Driver d(attached_scene());
    d.frame(3);
    d.click("tab/fibres");
    d.click("fibres/method/chmd");
    CHECK(parameters(d).get_choice("fibres.method") == "none");
    const Scene& scene = d.document().scene();
    CHECK(why_not(scene, scene.muscles[0], "chmd").find("no superficial fibres") != std::string::npos);
    CHECK(why_not(scene, scene.muscles[0], "kukacka").empty());
    Scene loose = scene;
    loose.muscles[0].attachments.clear();
    loose.muscles[0].attach_automatically = false;
    CHECK(why_not(loose, loose.muscles[0], "kukacka") == "muscle is not attached to any bone");
    CHECK(why_not(loose, loose.muscles[0], "none").empty());
}

TEST_CASE("Fibres that cannot be made say so in the panel and leave the rest alone", "[editor][ui][fibres]") {
    Scene scene = attached_scene();
    scene.muscles[0].attachments.pop_back(); // no insertion
    Driver d(scene);
    d.frame(3);
    d.click("tab/fibres");
    d.click("fibres/template/parallel");
    CHECK(fibres(d)[0].fibres == nullptr);
    CHECK(fibres(d)[0].problem.find("muscle") != std::string::npos);
    d.frame(2);
    CHECK(d.has("fibres/muscle/muscle"));
}

TEST_CASE("A template of one's own comes from a file, and a bad one is refused in one line",
          "[editor][ui][fibres]") {
    const test::TempDir folder;
    const auto bad = folder.path() / "bad.json", good = folder.path() / "mine.json";
    write_file(bad, "{\"format\": \"fascicle fibre template\", \"front\": []}");
    write_file(good,
               "{\"format\": \"fascicle fibre template\", \"label\": \"Mine\", \"front\": ["
               "{\"s\": 0, \"points\": [[0.2, 0], [0, 1]]}, {\"s\": 1, \"points\": [[0.8, 0], [1, 1]]}]}");
    Driver d(attached_scene());
    d.frame(3);
    d.click("tab/fibres");
    CHECK_FALSE(d.has("fibres/template/own"));
    d.click("fibres/template/file");
    d.editor().dialogs().pick.go_to(bad);
    d.frame(2);
    d.click("pick/ok");
    CHECK(d.has("pick/problem"));
    CHECK(d.document().history().steps().size() == 1);
    d.editor().dialogs().pick.go_to(good);
    d.frame(2);
    d.click("pick/ok");
    CHECK_FALSE(d.has("pick/ok"));
    REQUIRE(d.document().scene().muscles[0].fibre_template != nullptr);
    CHECK(d.document().scene().muscles[0].fibre_template->label == "Mine");
    CHECK(d.has("fibres/template/own"));
    CHECK(fibres(d)[0].fibres != nullptr);
    d.click("fibres/template/parallel"); // a built-in one takes its place
    CHECK(d.document().scene().muscles[0].fibre_template == nullptr);
    d.click("fibres/template/file");
    d.key(key_escape);
    CHECK_FALSE(d.has("pick/ok"));
}

TEST_CASE("The fibre panel draws empty, large and small", "[editor][panels][fibres]") {
    for (const Scene& scene : {Scene{}, attached_scene()})
        for (const float scale : {1.0f, 2.0f})
            for (const float width : {320.0f, 1280.0f}) {
                Driver d(scene, width * scale, 800 * scale, scale);
                d.state().side_panel = "fibres";
                d.state().dark = scale == 1;
                d.frame(4);
                CHECK(d.has("fibres/template/fanned") == (!scene.muscles.empty() && width > 1000));
            }
}
