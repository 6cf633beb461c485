// Wrap objects of bodies, and which muscles wrap over them.

#include "io/formats/text_scanner.hpp"
#include "io/osim/osim_reader.hpp"

#include <cmath>

namespace fascicle::io {

namespace {

/// m, and times the smallest radius: beyond them the squares that ways round a surface are made of have no digits in common.
constexpr double largest = 1e6, flattest = 1e6;

bool is_size(double x) {
    return x > 0 && x <= largest;
}

} // namespace

void OsimReader::read_wrap_objects(pugi::xml_node set, int body) {
    for (const pugi::xml_node node : members(set)) {
        const std::string_view type = node.name();
        WrapObject object;
        object.name = OsimDocument::name(node);
        object.body = body;
        object.active = document_.flag(node, "active", true);
        object.pose = {rotation_xyz(document_.vector(node, "xyz_body_rotation", Vec3::Zero())),
                       document_.vector(node, "translation", Vec3::Zero())};
        WrapSurface& surface = object.surface;
        bool sizes = true;
        if (type == "WrapSphere" || type == "WrapCylinder") {
            surface.shape = type == "WrapSphere" ? WrapShape::sphere : WrapShape::cylinder;
            surface.radius = document_.number(node, "radius", 0);
            surface.length = document_.number(node, "length", 0);
            sizes = is_size(surface.radius) && (type == "WrapSphere" || is_size(surface.length));
        } else if (type == "WrapEllipsoid") {
            surface.shape = WrapShape::ellipsoid;
            surface.radii = document_.vector(node, "dimensions", Vec3::Zero());
            const double least = surface.radii.minCoeff(), most = surface.radii.maxCoeff();
            sizes = is_size(least) && is_size(most) && most <= flattest * least;
        } else if (type == "WrapTorus") {
            surface.shape = WrapShape::torus;
        } else {
            passed_over_.add(std::string(type) + ", an unknown wrap object");
            continue;
        }
        if (!sizes)
            document_.fail(
                node, "wrap object '" + object.name + "' has a bad size",
                "radius, length or dimensions above 0 and up to 1e6 m, no dimension 1e6 times another");
        const std::string side = lower_case(OsimDocument::text(node, "quadrant"));
        if (!side.empty() && side != "all" && side != "unassigned") {
            const std::size_t axis = std::string_view("xyz").find(side.back());
            if (axis == std::string_view::npos || side.size() > 2 ||
                (side.size() == 2 && side[0] != '+' && side[0] != '-'))
                document_.fail(node.child("quadrant"), "quadrant is " + shown(side),
                               "all, +x, -x, +y, -y, +z or -z");
            surface.side_axis = static_cast<int>(axis);
            surface.side_sign = side[0] == '-' ? -1 : 1;
        }
        if (result_.model.wrap_objects.size() >= most_named)
            document_.fail(node, "more than 10000 wrap objects", "a model of fewer");
        result_.model.wrap_objects.push_back(std::move(object));
    }
}

void OsimReader::read_path_wraps(pugi::xml_node path, LineMuscle& muscle) {
    for (const pugi::xml_node node : members(path.child("PathWrapSet"))) {
        if (std::string_view(node.name()) != "PathWrap")
            continue;
        pugi::xml_node named = node.child("wrap_object");
        if (!named)
            named = OsimFrames::socket(node, "wrap_object");
        std::string name(trimmed(named.text().get()));
        name = name.substr(name.find_last_of('/') + 1);
        PathWrap wrap;
        wrap.object = -1;
        const auto& objects = result_.model.wrap_objects;
        for (std::size_t i = 0; i < objects.size() && wrap.object < 0; ++i)
            if (objects[i].name == name)
                wrap.object = static_cast<int>(i);
        if (wrap.object < 0)
            document_.fail(node, "there is no wrap object " + shown(name));
        const auto& object = objects[static_cast<std::size_t>(wrap.object)];
        if (object.surface.shape == WrapShape::torus) {
            result_.notes.push_back("muscle '" + muscle.name + "' runs past '" + object.name +
                                    "': wrapping through a torus is not handled");
            continue;
        }
        // Numbers of points from 1; below 1: from the first, to the last.
        const int last = static_cast<int>(muscle.points.size()) - 1;
        const std::vector<double> range = document_.numbers(node, "range", 2);
        for (const double end : range)
            if (std::abs(end) > 1e6 || end != std::floor(end) || end > last + 1)
                document_.fail(node.child("range"),
                               "the range of wrap object '" + name + "' is none of points",
                               "whole numbers up to " + std::to_string(last + 1));
        wrap.first = range.empty() || range[0] < 1 ? 0 : static_cast<int>(range[0]) - 1;
        wrap.last = range.empty() || range[1] < 1 ? last : static_cast<int>(range[1]) - 1;
        muscle.wraps.push_back(wrap);
    }
}

} // namespace fascicle::io
