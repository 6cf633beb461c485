#include "fascicle/anatomy/line_path.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

constexpr double condition_slack = 1e-5; // rad or m, as OpenSim's

template <class Value>
const Value& at(const std::vector<Value>& values, int i) {
    return values[static_cast<std::size_t>(i)];
}

bool is_active(const PathPoint& point, std::span<const double> q) {
    if (point.kind != PathPointKind::conditional)
        return true;
    const double value = q[static_cast<std::size_t>(point.coordinate)];
    return value >= point.range_min - condition_slack && value <= point.range_max + condition_slack;
}

Vec3 local_position(const PathPoint& point, std::span<const double> q) {
    if (point.kind != PathPointKind::moving)
        return point.location;
    return point.frame.apply(Vec3(point.moves[0].value(q), point.moves[1].value(q), point.moves[2].value(q)));
}

} // namespace

int LineModel::muscle_index(const std::string& wanted) const {
    for (std::size_t i = 0; i < muscles.size(); ++i)
        if (muscles[i].name == wanted)
            return static_cast<int>(i);
    return -1;
}

void set_posture(const Skeleton& skeleton, std::span<const double> values, Posture& posture) {
    posture.q.assign(values.begin(), values.end());
    apply_couplers(skeleton, posture.q);
    place_bodies(skeleton, posture.q, posture.poses);
}

std::vector<char> active_points(const LineMuscle& muscle, std::span<const double> q) {
    std::vector<char> active;
    for (const PathPoint& point : muscle.points)
        active.push_back(is_active(point, q) ? 1 : 0);
    return active;
}

const LinePath& LinePathSolver::solve(int muscle, const Posture& posture, std::span<const char> active) {
    muscle_ = &at(model_.muscles, muscle);
    if (active.empty()) {
        active_.clear();
        for (const PathPoint& point : muscle_->points)
            active_.push_back(is_active(point, posture.q) ? 1 : 0);
        active = active_;
    }
    place_points(posture, active);
    apply_wraps(posture, active);
    path_.length = path_length();
    return path_;
}

void LinePathSolver::place_points(const Posture& posture, std::span<const char> active) {
    path_.nodes.clear();
    for (std::size_t i = 0; i < muscle_->points.size(); ++i) {
        if (active[i] == 0)
            continue;
        const PathPoint& point = muscle_->points[i];
        PathNode node;
        node.position = at(posture.poses, point.body).apply(local_position(point, posture.q));
        node.body = point.body;
        node.point = static_cast<int>(i);
        path_.nodes.push_back(node);
    }
}

double LinePathSolver::path_length() const {
    double length = 0;
    for (std::size_t i = 0; i + 1 < path_.nodes.size(); ++i) {
        const PathNode &a = path_.nodes[i], &b = path_.nodes[i + 1];
        length += a.wrap >= 0 && a.wrap == b.wrap ? b.surface_length : (b.position - a.position).norm();
    }
    return length;
}

double LinePathSolver::moment_arm(int coordinate, const Posture& posture) {
    coordinate_rates(model_.skeleton, posture.q, coordinate, rates_);
    body_twists(model_.skeleton, posture.q, rates_, posture.poses, twists_);
    return moment_arm(twists_, rates_, posture);
}

double LinePathSolver::moment_arm(std::span<const Twist> twists, std::span<const double> rates,
                                  const Posture& posture) {
    const auto velocity = [&](const PathNode& node) {
        Vec3 v = twists[static_cast<std::size_t>(node.body)].at(node.position);
        if (node.point >= 0 && at(muscle_->points, node.point).kind == PathPointKind::moving) {
            const PathPoint& point = at(muscle_->points, node.point);
            Vec3 local;
            for (std::size_t k = 0; k < 3; ++k)
                local[static_cast<Eigen::Index>(k)] = point.moves[k].rate(posture.q, rates);
            v += at(posture.poses, node.body).rotation * (point.frame.rotation * local);
        }
        return v;
    };
    double arm = 0;
    for (std::size_t i = 0; i + 1 < path_.nodes.size(); ++i) {
        const PathNode &a = path_.nodes[i], &b = path_.nodes[i + 1];
        const Vec3 along = b.position - a.position;
        const double length = along.norm();
        if ((a.wrap >= 0 && a.wrap == b.wrap) ||
            !(length > 0)) // on one body: its length there does not change
            continue;
        arm += along.dot(velocity(a) - velocity(b)) / length;
    }
    return arm;
}

double LinePathSolver::moment_arm_by_difference(int muscle, int coordinate, const Posture& posture,
                                                double step) {
    const std::vector<char> active = active_points(at(model_.muscles, muscle), posture.q);
    coordinate_rates(model_.skeleton, posture.q, coordinate, rates_);
    double lengths[2];
    for (int side = 0; side < 2; ++side) {
        nearby_.q = posture.q;
        nearby_.q[static_cast<std::size_t>(coordinate)] += side == 0 ? step : -step;
        // What depends on others follows them; a dependent coordinate that is itself turned must not be set back.
        for (const CoordinateCoupler& coupler : model_.skeleton.couplers)
            if (coupler.dependent != coordinate)
                nearby_.q[static_cast<std::size_t>(coupler.dependent)] = coupler.function.value(nearby_.q);
        place_bodies(model_.skeleton, nearby_.q, nearby_.poses);
        lengths[side] = solve(muscle, nearby_, active).length;
    }
    return (lengths[1] - lengths[0]) / (2 * step);
}

void LinePathSolver::draw(const Posture& posture, Points& polyline) {
    polyline.clear();
    for (std::size_t i = 0; i < path_.nodes.size(); ++i) {
        const PathNode& node = path_.nodes[i];
        if (i > 0 && node.wrap >= 0 && node.wrap == path_.nodes[i - 1].wrap) {
            // The arc between the tangent points: wrapping from the node before to the one after gives the same again.
            const WrapObject& object = at(model_.wrap_objects, at(muscle_->wraps, node.wrap).object);
            const Pose pose = at(posture.poses, object.body).after(object.pose);
            wrap_segment(object.surface, pose.apply_inverse(path_.nodes[i - 2].position),
                         pose.apply_inverse(path_.nodes[i + 1].position), &curve_);
            for (std::size_t k = 1; k + 1 < curve_.size(); ++k)
                polyline.push_back(pose.apply(curve_[k]));
        }
        polyline.push_back(node.position);
    }
}

double polyline_moment_arm(const Points& points, std::span<const int> body_of,
                           std::span<const Twist> twists) {
    double arm = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const Vec3 along = points[i + 1] - points[i];
        const double length = along.norm();
        const auto velocity = [&](std::size_t k) {
            return twists[static_cast<std::size_t>(body_of[k])].at(points[k]);
        };
        if (length > 0)
            arm += along.dot(velocity(i) - velocity(i + 1)) / length;
    }
    return arm;
}

} // namespace fascicle
