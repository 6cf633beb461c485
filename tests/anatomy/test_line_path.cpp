#include "fascicle/anatomy/line_path.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

constexpr double pi = std::numbers::pi;

/// Ground and an arm that turns about z through the origin.
LineModel hinge() {
    LineModel model;
    Coordinate angle;
    angle.name = "angle";
    model.skeleton.coordinates.push_back(angle);
    model.skeleton.bodies.push_back({"arm", 0, Vec3::Zero(), {}});
    Joint joint;
    joint.child = 1;
    joint.rotations = {{Vec3::UnitZ(), {{{0, 1.0}}, JointFunction::linear(1, 0)}}};
    model.skeleton.joints.push_back(joint);
    arrange_skeleton(model.skeleton, "test");
    return model;
}

PathPoint fixed(int body, const Vec3& at) {
    PathPoint point;
    point.body = body;
    point.location = at;
    return point;
}

void add_wrap(LineModel& model, WrapShape shape, int body, const Pose& pose, double radius, const Vec3& radii,
              int side_axis = 0, int side_sign = 0) {
    WrapObject object;
    object.name = "wrap" + std::to_string(model.wrap_objects.size());
    object.body = body;
    object.pose = pose;
    object.surface = {shape, radius, 1.0, radii, side_axis, side_sign};
    model.wrap_objects.push_back(object);
    LineMuscle& muscle = model.muscles[0];
    muscle.wraps.push_back(
        {static_cast<int>(model.wrap_objects.size()) - 1, 0, static_cast<int>(muscle.points.size()) - 1});
}

Posture at(const LineModel& model, double angle) {
    Posture posture;
    std::vector<double> q(model.skeleton.coordinates.size(), 0.0);
    q[0] = angle;
    set_posture(model.skeleton, q, posture);
    return posture;
}

/// Exact arms against differences over a range of angles. Returns how often the path wrapped.
int check_arms(const LineModel& model, double from, double to, double tolerance_m) {
    LinePathSolver solver(model);
    int wrapped = 0;
    for (double a = from; a <= to; a += 0.0371) {
        const Posture posture = at(model, a);
        const double by_difference = solver.moment_arm_by_difference(0, 0, posture);
        const LinePath& path = solver.solve(0, posture);
        wrapped += path.nodes.size() > model.muscles[0].points.size() ? 1 : 0;
        INFO("angle " << a);
        CHECK(solver.moment_arm(0, posture) == Approx(by_difference).margin(tolerance_m));
    }
    return wrapped;
}

} // namespace

TEST_CASE("line path: a straight muscle over a hinge has the arm of its line", "[anatomy][line]") {
    LineModel model = hinge();
    model.muscles.push_back(
        {"m", "Muscle", {fixed(0, Vec3(0.2, 0.05, 0)), fixed(1, Vec3(-0.1, 0.02, 0))}, {}});
    LinePathSolver solver(model);
    const Posture posture = at(model, 0);
    CHECK(solver.solve(0, posture).length == Approx(std::hypot(0.3, 0.03)));
    // Force along the line on the arm, distance of the line to the axis; pulling up on the left side turns clockwise.
    const Vec3 pull = Vec3(0.3, 0.03, 0).normalized();
    const double arm = Vec3(-0.1, 0.02, 0).cross(pull).z();
    CHECK(solver.moment_arm(0, posture) == Approx(arm));
    CHECK(arm < 0);
    check_arms(model, -2, 2, 1e-8);
}

