#include "io/project_json.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/scene/line_muscles.hpp"

#include <algorithm>

namespace fascicle::io {
namespace fs = std::filesystem;
namespace {

Json vector_json(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

/// Adds to `fresh` what `previous` has and this version does not know.
void keep_unknown(Json& fresh, const Json& previous, const std::vector<std::string>& known) {
    if (previous.is_object())
        for (const auto& [key, value] : previous.items())
            if (!fresh.contains(key) && std::count(known.begin(), known.end(), key) == 0)
                fresh[key] = value;
}

/// The object of that name in a list of the previous file, or null.
Json previous_entry(const Json& previous, const char* list, const std::string& name) {
    if (const auto it = previous.find(list); it != previous.end() && it->is_array())
        for (const Json& entry : *it)
            if (entry.is_object() && entry.contains("name") && entry["name"] == name)
                return entry;
    return Json::object();
}

Json source_json(const MeshSource& source, const fs::path& folder) {
    std::error_code code;
    const fs::path absolute = fs::absolute(source.path, code);
    const fs::path relative = absolute.lexically_proximate(folder);
    Json json{{"path", relative.generic_string()}, {"hash", source.hash}};
    if (const auto size = fs::file_size(source.path, code); !code)
        json["size"] = size;
    return json;
}

template <typename Thing>
Json thing_json(const Thing& thing, const Scene& scene, const fs::path& folder) {
    Json json{{"name", thing.name}};
    if (!thing.source.path.empty())
        json.update(source_json(thing.source, folder));
    else if (!scene.embedded_name.empty())
        json["embedded"] = mesh_hash(*thing.mesh);
    else
        throw_error(folder.string(),
                    "'" + thing.name + "' comes from no file and cannot be named in a project",
                    "meshes from files or from an embedded scene");
    return json;
}

/// First and last vertex of every run of consecutive vertices, in one list.
Json ranges_json(const SurfaceRegion& region) {
    std::vector<int> ranges;
    region.for_each([&](int v) {
        if (!ranges.empty() && ranges.back() == v - 1) {
            ranges.back() = v;
        } else {
            ranges.push_back(v);
            ranges.push_back(v);
        }
    });
    return ranges;
}

Json muscle_json(const Muscle& muscle, const Scene& scene, const fs::path& folder) {
    Json json = thing_json(muscle, scene, folder);
    json["attach_automatically"] = muscle.attach_automatically;
    for (const MeshSource& source : muscle.outline_files)
        json["outline_files"].push_back(source_json(source, folder));
    if (muscle.outline_files.empty())
        for (const AttachmentOutline& outline : muscle.outlines) {
            Json points = Json::array();
            for (const Vec3& p : outline.points)
                points.push_back(vector_json(p));
            json["outlines"].push_back(
                {{"kind", to_text(outline.kind)}, {"bone", outline.bone}, {"points", points}});
            if (!outline.head.empty())
                json["outlines"].back()["head"] = outline.head;
            if (outline.hole)
                json["outlines"].back()["hole"] = true;
        }
    for (const Attachment& a : muscle.attachments)
        json["attachments"].push_back(
            {{"kind", to_text(a.kind)},
             {"bone", a.bone < 0 ? std::string() : scene.bones.at(static_cast<std::size_t>(a.bone)).name},
             {"vertices", a.vertices}});
    for (const AttachmentArea& area : muscle.areas) {
        const bool known = area.bone >= 0 && area.bone < static_cast<int>(scene.bones.size());
        Json entry{{"kind", to_text(area.kind)},
                   {"bone", known ? scene.bones[static_cast<std::size_t>(area.bone)].name : std::string()}};
        if (!area.head.empty())
            entry["head"] = area.head;
        entry["vertex_count"] = area.vertices.vertex_count();
        entry["ranges"] = ranges_json(area.vertices);
        json["areas"].push_back(std::move(entry));
    }
    if (!muscle.surface_fibres_source.path.empty())
        json["surface_fibres"] = source_json(muscle.surface_fibres_source, folder);
    if (!muscle.fibre_template_source.path.empty())
        json["fibre_template"] = source_json(muscle.fibre_template_source, folder);
    return json;
}

Json timeline_json(const Scene& scene) {
    const Timeline& timeline = scene.timeline;
    Json json{{"last_frame", timeline.last_frame}};
    if (timeline.hinge)
        json["hinge"] = {{"centre", vector_json(timeline.hinge->centre)},
                         {"axis", vector_json(timeline.hinge->axis)}};
    json["angles"] = Json::array();
    for (const AngleKey& key : timeline.angles)
        json["angles"].push_back({{"frame", key.frame}, {"angle_rad", key.angle_rad}});
    json["tracks"] = Json::array();
    for (std::size_t b = 0; b < timeline.bone_tracks.size() && b < scene.bones.size(); ++b) {
        Json keys = Json::array();
        for (const PoseKey& key : timeline.bone_tracks[b].keys) {
            Json pose = Json::array();
            for (int row = 0; row < 3; ++row) {
                for (int column = 0; column < 3; ++column)
                    pose.push_back(key.pose.rotation(row, column));
                pose.push_back(key.pose.translation[row]);
            }
            keys.push_back({{"frame", key.frame}, {"pose", pose}});
        }
        if (!keys.empty())
            json["tracks"].push_back({{"bone", scene.bones[b].name}, {"keys", keys}});
    }
    return json;
}

Json parameters_json(const ParamSet& parameters) {
    Json json = Json::object();
    for (const ParamRow& row : parameters.table().rows())
        if (row.kind == ParamKind::choice && (parameters.edited(row.key) || row.key == "solver.method"))
            json[row.key] = parameters.get_choice(row.key);
        else if (parameters.edited(row.key))
            json[row.key] = parameters.get(row.key);
    return json;
}

} // namespace

std::string mesh_hash(const TriMesh& mesh) {
    StateHash hash;
    hash.add_points(mesh.positions);
    for (const Tri& t : mesh.triangles)
        hash.add_bytes(t.data(), sizeof t);
    return hash.hex();
}

Json project_json(const Scene& scene, const fs::path& file, const Json& previous) {
    const fs::path folder = fs::absolute(file).parent_path();
    Json json{{"fascicle_project", project_version}, {"program_version", program_version()}};
    json["name"] = scene.name;
    if (!scene.embedded_name.empty())
        json["embedded_scene"] = scene.embedded_name;
    json["unit"] = to_text(scene.unit);
    json["bones"] = Json::array();
    for (const Bone& bone : scene.bones) {
        Json entry = thing_json(bone, scene, folder);
        keep_unknown(entry, previous_entry(previous, "bones", bone.name),
                     {"path", "hash", "size", "embedded"});
        json["bones"].push_back(std::move(entry));
    }
    json["muscles"] = Json::array();
    for (const Muscle& muscle : scene.muscles) {
        Json entry = muscle_json(muscle, scene, folder);
        keep_unknown(entry, previous_entry(previous, "muscles", muscle.name),
                     {"path", "hash", "size", "embedded", "outline_files", "outlines", "attachments", "areas",
                      "surface_fibres", "fibre_template"});
        json["muscles"].push_back(std::move(entry));
    }
    json["timeline"] = timeline_json(scene);
    if (scene.line_muscles != nullptr && !scene.line_muscles->source.path.empty())
        json["line_muscles"] = source_json(scene.line_muscles->source, folder);
    json["parameters"] = parameters_json(scene.parameters);
    if (const auto it = previous.find("parameters"); it != previous.end() && it->is_object())
        for (const auto& [key, value] : it->items())
            if (scene.parameters.table().find(key) == nullptr)
                json["parameters"][key] = value;
    keep_unknown(json, previous, {"embedded_scene", "line_muscles"});
    return json;
}

} // namespace fascicle::io
