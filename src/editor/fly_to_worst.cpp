#include "editor/fly_to_worst.hpp"

#include "editor/scene_view.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "fascicle/metrics/worst_vertex.hpp"

#include <cstdio>

namespace fascicle::editor {

namespace {

/// The scene as its meshes are, for before there is a run.
FramePtr mesh_frame(const Scene& scene) {
    auto frame = std::make_shared<Frame>();
    frame->bone_poses.resize(scene.bones.size());
    for (const Muscle& muscle : scene.muscles)
        frame->muscle_positions.push_back(view::mesh_points(muscle.mesh));
    return frame;
}

std::vector<std::vector<Attachment>> attachments_of(const view::ViewSubject& subject) {
    if (!subject.attachments.empty())
        return subject.attachments;
    std::vector<std::vector<Attachment>> lists;
    for (const Muscle& muscle : subject.scene->muscles)
        lists.push_back(muscle.attachments);
    return lists;
}

std::string sentence(const Scene& scene, const WorstVertex& worst, const FramePtr& frame) {
    const std::string& muscle = scene.muscles[static_cast<std::size_t>(worst.muscle)].name;
    const std::string& bone = scene.bones[static_cast<std::size_t>(worst.bone)].name;
    const std::string vertex = "vertex " + std::to_string(worst.vertex) + " of " + muscle;
    const std::string where = frame ? " in frame " + std::to_string(frame->index) : std::string(" at rest");
    char depth[40];
    std::snprintf(depth, sizeof depth, "%.2f mm", std::abs(worst.depth_mm));
    const std::string side = worst.depth_mm > 0 ? " inside " : " from ";
    return (worst.penetrating ? "Deepest: " : "Nothing penetrates; nearest free one: ") + vertex + ", " +
           depth + side + bone + where;
}

} // namespace

void fly_to_worst(EditorContext& context) {
    const view::ViewSubject subject = view_subject(context);
    const Scene& scene = *subject.scene;
    const FramePtr frame = subject.frame ? subject.frame : mesh_frame(scene);
    const FramePtr rest = subject.rest ? subject.rest : frame;
    const std::optional<WorstVertex> worst =
        worst_vertex(scene, *rest, *frame, attachments_of(subject), bone_solids(scene), hardware_threads());
    if (!worst) {
        context.log.add(Severity::warning, "No muscle has a free vertex near a bone");
        return;
    }
    const double half = worst_vertex_surroundings_mm / millimetres_per_unit(scene.unit);
    // A square across the line of sight: the vertex is in the middle of the picture, and the pivot of the next turn.
    view::Camera& camera = context.state.camera;
    Points square;
    for (const double side : {-half, half})
        for (const Vec3& way : {camera.right(), camera.up()})
            square.push_back(worst->point + side * way);
    camera.frame(square, context.state.view_aspect);
    context.log.add(Severity::note, sentence(scene, *worst, subject.frame));
}

} // namespace fascicle::editor
