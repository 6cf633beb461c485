#include "solver/classic/voxel_obstacle.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;
using classic::VoxelObstacle;

namespace {

/// Published: cells of 1 x 2 x 1, all 64^3 of them inside, so the obstacle is exactly [0,64) x [0,128) x [0,64).
VoxelObstacle block(bool meant = false) {
    return VoxelObstacle(box(64, 128, 64), meant);
}

bool near(const std::optional<Vec3>& answer, const Vec3& expected) {
    return answer && (*answer - expected).norm() < 1e-9;
}

Pose shift(double x, double y, double z) {
    return {Mat3::Identity(), Vec3(x, y, z)};
}

} // namespace

TEST_CASE("response A steps back from the candidate voxel by voxel to the first free cell",
          "[solver][classic][contact]") {
    const VoxelObstacle solid = block();
    // 19.5 voxels (39 units) deep on the way down: candidate at voxel 50.5, free at 64.5.
    CHECK(near(solid.respond(Vec3(32, 140, 32), Vec3(32, 101, 32)), Vec3(32, 129, 32)));
    // Steps have the length of a voxel in voxel space, along the way from p to x: here along x and y alike.
    const Vec3 x(70, 140, 32), p(60, 120, 32); // voxels (70, 70), (60, 60): 10 each way
    const double step = std::sqrt(0.5);
    CHECK(near(solid.respond(x, p), Vec3(60 + 6 * step, 2 * (60 + 6 * step), 32)));
    // Neither projection nor sliding: the sideways part of the move is undone as well.
    CHECK_FALSE(solid.respond(Vec3(32, 140, 32), Vec3(32, 130, 32)));
}

TEST_CASE("response A may put a vertex up to a voxel beyond where it was", "[solver][classic][contact]") {
    const VoxelObstacle solid = block();
    CHECK(near(solid.respond(Vec3(32, 128.4, 32), Vec3(32, 127.8, 32)), Vec3(32, 129.8, 32)));
}

TEST_CASE("only the candidate's own cell is looked at: a long move tunnels", "[solver][classic][contact]") {
    CHECK_FALSE(block().respond(Vec3(32, 140, 32), Vec3(32, -10, 32)));
}

TEST_CASE("response A in a moved and turned solid is that of the solid at rest",
          "[solver][classic][contact]") {
    const bool meant = GENERATE(false, true);
    VoxelObstacle rest = block(meant), moved = block(meant);
    Pose pose = rotation_about(Vec3(3, 2, 1), Vec3(1, -1, 2), 0.8);
    pose.translation += Vec3(100, -50, 20);
    moved.move(Pose(), pose);
    const Vec3 x(32, 140, 32), p(30, 101, 35);
    const auto expected = rest.respond(x, p);
    REQUIRE(expected);
    CHECK(near(moved.respond(pose.apply(x), pose.apply(p)), pose.apply(*expected)));
    CHECK(moved.inside(pose.apply(p)));
    CHECK_FALSE(moved.inside(pose.apply(x)));
}

TEST_CASE("response B: a vertex already inside goes with the last increment, published for ever",
          "[solver][classic][contact]") {
    VoxelObstacle solid = block();
    const Vec3 x(32, 60, 32), p(31, 61, 33);
    CHECK(near(solid.respond(x, p), x)); // a solid that never moved freezes it: p is ignored
    solid.move(Pose(), shift(0, 0.9, 0));
    CHECK(near(solid.respond(x, p), x + Vec3(0, 0.9, 0)));
    solid.end_substep(); // repeated in every substep of the frame
    CHECK(near(solid.respond(x, p), x + Vec3(0, 0.9, 0)));
    solid.move(shift(0, 0.9, 0), shift(0, 0.9, 0)); // and when the solid rests
    CHECK(near(solid.respond(x, p), x + Vec3(0, 0.9, 0)));
    Pose nudged = shift(0, 0.9, 0);
    nudged.translation[1] += 1e-13; // rounding is no motion
    solid.move(shift(0, 0.9, 0), nudged);
    CHECK(near(solid.respond(x, p), x + Vec3(0, 0.9, 0)));
    solid.move(nudged, shift(0, 0.4, 0));
    CHECK(near(solid.respond(x, p), x + Vec3(0, -0.5, 0)));
}

TEST_CASE("response B, meant: once a frame, and only while the solid moves", "[solver][classic][contact]") {
    VoxelObstacle solid = block(true);
    const Vec3 x(32, 60, 32), p(31, 61, 33);
    solid.move(Pose(), shift(0, 0.9, 0));
    CHECK(near(solid.respond(x, p), x + Vec3(0, 0.9, 0)));
    solid.end_substep();
    CHECK(near(solid.respond(x, p), x));
    solid.move(shift(0, 0.9, 0), shift(0, 0.9, 0));
    CHECK(near(solid.respond(x, p), x));
}

TEST_CASE("response B uses the world's increment in the rest frame: right for one axis, wrong for two",
          "[solver][classic][contact]") {
    const Vec3 centre(32, 64, 32), x(33, 60, 30);
    const Pose first = rotation_about(centre, Vec3::UnitX(), 0.3);
    const Pose same_axis = rotation_about(centre, Vec3::UnitX(), 0.4);
    const Pose other_axis = rotation_about(centre, Vec3::UnitZ(), 0.1).after(first);
    for (const bool one_axis : {true, false}) {
        const Pose& second = one_axis ? same_axis : other_axis;
        const Pose increment = second.after(first.inverse());
        VoxelObstacle published = block(false), meant = block(true);
        published.move(Pose(), first);
        published.move(first, second);
        meant.move(Pose(), first);
        meant.move(first, second);
        CHECK(near(meant.respond(x, x), increment.apply(x)));
        CHECK(near(published.respond(x, x), second.apply(increment.apply(second.apply_inverse(x)))));
        CHECK(near(published.respond(x, x), increment.apply(x)) == one_axis);
    }
}
