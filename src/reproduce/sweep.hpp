#pragma once
// Swings of the hip to both sides about an axis of its joint, for moment arms.

#include "fascicle/motion/timeline.hpp"
#include "reproduce/experiment.hpp"

namespace fascicle::reproduce {

/// A turn of the right femur of the public data, positive in the direction that the motion is named for.
struct SweepTurn {
    Vec3 axis; ///< unit, in the data's axes (x to the left, y backwards, z up), at the posture of the scan
    double rest_deg; ///< coordinate of the joint at the posture of the scan
    double to_deg;   ///< the sweep goes from this coordinate to its negative
};

/// Axes and posture of joint hip_r in LHDL_hip_r.osim. Its orientations in pelvis and femur, J and C (body-fixed XYZ angles), give the scan's
/// posture by J^T C = Rz(f) Rx(a) Ry(r): flexion f = 1.576, adduction a = -4.727, rotation r = -5.290 degrees. Adduction then turns about
/// J Rz(f) x, rotation about J Rz(f) Rx(a) y, the other two coordinates being as scanned.
SweepTurn sweep_turn(MotionKind motion);

/// From a motion out and back about a hinge: out, back through rest and as far as `other_rad` to the other side, each a third of the frames.
Timeline through_rest(const Timeline& out, double other_rad);

} // namespace fascicle::reproduce
