#pragma once
// A painted attachment area against the true one.

#include "fascicle/geometry/region_overlap.hpp"
#include "fascicle/io/lesson_file.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle::editor {

/// The true area of a quiz: on the bone, under the attachment that the lesson's scene was made with.
struct Quiz {
    std::string muscle, bone;
    AttachmentKind kind = AttachmentKind::insertion;
    SurfaceGraph graph; ///< of the bone
    SurfaceRegion truth;
    std::vector<std::pair<Vec3, Vec3>> border; ///< segments round the truth, on the bone at rest
    Points border_normals;                     ///< of the surface at each segment

    double truth_mm2(const Scene& scene) const;
};

/// Error naming the muscle or bone when the scene has no such attachment.
std::unique_ptr<Quiz> make_quiz(const LessonQuiz& question, const Scene& scene);

/// The areas of that muscle, kind and bone together against the truth; areas in scene units squared.
RegionOverlap score_quiz(const Quiz& quiz, const Scene& scene);

} // namespace fascicle::editor
