#include "editor/teach/quiz.hpp"

#include "fascicle/anatomy/area_from_attachment.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/region_border.hpp"
#include "fascicle/geometry/region_measure.hpp"

namespace fascicle::editor {

namespace {

/// How far the surface of a muscle may lie from the bone that it is fixed to.
constexpr double tolerance_mm = 2.0;

} // namespace

double Quiz::truth_mm2(const Scene& scene) const {
    const double mm = millimetres_per_unit(scene.unit);
    return measure_region(graph, truth).area * mm * mm;
}

std::unique_ptr<Quiz> make_quiz(const LessonQuiz& question, const Scene& scene) {
    const int muscle = scene.muscle_index(question.muscle), bone = scene.bone_index(question.bone);
    if (muscle < 0 || bone < 0)
        throw_error("quiz", "no '" + (muscle < 0 ? question.muscle : question.bone) + "' in the scene",
                    "a muscle and a bone of it");
    const Muscle& body = scene.muscles[static_cast<std::size_t>(muscle)];
    auto quiz = std::make_unique<Quiz>(
        Quiz{question.muscle,
             question.bone,
             question.kind == "origin" ? AttachmentKind::origin : AttachmentKind::insertion,
             SurfaceGraph(scene.bones[static_cast<std::size_t>(bone)].mesh),
             {},
             {},
             {}});
    quiz->truth = SurfaceRegion(quiz->graph.vertex_count());
    for (const Attachment& attachment : body.attachments)
        if (attachment.bone == bone && attachment.kind == quiz->kind)
            quiz->truth |= area_from_attachment(quiz->graph, *body.mesh, attachment,
                                                tolerance_mm / millimetres_per_unit(scene.unit));
    if (quiz->truth.empty())
        throw_error("quiz", question.muscle + " has no " + question.kind + " on " + question.bone,
                    "an attachment in the scene");
    const TriMesh& mesh = quiz->graph.mesh();
    for (const BorderLoop& loop : region_border(quiz->graph, quiz->truth)) {
        const Points points = border_positions(quiz->graph, loop);
        for (std::size_t i = 0; i < points.size() && points.size() > 1; ++i) {
            if (i + 1 == points.size() && !loop.closed)
                break;
            quiz->border.emplace_back(points[i], points[(i + 1) % points.size()]);
            quiz->border_normals.push_back(Vec3::Zero());
        }
    }
    // Which way the surface faces at each segment: that of the nearest triangle with a corner there is close enough.
    Points normals(mesh.positions.size(), Vec3::Zero());
    for (int t = 0; t < mesh.triangle_count(); ++t)
        for (const int v : mesh.triangles[static_cast<std::size_t>(t)])
            normals[static_cast<std::size_t>(v)] += quiz->graph.normal(t);
    std::size_t at = 0;
    for (const BorderLoop& loop : region_border(quiz->graph, quiz->truth))
        for (std::size_t i = 0; i < loop.points.size() && loop.points.size() > 1; ++i) {
            if (i + 1 == loop.points.size() && !loop.closed)
                break;
            quiz->border_normals[at++] =
                normals[static_cast<std::size_t>(loop.points[i].inside)].stableNormalized();
        }
    return quiz;
}

RegionOverlap score_quiz(const Quiz& quiz, const Scene& scene) {
    SurfaceRegion painted(quiz.graph.vertex_count());
    const int muscle = scene.muscle_index(quiz.muscle), bone = scene.bone_index(quiz.bone);
    if (muscle >= 0 && bone >= 0)
        for (const AttachmentArea& area : scene.muscles[static_cast<std::size_t>(muscle)].areas)
            if (area.bone == bone && area.kind == quiz.kind &&
                area.vertices.vertex_count() == painted.vertex_count())
                painted |= area.vertices;
    return overlap_of(quiz.graph, painted, quiz.truth);
}

} // namespace fascicle::editor
