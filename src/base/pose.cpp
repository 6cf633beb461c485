#include "fascicle/base/pose.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace fascicle {

bool has_direction(const Vec3& v) {
    return std::isnormal(v.squaredNorm());
}

Pose rotation_about(const Vec3& centre, const Vec3& axis, double angle_rad) {
    FASCICLE_ASSERT(has_direction(axis));
    Pose pose;
    pose.rotation = Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
    pose.translation = centre - pose.rotation * centre;
    return pose;
}

Pose screw_between(const Pose& from, const Pose& to, double s) {
    if (s <= 0.0)
        return from;
    if (s >= 1.0)
        return to;
    const Pose step = to.after(from.inverse());
    const Eigen::AngleAxisd turn(step.rotation);
    const double angle = turn.angle();
    if (angle < 1e-12) {
        Pose pose = from;
        pose.translation += s * step.translation;
        return pose;
    }
    // Chasles: x -> R x + t is a turn about a line plus a shift along it. With axis a: shift d = a.t, and a
    // point c of the line solves (I - R) c = t - d a, in the plane normal to a: c = (t' + cot(angle/2) a x
    // t') / 2.
    const Vec3 axis = turn.axis();
    const double shift = axis.dot(step.translation);
    const Vec3 across = step.translation - shift * axis;
    const Vec3 centre = 0.5 * (across + axis.cross(across) / std::tan(0.5 * angle));
    Pose part = rotation_about(centre, axis, s * angle);
    part.translation += s * shift * axis;
    return part.after(from);
}

} // namespace fascicle
