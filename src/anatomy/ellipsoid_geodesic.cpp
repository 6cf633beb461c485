#include "fascicle/anatomy/ellipsoid_geodesic.hpp"

#include "anatomy/ellipsoid_section.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

struct SurfaceRay {
    Vec3 position, tangent; ///< unit tangent
};

/// Geodesics of one ellipsoid, radii near 1, by the classical Runge-Kutta method.
class Tracer {
public:
    explicit Tracer(const Vec3& radii)
        : per_square_(radii.cwiseProduct(radii).cwiseInverse()),
          step_(0.03 * radii.minCoeff() * radii.minCoeff() / radii.maxCoeff()) {}

    /// Steps for a length: 0.03 of the smallest radius of curvature each, which leaves an error of about 1e-9 of the length;
    /// 4096 at most, which flat ellipsoids reach.
    int steps(double length) const {
        return static_cast<int>(std::clamp(std::ceil(length / step_), 8.0, 4096.0));
    }
    SurfaceRay trace(SurfaceRay ray, double length, int steps, std::vector<Vec3>* curve) const {
        const double h = length / steps;
        for (int i = 0; i < steps; ++i) {
            advance(ray, h);
            if (curve != nullptr)
                curve->push_back(ray.position);
        }
        return ray;
    }
    Vec3 normal(const Vec3& x) const { return x.cwiseProduct(per_square_).normalized(); }

private:
    Vec3 acceleration(const Vec3& x, const Vec3& v) const {
        const Vec3 slope = x.cwiseProduct(per_square_);
        return -(v.cwiseProduct(v).dot(per_square_) / slope.squaredNorm()) * slope;
    }
    void advance(SurfaceRay& ray, double h) const {
        const Vec3 x = ray.position, v = ray.tangent;
        const Vec3 a1 = acceleration(x, v);
        const Vec3 v2 = v + h / 2 * a1, a2 = acceleration(x + h / 2 * v, v2);
        const Vec3 v3 = v + h / 2 * a2, a3 = acceleration(x + h / 2 * v2, v3);
        const Vec3 v4 = v + h * a3, a4 = acceleration(x + h * v3, v4);
        ray.position = x + h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        ray.tangent = (v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)).normalized();
    }

    Vec3 per_square_;
    double step_;
};

/// The shooting problem: angle of departure and length on the surface against the miss at q.
class Shooting {
public:
    Shooting(const Vec3& radii, const Vec3& p, const Vec3& q)
        : radii_(radii), q_(q), from_(p.cwiseQuotient(radii)), tracer_(radii) {
        const double squared = std::max(1.0, from_.squaredNorm());
        foot_ = from_ / squared;
        k_ = std::sqrt(1 - 1 / squared);
        axis_x_ = from_.unitOrthogonal();
        axis_y_ = from_.normalized().cross(axis_x_);
    }

    SurfaceRay start(double angle) const {
        const Vec3 c = std::cos(angle) * axis_x_ + std::sin(angle) * axis_y_;
        return {(foot_ + k_ * c).cwiseProduct(radii_), (c - k_ * from_).cwiseProduct(radii_).normalized()};
    }
    /// Of the tangent point at the start of a section.
    double angle_of(const EllipsoidSections::Section& s, const Vec3& first) const {
        const Vec3 y = first.cwiseQuotient(radii_);
        const Vec3 c = k_ > 1e-7 ? Vec3((y - foot_) / k_) : Vec3(s.normal.cross(from_));
        return std::atan2(c.dot(axis_y_), c.dot(axis_x_));
    }
    /// How far q lies off the line on from the end: across the surface, and along its normal.
    Vec2 miss(const SurfaceRay& end) const {
        const Vec3 n = tracer_.normal(end.position), rest = q_ - end.position;
        return {rest.dot(n.cross(end.tangent)), rest.dot(n)};
    }

