// Placing: unit, frame and axes of what was read, surfaces that stand in for muscles, the motion.
#include "fascicle/anatomy/spindle.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "io/load_parts.hpp"
#include "io/osim_scene/osim_loader.hpp"
#include "io/osim_scene/osim_trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fascicle::io {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t tried_points = 2000;
constexpr double far_m =
    0.05; ///< a muscle farther from its bone than this is of another frame, unit or specimen
constexpr double same_fit_m = 5e-4; ///< the first one counts of frames that fit alike
constexpr double clearance_m = 0.0008;

} // namespace

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

void OsimSceneLoader::choose_unit() {
    std::vector<MeshPtr*> meshes;
    std::vector<MeshSource*> sources;
    const auto add = [&](auto& thing) {
        meshes.push_back(&thing.mesh);
        sources.push_back(&thing.source);
    };
    for (BoneEntry& bone : bones_)
        if (!bone.of_model)
            add(bone.bone);
    for (MuscleEntry& muscle : muscles_)
        if (muscle.line < 0)
            add(muscle.muscle);
    scene_.unit = r_.unit.value_or(LengthUnit::metre);
    if (!meshes.empty())
        settle_units(meshes, sources, r_.unit, scene_.unit, loaded_.notes);
    units_ = scene_units_per_metre(scene_.unit);
    if (!meshes.empty())
        say(std::string("the model is in metres, ") + (scene_.unit == LengthUnit::metre
                                                           ? "as the meshes"
                                                           : "taken times 1000 to the meshes' millimetres"));
}

void OsimSceneLoader::choose_frame() {
    std::vector<char> with_bone(skeleton().bodies.size(), 0);
    std::vector<TriedBone> bones;
    bool files = false;
    for (const BoneEntry& bone : bones_) {
        with_bone[static_cast<std::size_t>(bone.body)] = 1;
        files = files || !bone.of_model;
    }
    std::vector<TriedMuscle> muscles;
    for (const MuscleEntry& muscle : muscles_) {
        if (muscle.line >= 0)
            continue;
        files = true;
        const Points& all = muscle.muscle.mesh->positions;
        const std::size_t stride = std::max<std::size_t>(1, all.size() / tried_points);
        TriedMuscle tried{muscle.bodies, {}};
        for (std::size_t i = 0; i < all.size(); i += stride)
            tried.points.push_back(all[i] / units_);
        muscles.push_back(std::move(tried));
    }
    for (const BoneEntry& bone : bones_) {
        const bool asked = std::any_of(muscles.begin(), muscles.end(), [&](const TriedMuscle& m) {
            return std::count(m.bodies.begin(), m.bodies.end(), bone.body) > 0;
        });
        if (!asked && bone.of_model)
            continue;
        TriMesh mesh = *bone.bone.mesh;
        for (Vec3& p : mesh.positions)
            p /= bone.of_model ? 1.0 : units_;
        bones.push_back({bone.body, bone.of_model, std::make_shared<const SolidQuery>(mesh)});
    }
    double best = std::numeric_limits<double>::infinity(), best_muscles = 0;
    std::string figures;
    const Mat3 axes = motion_.ground.rotation;
    for (const MeshFrame frame : {MeshFrame::body, MeshFrame::ground, MeshFrame::scan}) {
        if (r_.osim.mesh_frame ? frame != *r_.osim.mesh_frame : !files && frame != MeshFrame::body)
            continue;
        FramePlacement placement = place_frame(*model_, frame, axes, with_bone);
        const Misfit fit = misfit(placement, *model_, muscles, bones);
        const double total = fit.muscles + fit.ends;
        figures += (figures.empty() ? "" : ", ") + std::string(to_text(frame)) + ' ' +
                   fixed(1000 * total, 1) + " mm";
        if (placement_.rest.empty() || total < best - same_fit_m) {
            best = total;
            best_muscles = fit.muscles;
            placement_ = std::move(placement);
        }
    }
    motion_.mesh_frame = placement_.frame;
    motion_.ground = placement_.ground;
    motion_.rest = placement_.rest;
    motion_.rest_values = placement_.rest_values;
    if (!files)
        return;
    const char* const meaning[] = {"in the frame of their (first) body; rest is the model's default posture",
                                   "in the model's ground; rest is the model's default posture",
                                   "in one frame that is that of every body, as scanned"};
    say(std::string("meshes are ") + (r_.osim.mesh_frame ? "taken to be " : "guessed to be ") +
        meaning[static_cast<int>(placement_.frame)] +
        "; muscles and ends of the model's lines miss the bones by: " + figures +
        (r_.osim.mesh_frame ? "" : "; --mesh-frame tells otherwise"));
    if (placement_.frame == MeshFrame::scan)
        say_posture();
    if (best_muscles > far_m)
        throw_error(where_,
                    "muscles are " + fixed(1000 * best_muscles, 0) +
                        " mm away from or inside of their bones (" + figures + ")",
                    "meshes of the model's specimen; --units and --mesh-frame tell how they are meant");
}

