// A scene from an OpenSim model through the dialog.
#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "render/osmesa_context.hpp"
#include "support/osim_scene.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <thread>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;
using fascicle::test::OsimFiles;

namespace {

void wait_for(Driver& d, const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!done() && std::chrono::steady_clock::now() < end) {
        d.frame();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(done());
    d.frame(3);
}

OsimChoice& choice(Driver& d) {
    return d.editor().dialogs().osim.choice();
}

/// Types the file's path; the model and the trial are then read ahead.
void choose(Driver& d, const std::filesystem::path& file) {
    d.click("browser/path");
    d.key(key_a, {.ctrl = true});
    d.type(file.string());
    d.key(key_enter);
    d.frame(2);
    wait_for(d, [&] { return !choice(d).reading(); });
}

void open_dialog(Driver& d) {
    d.frame(3);
    EditorContext context = d.editor().context();
    run_command(context, Command::open_model);
    d.frame(3);
    REQUIRE(d.has("osim/open"));
}

} // namespace

TEST_CASE("The dialog shows what a model and a trial hold, and opens them with a stand-in",
          "[editor][ui][osim]") {
    const OsimFiles files;
    Driver d;
    open_dialog(d);
    std::string why;
    choice(d).finished(why);
    CHECK(why == "Choose a model (.osim) first.");
    choose(d, files.path("arm.osim"));
    REQUIRE(choice(d).preview());
    CHECK(choice(d).preview()->bodies.size() == 2);
    CHECK(choice(d).preview()->muscles.size() == 1);
    CHECK(d.has("osim/holds"));
    choice(d).finished(why);
    CHECK(why == "Choose a trial (.mot, .sto) that moves it.");
    choose(d, files.path("trial.mot"));
    CHECK(choice(d).preview()->rows == 3);
    CHECK(d.has("osim/moves"));
    d.click("osim/stand_in");
    d.click("osim/stand_in/flexor_r");
    REQUIRE(choice(d).rows().size() == 1);
    d.click("osim/axes");
    d.click("osim/axes/2");
    d.click("osim/open");
    wait_for(d, [&] {
        return d.document().scene().bones.size() == 2 && d.document().scene().model_motion != nullptr;
    });
    const Scene& scene = d.document().scene();
    CHECK(scene.muscles.at(0).name == "flexor_r");
    CHECK(scene.model_motion->axes == "opensim_to_lps");
    CHECK(model_motion_in_force(scene) != nullptr);
    CHECK(scene.timeline.last_frame == 6);
    CHECK(d.editor().log().unseen_errors() == 0);
}

TEST_CASE("Meshes get the bodies of their names, and everyone can change them", "[editor][ui][osim]") {
    const OsimFiles files;
    Driver d;
    open_dialog(d);
    files.ball("left_femur.obj", Vec3(0, 0.032, 0));
    choose(d, files.path("arm.osim"));
    choose(d, files.path("trial.mot"));
    choose(d, files.path("left_femur.obj"));
    choose(d, files.path("Geometry/base.obj"));
    REQUIRE(choice(d).rows().size() == 2);
    CHECK(choice(d).rows()[0].bone);
    CHECK(choice(d).rows()[0].origin.empty()); // no body is called so
    CHECK(choice(d).rows()[1].origin == "base");
    CHECK_FALSE(choice(d).rows()[1].bone);
    std::string why;
    choice(d).finished(why);
    CHECK(why == "Say which body left_femur.obj belongs to.");
    d.click("osim/mesh/left_femur.obj/origin");
    d.click("osim/mesh/left_femur.obj/origin/arm_r");
    d.click("osim/mesh/base.obj/role");
    const SceneRequest request = choice(d).finished(why);
    CHECK(why.empty());
    REQUIRE(request.bones.size() == 2);
    CHECK(request.bones[0].string().ends_with("left_femur.obj=arm_r"));
    d.click("osim/mesh/base.obj/remove");
    CHECK(choice(d).rows().size() == 1);
    d.click("osim/cancel");
    d.frame(2);
    CHECK(choice(d).rows().empty());
    CHECK(d.document().scene().model_motion == nullptr);
}

TEST_CASE("Esc closes an open list first, and what was chosen outlasts the question about changes",
          "[editor][ui][osim]") {
    const OsimFiles files;
    Driver d;
    actions::set_parameter(d.document(), "solver.stiffness", 0.5);
    open_dialog(d);
    choose(d, files.path("arm.osim"));
    choose(d, files.path("trial.mot"));
    d.click("osim/stand_in");
    d.click("osim/stand_in/flexor_r");
    d.click("osim/axes");
    REQUIRE(d.has("osim/axes/2"));
    d.key(key_escape);
    d.frame(2);
    CHECK_FALSE(d.has("osim/axes/2"));
    REQUIRE(d.has("osim/open"));
    REQUIRE(choice(d).rows().size() == 1);
    for (const char* refusal : {"unsaved/cancel", "Esc"}) {
        INFO(refusal);
        d.click("osim/open");
        d.frame(2);
        REQUIRE(d.has("unsaved/cancel"));
        if (refusal == std::string("Esc"))
            d.key(key_escape);
        else
            d.click(refusal);
        d.frame(2);
        CHECK_FALSE(d.has("unsaved/cancel"));
        open_dialog(d);
        CHECK(choice(d).rows().size() == 1);
        CHECK(choice(d).preview());
    }
    d.key(key_escape);
    d.frame(2);
    CHECK(choice(d).rows().empty());
    CHECK(d.document().scene().model_motion == nullptr);
}

TEST_CASE("A dialog that is opened again while a scene loads keeps what is chosen in it",
          "[editor][ui][osim]") {
    const OsimFiles files;
    Driver d;
    open_dialog(d);
    choose(d, files.path("arm.osim"));
    choose(d, files.path("trial.mot"));
    d.click("osim/stand_in");
    d.click("osim/stand_in/flexor_r");
    std::string why;
    const SceneRequest earlier = choice(d).finished(why);
    REQUIRE(why.empty());
    EditorContext context = d.editor().context();
    context.features.opener.open(earlier);
    wait_for(d, [&] { return d.document().scene().model_motion != nullptr; });
    CHECK(d.has("osim/open"));
    CHECK(choice(d).model() == files.path("arm.osim"));
    CHECK(choice(d).rows().size() == 1);
    d.click("osim/cancel");
    CHECK(choice(d).model().empty());
}

TEST_CASE("A model that cannot be read is told in the dialog", "[editor][ui][osim]") {
    const OsimFiles files;
    write_file(files.path("broken.osim"), "<OpenSimDocument Version=\"40000\"><Model>");
    Driver d;
    open_dialog(d);
    choose(d, files.path("broken.osim"));
    CHECK_FALSE(choice(d).preview());
    CHECK(choice(d).problem().find("broken.osim") != std::string::npos);
    std::string why;
    choice(d).finished(why);
    CHECK_FALSE(why.empty());
}
