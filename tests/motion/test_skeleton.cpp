#include "fascicle/base/error.hpp"
#include "fascicle/motion/skeleton.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

constexpr double pi = std::numbers::pi;

int add_coordinate(Skeleton& s, const std::string& name) {
    Coordinate c;
    c.name = name;
    s.coordinates.push_back(c);
    return static_cast<int>(s.coordinates.size()) - 1;
}

JointAxis about(const Vec3& axis, int coordinate, double slope = 1) {
    return {axis.normalized(), {{{coordinate, 1.0}}, JointFunction::linear(slope, 0)}};
}

int add_body(Skeleton& s, const std::string& name, int parent, Joint joint) {
    s.bodies.push_back({name, 0, Vec3::Zero(), {}});
    joint.name = name + "_joint";
    joint.parent = parent;
    joint.child = static_cast<int>(s.bodies.size()) - 1;
    s.joints.push_back(joint);
    return joint.child;
}

std::vector<Pose> poses_at(const Skeleton& s, const std::vector<double>& q) {
    std::vector<Pose> poses;
    place_bodies(s, q, poses);
    return poses;
}

void check_near(const Vec3& a, const Vec3& b) {
    INFO(a.transpose() << " | " << b.transpose());
    CHECK((a - b).norm() < 1e-12);
}

/// Three bodies in a row with everything that joints have: offsets, skew axes, a spline, a coupled coordinate.
Skeleton chain(bool reversed = false) {
    Skeleton s;
    const int a = add_coordinate(s, "a"), b = add_coordinate(s, "b"), c = add_coordinate(s, "c");
    const int d = add_coordinate(s, "d");
    Joint first;
    first.parent_frame = {rotation_xyz(Vec3(0.3, -0.2, 0.9)), Vec3(1, 2, 3)};
    first.child_frame = {rotation_xyz(Vec3(-1.1, 0.4, 0.2)), Vec3(-0.2, 0.1, 0.5)};
    first.rotations = {about(Vec3(0, 0, 1), a), about(Vec3(1, 0, 0), b), about(Vec3(0.3, 1, 0.2), c)};
    first.translations = {about(Vec3(1, 0, 0), b, 0.3)};
    first.reversed = reversed;
    const int thigh = add_body(s, "thigh", 0, first);
    Joint second;
    second.parent_frame.translation = Vec3(0, -0.4, 0);
    second.rotations = {about(Vec3(0, 0, 1), d)};
    second.translations = {
        {Vec3(0, 1, 0), {{{d, 1.0}}, JointFunction::simm_spline({-2, -1, 0, 1.5}, {0.1, 0.02, 0, 0.05})}},
        {Vec3(1, 0, 0), {{{a, 0.2}, {d, -0.1}}, JointFunction::linear(1, 0.3)}}};
    add_body(s, "shank", thigh, second);
    s.couplers.push_back({c, {{{a, 1.0}}, JointFunction::polynomial({0.5, 0.1, 0})}});
    arrange_skeleton(s, "test");
    return s;
}

} // namespace

TEST_CASE("skeleton: Euler angles turn about the axes as they have been turned", "[motion][skeleton]") {
    check_near(rotation_xyz(Vec3(pi / 2, 0, 0)) * Vec3::UnitY(), Vec3::UnitZ());
    // First x, then the new y (which is z): x goes to y.
    check_near(rotation_xyz(Vec3(pi / 2, pi / 2, 0)) * Vec3::UnitX(), Vec3::UnitY());
    // Then the new z (which is x): the body's x is turned towards its y, which is ground's z ... and that was y's place.
    check_near(rotation_xyz(Vec3(pi / 2, pi / 2, pi / 2)) * Vec3::UnitX(), Vec3::UnitZ());
}

TEST_CASE("skeleton: a hinge with offsets, by hand", "[motion][skeleton]") {
    Skeleton s;
    const int q = add_coordinate(s, "knee");
    Joint joint;
    joint.parent_frame.translation = Vec3(0, -0.4, 0);
    joint.child_frame.translation = Vec3(0, 0.1, 0);
    joint.rotations = {about(Vec3::UnitZ(), q)};
    const int shank = add_body(s, "shank", 0, joint);
    CHECK(arrange_skeleton(s, "test").empty());
    const Pose pose = poses_at(s, {pi / 2})[static_cast<std::size_t>(shank)];
    // The hinge stays where it is; 0.1 below the child's hinge is 0.1 to its right after a quarter turn.
    check_near(pose.apply(Vec3(0, 0.1, 0)), Vec3(0, -0.4, 0));
    check_near(pose.apply(Vec3(0, 0, 0)), Vec3(0.1, -0.4, 0));
    // Both frames turned: a quarter about x makes the joint's z the parent's -y.
    s.joints[0].parent_frame = {rotation_xyz(Vec3(pi / 2, 0, 0)), Vec3::Zero()};
    s.joints[0].child_frame = {rotation_xyz(Vec3(pi / 2, 0, 0)), Vec3::Zero()};
    check_near(poses_at(s, {pi / 2})[1].apply(Vec3::UnitX()), Vec3(0, 0, 1));
    check_near(poses_at(s, {0})[1].apply(Vec3(1, 2, 3)), Vec3(1, 2, 3));
}