TEST_CASE("line path: conditional points come and go by their range, and stay for a difference",
          "[anatomy][line]") {
    LineModel model = hinge();
    PathPoint via = fixed(0, Vec3(0.05, 0.1, 0));
    via.kind = PathPointKind::conditional;
    via.coordinate = 0;
    via.range_min = -1;
    via.range_max = 0.5;
    model.muscles.push_back(
        {"m", "Muscle", {fixed(0, Vec3(0.2, 0, 0)), via, fixed(1, Vec3(-0.1, 0.05, 0))}, {}});
    LinePathSolver solver(model);
    const auto nodes = [&](double a) { return solver.solve(0, at(model, a)).nodes.size(); };
    CHECK(nodes(0.5) == 3);
    CHECK(nodes(0.5 + 0.9e-5) == 3); // both ends count, and a little more
    CHECK(nodes(0.5 + 1.1e-5) == 2);
    CHECK(nodes(-1) == 3);
    CHECK(nodes(-1.1) == 2);
    const Posture edge = at(model, 0.5);
    const double by_difference = solver.moment_arm_by_difference(0, 0, edge);
    solver.solve(0, edge);
    CHECK(solver.moment_arm(0, edge) == Approx(by_difference).margin(1e-8));
}

TEST_CASE("line path: a moving point's own motion counts", "[anatomy][line]") {
    LineModel model = hinge();
    PathPoint moving = fixed(1, Vec3::Zero());
    moving.kind = PathPointKind::moving;
    moving.frame = {rotation_xyz(Vec3(0.2, 0.3, 0.4)), Vec3(0.01, 0.02, 0.03)};
    moving.moves[0] = {{{0, 1.0}},
                       JointFunction::simm_spline({-2, -1, 0, 1, 2}, {0.1, 0.12, 0.11, 0.15, 0.1})};
    moving.moves[1] = {{{0, 1.0}}, JointFunction::linear(0.02, 0.1)};
    moving.moves[2] = {{}, JointFunction::constant(0.01)};
    model.muscles.push_back(
        {"m", "Muscle", {fixed(0, Vec3(0.2, 0.3, 0)), moving, fixed(1, Vec3(-0.1, 0.05, 0.1))}, {}});
    LinePathSolver solver(model);
    const Posture zero = at(model, 0);
    CHECK((solver.solve(0, zero).nodes[1].position - moving.frame.apply(Vec3(0.11, 0.1, 0.01))).norm() <
          1e-15);
    check_arms(model, -1.9, 1.9, 1e-7);
}

TEST_CASE("line path: over a pulley on the axis the arm is its radius", "[anatomy][line]") {
    LineModel model = hinge();
    model.muscles.push_back(
        {"m", "Muscle", {fixed(0, Vec3(0.3, 0, -0.01)), fixed(1, Vec3(-0.3, 0, 0.02))}, {}});
    add_wrap(model, WrapShape::cylinder, 0, {}, 0.04, Vec3::Zero(), 1, 1);
    LinePathSolver solver(model);
    for (const double a : {-0.2, 0.0, 0.4, 1.0, 2.0}) {
        const Posture posture = at(model, a);
        const LinePath& path = solver.solve(0, posture);
        REQUIRE(path.nodes.size() == 4);
        const double flat = 2 * std::sqrt(0.09 - 0.0016) + 0.04 * (pi + a - 2 * std::acos(0.04 / 0.3));
        CHECK(path.length == Approx(std::hypot(flat, 0.03)));
        CHECK(solver.moment_arm(0, posture) == Approx(-0.04 * flat / path.length));
    }
    CHECK(check_arms(model, -0.2, 2, 1e-7) > 55);
}

TEST_CASE("line path: exact arms over every kind of surface", "[anatomy][line]") {
    const Pose tilted{rotation_xyz(Vec3(0.4, -0.3, 0.5)), Vec3(0.005, 0.01, -0.01)};
    for (const WrapShape shape : {WrapShape::sphere, WrapShape::cylinder, WrapShape::ellipsoid})
        for (const int body : {0, 1}) {
            LineModel model = hinge();
            model.muscles.push_back(
                {"m", "Muscle", {fixed(0, Vec3(0.3, 0.01, 0)), fixed(1, Vec3(-0.25, 0.02, 0.03))}, {}});
            add_wrap(model, shape, body, tilted, 0.05, Vec3(0.07, 0.04, 0.05));
            INFO(static_cast<int>(shape) << ' ' << body);
            CHECK(check_arms(model, -0.6, 0.6, 1e-6) > 15);
        }
}