    /// Newton's method with halved steps. True when it ends at a path that meets q ahead of it.
    bool solve(double& angle, double& length) const {
        constexpr double nudge = 1e-6;
        if (!std::isfinite(angle) || !std::isfinite(length))
            return false; // radii so far apart that their squares have no digits
        for (int round = 0; round < 40; ++round) {
            const int steps = tracer_.steps(length);
            const SurfaceRay end = tracer_.trace(start(angle), length, steps, nullptr);
            const Vec2 here = miss(end);
            if (here.norm() < 1e-10)
                return (q_ - end.position).dot(end.tangent) > -1e-9;
            Eigen::Matrix2d jacobian;
            jacobian.col(0) =
                (miss(tracer_.trace(start(angle + nudge), length, steps, nullptr)) - here) / nudge;
            jacobian.col(1) = (miss(tracer_.trace(end, nudge, 1, nullptr)) - here) / nudge;
            Vec2 step = -jacobian.partialPivLu().solve(here);
            if (!step.allFinite())
                return false;
            step *= std::min(1.0, 0.5 / step.cwiseAbs().maxCoeff());
            double share = 1;
            for (; share > 1e-3; share /= 2) {
                const double next = length + share * step.y();
                if (next < 0)
                    continue;
                const int next_steps = tracer_.steps(next);
                if (miss(tracer_.trace(start(angle + share * step.x()), next, next_steps, nullptr)).norm() <
                    here.norm())
                    break;
            }
            if (share <= 1e-3)
                return here.norm() < 1e-9 && (q_ - end.position).dot(end.tangent) > -1e-9;
            angle += share * step.x();
            length += share * step.y();
        }
        return false;
    }
    SurfaceRay trace(double angle, double length, std::vector<Vec3>* curve) const {
        const SurfaceRay first = start(angle);
        if (curve != nullptr)
            curve->push_back(first.position);
        return tracer_.trace(first, length, tracer_.steps(length), curve);
    }

private:
    Vec3 radii_, q_;
    Vec3 from_; ///< p in y
    Tracer tracer_;
    Vec3 foot_, axis_x_, axis_y_;
    double k_ = 0;
};

} // namespace

EllipsoidPath ellipsoid_geodesic(const Vec3& radii, const Vec3& p, const Vec3& q, int side_axis,
                                 int side_sign, std::vector<Vec3>* curve) {
    const double unit = radii.mean();
    const Vec3 a = radii / unit, from = p / unit, to = q / unit;
    const EllipsoidSections sections(a, from, to);
    Vec3 near = side_sign != 0 ? closest_on_ellipsoid(a, (from + to) / 2) : Vec3::Zero();
    const bool mirrored = side_sign != 0 && !on_side(near[side_axis], side_sign);
    double plane = 0;
    if (mirrored) {
        near[side_axis] = -near[side_axis];
        plane = sections.angle_through(near);
    } else {
        plane = side_sign != 0 ? sections.angle_through(near) : sections.shortest_angle();
    }
    const EllipsoidSections::Section section = sections.section(plane);
    const Shooting shooting(a, from, to);
    double angle = shooting.angle_of(section, sections.point(section, 0));
    double length = sections.arc_length(section);
    const double section_length = sections.length(section);

    if (curve != nullptr)
        curve->clear();
    EllipsoidPath path;
    path.geodesic = shooting.solve(angle, length);
    if (path.geodesic) {
        path.first = shooting.start(angle).position;
        path.second = shooting.trace(angle, length, curve).position;
        path.surface_length = length;
        // A geodesic of another kind is not what was looked for: round once more, or back on the other side.
        const double total = (path.first - from).norm() + length + (path.second - to).norm();
        path.geodesic = total < 1.5 * section_length;
        if (mirrored && !on_side(shooting.trace(angle, length / 2, nullptr).position[side_axis], side_sign))
            path.geodesic = false;
    }
    if (!path.geodesic) {
        constexpr int steps = 256;
        path.first = sections.point(section, 0);
        path.second = sections.point(section, 1);
        path.surface_length = 0;
        Vec3 last = path.first;
        if (curve != nullptr)
            curve->assign(1, last);
        for (int i = 1; i <= steps; ++i) {
            const Vec3 next = sections.point(section, static_cast<double>(i) / steps);
            path.surface_length += (next - last).norm();
            if (curve != nullptr)
                curve->push_back(next);
            last = next;
        }
    }
    path.first *= unit;
    path.second *= unit;
    path.surface_length *= unit;
    if (curve != nullptr)
        for (Vec3& x : *curve)
            x *= unit;
    return path;
}

} // namespace fascicle