void OsimSceneLoader::say_posture() {
    std::string values;
    const std::vector<double> start = skeleton().default_values();
    for (std::size_t c = 0; c < start.size(); ++c)
        if (std::abs(motion_.rest_values[c] - start[c]) > 1e-4)
            values += (values.empty() ? "" : ", ") + coordinate_column(skeleton().coordinates[c]) + ' ' +
                      fixed(coordinate_number(skeleton().coordinates[c], motion_.rest_values[c]), 1);
    if (!values.empty())
        say("the scan is nearest to the model's posture " + values);
}

MeshPtr OsimSceneLoader::placed(const MeshPtr& mesh, const Pose& pose, double scale) const {
    if (scale == 1 && pose.is_identity())
        return mesh;
    TriMesh moved = *mesh;
    const Vec3 shift = units_ * pose.translation;
    for (Vec3& p : moved.positions)
        p = pose.rotation * (scale * p) + shift;
    return std::make_shared<const TriMesh>(std::move(moved));
}

void OsimSceneLoader::place_bones() {
    motion_.bone_of_body.assign(skeleton().bodies.size(), "");
    for (BoneEntry& entry : bones_) {
        const MeshPtr mesh =
            entry.of_model
                ? placed(entry.bone.mesh, placement_.rest[static_cast<std::size_t>(entry.body)], units_)
                : placed(entry.bone.mesh, file_pose(placement_, entry.body), 1);
        if (mesh != entry.bone.mesh)
            entry.bone.source.hash.clear(); // no longer what the file holds
        entry.bone.mesh = mesh;
        motion_.bone_of_body[static_cast<std::size_t>(entry.body)] = entry.bone.name;
        scene_.bones.push_back(entry.bone);
    }
    if (r_.osim.axes == AxisMapping::as_is && !r_.bones.empty())
        return;
    if (r_.osim.axes == AxisMapping::as_is)
        say("the model's axes are kept; views are named for x left, y posterior, z up. For a model with "
            "X forward, Y up: "
            "--axes opensim_to_lps");
    else
        say(std::string("axes turned: ") + motion_.axes);
}

void OsimSceneLoader::place_muscles() {
    std::vector<std::shared_ptr<const SolidQuery>> solids;
    for (MuscleEntry& entry : muscles_) {
        control_.checkpoint("read", 0.7);
        for (const int body : entry.bodies)
            entry.muscle.attach_to.push_back(motion_.bone_of_body[static_cast<std::size_t>(body)]);
        if (entry.line >= 0) {
            if (solids.empty())
                for (const Bone& bone : scene_.bones)
                    solids.push_back(std::make_shared<const SolidQuery>(*bone.mesh));
            make_stand_in(entry, solids);
        } else {
            const MeshPtr mesh = placed(entry.muscle.mesh, file_pose(placement_, entry.bodies.front()), 1);
            if (mesh != entry.muscle.mesh)
                entry.muscle.source.hash.clear();
            entry.muscle.mesh = mesh;
        }
        scene_.muscles.push_back(entry.muscle);
    }
    scene_.name = scene_.muscles.empty() ? model_->name : scene_.muscles[0].name;
    if (scene_.name.empty())
        scene_.name = r_.osim.model.stem().string();
}

Points OsimSceneLoader::rest_path(int line) const {
    Posture posture;
    set_posture(skeleton(), motion_.rest_values, posture);
    posture.poses = placement_.rest;
    LinePathSolver solver(*model_);
    solver.solve(line, posture);
    Points path;
    solver.draw(posture, path);
    for (Vec3& p : path)
        p *= units_;
    return path;
}

