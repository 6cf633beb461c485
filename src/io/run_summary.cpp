#include "io/run_summary.hpp"

#include "fascicle/base/build_info.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/run_provenance.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace fascicle {

std::string state_hash(const Frame& frame) {
    StateHash hash;
    for (const PointsPtr& positions : frame.muscle_positions)
        hash.add_points(*positions);
    return hash.hex();
}

RunSpeed run_speed(const Recording& recording) {
    std::vector<double> seconds;
    RunSpeed speed;
    for (int k = 1; k < recording.frame_count(); ++k) {
        seconds.push_back(recording.frame(k)->report.solve_seconds);
        speed.solve_seconds += seconds.back();
    }
    if (seconds.empty())
        return speed;
    std::sort(seconds.begin(), seconds.end());
    const std::size_t n = seconds.size();
    const double median = 0.5 * (seconds[(n - 1) / 2] + seconds[n / 2]);
    speed.fps_median = median > 0 ? 1.0 / median : 0.0;
    speed.fps_mean = speed.solve_seconds > 0 ? static_cast<double>(n) / speed.solve_seconds : 0.0;
    return speed;
}

namespace io {
namespace {

using Json = nlohmann::ordered_json;

const char* state_text(RunState state) {
    switch (state) {
    case RunState::running:
        return "running";
    case RunState::finished:
        return "finished";
    case RunState::cancelled:
        return "cancelled";
    case RunState::failed:
        return "failed";
    }
    return "failed";
}

template <typename Thing>
Json thing_json(const Thing& thing) {
    Json json{{"name", thing.name},
              {"vertices", thing.mesh->vertex_count()},
              {"triangles", thing.mesh->triangle_count()}};
    if (!thing.source.path.empty())
        json["path"] = thing.source.path;
    return json;
}

void add_input(Json& inputs, const MeshSource& source) {
    if (!source.path.empty())
        inputs.push_back({{"path", source.path}, {"hash", source.hash}});
}

Json parameters_json(const ParamSet& parameters) {
    Json json = Json::object();
    for (const ParamRow& row : parameters.table().rows()) {
        if (row.kind == ParamKind::choice)
            json[row.key] = parameters.get_choice(row.key);
        else if (row.kind == ParamKind::integer)
            json[row.key] = parameters.get_int(row.key);
        else
            json[row.key] = parameters.get(row.key);
    }
    return json;
}

/// Seconds per stage of the solver, summed over the frames and the muscles; of several threads the first one counts.
Json solve_stages(const Recording& recording) {
    std::map<std::string, double> stages;
    for (int k = 1; k < recording.frame_count(); ++k)
        for (const auto& [stage, seconds] : recording.frame(k)->report.stage_seconds)
            stages[stage] += seconds;
    return Json(stages);
}

/// What of an OpenSim model moved the bones.
Json model_json(const ModelMotion& motion) {
    const std::vector<Coordinate>& all = motion.model->skeleton.coordinates;
    Json json{{"name", motion.model->name},    {"mesh_frame", to_text(motion.mesh_frame)},
              {"axes", motion.axes},           {"lead_in_frames", motion.lead_in},
              {"first_row_s", motion.first_s}, {"frame_s", motion.frame_s}};
    if (motion.coordinate >= 0)
        json["coordinate"] = all[static_cast<std::size_t>(motion.coordinate)].name;
    json["bodies"] = Json::object();
    for (std::size_t b = 0; b < motion.bone_of_body.size(); ++b)
        if (!motion.bone_of_body[b].empty())
            json["bodies"][motion.model->skeleton.bodies[b].name] = motion.bone_of_body[b];
    return json;
}

} // namespace

std::string run_summary(const Recording& recording, const RunOutputOptions& options,
                        const std::vector<int>& vtp_frames, const std::vector<ExportedFile>& exports) {
    const Scene& scene = recording.scene();
    const RunSpeed speed = run_speed(recording);
    const FramePtr last = recording.last_frame();
    const auto attachments = recording.attachments();
    const auto fibres = recording.fibres();

    Json json;
    json["scene"] = scene.name;
    json["method"] = scene.parameters.get_choice("solver.method");
    json["threads"] = recording.threads() > 0 ? recording.threads() : options.threads;
    json["iterations"] = passes_per_frame(scene.parameters);
    json["frames"] = last ? last->index : 0;
    json["prepare_seconds"] = recording.prepare_seconds();
    json["solve_seconds"] = speed.solve_seconds;
    json["stage_seconds"] = solve_stages(recording);
    json["fps_median"] = speed.fps_median;
    json["fps_mean"] = speed.fps_mean;
    json["state_hash"] = last ? state_hash(*last) : std::string();
    json["state"] = state_text(recording.state());
    if (!recording.failure().empty())
        json["failure"] = recording.failure();
    json["frames_planned"] = scene.timeline.last_frame;
    json["embedded_scene"] = scene.embedded_name;
    json["unit"] = to_text(scene.unit);

    Json inputs = Json::array();
    json["muscles"] = Json::array();
    for (std::size_t m = 0; m < scene.muscles.size(); ++m) {
        const Muscle& muscle = scene.muscles[m];
        Json entry = thing_json(muscle);
        entry["attachments"] = Json::array();
        if (m < attachments.size())
            for (const Attachment& a : attachments[m])
                entry["attachments"].push_back(
                    {{"kind", to_text(a.kind)},
                     {"bone",
                      a.bone < 0 ? std::string() : scene.bones.at(static_cast<std::size_t>(a.bone)).name},
                     {"vertices", a.vertices.size()}});
        json["muscles"].push_back(std::move(entry));
        add_input(inputs, muscle.source);
        for (const MeshSource& source : muscle.outline_files)
            add_input(inputs, source);
        add_input(inputs, muscle.surface_fibres_source);
        add_input(inputs, muscle.fibre_template_source);
        if (m < fibres.size() && fibres[m] != nullptr) {
            Json seconds = Json::object();
            for (const auto& [stage, time] : fibres[m]->seconds)
                seconds[stage] = time;
            json["muscles"].back()["fibres"] = {{"method", scene.parameters.get_choice("fibres.method")},
                                                {"count", fibres[m]->rest.count},
                                                {"segments", fibres[m]->rest.segments},
                                                {"seconds", seconds}};
        }
    }
    json["bones"] = Json::array();
    for (const Bone& bone : scene.bones) {
        json["bones"].push_back(thing_json(bone));
        add_input(inputs, bone.source);
    }
    add_input(inputs, scene.motion_source);
    if (const ModelMotion* motion = model_motion_in_force(scene)) {
        add_input(inputs, motion->model_source);
        json["model"] = model_json(*motion);
    }
    if (scene.line_muscles != nullptr)
        add_input(inputs, scene.line_muscles->source);
    if (scene.timeline.hinge) {
        const Hinge& hinge = *scene.timeline.hinge;
        json["hinge"] = {{"centre", {hinge.centre.x(), hinge.centre.y(), hinge.centre.z()}},
                         {"axis", {hinge.axis.x(), hinge.axis.y(), hinge.axis.z()}}};
    }
    json["parameters"] = parameters_json(scene.parameters);
    json["inputs"] = std::move(inputs);
    json["notes"] = recording.notes();
    json["vtp_frames"] = vtp_frames;
    for (const ExportedFile& e : exports)
        json["exports"].push_back(
            {{"file", e.file.generic_string()}, {"bytes", e.bytes}, {"written", e.written}});
    json["program"] = {{"name", "fascicle"},
                       {"version", program_version()},
                       {"compiler", compiler_name()},
                       {"build", build_type()}};
    // Names may hold bytes that are no UTF-8: replaced rather than refused.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace io

std::string run_provenance(const Recording& recording) {
    const Scene& scene = recording.scene();
    const FramePtr last = recording.last_frame();
    io::Json json;
    json["program"] = std::string("fascicle ") + program_version();
    json["scene"] = scene.name;
    json["unit"] = to_text(scene.unit);
    json["method"] = scene.parameters.get_choice("solver.method");
    json["state_hash"] = last ? state_hash(*last) : std::string();
    json["parameters"] = io::parameters_json(scene.parameters);
    return json.dump(-1, ' ', false, io::Json::error_handler_t::replace);
}

} // namespace fascicle
