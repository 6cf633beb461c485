// The model and trial of a project.
#include "fascicle/base/error.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"
#include "io/osim_scene/osim_scene.hpp"
#include "io/project_json.hpp"

namespace fascicle::io {

void ProjectReader::opensim(const JsonFields& entry, Scene& scene) {
    ModelMotion motion;
    const JsonFields model = entry.object("model"), trial = entry.object("trial");
    const std::string frame = entry.text("mesh_frame", "body");
    for (const MeshFrame known : {MeshFrame::body, MeshFrame::ground, MeshFrame::scan})
        if (frame == to_text(known))
            motion.mesh_frame = known;
    if (frame != to_text(motion.mesh_frame))
        entry.fail("mesh_frame", "got '" + frame + "'", "body, ground or scan");
    motion.axes = entry.text("axes", "as_is");
    bool known_axes = false;
    for (const AxisMappingRow& row : axis_mappings())
        if (motion.axes == row.key) {
            motion.ground.rotation = axis_matrix(row.mapping);
            known_axes = true;
        }
    if (!known_axes)
        entry.fail("axes", "got '" + motion.axes + "'",
                   "as_is, ras_to_lps, opensim_to_lps or lps_to_opensim");
    if (entry.has("from_s"))
        motion.reading.from_s = entry.number("from_s", 0);
    if (entry.has("to_s"))
        motion.reading.to_s = entry.number("to_s", 0);
    motion.reading.frames = entry.integer("trial_frames", 0);
    if (motion.reading.frames < 0 || motion.reading.frames > 100000)
        entry.fail("trial_frames", "out of range", "1 to 100000");
    read_model_of(motion, resolved(model));
    const Skeleton& skeleton = motion.model->skeleton;
    motion.bone_of_body.assign(skeleton.bodies.size(), "");
    for (const JsonFields& item : entry.objects("bodies")) {
        const int body = skeleton.body_index(item.text("body"));
        if (body < 0)
            item.fail("body", "the model has no body '" + item.text("body") + "'", "a body of the model");
        motion.bone_of_body[static_cast<std::size_t>(body)] = item.text("bone");
    }
    try {
        read_trial_of(motion, resolved(trial), *notes_);
    } catch (const Error& error) {
        if (motion.trial_source.hash.empty() || motion.trial_source.hash == trial.text("hash"))
            throw;
        // Another trial under the same name: what the project itself has still counts.
        notes_->push_back(std::string(error.what()) +
                          "; the project's own motion stays, without the model's coordinates and lines");
        return;
    }
    if (entry.has("coordinate")) {
        motion.coordinate = skeleton.coordinate_index(entry.text("coordinate"));
        if (motion.coordinate < 0)
            entry.fail("coordinate", "the model has no coordinate '" + entry.text("coordinate") + "'",
                       "a coordinate of the model");
    }
    compare(model, motion.model_source);
    compare(trial, motion.trial_source);
    if (entry.flag("lines", true) && !motion.model->muscles.empty())
        scene.line_muscles = model_lines(motion);
    scene.model_motion = std::make_shared<const ModelMotion>(std::move(motion));
}

} // namespace fascicle::io
