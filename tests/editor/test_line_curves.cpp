// Line muscles in the editor: their curves, and that they follow their bones.

#include "editor/driver.hpp"
#include "fascicle/document/actions/scene_actions.hpp"
#include "fascicle/metrics/line_series.hpp"
#include "support/line_model.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;

namespace {

/// The arm with its line muscle, and a ball as a muscle.
Scene arm_with_lines() {
    Scene scene = arm_scene(0.8);
    std::vector<std::string> notes;
    scene.line_muscles = std::make_shared<const LineMuscles>(
        place_line_muscles(std::make_shared<const LineModel>(arm_model()), scene, "arm", notes));
    Muscle muscle;
    muscle.name = "muscle";
    muscle.mesh = std::make_shared<const TriMesh>(sphere(15, 2, Vec3(100, 25, 0)));
    muscle.attachments = {{AttachmentKind::origin, 0, {0, 1, 2}}, {AttachmentKind::insertion, 1, {3, 4, 5}}};
    scene.muscles.push_back(std::move(muscle));
    return scene;
}

} // namespace

TEST_CASE("Plots of length and moment arm are there for line muscles, with one legend entry",
          "[editor][lines]") {
    for (const float width : {2200.0f, 700.0f}) {
        Driver d(arm_with_lines(), width, 1200);
        d.frame(3);
        CHECK(d.has("plot/fibre_length"));
        CHECK(d.has("plot/moment_arm"));
        CHECK_FALSE(d.has("plot/moment_arm/legend/flexor_r"));
        CHECK_FALSE(d.has("plot/volume_ratio/legend/line muscles"));
    }
    Driver d(arm_with_lines(), 2200, 1200);
    d.frame(3);
    d.click("plot/moment_arm/legend/line muscles");
    CHECK(d.state().hidden_curves.count("line muscles") == 1);
    d.click("plot/moment_arm/legend/line muscles");
    CHECK(d.state().hidden_curves.empty());

    Scene without = arm_with_lines();
    without.line_muscles = nullptr;
    Driver plain(without, 2200, 1200);
    plain.frame(3);
    CHECK_FALSE(plain.has("plot/moment_arm"));
}

TEST_CASE("Line muscles go with a bone whatever it is called, and stay when it is gone",
          "[document][lines]") {
    Document document(arm_with_lines());
    const LineSeries before = line_series(document.scene());
    REQUIRE(actions::rename_bone(document, 1, "ulna"));
    CHECK(document.scene().line_muscles->bone_of_body[2] == "ulna");
    CHECK(line_series(document.scene()).lengths_mm == before.lengths_mm);
    actions::remove_bone(document, 1);
    const LineSeries after = line_series(document.scene());
    CHECK(after.length_mm(10, 0) == Approx(before.length_mm(0, 0)));
    document.undo();
    document.undo();
    CHECK(document.scene().line_muscles->bone_of_body[2] == "arm");
}
