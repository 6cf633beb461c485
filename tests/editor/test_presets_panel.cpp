#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "editor/param_effect.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/io/files.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

const ParamSet& parameters(Driver& d) {
    return d.document().scene().parameters;
}

std::size_t steps(Driver& d) {
    return d.document().history().steps().size();
}

} // namespace

TEST_CASE("A preset from the list is one undo step, and shows as the one in force", "[editor][ui][presets]") {
    Driver d;
    d.frame(3);
    d.click("parameters/presets");
    d.click("parameters/presets/stiff");
    CHECK(parameters(d).get("solver.stiffness") == 0.99);
    CHECK(parameters(d).get("solver.bending") == 0.8);
    CHECK(steps(d) == 2);
    CHECK(d.document().history().undo_name() == "Preset Stiff");
    d.click("parameters/presets");
    d.click("parameters/presets/paper");
    CHECK(parameters(d).get_choice("solver.method") == "classic");
    CHECK(parameters(d).get("solver.stiffness") == 1);
    d.key(key_z, {.ctrl = true});
    d.key(key_z, {.ctrl = true});
    CHECK(parameters(d) == default_parameters());
}

TEST_CASE("Own presets are kept, applied and deleted", "[editor][ui][presets]") {
    const test::TempDir folder;
    Driver d(test::small_scene(), 1280, 1500, 1, true, folder.path()); // all rows in sight
    d.frame(3);
    actions::set_parameter(d.document(), "solver.damping", 42);
    d.frame(2);
    d.click("parameters/keep");
    d.type("My Muscle");
    d.click("parameters/keep/ok");
    const auto file = folder.path() / "presets" / "my-muscle.json";
    REQUIRE(std::filesystem::exists(file));
    CHECK(read_preset(file).label == "My Muscle");

    d.click("parameters/reset_all");
    CHECK(parameters(d).get("solver.damping") != 42);
    d.click("parameters/presets");
    d.click("parameters/presets/my-muscle");
    CHECK(parameters(d).get("solver.damping") == 42);

    d.click("parameters/presets");
    d.click("parameters/presets/my-muscle/delete");
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK_FALSE(d.has("parameters/presets/my-muscle"));
}

TEST_CASE("A preset cannot take a name of the program's or none, nor be kept without a folder",
          "[editor][ui][presets]") {
    const test::TempDir folder;
    Driver d(test::small_scene(), 1280, 800, 1, true, folder.path());
    d.frame(3);
    d.click("parameters/keep");
    d.click("parameters/keep/ok"); // no name yet
    CHECK(d.has("parameters/keep/name"));
    d.click("parameters/keep/name");
    d.type("Paper");
    d.click("parameters/keep/ok");
    CHECK(d.has("parameters/keep/name")); // still open
    CHECK_FALSE(std::filesystem::exists(folder.path() / "presets"));

    Driver none;
    none.frame(3);
    none.click("parameters/keep");
    CHECK_FALSE(none.has("parameters/keep/name"));
}

TEST_CASE("A bad preset file is told in the messages and leaves the others", "[editor][ui][presets]") {
    const test::TempDir folder;
    write_file(folder.path() / "presets" / "bad.json",
               "{\"format\": \"fascicle preset\", \"values\": {\"solver.nope\": 1}}");
    write_file(folder.path() / "presets" / "good.json",
               "{\"format\": \"fascicle preset\", \"values\": {\"solver.pressure\": 1.1}}");
    Driver d(test::small_scene(), 1280, 800, 1, true, folder.path());
    d.frame(3);
    d.click("parameters/presets");
    CHECK(d.has("parameters/presets/good"));
    CHECK_FALSE(d.has("parameters/presets/bad"));
    bool told = false;
    for (const auto& message : d.editor().log().messages())
        told |= message.text.find("solver.nope") != std::string::npos;
    CHECK(told);
}

TEST_CASE("Search, only changed and folding decide which parameters are shown", "[editor][ui][parameters]") {
    Driver d;
    d.frame(3);
    d.click("parameters/search");
    d.type("coulomb friction"); // of the meaning and the label
    CHECK(d.has("parameter/contact.friction"));
    CHECK_FALSE(d.has("parameter/solver.stiffness"));
    d.type(" zzz");
    CHECK_FALSE(d.has("parameter/contact.friction"));
    d.click("parameters/show_all");
    CHECK(d.has("parameter/solver.stiffness"));

    d.click("parameters/only_changed");
    CHECK_FALSE(d.has("parameter/solver.stiffness"));
    actions::set_parameter(d.document(), "solver.stiffness", 0.5);
    d.frame(2);
    CHECK(d.has("parameter/solver.stiffness"));
    CHECK_FALSE(d.has("parameter/solver.bending"));
    d.click("parameters/only_changed");

    d.click("parameters/group/Solver");
    CHECK_FALSE(d.has("parameter/solver.stiffness"));
    CHECK(d.has("parameter/contact.friction"));
    d.click("parameters/group/Solver");
    CHECK(d.has("parameter/solver.stiffness"));
}

TEST_CASE("Rows without effect say why, by method, volume and fibres", "[editor][parameters]") {
    Scene scene = test::small_scene();
    const auto reason = [&](const char* key) {
        return no_effect_reason(scene, *parameter_table().find(key));
    };
    CHECK(reason("classic.equations") == "only the method classic uses it");
    CHECK(reason("solver.tone").empty());
    CHECK(reason("contact.friction").empty());
    CHECK(reason("solver.pressure").empty());
    CHECK(reason("fibres.count") == "no fibres are made");
    scene.parameters.set_text("solver.volume", "free");
    CHECK(reason("solver.pressure") == "the volume is free");
    scene.parameters.set_text("fibres.method", "streamlines");
    CHECK(reason("fibres.count").empty());
    CHECK_FALSE(reason("fibres.template").empty());
    set_method(scene.parameters, "classic");
    CHECK(reason("classic.equations").empty());
    CHECK_FALSE(reason("solver.frame_time").empty());
    CHECK_FALSE(reason("solver.tone").empty());
    CHECK_FALSE(reason("contact.grid_mm").empty());
    for (const ParamRow& row : parameter_table().rows()) {
        INFO(row.key);
        CHECK_FALSE(row.meaning.empty());
        CHECK_FALSE(row.source.empty());
        CHECK_FALSE(row.unit.empty());
    }
}
