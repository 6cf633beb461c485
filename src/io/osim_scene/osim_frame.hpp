#pragma once
// In which frame mesh files lie that go with a model's bodies.

#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/scene/model_motion.hpp"

namespace fascicle::io {

/// Where bodies are at rest, and in which posture.
struct FramePlacement {
    MeshFrame frame = MeshFrame::body;
    Pose ground;            ///< of the model's ground in the scene
    std::vector<Pose> rest; ///< per body, scene axes, metres
    std::vector<double> rest_values;
};
/// axes: of ground into the scene. A scan's own axes are the scene's, turned by `axes`.
FramePlacement place_frame(const LineModel& model, MeshFrame frame, const Mat3& axes,
                           const std::vector<char>& bodies_with_bone);

/// Pose of a file's vertices (in metres) in the scene at rest. body: the (first) one of the mesh.
Pose file_pose(const FramePlacement& placement, int body);

/// A bone as the placements are tried on: its surface in metres, in its body's frame (of the model), or as in its own file.
struct TriedBone {
    int body = 0;
    bool in_body_frame = true;
    std::shared_ptr<const SolidQuery> solid;
};
struct TriedMuscle {
    std::vector<int> bodies;
    Points points; ///< some vertices, as in its file, metres
};

/// How badly things fit in a placement, metres; 0 where there is nothing to tell.
struct Misfit {
    /// Mean over muscles and their bodies of the distance between the surfaces or, where they overlap, of the deepest vertex's depth.
    double muscles = 0;
    /// Mean distance of the ends of the model's line muscles to the surfaces of bones that are files: it tells ground from scan.
    double ends = 0;
};
Misfit misfit(const FramePlacement& placement, const LineModel& model,
              const std::vector<TriedMuscle>& muscles, const std::vector<TriedBone>& bones);

} // namespace fascicle::io
