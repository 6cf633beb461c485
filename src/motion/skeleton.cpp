#include "fascicle/motion/skeleton.hpp"

namespace fascicle {
namespace {

template <class Named>
int index_of(const std::vector<Named>& all, const std::string& name) {
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].name == name)
            return static_cast<int>(i);
    return -1;
}

template <class Value>
const Value& at(std::span<const Value> values, int i) {
    return values[static_cast<std::size_t>(i)];
}

double argument(const CoordinateFunction& f, std::span<const double> values) {
    double sum = 0;
    for (const auto& term : f.terms)
        sum += term.weight * at(values, term.coordinate);
    return sum;
}

Mat3 turn(const JointAxis& axis, std::span<const double> q) {
    return Eigen::AngleAxisd(axis.amount.value(q), axis.axis).toRotationMatrix();
}

/// Of M in F, or of F in M when the joint is reversed.
Pose axes_pose(const Joint& joint, std::span<const double> q) {
    Pose pose;
    for (const JointAxis& axis : joint.rotations)
        pose.rotation = pose.rotation * turn(axis, q);
    for (const JointAxis& axis : joint.translations)
        pose.translation += axis.amount.value(q) * axis.axis;
    return pose;
}

/// Motion of the moved frame seen from the other one, in coordinates of the latter and about its origin.
Twist axes_twist(const Joint& joint, std::span<const double> q, std::span<const double> rates) {
    Twist twist;
    Mat3 before = Mat3::Identity();
    Vec3 origin = Vec3::Zero(), origin_velocity = Vec3::Zero();
    for (const JointAxis& axis : joint.rotations) {
        twist.angular += axis.amount.rate(q, rates) * (before * axis.axis);
        before = before * turn(axis, q);
    }
    for (const JointAxis& axis : joint.translations) {
        origin += axis.amount.value(q) * axis.axis;
        origin_velocity += axis.amount.rate(q, rates) * axis.axis;
    }
    twist.linear = origin_velocity - twist.angular.cross(origin);
    return twist;
}

/// The same motion described in the frame that `pose` places the first one in.
Twist seen_from(const Pose& pose, const Twist& twist) {
    Twist outer;
    outer.angular = pose.rotation * twist.angular;
    outer.linear = pose.rotation * twist.linear - outer.angular.cross(pose.translation);
    return outer;
}

} // namespace

double CoordinateFunction::value(std::span<const double> q) const {
    return function.value(argument(*this, q));
}

double CoordinateFunction::rate(std::span<const double> q, std::span<const double> rates) const {
    const double argument_rate = argument(*this, rates);
    return argument_rate == 0.0 ? 0.0 : function.derivative(argument(*this, q)) * argument_rate;
}

int Skeleton::body_index(const std::string& name) const {
    return index_of(bodies, name);
}

int Skeleton::coordinate_index(const std::string& name) const {
    return index_of(coordinates, name);
}

std::vector<double> Skeleton::default_values() const {
    std::vector<double> q;
    for (const Coordinate& c : coordinates)
        q.push_back(c.default_value);
    apply_couplers(*this, q);
    return q;
}

void apply_couplers(const Skeleton& skeleton, std::span<double> q) {
    for (const CoordinateCoupler& coupler : skeleton.couplers)
        q[static_cast<std::size_t>(coupler.dependent)] = coupler.function.value(q);
}

void place_bodies(const Skeleton& skeleton, std::span<const double> q, std::vector<Pose>& poses) {
    poses.assign(skeleton.bodies.size(), Pose{});
    for (const Skeleton::Step& step : skeleton.order) {
        const Joint& joint = skeleton.joints[static_cast<std::size_t>(step.joint)];
        Pose moved = axes_pose(joint, q);
        if (joint.reversed)
            moved = moved.inverse();
        const Pose child_in_parent = joint.parent_frame.after(moved).after(joint.child_frame.inverse());
        Pose& parent = poses[static_cast<std::size_t>(joint.parent)];
        Pose& child = poses[static_cast<std::size_t>(joint.child)];
        if (step.backwards)
            parent = child.after(child_in_parent.inverse());
        else
            child = parent.after(child_in_parent);
    }
}

void coordinate_rates(const Skeleton& skeleton, std::span<const double> q, int coordinate,
                      std::vector<double>& rates) {
    rates.assign(skeleton.coordinates.size(), 0.0);
    rates[static_cast<std::size_t>(coordinate)] = 1.0;
    for (const CoordinateCoupler& coupler : skeleton.couplers)
        if (coupler.dependent != coordinate)
            rates[static_cast<std::size_t>(coupler.dependent)] = coupler.function.rate(q, rates);
}

void body_twists(const Skeleton& skeleton, std::span<const double> q, std::span<const double> rates,
                 std::span<const Pose> poses, std::vector<Twist>& twists) {
    twists.assign(skeleton.bodies.size(), Twist{});
    for (const Skeleton::Step& step : skeleton.order) {
        const Joint& joint = skeleton.joints[static_cast<std::size_t>(step.joint)];
        // The moving frame is M in F, seen from ground through F; reversed: F in M, through M, and the other way round.
        const Pose& known = joint.reversed ? at(poses, joint.child) : at(poses, joint.parent);
        const Pose& frame = joint.reversed ? joint.child_frame : joint.parent_frame;
        Twist relative = seen_from(known.after(frame), axes_twist(joint, q, rates));
        if (joint.reversed != step.backwards) {
            relative.angular = -relative.angular;
            relative.linear = -relative.linear;
        }
        const int from = step.backwards ? joint.child : joint.parent;
        const int to = step.backwards ? joint.parent : joint.child;
        const Twist& base = twists[static_cast<std::size_t>(from)];
        twists[static_cast<std::size_t>(to)] = {base.angular + relative.angular,
                                                base.linear + relative.linear};
    }
}

Mat3 rotation_xyz(const Vec3& angles_rad) {
    return (Eigen::AngleAxisd(angles_rad.x(), Vec3::UnitX()) *
            Eigen::AngleAxisd(angles_rad.y(), Vec3::UnitY()) *
            Eigen::AngleAxisd(angles_rad.z(), Vec3::UnitZ()))
        .toRotationMatrix();
}

} // namespace fascicle
