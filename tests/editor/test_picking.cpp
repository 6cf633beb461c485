#include "editor/driver.hpp"
#include "editor/picking.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;

TEST_CASE("Picking finds the nearest visible body at the frame shown", "[editor][picking]") {
    const RecordingPtr recording = test::small_recording(31);
    const view::ViewSubject rest = view::subject_of(*recording, 0);
    const view::Ray along{Vec3(-100, 10, 20), Vec3::UnitX()};
    view::ViewOptions options;
    std::optional<Hit> hit = pick(rest, options, along);
    REQUIRE(hit);
    CHECK(hit->bone == 0);
    CHECK(hit->distance == Approx(100));
    CHECK(hit->point.x() == Approx(0).margin(1e-9));
    options.hidden_bones = {true, false};
    hit = pick(rest, options, along);
    REQUIRE(hit);
    CHECK(hit->muscle == 0);
    CHECK(hit->point.x() == Approx(25).margin(0.5));
    options.hidden_muscles = {true};
    hit = pick(rest, options, along);
    REQUIRE(hit);
    CHECK(hit->bone == 1);
    CHECK(hit->point.x() == Approx(60));
    options.hidden_bones = {true, true};
    CHECK_FALSE(pick(rest, options, along));

    // At frame 30 the second bone has turned by 1 rad about x through (., 10, 20): its corner is not where it was.
    options.hidden_bones = {true, false};
    const Vec3 corner = recording->scene().timeline.bone_pose(1, 30).apply(Vec3(70, 19, 39));
    const view::Ray down{corner + Vec3(0, 0, 100), -Vec3::UnitZ()};
    REQUIRE(pick(view::subject_of(*recording, 30), options, down));
    const view::Ray at_rest{Vec3(70, 0.5, 100), -Vec3::UnitZ()};
    CHECK(pick(rest, options, at_rest));
}
