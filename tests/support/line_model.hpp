#pragma once
// The smallest line model: an arm that turns about an axis through the origin, and one muscle across it.

#include "fascicle/motion/timeline.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "support/shapes.hpp"

#include <string>

namespace fascicle::test {

/// An OpenSim file: bodies base (welded to ground) and arm_r; elbow turns the arm about z, from 0. The muscle `flexor_r` runs from
/// base (0.2, 0, 0) to arm (0, 0.05, 0), metres; with `via` between them a point of the base (0.1, 0.1, 0) that is there
/// while the elbow is between -0.3 and 0.3 rad.
inline std::string arm_osim(bool via = false, const std::string& base = "base",
                            const std::string& arm = "arm_r") {
    const auto point = [](const std::string& type, const std::string& body, const std::string& at,
                          const std::string& more = {}) {
        return "<" + type + " name=\"p\"><socket_parent_frame>/bodyset/" + body +
               "</socket_parent_frame><location>" + at + "</location>" + more + "</" + type + ">";
    };
    return "<?xml version=\"1.0\"?>\n<OpenSimDocument Version=\"40000\">\n<Model name=\"arm\">\n<Ground "
           "name=\"ground\"/>\n"
           "<BodySet name=\"bodyset\"><objects><Body name=\"" +
           base + "\"/><Body name=\"" + arm +
           "\"/></objects></BodySet>\n<JointSet name=\"jointset\"><objects>\n"
           "<WeldJoint "
           "name=\"weld\"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/" +
           base +
           "</socket_child_frame></WeldJoint>\n"
           "<PinJoint name=\"elbow\"><socket_parent_frame>/bodyset/" +
           base + "</socket_parent_frame><socket_child_frame>/bodyset/" + arm +
           "</socket_child_frame><coordinates><Coordinate name=\"elbow_q\"/></coordinates></PinJoint>\n"
           "</objects></JointSet>\n<ForceSet><objects>\n<Thelen2003Muscle name=\"flexor_r\"><GeometryPath "
           "name=\"path\"><PathPointSet><objects>" +
           point("PathPoint", base, "0.2 0 0") +
           (via ? point(
                      "ConditionalPathPoint", base, "0.1 0.1 0",
                      "<socket_coordinate>/jointset/elbow/elbow_q</socket_coordinate><range>-0.3 0.3</range>")
                : std::string()) +
           point("PathPoint", arm, "0 0.05 0") +
           "</objects></PathPointSet></GeometryPath></Thelen2003Muscle>\n</objects></ForceSet>\n</Model>\n</"
           "OpenSimDocument>\n";
}

/// As arm_osim(via) says it.
inline LineModel arm_model(bool via = false) {
    LineModel model;
    model.name = "arm";
    Coordinate elbow;
    elbow.name = "elbow_q";
    model.skeleton.coordinates = {elbow};
    model.skeleton.bodies.push_back({"base", 0, Vec3::Zero(), {}});
    model.skeleton.bodies.push_back({"arm_r", 0, Vec3::Zero(), {}});
    Joint weld, pin;
    weld.child = 1;
    pin.parent = 1;
    pin.child = 2;
    pin.rotations = {{Vec3::UnitZ(), {{{0, 1.0}}, JointFunction::linear(1, 0)}}};
    model.skeleton.joints = {weld, pin};
    arrange_skeleton(model.skeleton, "arm");
    LineMuscle muscle;
    muscle.name = "flexor_r";
    const auto point = [&](int body, const Vec3& at) {
        PathPoint p;
        p.body = body;
        p.location = at;
        return p;
    };
    muscle.points = {point(1, {0.2, 0, 0}), point(2, {0, 0.05, 0})};
    if (via) {
        PathPoint p = point(1, {0.1, 0.1, 0});
        p.kind = PathPointKind::conditional;
        p.coordinate = 0;
        p.range_min = -0.3;
        p.range_max = 0.3;
        muscle.points.insert(muscle.points.begin() + 1, p);
    }
    model.muscles = {muscle};
    return model;
}

/// Balls of 5 mm about the ends of that muscle as bones `base` and `arm`; the arm turns about z through the origin by angle_rad in
/// ten frames, and back.
inline Scene arm_scene(double angle_rad, LengthUnit unit = LengthUnit::millimetre) {
    const double s = scene_units_per_metre(unit);
    Scene scene;
    scene.unit = unit;
    scene.bones = {{"base", std::make_shared<const TriMesh>(sphere(0.005 * s, 2, s * Vec3(0.2, 0, 0))), {}},
                   {"arm", std::make_shared<const TriMesh>(sphere(0.005 * s, 2, s * Vec3(0, 0.05, 0))), {}}};
    scene.timeline = make_hinge_timeline({Vec3::Zero(), Vec3(0, 0, 2)}, angle_rad, {10, 10, 0}, 2, {1});
    return scene;
}

} // namespace fascicle::test
