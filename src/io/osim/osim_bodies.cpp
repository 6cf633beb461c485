// Bodies, the meshes they are drawn with, and the frames that hang on them.

#include "io/osim/osim_reader.hpp"

#include "io/formats/text_scanner.hpp"

#include <algorithm>

namespace fascicle::io {
namespace {

std::string mesh_file(std::string_view name) {
    std::string file(name);
    std::replace(file.begin(), file.end(), '\\', '/');
    return file;
}

} // namespace

void OsimReader::collect_frames(pugi::xml_node node, const std::string& scope) {
    for (const char* holder : {"components", "frames", "FrameSet"})
        for (const pugi::xml_node child : members(node.child(holder)))
            if (std::string_view(child.name()) == "PhysicalOffsetFrame") {
                frames_.add_offset(scope, child);
                for (const pugi::xml_node inner : members(child.child("components")))
                    if (std::string_view(inner.name()) == "PhysicalOffsetFrame")
                        frames_.add_offset(scope + "/" + OsimDocument::name(child), inner);
            }
}

void OsimReader::read_old_meshes(pugi::xml_node node, Body& body) {
    const pugi::xml_node visible = node.child("VisibleObject");
    const auto pose_of = [&](pugi::xml_node element) {
        const std::vector<double> v = document_.numbers(element, "transform", 6);
        return v.empty() ? Pose{} : Pose{rotation_xyz(Vec3(v[0], v[1], v[2])), Vec3(v[3], v[4], v[5])};
    };
    const Vec3 scale = document_.vector(visible, "scale_factors", Vec3::Ones());
    for (const pugi::xml_node geometry : members(visible.child("GeometrySet"))) {
        const std::string_view file = OsimDocument::text(geometry, "geometry_file");
        if (!file.empty())
            body.meshes.push_back(
                {mesh_file(file),
                 scale.cwiseProduct(document_.vector(geometry, "scale_factors", Vec3::Ones())),
                 pose_of(visible).after(pose_of(geometry))});
    }
    TextScanner files(visible.child("geometry_files").text().get(), document_.file());
    for (std::string_view file; !(file = files.next_word()).empty();)
        body.meshes.push_back({mesh_file(file), scale, pose_of(visible)});
}

void OsimReader::read_meshes(pugi::xml_node node, const Pose& pose, Body& body) {
    for (const pugi::xml_node mesh : members(node.child("attached_geometry"))) {
        const pugi::xml_node file = OsimDocument::first_of(mesh, {"mesh_file", "geometry_file"});
        if (std::string_view(mesh.name()) == "Mesh" && file)
            body.meshes.push_back({mesh_file(trimmed(file.text().get())),
                                   document_.vector(mesh, "scale_factors", Vec3::Ones()), pose});
    }
    for (const pugi::xml_node child : members(node.child("components")))
        if (std::string_view(child.name()) == "PhysicalOffsetFrame") {
            const Pose own{rotation_xyz(document_.vector(child, "orientation", Vec3::Zero())),
                           document_.vector(child, "translation", Vec3::Zero())};
            for (const pugi::xml_node mesh : members(child.child("attached_geometry"))) {
                const pugi::xml_node file = OsimDocument::first_of(mesh, {"mesh_file", "geometry_file"});
                if (std::string_view(mesh.name()) == "Mesh" && file)
                    body.meshes.push_back({mesh_file(trimmed(file.text().get())),
                                           document_.vector(mesh, "scale_factors", Vec3::Ones()),
                                           pose.after(own)});
            }
        }
}

void OsimReader::read_body(pugi::xml_node node, int index, const std::string& path) {
    frames_.add_body(path, index, node);
    collect_frames(node, path);
    Body& body = skeleton_.bodies[static_cast<std::size_t>(index)];
    body.mass_kg = document_.number(node, "mass", 0);
    body.mass_centre = document_.vector(node, "mass_center", Vec3::Zero());
    read_old_meshes(node, body);
    read_meshes(node, {}, body);
    read_wrap_objects(node.child("WrapObjectSet"), index);
}

void OsimReader::read_bodies(pugi::xml_node model) {
    bool ground = false;
    if (const pugi::xml_node node = model.child("Ground")) {
        read_body(node, 0, "/ground");
        ground = true;
    }
    for (const pugi::xml_node node : members(model.child("BodySet"))) {
        const std::string name = OsimDocument::name(node);
        if (std::string_view(node.name()) != "Body") {
            passed_over_.add(std::string(node.name()) + " in BodySet");
            continue;
        }
        if (name.empty())
            document_.fail(node, "a body without a name", "a name for each");
        if (name == "ground") {
            read_body(node, 0, "/ground");
            ground = true;
            continue;
        }
        if (skeleton_.bodies.size() >= most_named)
            document_.fail(node, "more than 10000 bodies", "a model of fewer");
        skeleton_.bodies.push_back({name, 0, Vec3::Zero(), {}});
        read_body(node, static_cast<int>(skeleton_.bodies.size()) - 1, "/bodyset/" + name);
    }
    if (!ground)
        frames_.add_body("/ground", 0, model);
    for (const pugi::xml_node node : members(model.child("ComponentSet")))
        if (std::string_view(node.name()) == "PhysicalOffsetFrame")
            frames_.add_offset("/componentset", node);
    collect_frames(model, "");
}

} // namespace fascicle::io
