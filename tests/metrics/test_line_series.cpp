#include "fascicle/metrics/line_series.hpp"
#include "fascicle/metrics/line_tracker.hpp"
#include "support/line_model.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::test;

namespace {

Scene with_lines(Scene scene, bool via = false) {
    std::vector<std::string> notes;
    scene.line_muscles = std::make_shared<const LineMuscles>(
        place_line_muscles(std::make_shared<const LineModel>(arm_model(via)), scene, "arm", notes));
    return scene;
}

/// Two points at distances a and b from the axis, the directions to them `between` apart.
double law_of_cosines(double a, double b, double between) {
    return std::sqrt(a * a + b * b - 2 * a * b * std::cos(between));
}

constexpr double pi = 3.14159265358979323846;

} // namespace

TEST_CASE("line series: length and moment arm of two points in closed form", "[metrics][lines]") {
    for (const double turn : {0.8, -0.8})
        for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::metre}) {
            const LineSeries series = line_series(with_lines(arm_scene(turn, unit)));
            CHECK(series.exact_arms);
            CHECK(series.muscles == std::vector<std::string>{"flexor_r"});
            REQUIRE(series.frames.size() == 21);
            for (std::size_t k = 0; k < series.frames.size(); ++k) {
                const double between =
                    pi / 2 + series.angles_rad[k]; // the arm's point is at 90 degrees at rest
                const double length = law_of_cosines(200, 50, between);
                const double sign = turn > 0 ? 1 : -1;
                CHECK(series.length_mm(k, 0) == Approx(length).epsilon(1e-12));
                CHECK(series.moment_arm_mm(k, 0) ==
                      Approx(-sign * 200 * 50 * std::sin(between) / length).epsilon(1e-12));
            }
            CHECK(series.angles_rad[10] == Approx(turn));
            CHECK((series.moment_arm_mm(5, 0) < 0) == (turn > 0)); // it lengthens while the arm goes away
        }
}

TEST_CASE("line series: conditional points come and go with the joint of the scene", "[metrics][lines]") {
    const Scene scene = with_lines(arm_scene(0.8), true);
    const LineSeries series = line_series(scene);
    int straight = 0;
    for (std::size_t k = 0; k < series.frames.size(); ++k) {
        const double angle = series.angles_rad[k];
        const double direct = law_of_cosines(200, 50, pi / 2 + angle);
        const double over = 100 * std::sqrt(2.0) + law_of_cosines(100 * std::sqrt(2.0), 50, pi / 4 + angle);
        CHECK(series.length_mm(k, 0) == Approx(angle <= 0.3 + 1e-5 ? over : direct).epsilon(1e-12));
        straight += angle > 0.3 + 1e-5 ? 1 : 0;
    }
    CHECK(straight > 5);
    CHECK(straight < 15);

    // Where the coordinate can't be told they stay as at rest.
    Scene unknown = scene;
    unknown.timeline.hinge.reset();
    const LineSeries held = line_series(unknown);
    const double angle = held.angles_rad[10];
    CHECK(held.length_mm(10, 0) ==
          Approx(100 * std::sqrt(2.0) + law_of_cosines(100 * std::sqrt(2.0), 50, pi / 4 + angle))
              .epsilon(1e-12));
}

TEST_CASE("line series: a bone that does not turn about the hinge gets arms by excursion",
          "[metrics][lines]") {
    Scene scene = with_lines(arm_scene(0.8));
    const LineSeries exact = line_series(scene);
    scene.timeline.hinge->centre = Vec3(0, 0.01, 0); // not where the track turns
    CHECK_FALSE(LineTracker(scene).exact());
    const LineSeries fitted = line_series(scene);
    CHECK_FALSE(fitted.exact_arms);
    for (std::size_t k = 0; k < exact.frames.size(); ++k) {
        CHECK(fitted.length_mm(k, 0) == exact.length_mm(k, 0));
        CHECK(fitted.moment_arm_mm(k, 0) == Approx(exact.moment_arm_mm(k, 0)).margin(0.5));
    }
    // No angle, no arm.
    Scene shifted = with_lines(arm_scene(0.8));
    shifted.timeline = make_shift_timeline(Vec3(10, 0, 0), {4, 0, 0}, 2, 1);
    const LineSeries shift = line_series(shifted);
    for (std::size_t k = 0; k < shift.frames.size(); ++k) {
        const double x = 10 * static_cast<double>(k) / 4;
        CHECK(shift.length_mm(k, 0) == Approx(std::hypot(200 - x, 50)));
        CHECK(std::isnan(shift.moment_arm_mm(k, 0)));
    }
}

TEST_CASE("line series: of a recording it is that of the same frames as planned", "[metrics][lines]") {
    const auto scene = std::make_shared<const Scene>(with_lines(arm_scene(0.8)));
    Recording recording(scene);
    for (int k = 0; k < 4; ++k) {
        Frame frame;
        frame.index = k;
        frame.angle_rad = scene->timeline.angle_rad(k);
        frame.bone_poses = {scene->timeline.bone_pose(0, k), scene->timeline.bone_pose(1, k)};
        recording.append(std::make_shared<const Frame>(frame));
    }
    const LineSeries planned = line_series(*scene), run = line_series(recording);
    REQUIRE(run.frames == std::vector<int>{0, 1, 2, 3});
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(run.length_mm(k, 0) == planned.length_mm(k, 0));
        CHECK(run.moment_arm_mm(k, 0) == planned.moment_arm_mm(k, 0));
    }
    Scene plain = *scene;
    plain.line_muscles = nullptr;
    CHECK(line_series(plain).frames.empty());
}

TEST_CASE("line tracker: the polyline is in scene units and goes with the bones", "[metrics][lines]") {
    const Scene scene = with_lines(arm_scene(0.8));
    LineTracker tracker(scene);
    CHECK(tracker.muscle_count() == 1);
    Points path = tracker.measure(0, true).polyline;
    REQUIRE(path.size() == 2);
    CHECK((path[0] - Vec3(200, 0, 0)).norm() < 1e-9);
    CHECK((path[1] - Vec3(0, 50, 0)).norm() < 1e-9);
    const std::vector<Pose> poses{Pose{Mat3::Identity(), Vec3(1, 2, 3)}, scene.timeline.bone_pose(1, 10)};
    tracker.set_frame(poses, 0.8);
    path = tracker.measure(0, true).polyline;
    CHECK((path[0] - Vec3(201, 2, 3)).norm() < 1e-9);
    CHECK((path[1] - 50 * Vec3(-std::sin(0.8), std::cos(0.8), 0)).norm() < 1e-9);
    CHECK(tracker.measure(0).polyline.empty());
}
