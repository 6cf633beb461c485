// Joints, their coordinates, and constraints between coordinates.

#include "fascicle/base/error.hpp"
#include "fascicle/base/pose.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/osim/osim_reader.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::io {
namespace {

/// Axes of the joints that are not told by functions: 0, 1, 2 turn about x, y, z; 3, 4, 5 shift along them. In the order of
/// the joint's coordinates.
struct PlainJoint {
    const char* type;
    std::vector<int> axes;
};

const std::vector<PlainJoint>& plain_joints() {
    static const std::vector<PlainJoint> all{
        {"WeldJoint", {}},          {"PinJoint", {2}},
        {"SliderJoint", {3}},       {"UniversalJoint", {0, 1}},
        {"BallJoint", {0, 1, 2}},   {"GimbalJoint", {0, 1, 2}},
        {"PlanarJoint", {2, 3, 4}}, {"FreeJoint", {0, 1, 2, 3, 4, 5}},
    };
    return all;
}

CoordinateFunction itself(int coordinate) {
    return {{{coordinate, 1.0}}, JointFunction::linear(1, 0)};
}

} // namespace

std::vector<int> OsimReader::read_coordinates(pugi::xml_node joint) {
    std::vector<int> indices;
    for (const pugi::xml_node node :
         members(OsimDocument::first_of(joint, {"CoordinateSet", "coordinates"}))) {
        if (std::string_view(node.name()) != "Coordinate")
            continue;
        Coordinate c;
        c.name = OsimDocument::name(node);
        if (c.name.empty() || skeleton_.coordinate_index(c.name) >= 0)
            document_.fail(
                node, c.name.empty() ? "a coordinate without a name" : "two coordinates " + shown(c.name),
                "a name for each");
        if (skeleton_.coordinates.size() >= most_named)
            document_.fail(node, "more than 10000 coordinates", "a model of fewer");
        c.default_value = document_.number(node, "default_value", 0);
        const std::vector<double> range = document_.numbers(node, "range", 2);
        if (!range.empty()) {
            c.range_min = range[0];
            c.range_max = range[1];
        }
        c.locked = document_.flag(node, "locked", false);
        c.clamped = document_.flag(node, "clamped", false);
        indices.push_back(static_cast<int>(skeleton_.coordinates.size()));
        told_kinds_.emplace_back(indices.back(), lower_case(OsimDocument::text(node, "motion_type")));
        skeleton_.coordinates.push_back(std::move(c));
    }
    return indices;
}

void OsimReader::read_joint_frames(pugi::xml_node node, int old_child, Joint& joint) {
    if (old_child >= 0) { // OpenSim 3: the joint stands inside of its child
        const pugi::xml_node parent = node.child("parent_body");
        if (!parent)
            document_.fail(node, "joint '" + joint.name + "' has no parent", "parent_body");
        joint.parent = frames_.resolve(parent.text().get(), "/bodyset", parent).body;
        joint.child = old_child;
        const auto pose = [&](std::initializer_list<const char*> location,
                              std::initializer_list<const char*> orientation) {
            Pose p;
            if (const pugi::xml_node place = OsimDocument::first_of(node, location))
                p.translation = document_.vector(node, place.name(), Vec3::Zero());
            if (const pugi::xml_node turn = OsimDocument::first_of(node, orientation))
                p.rotation = rotation_xyz(document_.vector(node, turn.name(), Vec3::Zero()));
            return p;
        };
        joint.parent_frame = pose({"location_in_parent"}, {"orientation_in_parent"});
        joint.child_frame = pose({"location_in_child", "location"}, {"orientation_in_child", "orientation"});
        joint.reversed = document_.flag(node, "reverse", false);
        return;
    }
    const auto connect = [&](const char* side, int& body, Pose& pose) {
        const pugi::xml_node socket = OsimFrames::socket(node, side);
        if (!socket)
            document_.fail(node, "joint '" + joint.name + "' has no " + side, std::string("socket_") + side);
        const BodyFrame frame = frames_.resolve(socket.text().get(), "/jointset/" + joint.name, socket);
        body = frame.body;
        pose = frame.pose;
    };
    connect("parent_frame", joint.parent, joint.parent_frame);
    connect("child_frame", joint.child, joint.child_frame);
}

void OsimReader::read_spatial_transform(pugi::xml_node node, Joint& joint) {
    const pugi::xml_node transform = node.child("SpatialTransform");
    if (!transform)
        document_.fail(node, "joint '" + joint.name + "' has no SpatialTransform", "six axes");
    std::size_t place = 0;
    std::array<JointAxis, 6> axes;
    for (std::size_t i = 0; i < 6; ++i)
        axes[i].axis = Vec3::Unit(static_cast<Eigen::Index>(i % 3));
    for (const pugi::xml_node axis : members(transform)) {
        if (std::string_view(axis.name()) != "TransformAxis")
            continue;
        // By name where it has one of the six, else by place.
        const std::string name = OsimDocument::name(axis);
        std::size_t slot = place++;
        for (std::size_t i = 0; i < 6; ++i)
            if (name == (i < 3 ? "rotation" : "translation") + std::to_string(i % 3 + 1))
                slot = i;
        if (slot >= 6)
            document_.fail(axis, "a seventh axis", "three rotations and three translations");
        const Vec3 along = document_.vector(axis, "axis", axes[slot].axis);
        if (!has_direction(along))
            document_.fail(axis, "the axis has no direction", "an axis other than 0 0 0");
        axes[slot] = {along.normalized(), read_function(axis, coordinates_named(axis.child("coordinates")))};
    }
    for (std::size_t i = 0; i < 6; ++i)
        (i < 3 ? joint.rotations : joint.translations).push_back(axes[i]);
}

