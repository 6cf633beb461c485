// Reading: the model, the motion, meshes of bones and muscles.
#include "io/osim_scene/osim_loader.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/load_parts.hpp"
#include "io/osim_scene/osim_bones.hpp"
#include "io/osim_scene/osim_trial.hpp"

#include <algorithm>

namespace fascicle::io {
namespace fs = std::filesystem;
namespace {

/// Whether a motion is a table of poses (motion_file.hpp) and no trial: its header says so.
bool is_pose_table(std::string_view bytes) {
    const std::string head = lower_case(bytes.substr(0, std::min<std::size_t>(bytes.find('\n'), 400)));
    return head.find("frame") != std::string::npos && head.find("bone") != std::string::npos;
}

} // namespace

std::string hash_of(const std::string& bytes) {
    StateHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    return hash.hex();
}

LoadedScene OsimSceneLoader::load() {
    control_.checkpoint("read", 0.0);
    read_model();
    read_motion();
    control_.checkpoint("read", 0.1);
    r_.bones.empty() ? find_bones() : read_bones();
    control_.checkpoint("read", 0.4);
    read_muscles();
    choose_unit();
    control_.checkpoint("read", 0.6);
    choose_frame();
    place_bones();
    place_muscles();
    require_unique_names(scene_);
    load_muscle_files(
        scene_, r_, [&] { control_.checkpoint("read", 0.8); }, loaded_.notes);
    if (table_)
        make_motion();
    return std::move(loaded_);
}

void OsimSceneLoader::read_model() {
    const std::string bytes = read_file(r_.osim.model, std::size_t{128} << 20);
    OsimModel file = read_osim(bytes, where_);
    for (const std::string& note : file.notes)
        say(r_.osim.model.filename().string() + ": " + note);
    model_ = std::make_shared<const LineModel>(std::move(file.model));
    motion_.model = model_;
    motion_.model_source = {where_, hash_of(bytes)};
    motion_.axes = axis_mapping_key(r_.osim.axes);
    motion_.ground.rotation = axis_matrix(r_.osim.axes);
    motion_.reading = r_.osim.reading;
    if (!r_.osim.coordinate.empty())
        coordinate_named(r_.osim.coordinate);
}

int OsimSceneLoader::coordinate_named(const std::string& name) const {
    const int c = skeleton().coordinate_index(name);
    if (c >= 0)
        return c;
    std::vector<std::string> names;
    for (const Coordinate& coordinate : skeleton().coordinates)
        names.push_back(coordinate.name);
    throw_error("--coordinate", "the model has no coordinate '" + name + "'" + did_you_mean(name, names),
                "one of its coordinates", ErrorKind::usage);
}

void OsimSceneLoader::read_motion() {
    const std::string bytes = read_file(r_.motion, std::size_t{256} << 20);
    if (is_pose_table(bytes))
        return;
    table_ = read_storage(bytes, r_.motion.string());
    motion_.trial_source = {r_.motion.string(), hash_of(bytes)};
}

int OsimSceneLoader::body_named(const std::string& option, const std::string& name) const {
    const int b = skeleton().body_index(name);
    if (b >= 0)
        return b;
    std::vector<std::string> names;
    std::string known;
    for (const Body& body : skeleton().bodies) {
        names.push_back(body.name);
        known += (known.empty() ? "" : ", ") + body.name;
    }
    throw_error(option, "the model has no body '" + name + "'" + did_you_mean(name, names),
                "one of " + (known.size() > 300 ? known.substr(0, 300) + " ..." : known), ErrorKind::usage);
}

void OsimSceneLoader::read_bones() {
    for (const fs::path& text : r_.bones) {
        const MeshOfBodies entry = parse_mesh_of_bodies("--bone", text.string());
        if (entry.bodies.size() != 1)
            throw_error("--bone", "got '" + text.string() + "'", "MESH=BODY: a bone is one body",
                        ErrorKind::usage);
        BoneEntry bone;
        bone.body = body_named("--bone", entry.bodies[0]);
        for (const BoneEntry& other : bones_)
            if (other.body == bone.body)
                throw_error("--bone", "two meshes are of body '" + entry.bodies[0] + "'", "one for a body",
                            ErrorKind::usage);
        bone.bone = load_bone(entry.mesh, loaded_.notes);
        bones_.push_back(std::move(bone));
        control_.checkpoint("read", 0.2);
    }
}

void OsimSceneLoader::find_bones() {
    std::vector<std::string> lost;
    ModelMeshes meshes(r_.osim.model);
    for (std::size_t b = 0; b < skeleton().bodies.size(); ++b) {
        const Body& body = skeleton().bodies[b];
        if (b == 0 || body.meshes.empty())
            continue; // ground is no bone; its mesh is a floor
        control_.checkpoint("read", 0.1 + 0.3 * double(b) / double(skeleton().bodies.size()));
        std::vector<std::string> missing;
        std::optional<BodyBone> found = read_body_bone(meshes, body, missing, loaded_.notes);
        std::string names;
        for (const std::string& name : missing)
            names += (names.empty() ? "" : ", ") + name;
        if (!found)
            lost.push_back(body.name + " (" + (names.empty() ? "no triangles" : names) + ")");
        else if (!missing.empty())
            say("bone " + body.name + " lacks a part: " + names + " not found");
        if (!found)
            continue;
        BoneEntry bone;
        bone.body = static_cast<int>(b);
        bone.of_model = true;
        bone.bone.name = body.name;
        bone.bone.mesh = std::make_shared<const TriMesh>(std::move(found->mesh));
        const double size = bounding_box(bone.bone.mesh->positions, bone.bone.mesh->triangles).diagonal();
        if (size > 5)
            say("bone " + body.name + " is " + fixed(size, 1) +
                " m across: are its meshes in millimetres? scale_factors of the model would say so");
        bones_.push_back(std::move(bone));
    }
    std::string names;
    for (const std::string& name : lost)
        names += (names.empty() ? "" : "; ") + name;
    if (names.size() > 400)
        names = names.substr(0, 400) + " ...";
    if (bones_.empty())
        throw_error(where_,
                    names.empty() ? "the model names no meshes of bodies"
                                  : "no mesh of a body was found: " + names,
                    "meshes beside the model or in its folder Geometry, or --bone MESH=BODY");
    if (!lost.empty())
        say("bodies without a bone, since their meshes were not found: " + names);
}

bool OsimSceneLoader::has_bone(int body) const {
    return std::any_of(bones_.begin(), bones_.end(), [&](const BoneEntry& b) { return b.body == body; });
}

void OsimSceneLoader::require_bone(const std::string& muscle, int body) const {
    if (!has_bone(body))
        throw_error(where_,
                    "muscle '" + muscle + "' attaches to body '" + body_name(body) + "', which has no bone",
                    "a mesh of it beside the model, or --bone MESH=" + body_name(body));
}

void OsimSceneLoader::read_muscles() {
    for (const fs::path& text : r_.muscles) {
        const MeshOfBodies parsed = parse_mesh_of_bodies("--muscle", text.string());
        MuscleEntry entry;
        for (const std::string& name : parsed.bodies)
            entry.bodies.push_back(body_named("--muscle", name));
        const std::string name = parsed.mesh.string();
        std::error_code error;
        if (!fs::exists(parsed.mesh, error))
            entry.line = model_->muscle_index(name);
        if (entry.line >= 0) {
            stand_in(entry, name);
        } else {
            if (!fs::exists(parsed.mesh, error))
                throw_error(name,
                            "no such file, and no muscle of the model" + did_you_mean(name, muscle_names()),
                            "a mesh file, or a line muscle of the model");
            if (entry.bodies.empty())
                throw_error("--muscle", "got '" + text.string() + "'",
                            "MESH=BODY,BODY: the bodies that it is fixed to", ErrorKind::usage);
            entry.muscle = load_muscle(parsed.mesh, loaded_.notes);
        }
        for (const int body : entry.bodies)
            require_bone(entry.muscle.name, body);
        muscles_.push_back(std::move(entry));
        control_.checkpoint("read", 0.5);
    }
}

std::vector<std::string> OsimSceneLoader::muscle_names() const {
    std::vector<std::string> names;
    for (const LineMuscle& muscle : model_->muscles)
        names.push_back(muscle.name);
    return names;
}

void OsimSceneLoader::stand_in(MuscleEntry& entry, const std::string& name) const {
    const LineMuscle& line = model_->muscles[static_cast<std::size_t>(entry.line)];
    entry.muscle.name = name;
    const int origin = line.points.front().body, insertion = line.points.back().body;
    const std::string ends = body_name(origin) + "," + body_name(insertion);
    if (entry.bodies.empty())
        entry.bodies = origin == insertion ? std::vector{origin} : std::vector{origin, insertion};
    if (entry.bodies.size() > 2 || entry.bodies.front() != origin || entry.bodies.back() != insertion)
        throw_error("--muscle",
                    "the path of line muscle '" + name + "' goes from " + body_name(origin) + " to " +
                        body_name(insertion),
                    name + "=" + ends, ErrorKind::usage);
    if (!(line.max_isometric_force_n > 0) || !(line.optimal_fibre_length_m > 0))
        throw_error(where_,
                    "line muscle '" + name +
                        "' tells no force or fibre length, so no surface can stand in for it",
                    "max_isometric_force and optimal_fiber_length above 0, or a mesh");
}

LoadedScene load_osim_scene(const SceneRequest& request, const JobControl& control) {
    return OsimSceneLoader(request, control).load();
}

std::shared_ptr<const LineMuscles> model_lines(const ModelMotion& motion) {
    auto lines = std::make_shared<LineMuscles>();
    lines->model = motion.model;
    lines->rest = motion.rest;
    lines->bone_of_body = motion.bone_of_body;
    lines->rest_values = motion.rest_values;
    return lines;
}

void read_model_of(ModelMotion& motion, const fs::path& model) {
    const std::string bytes = read_file(model, std::size_t{128} << 20);
    motion.model = std::make_shared<const LineModel>(read_osim(bytes, model.string()).model);
    motion.model_source = {model.string(), hash_of(bytes)};
}

void read_trial_of(ModelMotion& motion, const fs::path& trial, std::vector<std::string>& notes) {
    std::vector<char> with_bone;
    for (const std::string& bone : motion.bone_of_body)
        with_bone.push_back(bone.empty() ? 0 : 1);
    FramePlacement placement =
        place_frame(*motion.model, motion.mesh_frame, motion.ground.rotation, with_bone);
    motion.ground = placement.ground;
    motion.rest = std::move(placement.rest);
    motion.rest_values = std::move(placement.rest_values);
    const std::string bytes = read_file(trial, std::size_t{256} << 20);
    motion.trial_source = {trial.string(), hash_of(bytes)};
    std::vector<std::string> known; // all of them were said when the project was made
    read_trial_frames(read_storage(bytes, trial.string()), motion, known);
    for (const std::string& note : known)
        if (note.find("jumps") != std::string::npos)
            notes.push_back(trial.filename().string() + ": " + note);
}

} // namespace fascicle::io
