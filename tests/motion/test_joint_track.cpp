#include "fascicle/motion/joint_track.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

constexpr double pi = std::numbers::pi;
const Vec3 centre(1, 2, 3);

double difference(const Pose& a, const Pose& b) {
    return (a.rotation - b.rotation).norm() + (a.translation - b.translation).norm();
}

JointKey flexion(double frame, double angle) {
    return {frame, {{centre, Vec3::UnitX(), angle}}};
}

JointKey both(double frame, double flexion, double abduction) {
    return {frame, {{centre, Vec3::UnitX(), flexion}, {centre, Vec3::UnitY(), abduction}}};
}

BoneTrack at_rest() {
    return {{{0, Pose{}}}};
}

} // namespace

TEST_CASE("joint turns: the first is applied first", "[motion][joint_track]") {
    const Vec3 p(4, -1, 2);
    const Pose pose = pose_of(both(0, 0.3, -0.8).turns);
    const Vec3 flexed = rotation_about(centre, Vec3::UnitX(), 0.3).apply(p);
    CHECK((pose.apply(p) - rotation_about(centre, Vec3::UnitY(), -0.8).apply(flexed)).norm() < 1e-12);
    CHECK((pose.apply(centre) - centre).norm() < 1e-12);
    CHECK(pose_of({}).is_identity());
    CHECK(pose_of(both(0, 0, 0).turns).is_identity());
}

TEST_CASE("joint keys about one axis go through any number of turns", "[motion][joint_track]") {
    const double angle = GENERATE(0.2, -pi, 5.0, -6.0 * pi);
    BoneTrack track = at_rest();
    REQUIRE(append_joint_key(track, {0, {}}, flexion(100, angle)) == KeyStep::good);
    for (const double frame : {0.0, 3.5, 50.0, 77.0, 100.0})
        CHECK(difference(track.sample(frame), rotation_about(centre, Vec3::UnitX(), angle * frame / 100)) <
              1e-9);
    REQUIRE(append_joint_key(track, flexion(100, angle), flexion(200, 0)) == KeyStep::good);
    CHECK(track.keys.back().pose.is_identity());
    CHECK(difference(track.sample(150), rotation_about(centre, Vec3::UnitX(), angle / 2)) < 1e-9);
}

TEST_CASE("joint keys about two axes: the angles are met at the keys, and in between where the step is cut",
          "[motion][joint_track]") {
    BoneTrack track = at_rest();
    REQUIRE(append_joint_key(track, {0, {}}, both(10, 0.4, 0.6)) == KeyStep::good);
    CHECK(track.keys.size() == 2); // a single screw
    REQUIRE(append_joint_key(track, both(10, 0.4, 0.6), both(30, 0.4 - pi, 0.6 + pi)) == KeyStep::good);
    CHECK(track.keys.size() == 6);
    CHECK(difference(track.sample(10), pose_of(both(0, 0.4, 0.6).turns)) == 0);
    CHECK(difference(track.sample(20), pose_of(both(0, 0.4 - pi / 2, 0.6 + pi / 2).turns)) < 1e-12);
    CHECK(difference(track.sample(30), pose_of(both(0, 0.4 - pi, 0.6 + pi).turns)) == 0);
    // One turn fewer: that angle is 0.
    REQUIRE(append_joint_key(track, both(30, 0.4 - pi, 0.6 + pi), flexion(50, 0.4 - pi)) == KeyStep::good);
    CHECK(difference(track.sample(40), pose_of(both(0, 0.4 - pi, 0.3 + pi / 2).turns)) < 1e-12);
}

TEST_CASE("joint keys: what cannot be told is refused and leaves the track as it is",
          "[motion][joint_track]") {
    BoneTrack track = at_rest();
    CHECK(append_joint_key(track, {0, {}}, flexion(1, 1.01 * pi)) == KeyStep::too_fast);
    CHECK(append_joint_key(track, {0, {}}, both(1, 0.6 * pi, -0.5 * pi)) == KeyStep::too_fast);
    CHECK(track.keys.size() == 1);
    REQUIRE(append_joint_key(track, {0, {}}, flexion(10, 1)) == KeyStep::good);
    JointKey other{20, {{centre, Vec3::UnitZ(), 1}}};
    CHECK(append_joint_key(track, flexion(10, 1), other) == KeyStep::good); // another axis: one screw
    CHECK(track.keys.size() == 3);
    CHECK_FALSE(same_axes(flexion(0, 1), other));
    JointKey far{30, {{centre, Vec3::UnitX(), 4}}};
    CHECK(append_joint_key(track, other, far) == KeyStep::ambiguous);
    CHECK(track.keys.size() == 3);
}

TEST_CASE("steps between poses must be below half a turn", "[motion][joint_track]") {
    const auto key = [](double frame, double angle) {
        return PoseKey{frame, rotation_about(centre, Vec3(1, 1, 0), angle)};
    };
    CHECK(check_step(key(0, 0), key(5, 3.1)) == KeyStep::good);
    CHECK(check_step(key(0, 0), key(5, pi)) == KeyStep::ambiguous);
    CHECK(check_step(key(0, -2), key(0.5, -0.2)) == KeyStep::too_fast);
}
