#include "fascicle/anatomy/spindle.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/volume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

constexpr double end_share = 0.12;        // of the largest cross-section
constexpr double attached_share = 0.03;   // of the path, at each end
constexpr double specific_tension = 60e4; // N/m^2

double area_share(double s) {
    const double wave = std::sin(std::numbers::pi * s);
    return end_share + (1 - end_share) * wave * wave;
}

/// `count` + 1 points at equal distances along the polyline.
Points stations_of(const Points& path, int count) {
    std::vector<double> at{0};
    for (std::size_t i = 1; i < path.size(); ++i)
        at.push_back(at.back() + (path[i] - path[i - 1]).norm());
    Points stations;
    std::size_t piece = 1;
    for (int k = 0; k <= count; ++k) {
        const double s = at.back() * k / count;
        while (piece + 1 < path.size() && at[piece] < s)
            ++piece;
        const double length = at[piece] - at[piece - 1];
        const double share = length > 0 ? std::clamp((s - at[piece - 1]) / length, 0.0, 1.0) : 0.0;
        stations.push_back(path[piece - 1] + share * (path[piece] - path[piece - 1]));
    }
    return stations;
}

double length_of(const Points& line) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        sum += (line[i] - line[i - 1]).norm();
    return sum;
}

/// Rounds corners, ends stay.
void smooth(Points& line, int rounds) {
    for (; rounds > 0; --rounds) {
        const Points old = line;
        for (std::size_t i = 1; i + 1 < line.size(); ++i)
            line[i] = 0.5 * old[i] + 0.25 * (old[i - 1] + old[i + 1]);
    }
}

class SpindleMaker {
public:
    explicit SpindleMaker(const SpindleRequest& request) : request_(request) {}

    Spindle make() {
        Spindle result;
        const double length = length_of(request_.path);
        radius_ = std::sqrt(2 * request_.volume / ((1 + end_share) * length * std::numbers::pi));
        const double edge = 2 * std::numbers::pi * 0.7 * radius_ / request_.around;
        rings_ = std::clamp(static_cast<int>(std::lround(length / edge)), 16, 160);
        const Points path = stations_of(request_.path, rings_);
        axis_ = path;
        smooth(axis_, 3);
        push_axis_out();
        for (std::size_t i = 0; i < path.size(); ++i)
            result.largest_shift = std::max(result.largest_shift, (axis_[i] - path[i]).norm());
        axis_ = stations_of(axis_, rings_);
        result.length = length_of(axis_);
        triangulate(result.mesh.triangles);
        // Bones take volume away and a polygon of `around` corners is smaller than its circle: the radius makes up for it.
        const double least = request_.bones.empty() ? 1e-3 : 0.02;
        for (int round = 0; round < 12; ++round) {
            place(result.mesh.positions);
            result.volume = signed_volume(result.mesh.positions, result.mesh.triangles);
            const double ratio = request_.volume / result.volume;
            if (!(result.volume > 0) || std::abs(ratio - 1) < 0.5 * least)
                break;
            radius_ *= std::clamp(std::sqrt(ratio), 0.8, 1.25);
        }
        result.radius = radius_;
        for (const Vec3& p : result.mesh.positions)
            result.inside += depth(p) > 0 ? 1 : 0;
        const int near = std::max(1, static_cast<int>(std::ceil(attached_share * rings_)));
        for (int v = 0; v < request_.around * (near + 1); ++v)
            result.origin.push_back(v);
        for (int v = request_.around * (rings_ - near); v < request_.around * (rings_ + 1); ++v)
            result.insertion.push_back(v);
        result.origin.push_back(cap(0));
        result.insertion.push_back(cap(1));
        return result;
    }

private:
    int cap(int end) const { return request_.around * (rings_ + 1) + end; }
    double radius_at(std::size_t ring) const {
        return radius_ * std::sqrt(area_share(double(ring) / rings_));
    }

    /// Depth inside of the deepest bone at p, negative outside.
    double depth(const Vec3& p) const {
        double deepest = -std::numeric_limits<double>::infinity();
        for (const auto& bone : request_.bones)
            deepest = std::max(deepest, -bone->signed_distance(p));
        return deepest;
    }

