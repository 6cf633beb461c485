#pragma once
// Moment arms about the joint's axis, from how lengths change with the angle.

#include "fascicle/anatomy/fibre_shape.hpp"
#include "fascicle/scene/scene.hpp"

namespace fascicle {

/// The direction in which a motion bends its joint: the sign of (angle - angle of frame 0) where that is largest,
/// the first time; +1 when the angle never changes. The flexion angle is sign * angle: in the hip data flexion is a
/// negative angle about +x, so the sign is -1 there. Moment arms are about the flexion angle: positive for what
/// shortens while the motion goes out (a flexor, when it flexes), negative for what lengthens (methods.md 7, 8.4).
double flexion_sign(std::span<const double> angles_rad);
/// Of a motion as a whole, known before its first frame; frames 0 to last_frame.
double flexion_sign(const Timeline& timeline);
/// +1 where a trial of a model moves the scene: its coordinates are positive in the direction that they are named for.
double flexion_sign(const Scene& scene);

/// A part of a motion in which the angle goes one way only, frames `first` to `last`, both included; first < last.
struct MotionSpan {
    std::size_t first = 0;
    std::size_t last = 0;
    bool operator==(const MotionSpan&) const = default;
};

/// The spans of a motion, in order: the way out and the way back are two, since a muscle need not take the same
/// shapes on both. A turn is one when the angle goes back by more than half a degree, or a fiftieth of its whole
/// range if that is less; so the noise of a measured motion does not cut it up. Frames in which the angle stands
/// still at an end belong to no span. Empty when the angle never changes by more than 1e-7 rad. Error when an
/// angle is not finite.
std::vector<MotionSpan> motion_spans(std::span<const double> angles_rad);

enum class ArmMethod {
    polynomial,        ///< least squares in the angle over the span, as Modenese & Kohout 2020
    central_difference ///< parabola through the frame and the nearest ones `step_rad` or more before and after it
};

struct ArmOptions {
    ArmMethod method = ArmMethod::polynomial;
    /// Of the polynomial, 1 to 8; lower where a span has fewer than degree + 1 distinct angles.
    int degree = 4;
    double step_rad = 0.017453292519943295; ///< 1 degree each way: "central difference 2 deg" (methods.md 7)
};

/// Moment arms by tendon excursion (An et al. 1984): r = -dL / d(sign * angle), in the unit of the lengths per
/// radian, which is that unit. angles: K; lengths: K x F, frame-major; result: K x F.
/// Each span is fitted by itself. A frame where two spans meet takes its value from the span that ends there;
/// frames in which the angle stands still keep the value of the span before them, those before the first span that
/// of its beginning. A motion in which the angle never changes, or of one frame: NaN. A span of two angles gives one
/// slope, of three a parabola. At a span's ends the central difference becomes the parabola through the three nearest frames that
/// are step_rad apart (one-sided, still second order); a span too short for that gets one parabola as a whole.
/// A length that is not finite makes its own fibre's arms NaN in its span. Error as motion_spans, or when the number
/// of lengths is not K x F.
std::vector<double> excursion_arms(std::span<const double> angles_rad, std::span<const double> lengths,
                                   int fibres, double sign, const ArmOptions& options = {});

/// The spans from `from_span` on, and every frame that keeps a value of theirs, into `arms` (K x F), of which the rest
/// is as excursion_arms left it for these spans: what a motion that is still going on needs after each frame.
void update_arms(const std::vector<MotionSpan>& spans, std::size_t from_span,
                 std::span<const double> angles_rad, std::span<const double> lengths, int fibres, double sign,
                 const ArmOptions& options, std::span<double> arms);

/// Moment arm of a line that ends on the moving bone: r = sign * a . ((p - c) x t), p: the fibre's end there, t: unit
/// pull on the bone, from p along the last segment that has a length; a, c: unit axis and centre of the hinge.
/// Scene units. Equal to the excursion arm of a straight fibre whose other end stands still; for any fibre that is
/// all the bone feels. Of a path with several points on the moving bone hand over the part up to the first of them.
/// NaN for a fibre without length; Error for an axis without direction.
double line_arm(std::span<const Vec3> fibre, FibreEnd moving_end, const Hinge& hinge, double sign);
/// The same for all fibres, F values.
std::vector<double> line_arms(const FibreSet& fibres, FibreEnd moving_end, const Hinge& hinge, double sign);

} // namespace fascicle