TEST_CASE("line path: two surfaces share a path until it settles", "[anatomy][line]") {
    LineModel model = hinge();
    model.muscles.push_back({"m", "Muscle", {fixed(0, Vec3(0.4, 0, 0)), fixed(1, Vec3(-0.4, 0, 0.01))}, {}});
    add_wrap(model, WrapShape::sphere, 0, {Mat3::Identity(), Vec3(0.15, -0.02, 0.005)}, 0.05, Vec3::Zero());
    add_wrap(model, WrapShape::ellipsoid, 1, {Mat3::Identity(), Vec3(-0.15, -0.02, 0)}, 0,
             Vec3(0.06, 0.05, 0.04));
    LinePathSolver solver(model);
    const Posture posture = at(model, 0.3);
    const LinePath path = solver.solve(0, posture);
    CHECK(path.nodes.size() == 6);
    CHECK(check_arms(model, -0.2, 0.5, 2e-6) > 15);
    // Drawn, it runs over the same points and is as long, less what chords leave out.
    solver.solve(0, posture);
    Points polyline;
    solver.draw(posture, polyline);
    double length = 0;
    for (std::size_t i = 0; i + 1 < polyline.size(); ++i)
        length += (polyline[i + 1] - polyline[i]).norm();
    CHECK(polyline.size() > 10);
    CHECK(length <= path.length + 1e-9);
    CHECK(length > 0.999 * path.length);
}

TEST_CASE("line path: ranges, objects that are off, and a second muscle of the same solver",
          "[anatomy][line]") {
    LineModel model = hinge();
    model.muscles.push_back(
        {"m",
         "Muscle",
         {fixed(0, Vec3(0.3, 0, 0)), fixed(0, Vec3(0.2, 0, 0)), fixed(1, Vec3(-0.3, 0.001, 0))},
         {}});
    add_wrap(model, WrapShape::sphere, 0, {}, 0.05, Vec3::Zero());
    LinePathSolver solver(model);
    const Posture posture = at(model, 0);
    const double wrapped = solver.solve(0, posture).length;
    CHECK(solver.solve(0, posture).nodes.size() == 5);
    model.muscles[0].wraps[0].last = 1; // not between the points that it lies between
    CHECK(solver.solve(0, posture).nodes.size() == 3);
    model.muscles[0].wraps[0].last = 2;
    model.wrap_objects[0].active = false;
    CHECK(solver.solve(0, posture).nodes.size() == 3);
    CHECK(solver.solve(0, posture).length < wrapped);
    CHECK(model.muscle_index("m") == 0);
    CHECK(model.muscle_index("n") == -1);
}

TEST_CASE("line path: coupled coordinates take part in the arm", "[anatomy][line]") {
    LineModel model = hinge();
    Coordinate second;
    second.name = "second";
    model.skeleton.coordinates.push_back(second);
    model.skeleton.bodies.push_back({"hand", 0, Vec3::Zero(), {}});
    Joint joint;
    joint.parent = 1;
    joint.child = 2;
    joint.parent_frame.translation = Vec3(-0.2, 0, 0);
    joint.rotations = {{Vec3::UnitZ(), {{{1, 1.0}}, JointFunction::linear(1, 0)}}};
    model.skeleton.joints.push_back(joint);
    model.skeleton.couplers.push_back({1, {{{0, 1.0}}, JointFunction::polynomial({0.5, 1, 0})}});
    arrange_skeleton(model.skeleton, "test");
    model.muscles.push_back(
        {"m", "Muscle", {fixed(0, Vec3(0.3, 0.1, 0)), fixed(2, Vec3(-0.1, 0.03, 0))}, {}});
    check_arms(model, -1, 1, 1e-8);
}
