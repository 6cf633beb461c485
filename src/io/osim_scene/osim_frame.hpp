#pragma once
// In which frame mesh files lie that go with a model's bodies.

#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/scene/model_motion.hpp"

namespace fascicle::io {

/// Where bodies are at rest, and in which posture.
struct FramePlacement {
    MeshFrame frame = MeshFrame::body;
    std::vector<Pose> rest; ///< per body, scene axes, metres
    std::vector<double> rest_values;
};
FramePlacement place_frame(const LineModel& model, MeshFrame frame, const Mat3& axes,
                           const std::vector<char>& bodies_with_bone);

/// Pose of a file's vertices (in metres) in the scene at rest. body: the (first) one of the mesh.
Pose file_pose(const FramePlacement& placement, const Mat3& axes, int body);

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

/// How badly muscles and bones fit in a placement, metres: mean over muscles and their bodies of the distance between the surfaces or, where
/// they overlap, of the deepest vertex's depth. 0 without muscles.
double misfit(const FramePlacement& placement, const Mat3& axes, const std::vector<TriedMuscle>& muscles,
              const std::vector<TriedBone>& bones);

} // namespace fascicle::io