void OsimReader::set_axes(pugi::xml_node node, const std::vector<int>& coordinates, Joint& joint) {
    const auto& all = plain_joints();
    const auto plain =
        std::find_if(all.begin(), all.end(), [&](const PlainJoint& p) { return joint.type == p.type; });
    if (plain == all.end()) {
        std::string known = "CustomJoint";
        for (const PlainJoint& p : all)
            known += std::string(", ") + p.type;
        document_.fail(node, "joint '" + joint.name + "' is of the kind " + shown(joint.type),
                       "one of " + known);
    }
    if (coordinates.size() > plain->axes.size())
        document_.fail(
            node, "joint '" + joint.name + "' has " + std::to_string(coordinates.size()) + " coordinates",
            std::to_string(plain->axes.size()) + " for a " + joint.type);
    for (std::size_t i = 0; i < plain->axes.size(); ++i) {
        int coordinate = i < coordinates.size() ? coordinates[i] : -1;
        if (coordinate < 0) { // not told: OpenSim makes one of this name
            coordinate = static_cast<int>(skeleton_.coordinates.size());
            Coordinate c;
            c.name = joint.name + "_coord_" + std::to_string(i);
            skeleton_.coordinates.push_back(std::move(c));
        }
        const int axis = plain->axes[i];
        (axis < 3 ? joint.rotations : joint.translations)
            .push_back({Vec3::Unit(axis % 3), itself(coordinate)});
    }
}

void OsimReader::read_joint(pugi::xml_node node, int old_child) {
    Joint joint;
    joint.name = OsimDocument::name(node);
    joint.type = node.name();
    read_joint_frames(node, old_child, joint);
    const std::vector<int> coordinates = read_coordinates(node);
    if (joint.type == "CustomJoint")
        read_spatial_transform(node, joint);
    else
        set_axes(node, coordinates, joint);
    if (skeleton_.joints.size() >= most_named)
        document_.fail(node, "more than 10000 joints", "a model of fewer");
    skeleton_.joints.push_back(std::move(joint));
}

/// A coordinate that turns something is rotational, one that only shifts translational; OpenSim 3 says so itself.
void OsimReader::set_coordinate_kinds() {
    std::vector<char> turns(skeleton_.coordinates.size(), 0), shifts = turns;
    for (const Joint& joint : skeleton_.joints) {
        for (const JointAxis& axis : joint.rotations)
            for (const auto& term : axis.amount.terms)
                turns[static_cast<std::size_t>(term.coordinate)] = 1;
        for (const JointAxis& axis : joint.translations)
            for (const auto& term : axis.amount.terms)
                shifts[static_cast<std::size_t>(term.coordinate)] = 1;
    }
    for (std::size_t i = 0; i < skeleton_.coordinates.size(); ++i)
        if (turns[i] == 0 && shifts[i] != 0)
            skeleton_.coordinates[i].kind = CoordinateKind::translational;
    for (const auto& [coordinate, told] : told_kinds_)
        if (told == "rotational" || told == "translational")
            skeleton_.coordinates[static_cast<std::size_t>(coordinate)].kind =
                told == "rotational" ? CoordinateKind::rotational : CoordinateKind::translational;
}

void OsimReader::read_joints(pugi::xml_node model) {
    for (const pugi::xml_node node : members(model.child("JointSet")))
        collect_frames(node, "/jointset/" + OsimDocument::name(node));
    for (const pugi::xml_node body : members(model.child("BodySet")))
        if (const pugi::xml_node joint = OsimDocument::first_element(body.child("Joint"))) {
            const int child = skeleton_.body_index(OsimDocument::name(body));
            if (child > 0)
                read_joint(joint, child);
        }
    for (const pugi::xml_node node : members(model.child("JointSet")))
        read_joint(node, -1);
    set_coordinate_kinds();
}

void OsimReader::read_couplers(pugi::xml_node model) {
    for (const pugi::xml_node node : members(model.child("ConstraintSet"))) {
        if (std::string_view(node.name()) != "CoordinateCouplerConstraint") {
            passed_over_.add(std::string(node.name()) + ", a constraint: bodies move as their joints say");
            continue;
        }
        if (document_.flag(node, "isDisabled", false) || !document_.flag(node, "isEnforced", true))
            continue;
        const pugi::xml_node dependent = node.child("dependent_coordinate_name");
        const pugi::xml_node function = node.child("coupled_coordinates_function");
        if (!dependent || !function)
            document_.fail(node, "constraint '" + OsimDocument::name(node) + "' is not complete",
                           "dependent_coordinate_name and coupled_coordinates_function");
        CoordinateCoupler coupler;
        coupler.dependent = coordinate_named(dependent.text().get(), dependent);
        coupler.function =
            read_function(function, coordinates_named(node.child("independent_coordinate_names")));
        coupler.function.function =
            coupler.function.function.scaled(document_.number(node, "scale_factor", 1));
        skeleton_.couplers.push_back(std::move(coupler));
    }
}

} // namespace fascicle::io
