#include "io/osim/osim_frames.hpp"

#include "fascicle/motion/skeleton.hpp"
#include "io/formats/text_scanner.hpp"

namespace fascicle::io {
namespace {

constexpr int deepest = 64; // frames that hang on frames

std::string last_part(std::string_view path) {
    return std::string(path.substr(path.find_last_of('/') + 1));
}

/// "/jointset/hip" and "../ground" -> "/jointset/ground".
std::string joined(std::string scope, std::string_view relative) {
    while (!relative.empty()) {
        const std::size_t cut = std::min(relative.find('/'), relative.size());
        const std::string_view part = relative.substr(0, cut);
        if (part == "..")
            scope.erase(std::min(scope.find_last_of('/'), scope.size()));
        else if (part != "." && !part.empty())
            scope.append(1, '/').append(part);
        relative.remove_prefix(std::min(cut + 1, relative.size()));
    }
    return scope;
}

} // namespace

void OsimFrames::add_body(const std::string& path, int body, pugi::xml_node node) {
    if (!bodies_.emplace(path, body).second)
        document_.fail(node, "there are two bodies called " + shown(last_part(path)), "a name for each");
    paths_by_name_.emplace(last_part(path), path);
}

void OsimFrames::add_offset(const std::string& scope, pugi::xml_node node) {
    const std::string path = scope + "/" + OsimDocument::name(node);
    if (offsets_.emplace(path, Offset{scope, node}).second)
        paths_by_name_.emplace(last_part(path), path);
}

BodyFrame OsimFrames::offset_frame(const Offset& offset, int depth) const {
    if (depth > deepest)
        document_.fail(offset.node, "frames hang on each other in a circle", "frames that end at a body");
    const pugi::xml_node parent = socket(offset.node, "parent");
    if (!parent)
        document_.fail(offset.node, "the frame has no parent", "socket_parent");
    BodyFrame frame =
        resolve(parent.text().get(), offset.scope + "/" + OsimDocument::name(offset.node), parent, depth + 1);
    const Pose own{rotation_xyz(document_.vector(offset.node, "orientation", Vec3::Zero())),
                   document_.vector(offset.node, "translation", Vec3::Zero())};
    frame.pose = frame.pose.after(own);
    return frame;
}

std::optional<BodyFrame> OsimFrames::find(const std::string& path, int depth) const {
    if (const auto body = bodies_.find(path); body != bodies_.end())
        return BodyFrame{body->second, {}};
    if (const auto offset = offsets_.find(path); offset != offsets_.end())
        return offset_frame(offset->second, depth);
    return std::nullopt;
}

BodyFrame OsimFrames::resolve(std::string_view reference, const std::string& scope, pugi::xml_node node,
                              int depth) const {
    const std::string_view wanted = trimmed(reference);
    if (wanted.empty())
        document_.fail(node, std::string(node.name()) + " names no frame", "a body");
    const bool absolute = wanted.front() == '/';
    if (const auto found = find(absolute ? std::string(wanted) : joined(scope, wanted), depth))
        return *found;
    // A bare name, or a path of another version's making: a body of that name, else the one frame.
    const std::string name = last_part(wanted);
    const auto [first, end] = paths_by_name_.equal_range(name);
    for (auto it = first; it != end; ++it)
        if (bodies_.count(it->second) > 0)
            return *find(it->second, depth);
    if (first == end)
        document_.fail(node, "there is no body or frame " + shown(wanted));
    if (std::next(first) != end)
        document_.fail(node, "there are several frames " + shown(name), "a path that tells them apart");
    return *find(first->second, depth);
}

BodyFrame OsimFrames::resolve(std::string_view reference, const std::string& scope,
                              pugi::xml_node node) const {
    return resolve(reference, scope, node, 0);
}

pugi::xml_node OsimFrames::socket(pugi::xml_node element, const char* name) {
    const std::string plain = std::string("socket_") + name;
    if (const pugi::xml_node found = element.child(plain.c_str()))
        return found;
    if (const pugi::xml_node found = element.child((plain + "_connectee_name").c_str()))
        return found;
    for (const pugi::xml_node connector : element.child("connectors").children())
        if (OsimDocument::name(connector) == name)
            return connector.child("connectee_name");
    return {};
}

} // namespace fascicle::io