void OsimSceneLoader::make_stand_in(MuscleEntry& entry,
                                    const std::vector<std::shared_ptr<const SolidQuery>>& solids) {
    const LineMuscle& line = model_->muscles[static_cast<std::size_t>(entry.line)];
    SpindleRequest request;
    request.path = rest_path(entry.line);
    double length = 0;
    for (std::size_t i = 1; i < request.path.size(); ++i)
        length += (request.path[i] - request.path[i - 1]).norm() / units_;
    const double volume = line_muscle_volume_m3(line.max_isometric_force_n, line.optimal_fibre_length_m);
    if (!std::isfinite(length) || !(length > 1e-3) || !(length < 10) || !(volume > 1e-9) || !(volume < 0.1))
        throw_error(where_,
                    "line muscle '" + line.name + "' is " + fixed(1000 * length, 1) + " mm long and of " +
                        fixed(1e6 * std::min(volume, 1.0), 3) + " cm3: no surface can stand in for it",
                    "1 mm to 10 m and 0.001 cm3 to 0.1 m3");
    request.volume = volume * units_ * units_ * units_;
    request.bones = solids;
    request.clearance = clearance_m * units_;
    const Spindle spindle = make_spindle(request);
    if (!(spindle.volume > 0))
        throw_error(where_, "no surface can stand in for line muscle '" + line.name + "' beside these bones",
                    "a mesh of the muscle");
    entry.muscle.mesh = std::make_shared<const TriMesh>(spindle.mesh);
    const int origin = bone_index(entry.bodies.front()), insertion = bone_index(entry.bodies.back());
    entry.muscle.attachments = {{AttachmentKind::origin, origin, spindle.origin},
                                {AttachmentKind::insertion, insertion, spindle.insertion}};
    entry.muscle.attach_automatically = false;
    const double cubic_cm = spindle.volume / (units_ * units_ * units_) * 1e6;
    say(line.name + ": no mesh, a spindle stands in for it: " + fixed(cubic_cm, 1) + " cm3 (" +
        fixed(line.max_isometric_force_n, 0) + " N / 60 N/cm2 x " +
        fixed(100 * line.optimal_fibre_length_m, 1) + " cm), " + fixed(1000 * spindle.length / units_, 0) +
        " mm along the model's path, at most " + fixed(2000 * spindle.radius / units_, 0) + " mm thick" +
        (spindle.largest_shift > clearance_m * units_
             ? ", its axis pushed off the bones by up to " + fixed(1000 * spindle.largest_shift / units_, 0) +
                   " mm"
             : std::string()) +
        (spindle.inside > 0 ? "; " + std::to_string(spindle.inside) + " vertices are inside of a bone"
                            : std::string()));
}

int OsimSceneLoader::bone_index(int body) const {
    return scene_.bone_index(motion_.bone_of_body[static_cast<std::size_t>(body)]);
}

void OsimSceneLoader::make_motion() {
    for (const std::string& note : table_->notes)
        if (note.find("several columns") == std::string::npos) // of what is no coordinate, mostly
            say(r_.motion.filename().string() + ": " + note);
    std::vector<std::string> notes;
    read_trial_frames(*table_, motion_, notes);
    for (const std::string& note : notes)
        say(r_.motion.filename().string() + ": " + note);
    std::vector<int> bodies;
    for (const MuscleEntry& muscle : muscles_)
        bodies.insert(bodies.end(), muscle.bodies.begin(), muscle.bodies.end());
    motion_.coordinate =
        r_.osim.coordinate.empty() ? main_coordinate(motion_, bodies) : coordinate_named(r_.osim.coordinate);
    scene_.timeline = model_motion_timeline(motion_, scene_);
    scene_.motion_source = motion_.trial_source;
    scene_.parameters.set("solver.frame_time", std::clamp(motion_.frame_s, 1e-4, 1.0));
    scene_.line_muscles = model_->muscles.empty() ? nullptr : model_lines(motion_);
    const int last = scene_.timeline.last_frame;
    say(r_.motion.filename().string() + ": frames " + std::to_string(motion_.lead_in) + " to " +
        std::to_string(last) + " are " + fixed(motion_.first_s, 3) + " to " +
        fixed(motion_.first_s + (last - motion_.lead_in) * motion_.frame_s, 3) + " s, " +
        fixed(1 / motion_.frame_s, 1) + " a second" +
        (motion_.lead_in > 0 ? "; frames before lead there from rest" : "; its first row is rest"));
    if (motion_.coordinate >= 0)
        say("angle_deg is " + skeleton().coordinates[static_cast<std::size_t>(motion_.coordinate)].name +
            (r_.osim.coordinate.empty() ? "; --coordinate tells another one" : ""));
    scene_.model_motion = std::make_shared<const ModelMotion>(std::move(motion_));
}

} // namespace fascicle::io