    /// The way out of (or further away from) one bone, so that p is `distance` outside of it.
    static Vec3 way_out(const SolidQuery& bone, const Vec3& p, double distance) {
        const double now = bone.signed_distance(p);
        if (now >= distance)
            return Vec3::Zero();
        const Vec3 foot = bone.bvh().closest(p).point;
        const Vec3 out = now > 0 ? Vec3(p - foot) : Vec3(foot - p);
        const double reach = out.norm();
        return reach > 1e-12 ? Vec3((distance - now) / reach * out) : Vec3::Zero();
    }

    /// Shifts of the axis that give the spindle room beside the bones, smooth along it. At the ends, where the muscle is fixed,
    /// no room is asked for beyond the clearance.
    void push_axis_out() {
        const Points start = axis_;
        Points shift(axis_.size(), Vec3::Zero());
        for (int round = 0; round < 60 && !request_.bones.empty(); ++round) {
            double most = 0;
            for (std::size_t i = 0; i < axis_.size(); ++i) {
                const double s = double(i) / rings_, from_end = std::min(s, 1 - s);
                const double room = std::clamp(from_end / 0.15, 0.0, 1.0) * 0.9 * radius_at(i);
                for (const auto& bone : request_.bones) {
                    const Vec3 way = 0.5 * way_out(*bone, start[i] + shift[i], room + request_.clearance);
                    shift[i] += way;
                    most = std::max(most, way.norm());
                }
            }
            smooth(shift, 2);
            if (most < 0.02 * radius_)
                break;
        }
        for (std::size_t i = 0; i < axis_.size(); ++i)
            axis_[i] = start[i] + shift[i];
    }

    /// Rings in planes across the axis, turned as little as possible from one to the next; then out of the bones.
    void place(Points& positions) const {
        positions.clear();
        Vec3 side = Vec3::Zero(), along = Vec3::Zero();
        for (std::size_t i = 0; i < axis_.size(); ++i) {
            const Vec3 t =
                (axis_[std::min(i + 1, axis_.size() - 1)] - axis_[i == 0 ? 0 : i - 1]).normalized();
            if (i == 0) {
                side = t.unitOrthogonal();
            } else {
                side = Eigen::Quaterniond::FromTwoVectors(along, t) * side;
                side = (side - side.dot(t) * t).normalized();
            }
            along = t;
            const Vec3 other = t.cross(side);
            for (int k = 0; k < request_.around; ++k) {
                const double angle = 2 * std::numbers::pi * k / request_.around;
                positions.push_back(axis_[i] +
                                    radius_at(i) * (std::cos(angle) * side + std::sin(angle) * other));
            }
        }
        positions.push_back(axis_.front());
        positions.push_back(axis_.back());
        for (int round = 0; round < 4; ++round)
            for (Vec3& p : positions)
                for (const auto& bone : request_.bones)
                    p += way_out(*bone, p, request_.clearance);
    }

    void triangulate(std::vector<Tri>& triangles) const {
        const int n = request_.around;
        for (int i = 0; i < rings_; ++i)
            for (int k = 0; k < n; ++k) {
                const int a = i * n + k, b = i * n + (k + 1) % n, c = a + n, d = b + n;
                triangles.push_back({a, b, d});
                triangles.push_back({a, d, c});
            }
        for (int k = 0; k < n; ++k) {
            triangles.push_back({cap(0), (k + 1) % n, k});
            triangles.push_back({cap(1), rings_ * n + k, rings_ * n + (k + 1) % n});
        }
    }

    const SpindleRequest& request_;
    int rings_ = 0;
    double radius_ = 0;
    Points axis_;
};

} // namespace

Spindle make_spindle(const SpindleRequest& request) {
    FASCICLE_ASSERT(request.path.size() >= 2 && request.volume > 0 && request.around >= 6);
    FASCICLE_ASSERT(length_of(request.path) > 0);
    return SpindleMaker(request).make();
}

double line_muscle_volume_m3(double force_n, double optimal_fibre_length_m) {
    return force_n / specific_tension * optimal_fibre_length_m;
}

} // namespace fascicle
