#include "reproduce/experiment_scene.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "reproduce/sweep.hpp"

#include <algorithm>
#include <numbers>

namespace fascicle::reproduce {

namespace {

const double flexion_deg =
    -57.295779513082323; // 1 rad forwards: a negative angle about +x (docs/conventions.md)
const double radians = std::numbers::pi / 180;
const double squeeze = -90; // units in y, of a gap of 100

/// The files of a row, found; `missing` names those that are needed and not there.
struct FoundFiles {
    SceneRequest request;
    std::string missing;
};

FoundFiles find_files(const Experiment& e, const DataFiles& data) {
    FoundFiles found;
    const auto need = [&](const std::string& name, std::vector<std::filesystem::path>& into) {
        if (const auto path = data.find(name))
            into.push_back(*path);
        else
            found.missing += (found.missing.empty() ? "" : ", ") + name;
    };
    SceneRequest& r = found.request;
    need(e.muscle_file, r.muscles);
    for (const std::string& name : e.fixed_bones)
        need(name, r.bones);
    for (const std::string& name : e.moving_bones)
        need(name, r.moving_bones);
    if (!e.attachments.empty())
        if (const auto path = data.find(e.attachments))
            r.attachments = {{e.muscle, *path}};
    if (!e.surface_fibres.empty())
        if (const auto path = data.find(e.surface_fibres))
            r.surface_fibres = {{e.muscle, *path}};
    if (!e.line_model.empty())
        if (const auto path = data.find(e.line_model))
            r.lines = *path;
    return found;
}

/// The box between its plates from files: nothing is attached, one plate is shifted.
Scene squeezed_scene(const SceneRequest& request, std::vector<std::string>& notes) {
    // The parameters that suit a squeeze to a tenth are those of the embedded scene (squish_box.cpp).
    Scene scene = make_embedded_scene("squish-box");
    const Timeline timeline = scene.timeline;
    scene.name = "box";
    scene.embedded_name.clear();
    scene.bones.clear();
    scene.muscles.clear();
    for (const auto* list : {&request.moving_bones, &request.bones})
        for (const std::filesystem::path& path : *list)
            scene.bones.push_back(load_bone(path, notes));
    scene.muscles.push_back(load_muscle(request.muscles.front(), notes));
    scene.muscles.front().attach_automatically = false;
    scene.timeline =
        make_shift_timeline(Vec3(0, squeeze, 0), {100, 100, 100}, static_cast<int>(scene.bones.size()), 0);
    FASCICLE_ASSERT(scene.timeline.last_frame == timeline.last_frame);
    return scene;
}

void add_inputs(const SceneRequest& r, std::set<std::filesystem::path>& inputs) {
    for (const auto* list : {&r.muscles, &r.bones, &r.moving_bones})
        inputs.insert(list->begin(), list->end());
    for (const auto* list : {&r.attachments, &r.surface_fibres})
        for (const auto& [name, path] : *list)
            inputs.insert(path);
    if (!r.lines.empty())
        inputs.insert(r.lines);
}

} // namespace

ExperimentScene make_experiment_scene(const Experiment& e, const DataFiles& data, int threads) {
    ExperimentScene result;
    FoundFiles found = find_files(e, data);
    if (found.missing.empty()) {
        result.real = true;
        add_inputs(found.request, result.inputs);
        if (e.motion == MotionKind::squeeze) {
            result.scene = squeezed_scene(found.request, result.notes);
        } else {
            SceneRequest& r = found.request;
            const bool sweeps = is_sweep(e.motion);
            r.hinge = HingeRequest{e.centre, sweeps ? sweep_turn(e.motion).axis : Vec3::UnitX()};
            r.angle_deg = sweeps ? sweep_turn(e.motion).to_deg - sweep_turn(e.motion).rest_deg : flexion_deg;
            r.unit = LengthUnit::millimetre;
            r.threads = threads;
            LoadedScene loaded = load_scene(r);
            result.scene = std::move(loaded.scene);
            if (sweeps) {
                const SweepTurn turn = sweep_turn(e.motion);
                result.scene.timeline =
                    through_rest(result.scene.timeline, radians * (-turn.to_deg - turn.rest_deg));
            }
            result.notes = std::move(loaded.notes);
        }
    } else if (!e.stand_in.empty()) {
        result.scene = make_embedded_scene(e.stand_in, threads);
        const std::string& name = e.stand_in_muscle.empty() ? e.muscle : e.stand_in_muscle;
        std::erase_if(result.scene.muscles, [&](const Muscle& m) { return m.name != name; });
        FASCICLE_ASSERT(result.scene.muscles.size() == 1);
        result.notes.push_back("not in the data: " + found.missing + "; the embedded scene '" + e.stand_in +
                               "' stands in");
    } else {
        result.missing = "not in the data: " + found.missing;
        return result;
    }
    if (e.fibres != "none")
        result.scene.parameters.set_text("fibres.method", e.fibres);
    return result;
}

Timeline in_frames(const Timeline& timeline, int frames) {
    FASCICLE_ASSERT(frames >= 1 && timeline.last_frame >= 1);
    Timeline result = timeline;
    if (frames == timeline.last_frame)
        return result;
    const double factor = static_cast<double>(frames) / timeline.last_frame;
    for (BoneTrack& track : result.bone_tracks)
        for (PoseKey& key : track.keys)
            key.frame *= factor;
    for (AngleKey& key : result.angles)
        key.frame *= factor;
    result.last_frame = frames;
    return result;
}

} // namespace fascicle::reproduce
