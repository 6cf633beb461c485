#include "output/animation_export.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/run_provenance.hpp"
#include "output/data_export.hpp"
#include "output/staged_files.hpp"

namespace fascicle::output {
namespace fs = std::filesystem;

namespace {

AnimatedBody muscle_body(const Recording& recording, std::size_t m, const std::vector<FramePtr>& frames) {
    const Muscle& muscle = recording.scene().muscles[m];
    AnimatedBody body;
    body.name = muscle.name;
    body.kind = BodyKind::muscle;
    body.triangles = muscle.mesh->triangles;
    body.rest = *frames[0]->muscle_positions[m];
    body.points = [frames, m](std::size_t k, Points& points) { points = *frames[k]->muscle_positions[m]; };
    return body;
}

AnimatedBody fibre_body(const Recording& recording, std::size_t m, const FibreModelPtr& model,
                        const std::vector<FramePtr>& frames) {
    AnimatedBody body;
    body.name = recording.scene().muscles[m].name + " fibres";
    body.kind = BodyKind::fibres;
    const auto per_fibre = static_cast<int>(model->rest.points_per_fibre());
    for (int f = 0; f < model->rest.count; ++f) {
        std::vector<int> line;
        for (int i = 0; i < per_fibre; ++i)
            line.push_back(f * per_fibre + i);
        body.lines.push_back(std::move(line));
    }
    body.points = [model, frames, m](std::size_t k, Points& points) {
        points.resize(model->rest.points.size());
        model->carrier.carry(*frames[k]->muscle_positions[m], points);
    };
    body.points(0, body.rest);
    return body;
}

/// Leaves frames at equal distances: where the last one was added beside the steps, it goes.
void make_even(std::vector<int>& places, const Recording& recording) {
    std::vector<int> numbers;
    for (const int place : places)
        numbers.push_back(recording.frame(place)->index);
    while (numbers.size() > 1 && !evenly_spaced(numbers)) {
        numbers.pop_back();
        places.pop_back();
    }
}

} // namespace

Animation animation_of(const Recording& recording, const ExportRequest& request, bool even) {
    const Scene& scene = recording.scene();
    std::vector<int> places = chosen_frames(recording, request);
    if (even)
        make_even(places, recording);
    Animation animation;
    animation.name = scene.name;
    animation.millimetres_per_unit = millimetres_per_unit(scene.unit);
    animation.up = request.up;
    animation.provenance = run_provenance(recording);
    const double frame_time = scene.parameters.get("solver.frame_time");
    std::vector<FramePtr> frames;
    for (const int place : places) {
        frames.push_back(recording.frame(place));
        animation.frames.push_back(frames.back()->index);
        animation.seconds.push_back(frames.back()->index * frame_time);
    }
    const std::vector<FibreModelPtr> models = recording.fibres();
    for (std::size_t m = 0; m < scene.muscles.size(); ++m)
        animation.bodies.push_back(muscle_body(recording, m, frames));
    for (std::size_t m = 0; m < models.size(); ++m)
        if (models[m] != nullptr && models[m]->rest.count > 0)
            animation.bodies.push_back(fibre_body(recording, m, models[m], frames));
    for (std::size_t b = 0; b < scene.bones.size(); ++b) {
        AnimatedBody body;
        body.name = scene.bones[b].name;
        body.kind = BodyKind::bone;
        body.triangles = scene.bones[b].mesh->triangles;
        body.rest = scene.bones[b].mesh->positions;
        for (const FramePtr& frame : frames)
            body.poses.push_back(frame->bone_poses[b]);
        animation.bodies.push_back(std::move(body));
    }
    return animation;
}

void write_animation(const ExportRequest& request, const Recording& recording, const JobControl& control) {
    const AnimationFormat* format = find_animation_format(request.kind);
    FASCICLE_ASSERT(format != nullptr);
    const Animation animation = animation_of(recording, request, format->even_frames);
    const AnimationOptions options{request.morph_targets};
    if (!format->folder) {
        check_no_input(request.target, recording.scene());
        return format->write(request.target, animation, options, control);
    }
    StagedFiles files(request.target);
    format->write(files.place(), animation, options, control);
    files.commit(recording.scene());
}

void export_animation(const ExportRequest& request, const Animation& animation, const fs::path& source,
                      const JobControl& control) {
    const AnimationFormat* format = find_animation_format(request.kind);
    FASCICLE_ASSERT(format != nullptr);
    const AnimationOptions options{request.morph_targets};
    std::set<fs::path> inputs; // the file, and those that stand with it
    std::error_code error;
    const fs::path folder = source.has_parent_path() ? source.parent_path() : fs::path(".");
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == source.extension() || it->path().stem() == source.stem())
            inputs.insert(fs::weakly_canonical(it->path(), error));
    if (!format->folder) {
        if (fs::weakly_canonical(request.target, error) == fs::weakly_canonical(source, error))
            throw_error(request.target.string(), "the animation was read from this file", "another name",
                        ErrorKind::usage);
        return format->write(request.target, animation, options, control);
    }
    StagedFiles files(request.target);
    format->write(files.place(), animation, options, control);
    files.commit(inputs);
}

} // namespace fascicle::output
