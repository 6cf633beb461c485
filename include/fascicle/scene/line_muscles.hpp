#pragma once
// Line-segment muscles of a model among the bones of a scene: which bone carries which body, and where it is at rest.

#include "fascicle/anatomy/line_path.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// A plain value. Poses are in the axes of the scene and in metres, whatever the scene's unit is: a body's point p (its own
/// frame, metres) is at p_scene = scene_units_per_metre(unit) * rest[body].apply(p) at rest, and in a frame wherever the
/// bone's pose takes that.
struct LineMuscles {
    std::shared_ptr<const LineModel> model;
    std::vector<Pose> rest;                ///< one per body
    std::vector<std::string> bone_of_body; ///< one per body; empty, or no bone of the scene: it stays
    std::vector<double> rest_values; ///< one per coordinate: the posture of the model that is nearest to rest
    MeshSource source;
};

double scene_units_per_metre(LengthUnit unit);

/// Places a model in a scene. What is a scene's own frame for the model is found from where the ends of the muscles lie: of
///   the model's ground (bodies as in its default posture), the frame of one body (the others as in the default posture),
///   and the frame of each body at once (models whose bones were digitised as they lay)
/// the one that leaves the muscles' ends nearest to the bones in the mean; of equals the first. In the last case the rest values
/// are fitted: least squares of the bodies' places to each other.
/// A body belongs to the bone of its name, else to that of its name without `_r` or `_l`, else to the nearest bone, if the
/// ends of its muscles are within 5 mm of it in the median, else to the first bone that does not move. notes: a sentence per
/// decision. Bodies without points or wrap objects of muscles do not count.
/// Error naming `where`: no muscles, no body that belongs to a bone by its name or place, ends more than 50 mm from the
/// bones in the mean.
LineMuscles place_line_muscles(std::shared_ptr<const LineModel> model, const Scene& scene,
                               const std::string& where, std::vector<std::string>& notes);

/// The model's coordinate that turns with the scene's joint: its value in a frame is its value at rest plus
/// per_angle * (angle - angle of frame 0).
struct LineCoordinate {
    int index = -1; ///< -1: it can't be told; every coordinate then stays as at rest
    double per_angle = 0;
};

/// The only free coordinate that turns a body on a moving bone against those that stay, within 25 degrees of the hinge's axis. note (may be
/// null): which, or why none.
LineCoordinate hinge_coordinate(const LineMuscles& lines, const Scene& scene, std::string* note = nullptr);

/// Which bodies carry points or wrap objects of muscles: one flag per body.
std::vector<char> bodies_in_use(const LineModel& model);

} // namespace fascicle
