#include "io/project_json.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "io/mesh_codec.hpp"
#include "io/project_unknown.hpp"

#include <algorithm>
#include <mutex>
#include <set>

namespace fascicle::io {
namespace fs = std::filesystem;
namespace {

Json vector_json(const Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

/// StateHash of the file's bytes; empty when there is no such file. Remembered while time and size stay, so that saving
/// often does not read large meshes often.
std::string hash_of_file(const fs::path& path) {
    static std::mutex mutex;
    static std::map<fs::path, std::pair<std::pair<fs::file_time_type, std::uintmax_t>, std::string>> known;
    std::error_code code;
    const auto time = fs::last_write_time(path, code);
    const auto size = code ? 0 : fs::file_size(path, code);
    if (code || !fs::is_regular_file(path, code))
        return {};
    const std::lock_guard lock(mutex);
    auto& [state, hash] = known[path];
    if (hash.empty() || state != std::pair(time, size))
        try {
            const std::string bytes = read_file(path);
            StateHash fresh;
            fresh.add_bytes(bytes.data(), bytes.size());
            hash = fresh.hex();
            state = {time, size};
        } catch (const Error&) {
            hash.clear();
        }
    return hash;
}

/// Whether the file still holds what was read from it.
bool is_current(const MeshSource& source) {
    return !source.path.empty() && !source.hash.empty() && hash_of_file(source.path) == source.hash;
}

/// Hashes of all meshes of an embedded scene, made once.
const std::set<std::string>& embedded_hashes(const std::string& name) {
    static std::mutex mutex;
    static std::map<std::string, std::set<std::string>> known;
    const std::lock_guard lock(mutex);
    const auto [it, is_new] = known.try_emplace(name);
    if (is_new) {
        const auto& all = embedded_scenes();
        if (std::none_of(all.begin(), all.end(), [&](const auto& info) { return info.name == name; }))
            return it->second;
        const Scene scene = make_embedded_scene(name);
        for (const Bone& bone : scene.bones)
            it->second.insert(mesh_hash(*bone.mesh));
        for (const Muscle& muscle : scene.muscles)
            it->second.insert(mesh_hash(*muscle.mesh));
    }
    return it->second;
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
Json thing_json(const Thing& thing, const Scene& scene, const fs::path& folder, bool carry) {
    Json json{{"name", thing.name}};
    if (!carry && is_current(thing.source)) {
        json.update(source_json(thing.source, folder));
        return json;
    }
    if (!carry && !scene.embedded_name.empty() && thing.source.path.empty())
        if (const std::string hash = mesh_hash(*thing.mesh);
            embedded_hashes(scene.embedded_name).count(hash) != 0) {
            json["embedded"] = hash;
            return json;
        }
    json["mesh"] = carried_mesh_json(*thing.mesh);
    return json;
}

Json points_json(const Points& points) {
    Json json = Json::array();
    for (const Vec3& p : points)
        json.push_back(vector_json(p));
    return json;
}

Json polygons_json(const std::vector<FibrePolygon>& side) {
    Json json = Json::array();
    for (const FibrePolygon& polygon : side) {
        Json points = Json::array();
        for (const Vec2& p : polygon.points)
            points.push_back({p.x(), p.y()});
        json.push_back({{"s", polygon.s}, {"weight", polygon.weight}, {"points", points}});
    }
    return json;
}

/// As in a template file.
Json template_json(const FibreTemplate& t) {
    Json json{{"format", "fascicle fibre template"},
              {"version", 1},
              {"key", t.key},
              {"label", t.label},
              {"meaning", t.meaning},
              {"front", polygons_json(t.front)}};
    if (!t.back.empty())
        json["back"] = polygons_json(t.back);
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

Json muscle_json(const Muscle& muscle, const Scene& scene, const fs::path& folder, bool carry) {
    Json json = thing_json(muscle, scene, folder, carry);
    json["attach_automatically"] = muscle.attach_automatically;
    if (!muscle.attach_to.empty())
        json["attach_to"] = muscle.attach_to;
    const bool files = !carry && !muscle.outline_files.empty() &&
                       std::all_of(muscle.outline_files.begin(), muscle.outline_files.end(), is_current);
    for (const MeshSource& source : muscle.outline_files)
        if (files)
            json["outline_files"].push_back(source_json(source, folder));
    for (const AttachmentOutline& outline : muscle.outlines) {
        if (files)
            break;
        json["outlines"].push_back({{"kind", to_text(outline.kind)},
                                    {"bone", outline.bone},
                                    {"points", points_json(outline.points)}});
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
    if (muscle.surface_fibres != nullptr && !carry && is_current(muscle.surface_fibres_source))
        json["surface_fibres"] = source_json(muscle.surface_fibres_source, folder);
    else if (muscle.surface_fibres != nullptr)
        json["surface_fibres"] = {{"points", points_json(muscle.surface_fibres->points)},
                                  {"lines", muscle.surface_fibres->lines}};
    if (muscle.fibre_template != nullptr && !carry && is_current(muscle.fibre_template_source))
        json["fibre_template"] = source_json(muscle.fibre_template_source, folder);
    else if (muscle.fibre_template != nullptr)
        json["fibre_template"] = {{"template", template_json(*muscle.fibre_template)}};
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

/// The model and trial are read again; what the user said of them stands here.
Json opensim_json(const Scene& scene, const fs::path& folder) {
    const ModelMotion& motion = *scene.model_motion;
    const Skeleton& skeleton = motion.model->skeleton;
    Json json{{"model", source_json(motion.model_source, folder)},
              {"trial", source_json(motion.trial_source, folder)},
              {"mesh_frame", to_text(motion.mesh_frame)},
              {"axes", motion.axes}};
    if (motion.coordinate >= 0)
        json["coordinate"] = skeleton.coordinates[static_cast<std::size_t>(motion.coordinate)].name;
    if (motion.reading.from_s)
        json["from_s"] = *motion.reading.from_s;
    if (motion.reading.to_s)
        json["to_s"] = *motion.reading.to_s;
    if (motion.reading.frames > 0)
        json["trial_frames"] = motion.reading.frames;
    json["lines"] = scene.line_muscles != nullptr && scene.line_muscles->model == motion.model;
    json["bodies"] = Json::array();
    for (std::size_t b = 0; b < motion.bone_of_body.size(); ++b)
        if (!motion.bone_of_body[b].empty())
            json["bodies"].push_back({{"body", skeleton.bodies[b].name}, {"bone", motion.bone_of_body[b]}});
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

/// Defaults that the scene brings with it in place of its method's.
Json parameter_defaults_json(const ParamSet& parameters) {
    ParamSet plain = default_parameters();
    set_method(plain, parameters.get_choice("solver.method"));
    Json json = Json::object();
    for (const ParamRow& row : parameters.table().rows())
        if (row.kind != ParamKind::choice &&
            parameters.default_value(row.key) != plain.default_value(row.key))
            json[row.key] = parameters.default_value(row.key);
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

Json project_json(const Scene& scene, const fs::path& file, const Json& previous, bool carry_meshes) {
    const fs::path folder = fs::absolute(file).parent_path().lexically_normal();
    Json json{{"fascicle_project", project_version}, {"program_version", program_version()}};
    json["name"] = scene.name;
    if (!scene.embedded_name.empty())
        json["embedded_scene"] = scene.embedded_name;
    if (carry_meshes)
        json["carries_meshes"] = true;
    json["unit"] = to_text(scene.unit);
    json["bones"] = Json::array();
    for (const Bone& bone : scene.bones)
        json["bones"].push_back(thing_json(bone, scene, folder, carry_meshes));
    json["muscles"] = Json::array();
    for (const Muscle& muscle : scene.muscles)
        json["muscles"].push_back(muscle_json(muscle, scene, folder, carry_meshes));
    json["timeline"] = timeline_json(scene);
    for (const Marker& marker : scene.markers)
        json["markers"].push_back({{"frame", marker.frame}, {"name", marker.name}});
    if (!scene.motion_source.path.empty())
        json["motion_file"] = source_json(scene.motion_source, folder);
    if (scene.model_motion != nullptr)
        json["opensim"] = opensim_json(scene, folder);
    if (scene.line_muscles != nullptr && !scene.line_muscles->source.path.empty())
        json["line_muscles"] = source_json(scene.line_muscles->source, folder);
    if (Json defaults = parameter_defaults_json(scene.parameters); !defaults.empty())
        json["parameter_defaults"] = std::move(defaults);
    json["parameters"] = parameters_json(scene.parameters);
    if (const auto it = previous.find("parameters"); it != previous.end() && it->is_object())
        for (const auto& [key, value] : it->items())
            if (scene.parameters.table().find(key) == nullptr)
                json["parameters"][key] = value;
    keep_unknown_fields(json, previous);
    return json;
}

} // namespace fascicle::io
