// Muscles: their points, and the numbers that tell their force.

#include "io/formats/text_scanner.hpp"
#include "io/osim/osim_reader.hpp"

namespace fascicle::io {

void OsimReader::read_moving_point(pugi::xml_node node, const Pose& frame, PathPoint& point) {
    point.kind = PathPointKind::moving;
    point.frame = frame;
    const char* const names[3][5] = {
        {"x_location", "XAttachment", "x_coordinate", "XCoordinate", "x_coordinate"},
        {"y_location", "YAttachment", "y_coordinate", "YCoordinate", "y_coordinate"},
        {"z_location", "ZAttachment", "z_coordinate", "ZCoordinate", "z_coordinate"}};
    for (std::size_t k = 0; k < 3; ++k) {
        const pugi::xml_node place = OsimDocument::first_of(node, {names[k][0], names[k][1]});
        pugi::xml_node coordinate = OsimFrames::socket(node, names[k][4]);
        if (!coordinate)
            coordinate = OsimDocument::first_of(node, {names[k][2], names[k][3]});
        if (!place)
            document_.fail(node, "moving point '" + point.name + "' lacks a function", names[k][0]);
        point.moves[k] = read_function(place, coordinates_named(coordinate));
    }
}

PathPoint OsimReader::read_point(pugi::xml_node node) {
    PathPoint point;
    point.name = OsimDocument::name(node);
    const std::string_view type = node.name();
    pugi::xml_node holder = OsimFrames::socket(node, "parent_frame");
    if (!holder)
        holder = node.child("body");
    if (!holder)
        document_.fail(node, "path point '" + point.name + "' belongs to no body",
                       "body or socket_parent_frame");
    const BodyFrame frame = frames_.resolve(holder.text().get(), "/bodyset", holder);
    point.body = frame.body;
    if (type == "MovingPathPoint") {
        read_moving_point(node, frame.pose, point);
        return point;
    }
    if (!node.child("location"))
        document_.fail(node, "path point '" + point.name + "' has no place", "location");
    point.location = frame.pose.apply(document_.vector(node, "location", Vec3::Zero()));
    if (type == "ConditionalPathPoint") {
        point.kind = PathPointKind::conditional;
        pugi::xml_node coordinate = OsimFrames::socket(node, "coordinate");
        if (!coordinate)
            coordinate = OsimDocument::first_of(node, {"coordinate", "coordinates"});
        if (!coordinate)
            document_.fail(node, "conditional point '" + point.name + "' has no condition", "a coordinate");
        point.coordinate = coordinate_named(coordinate.text().get(), coordinate);
        const std::vector<double> range = document_.numbers(node, "range", 2);
        if (!range.empty()) {
            point.range_min = range[0];
            point.range_max = range[1];
        }
    } else if (type != "PathPoint") {
        document_.fail(node, "a path point of the kind " + shown(type),
                       "PathPoint, ConditionalPathPoint or MovingPathPoint");
    }
    return point;
}

LineMuscle OsimReader::read_muscle(pugi::xml_node node, pugi::xml_node path, pugi::xml_node defaults) {
    LineMuscle muscle;
    muscle.name = OsimDocument::name(node);
    muscle.type = node.name();
    std::size_t always = 0;
    for (const pugi::xml_node point : members(path.child("PathPointSet"))) {
        muscle.points.push_back(read_point(point));
        always += muscle.points.back().kind != PathPointKind::conditional ? 1U : 0U;
    }
    if (always < 2)
        document_.fail(node,
                       "muscle '" + muscle.name + "' has " + std::to_string(always) +
                           " points that are always there",
                       "two at least: origin and insertion");
    read_path_wraps(path, muscle);
    const auto value = [&](const char* key) {
        return document_.number(node, key, document_.number(defaults, key, 0));
    };
    muscle.max_isometric_force_n = value("max_isometric_force");
    muscle.optimal_fibre_length_m = value("optimal_fiber_length");
    muscle.tendon_slack_length_m = value("tendon_slack_length");
    muscle.pennation_rad =
        value(node.child("pennation_angle") ? "pennation_angle" : "pennation_angle_at_optimal");
    return muscle;
}

void OsimReader::read_muscles(pugi::xml_node model) {
    for (const pugi::xml_node node : members(model.child("ForceSet"))) {
        const std::string type = node.name();
        const pugi::xml_node path = node.child("GeometryPath");
        if (path && type.find("Muscle") != std::string::npos)
            result_.model.muscles.push_back(
                read_muscle(node, path, model.child("defaults").child(type.c_str())));
        else
            passed_over_.add(type + ", no muscle with a line");
    }
}

} // namespace fascicle::io
