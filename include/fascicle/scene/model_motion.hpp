#pragma once
// A measured trial of a model (OpenSim) that moves the bones of a scene: which body each bone is, and the coordinates of every frame.

#include "fascicle/anatomy/line_path.hpp"
#include "fascicle/scene/scene.hpp"

#include <optional>

namespace fascicle {

/// Where the vertices of mesh files are that go with a model's bodies.
enum class MeshFrame {
    body,   ///< in the frame of their (first) body; rest is the model's default posture
    ground, ///< in the model's ground; rest is the model's default posture
    scan ///< in one frame that is that of every body at once: the bones as they lay; rest is the posture nearest to that
};
const char* to_text(MeshFrame frame);

/// How a trial was read, kept with projects so that reading it again gives the same frames.
struct TrialReading {
    std::optional<double> from_s, to_s; ///< part of the trial; absent: all of it
    int frames = 0;                     ///< after the lead-in; 0: the trial's own rate
    friend bool operator==(const TrialReading&, const TrialReading&) = default;
};

/// A plain value. Model: metres, radians. A body's point p (its own frame) is in the scene at
///   units * ground * X_body(q) * p,
/// X_body: place_bodies of the skeleton, units = scene_units_per_metre; in frame 0, rest, at units * rest[body] * p.
struct ModelMotion {
    std::shared_ptr<const LineModel> model;
    MeshSource model_source, trial_source;
    MeshFrame mesh_frame = MeshFrame::body;
    std::string axes = "as_is"; ///< key of the axis mapping
    TrialReading reading;
    Pose
        ground; ///< of the model's ground in the scene, metres: the axes; of a scan what puts its first body at the origin, too
    std::vector<std::string> bone_of_body; ///< one per body: name of its bone, or empty
    std::vector<Pose> rest;                ///< one per body, scene axes, metres
    std::vector<double> rest_values;       ///< one per coordinate: the posture at rest
    int lead_in = 0;                 ///< frame of the trial's first row; frames before lead there from rest
    double first_s = 0, frame_s = 0; ///< trial time of frame lead_in; time between frames
    std::vector<double> values;      ///< frame-major, last_frame + 1 by coordinates; couplers applied
    std::vector<int> moving;         ///< coordinates that change over the frames, in the model's order
    int coordinate = -1;             ///< the one that `angle_deg` is; -1: none turns

    std::size_t coordinate_count() const { return rest_values.size(); }
    int frame_count() const {
        return rest_values.empty() ? 0 : static_cast<int>(values.size() / rest_values.size());
    }
    /// Values of all coordinates in a frame, 0 <= frame < frame_count().
    std::span<const double> at(int frame) const {
        return {values.data() + static_cast<std::size_t>(frame) * coordinate_count(), coordinate_count()};
    }
    /// Of a body in a frame: from its own frame to the scene's axes, metres. poses: of place_bodies at the frame's values.
    Pose body_pose(std::size_t body, int frame, std::span<const Pose> poses) const;
};

/// The scene's model motion while its timeline is still the trial's (motion_source says so) or the beginning of it, else null.
const ModelMotion* model_motion_in_force(const Scene& scene);

/// Column name of a coordinate's values: NAME_deg, or NAME_mm for one that shifts.
std::string coordinate_column(const Coordinate& coordinate);
/// A value in that column's unit.
double coordinate_number(const Coordinate& coordinate, double value);

/// The timeline of the trial: a key per frame for each bone of a body, in scene units; angles are the values of `coordinate`.
/// Error naming the trial when a bone would turn by half a turn or more in a frame, or when no bone moves.
Timeline model_motion_timeline(const ModelMotion& motion, const Scene& scene);

/// The coordinate that names the frames when nobody says which: of the rotational ones that change and turn one of `bodies`
/// against another one of them, the one that changes most; else of all that turn any bone's body; -1: none.
int main_coordinate(const ModelMotion& motion, const std::vector<int>& bodies);

} // namespace fascicle
