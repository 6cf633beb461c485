#pragma once
// The solids of the hip scene: right hip of an adult in millimetres, origin in the centre of the femoral head, +x to
// the subject's left, +y posterior, +z superior. The midline is at x = midline_x. Proportions follow textbook anatomy
// (H. Gray, "Anatomy of the Human Body"): head radius 23.5, neck-shaft angle 127 degrees with 12 degrees of
// anteversion, femur 425 long, hip bone 210 high, hip centres 180 apart; all shapes are our own.

#include "fascicle/geometry/implicit.hpp"

namespace fascicle::embedded {

constexpr double midline_x = 90.0;
constexpr double head_radius = 23.5;
constexpr double socket_radius = 25.5;

ImplicitShape sacrum_shape();
ImplicitShape femur_shape();
/// The hip bone keeps off the sacrum, which is needed for that.
ImplicitShape iliac_shape(const ImplicitShape& sacrum);

/// What muscles keep off, each positive outside its bone.
struct HipBones {
    Implicit iliac, sacrum, femur;
};

/// Broad and thick behind the joint: from the back of the ilium and the side of the sacrum to the upper femur.
ImplicitShape gluteus_maximus_shape(const HipBones& bones);
/// A fan in the hollow of the ilium that gathers over the front of the head and ends at the lesser trochanter.
ImplicitShape iliacus_shape(const HipBones& bones);

/// Where the lesser trochanter takes up the tendon of iliacus.
inline const Vec3 lesser_trochanter(-21, 26, -60);

} // namespace fascicle::embedded
