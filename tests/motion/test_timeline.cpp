#include "fascicle/base/error.hpp"
#include "fascicle/motion/timeline.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

const Hinge hinge{Vec3(1, 2, 3), Vec3(2, 0, 0)};

double difference(const Pose& a, const Pose& b) {
    return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
}

} // namespace

TEST_CASE("hinge timeline: linear out, linear back, then exactly rest", "[motion][timeline]") {
    const double angle = GENERATE(-1.0, 0.5, 2.0 * std::numbers::pi, -7.0);
    const Timeline timeline = make_hinge_timeline(hinge, angle, {100, 50, 30}, 3, {1});
    CHECK(timeline.last_frame == 180);
    for (const double frame : {0.0, 12.5, 37.0, 100.0, 110.0, 140.0, 150.0, 170.0, 180.0}) {
        const double share = frame <= 100 ? frame / 100 : frame <= 150 ? (150 - frame) / 50 : 0;
        CHECK(timeline.angle_rad(frame) == Approx(share * angle).margin(1e-12));
        CHECK(difference(timeline.bone_pose(1, frame),
                         rotation_about(hinge.centre, hinge.axis, share * angle)) < 1e-9);
        CHECK(timeline.bone_pose(0, frame).is_identity());
        CHECK(timeline.bone_pose(7, frame).is_identity());
    }
    CHECK(timeline.bone_pose(1, 0).is_identity());
    CHECK(timeline.bone_pose(1, 160).is_identity());
    CHECK(timeline.bone_tracks[1].moves());
    CHECK_FALSE(timeline.bone_tracks[0].moves());
}

TEST_CASE("hinge timeline: phases may be missing, but not all", "[motion][timeline]") {
    CHECK(make_hinge_timeline(hinge, 1, {10, 0, 0}, 1, {0}).angle_rad(10) == Approx(1));
    CHECK(make_hinge_timeline(hinge, 1, {10, 0, 5}, 1, {0}).angle_rad(15) == Approx(1));
    CHECK(make_hinge_timeline(hinge, 1, {0, 0, 5}, 1, {0}).angle_rad(5) == 0);
    CHECK(make_hinge_timeline(hinge, 1, {0, 5, 5}, 1, {0}).angle_rad(3) == 0);
    CHECK_THROWS_AS(make_hinge_timeline(hinge, 1, {0, 0, 0}, 1, {0}), Error);
    CHECK_THROWS_AS(make_hinge_timeline(hinge, 1, {-1, 5, 0}, 1, {0}), Error);
}

TEST_CASE("shift timeline: 0.9 a frame for 100 frames and back", "[motion][timeline]") {
    const Timeline timeline = make_shift_timeline(Vec3(0, -90, 0), {100, 100, 100}, 2, 1);
    CHECK(timeline.bone_pose(1, 10).translation.y() == Approx(-9));
    CHECK(timeline.bone_pose(1, 100).translation.y() == -90);
    CHECK(timeline.bone_pose(1, 190).translation.y() == Approx(-9));
    CHECK(timeline.bone_pose(1, 250).is_identity());
    CHECK(timeline.angle_rad(50) == 0);
}
