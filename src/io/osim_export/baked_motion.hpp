#pragma once
// How the bones of a run move, as joints of a model: coordinates, their values in every frame, which frames a function of them can tell.

#include "fascicle/io/osim_export.hpp"
#include "io/osim_export/baked_model.hpp"
#include "io/osim_export/osim_names.hpp"

namespace fascicle::io {

struct BakedMotion {
    OsimCoordinate kind = OsimCoordinate::joint; ///< joint or time
    std::vector<double> values;                  ///< of the first coordinate, per frame of the recording
    std::vector<double> angles_rad;              ///< of the recording's frames, as in metrics.csv
    double sign = 1;                             ///< flexion_sign of the timeline
    int span_first = 0, span_last = 0;           ///< places in the recording: of the fitted span of a joint
    std::vector<int> fitted; ///< places in the recording, ascending by value, no two equal
    /// Frames of the recording x bodies. A bone that stays is where its mesh is written: at `placed`, its body not moved.
    std::vector<std::vector<Pose>> poses;
    std::vector<Pose>
        placed; ///< per bone, from its rest: the identity but for bones that stand elsewhere all the time

    /// Poses of bodies in ground at a value of the coordinate; only for a joint.
    Pose pose(int body, double value) const;

    Vec3 centre = Vec3::Zero(), axis = Vec3::UnitZ(); ///< of the hinge, the model's axes, metres
    std::vector<char> turns;                          ///< per body
};

/// x_model = scale * turn * x_scene.
struct ToModel {
    Mat3 turn = Mat3::Identity();
    double scale = 1;
    Vec3 point(const Vec3& x) const { return scale * (turn * x); }
    Pose pose(const Pose& p) const {
        return {turn * p.rotation * turn.transpose(), scale * (turn * p.translation)};
    }
};

/// Fills bodies' names, coordinates and joints of the model. Error when nothing moves, or when `wanted` is a joint and there is none.
BakedMotion bake_motion(const Recording& recording, const ToModel& to_model, OsimCoordinate wanted,
                        BakedModel& model);

} // namespace fascicle::io