TEST_CASE("skeleton: shifts go along the parent's axes, turns follow each other", "[motion][skeleton]") {
    Skeleton s;
    const int turn = add_coordinate(s, "turn"), shift = add_coordinate(s, "shift"),
              tilt = add_coordinate(s, "tilt");
    Joint joint;
    joint.rotations = {about(Vec3::UnitZ(), turn), about(Vec3::UnitX(), tilt)};
    joint.translations = {about(Vec3::UnitX(), shift)};
    add_body(s, "body", 0, joint);
    arrange_skeleton(s, "test");
    check_near(poses_at(s, {pi / 2, 5, 0})[1].apply(Vec3(1, 0, 0)), Vec3(5, 1, 0));
    // About z, then about the new x, which is ground's y: the body's z goes to ground's x.
    check_near(poses_at(s, {pi / 2, 0, pi / 2})[1].rotation * Vec3::UnitZ(), Vec3::UnitX());
}

TEST_CASE("skeleton: a reversed joint is the inverse motion", "[motion][skeleton]") {
    const Skeleton plain = chain(), reversed = chain(true);
    std::vector<double> q{0.4, -0.3, 0.2, 0.7};
    const Pose a = poses_at(plain, q)[1], b = poses_at(reversed, q)[1];
    const Joint& joint = plain.joints[0];
    const Pose ra = joint.parent_frame.inverse().after(a).after(joint.child_frame);
    const Pose rb = joint.parent_frame.inverse().after(b).after(joint.child_frame);
    check_near(ra.after(rb).apply(Vec3(1, 2, 3)), Vec3(1, 2, 3));
}

TEST_CASE("skeleton: a joint may name its bodies the other way round", "[motion][skeleton]") {
    Skeleton s = chain();
    std::swap(s.joints[1].parent, s.joints[1].child);
    std::swap(s.joints[1].parent_frame, s.joints[1].child_frame);
    s.joints[1].reversed = true;         // twice the inverse: the same motion
    std::swap(s.joints[0], s.joints[1]); // and not in order
    CHECK(arrange_skeleton(s, "test").empty());
    const std::vector<double> q{0.4, -0.3, 0.2, 0.7};
    for (std::size_t b = 0; b < 3; ++b)
        check_near(poses_at(s, q)[b].apply(Vec3(1, 2, 3)), poses_at(chain(), q)[b].apply(Vec3(1, 2, 3)));
}

TEST_CASE("skeleton: twists are the derivative of poses", "[motion][skeleton]") {
    for (const int kind : {0, 1, 2}) {
        Skeleton s = chain(kind == 1);
        if (kind == 2) {
            std::swap(s.joints[1].parent, s.joints[1].child);
            std::swap(s.joints[1].parent_frame, s.joints[1].child_frame);
            arrange_skeleton(s, "test");
        }
        for (int coordinate = 0; coordinate < 4; ++coordinate) {
            std::vector<double> q{0.4, -0.3, 0.0, -1.2};
            apply_couplers(s, q);
            std::vector<double> rates;
            coordinate_rates(s, q, coordinate, rates);
            std::vector<Twist> twists;
            body_twists(s, q, rates, poses_at(s, q), twists);
            const double h = 1e-6;
            std::vector<double> more = q, less = q;
            for (std::size_t i = 0; i < q.size(); ++i) {
                more[i] += h * rates[i];
                less[i] -= h * rates[i];
            }
            const auto ahead = poses_at(s, more), behind = poses_at(s, less), here = poses_at(s, q);
            for (std::size_t b = 0; b < 3; ++b)
                for (const Vec3& local : {Vec3(0, 0, 0), Vec3(1, 2, -3)}) {
                    const Vec3 wanted = (ahead[b].apply(local) - behind[b].apply(local)) / (2 * h);
                    INFO(kind << ' ' << coordinate << ' ' << b);
                    CHECK((twists[b].at(here[b].apply(local)) - wanted).norm() < 1e-8);
                }
        }
    }
}

TEST_CASE("skeleton: coupled coordinates follow, in any order of the couplers", "[motion][skeleton]") {
    Skeleton s;
    const int a = add_coordinate(s, "a"), b = add_coordinate(s, "b"), c = add_coordinate(s, "c");
    s.coordinates[0].default_value = 3;
    const auto twice = [](int of) { return CoordinateFunction{{{of, 1.0}}, JointFunction::linear(2, 0)}; };
    s.couplers = {{c, twice(b)}, {b, twice(a)}};
    arrange_skeleton(s, "test");
    CHECK(s.default_values() == std::vector<double>{3, 6, 12});
    std::vector<double> rates;
    coordinate_rates(s, s.default_values(), a, rates);
    CHECK(rates == std::vector<double>{1, 2, 4});
    coordinate_rates(s, s.default_values(), b, rates); // itself dependent: what it depends on stays
    CHECK(rates == std::vector<double>{0, 1, 2});
}

TEST_CASE("skeleton: loops, circles and loose bodies are told", "[motion][skeleton]") {
    Skeleton s = chain();
    Joint extra;
    extra.name = "extra";
    extra.parent = 0;
    extra.child = 2;
    s.joints.push_back(extra);
    CHECK_THROWS_WITH(arrange_skeleton(s, "file"),
                      Catch::Contains("file") && Catch::Contains("extra") && Catch::Contains("loop"));
    s.joints.back().child = 0;
    CHECK_THROWS_WITH(arrange_skeleton(s, "file"), Catch::Contains("itself"));
    s.joints.pop_back();
    s.bodies.push_back({"loose", 0, Vec3::Zero(), {}});
    const auto notes = arrange_skeleton(s, "file");
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("loose") != std::string::npos);
    s.couplers.push_back({0, {{{2, 1.0}}, JointFunction::linear(1, 0)}}); // c depends on a
    CHECK_THROWS_WITH(arrange_skeleton(s, "file"), Catch::Contains("depends on itself"));
    s.couplers = {{0, {}}, {0, {}}};
    CHECK_THROWS_WITH(arrange_skeleton(s, "file"), Catch::Contains("two constraints"));
}
