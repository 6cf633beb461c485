#include "io/osim_scene/osim_bones.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <cstdlib>

namespace fascicle::io {
namespace fs = std::filesystem;
namespace {

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

/// A model may name any file; only those are looked at that are called as meshes are.
bool is_mesh_name(const std::string& name) {
    const std::string extension = lower_case(fs::path(name).extension().string());
    for (const MeshFormat& format : mesh_formats())
        if (std::count(format.extensions.begin(), format.extensions.end(), extension) > 0)
            return true;
    return false;
}

/// The file of this path, or one whose name (of the last part, and of a folder before it) differs in upper and lower case alone.
std::optional<fs::path> any_case(const fs::path& folder, const fs::path& name) {
    if (is_file(folder / name))
        return folder / name;
    fs::path at = folder;
    for (const fs::path& part : name) {
        std::error_code error;
        if (part == "." || part == ".." || fs::exists(at / part, error)) {
            at /= part;
            continue;
        }
        const std::string wanted = lower_case(part.string());
        std::optional<fs::path> found;
        int looked_at = 0;
        for (fs::directory_iterator entry(at, error), end; !error && entry != end && looked_at < 10000;
             entry.increment(error), ++looked_at)
            if (lower_case(entry->path().filename().string()) == wanted &&
                (!found || entry->path() < *found)) // the same one on every file system
                found = entry->path();
        if (!found)
            return std::nullopt;
        at = *found;
    }
    return is_file(at) ? std::optional(at) : std::nullopt;
}

} // namespace

std::optional<fs::path> find_model_mesh(const fs::path& model, const std::string& name) {
    if (name.find('\0') != std::string::npos || !is_mesh_name(name))
        return std::nullopt;
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    const fs::path wanted = fs::path(slashes).lexically_normal();
    if (wanted.is_absolute())
        return is_file(wanted) ? std::optional(wanted) : std::nullopt;
    const fs::path beside = model.has_parent_path() ? model.parent_path() : fs::path(".");
    std::vector<fs::path> folders{beside, beside / "Geometry"};
    if (const char* home = std::getenv("OPENSIM_HOME"); home != nullptr && *home != '\0')
        folders.push_back(fs::path(home) / "Geometry");
    for (const fs::path& part : {wanted, wanted.filename()})
        for (const fs::path& folder : folders)
            if (auto found = any_case(folder, part))
                return found;
    return std::nullopt;
}

std::shared_ptr<const ModelMeshes::Part> ModelMeshes::find(const std::string& name,
                                                           std::vector<std::string>& notes) {
    auto path = found_.find(name);
    if (path == found_.end())
        path = found_.emplace(name, find_model_mesh(model_, name)).first;
    if (!path->second)
        return nullptr;
    std::shared_ptr<const Part>& part = parts_[*path->second];
    if (part == nullptr) {
        MeshFile file = read_mesh_file(*path->second);
        const std::string file_name = path->second->filename().string();
        for (const std::string& line : file.notes)
            notes.push_back(file_name + ": " + line);
        part = std::make_shared<const Part>(Part{file_name, std::move(file.mesh)});
    }
    return part;
}

void ModelMeshes::use(const Part& part, const Body& body, const TriMesh& so_far) {
    const std::size_t points = part.mesh.positions.size(), triangles = part.mesh.triangles.size();
    const auto fail = [&](const std::string& whose, const char* most) {
        throw_error(model_.string(),
                    whose + " more than " + most + " million points or triangles with " + part.name,
                    "fewer: one file may be named again and again");
    };
    if (so_far.positions.size() + points > most_in_body || so_far.triangles.size() + triangles > most_in_body)
        fail("the meshes of body '" + body.name + "' have", "5");
    points_ += points;
    triangles_ += triangles;
    if (points_ > most_in_all || triangles_ > most_in_all)
        fail("the meshes of its bodies have", "20");
}

std::optional<BodyBone> read_body_bone(ModelMeshes& meshes, const Body& body,
                                       std::vector<std::string>& missing, std::vector<std::string>& notes) {
    BodyBone bone;
    for (const BodyMesh& named : body.meshes) {
        const auto part = meshes.find(named.file, notes);
        if (part == nullptr) {
            missing.push_back(fs::path(named.file).filename().string());
            continue;
        }
        meshes.use(*part, body, bone.mesh);
        const bool mirrored = named.scale.prod() < 0;
        if (mirrored)
            notes.push_back(part->name + ": mirrored by the model's scale factors");
        const auto first = static_cast<int>(bone.mesh.positions.size());
        for (const Vec3& p : part->mesh.positions)
            bone.mesh.positions.push_back(named.pose.apply(named.scale.cwiseProduct(p)));
        for (const Tri& t : part->mesh.triangles)
            bone.mesh.triangles.push_back(mirrored ? Tri{first + t[0], first + t[2], first + t[1]}
                                                   : Tri{first + t[0], first + t[1], first + t[2]});
        bone.files.push_back(part->name);
    }
    if (bone.files.empty() || bone.mesh.triangles.empty())
        return std::nullopt;
    MendedMesh mended = mend(std::move(bone.mesh));
    require_bone_surface(mended.report, "body " + body.name + " of " + meshes.model().string());
    for (const std::string& line : mended.report.lines())
        notes.push_back(body.name + ": " + line);
    bone.mesh = std::move(mended.mesh);
    return bone;
}

} // namespace fascicle::io
