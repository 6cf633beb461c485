#include "fascicle/io/mesh_bodies.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/io/format_registry.hpp"
#include "io/formats/gltf_read.hpp"
#include "io/formats/obj_bodies.hpp"
#include "io/formats/usda_read.hpp"

namespace fascicle {

Animation read_bodies(std::string_view bytes, const std::string& file) {
    const MeshFormat* format = recognise_format(bytes, file);
    const std::string extension = format != nullptr ? format->extensions.front() : std::string();
    if (extension == ".glb")
        return io::read_glb(bytes, file);
    if (extension == ".usda")
        return io::read_usda(bytes, file);
    if (extension == ".obj")
        try {
            return io::read_obj_bodies(bytes, file);
        } catch (const Error&) { // not in bodies: one mesh, whose reader says what is wrong, if anything is
        }
    return {};
}

MeshData body_mesh(const Animation& animation, const std::string& name, const std::string& file) {
    if (animation.bodies.empty())
        throw_error("--body", file + " holds one mesh", "a .glb, .usda, or .obj with objects (o NAME)",
                    ErrorKind::usage);
    std::vector<std::string> names;
    for (const AnimatedBody& body : animation.bodies) {
        names.push_back(body.name);
        if (body.name != name)
            continue;
        Animation alone;
        alone.notes = animation.notes;
        alone.frames = animation.frames;
        alone.seconds = animation.seconds;
        alone.bodies = {body};
        return first_frame(alone);
    }
    throw_error("--body", file + " has no body '" + name + "'" + did_you_mean(name, names),
                "one of " + body_names(animation), ErrorKind::usage);
}

std::string body_names(const Animation& animation) {
    constexpr std::size_t most = 20;
    std::string text;
    for (std::size_t b = 0; b < animation.bodies.size() && b < most; ++b)
        text += (b == 0 ? "" : ", ") + animation.bodies[b].name;
    if (animation.bodies.size() > most)
        text += " and " + std::to_string(animation.bodies.size() - most) + " more";
    return text;
}

} // namespace fascicle
