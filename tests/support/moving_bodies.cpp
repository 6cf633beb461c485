#include "support/moving_bodies.hpp"

#include "support/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::test {

Animation moving_bodies(int count, int first, int step) {
    Animation out;
    out.name = "two bones";
    for (int k = 0; k < count; ++k) {
        out.frames.push_back(first + k * step);
        out.seconds.push_back(0.01 * out.frames.back());
    }
    AnimatedBody muscle;
    muscle.name = "glut\xC3\xA9us \"max\"/1";
    const TriMesh ball = sphere(40, 1);
    muscle.triangles = ball.triangles;
    const Points rest = ball.positions;
    muscle.points = [rest](std::size_t k, Points& points) {
        points = rest;
        for (Vec3& p : points) { // far from the origin, as scans lie
            p += Vec3(123.25 + 3 * std::sin(0.1 * static_cast<double>(k) + p.z() / 20), -310.5,
                      900 + 0.2 * static_cast<double>(k));
        }
    };
    muscle.points(0, muscle.rest);
    out.bodies.push_back(muscle);

    AnimatedBody fibres;
    fibres.name = "fibres";
    fibres.kind = BodyKind::fibres;
    fibres.lines = {{0, 1, 2}, {3, 4, 5}};
    fibres.points = [](std::size_t k, Points& points) {
        points.assign(6, Vec3::Zero());
        for (std::size_t i = 0; i < 6; ++i)
            points[i] = Vec3(100 + 0.37 * static_cast<double>(i * k), static_cast<double>(i),
                             -7.77 * static_cast<double>(i % 3));
    };
    fibres.points(0, fibres.rest);
    out.bodies.push_back(fibres);

    AnimatedBody still;
    still.name = "pelvis";
    still.kind = BodyKind::bone;
    const TriMesh block = box(10, 20, 30);
    still.triangles = block.triangles;
    still.rest = block.positions;
    still.poses.assign(static_cast<std::size_t>(count), Pose{});
    out.bodies.push_back(still);

    AnimatedBody turning = still;
    turning.name = "pelvis";        // the same name again
    for (int k = 0; k < count; ++k) // 4 rad in all: quaternions change their sign on the way
        turning.poses[static_cast<std::size_t>(k)] =
            rotation_about({140, 240, -430}, {1, 0.2, -0.1}, 4.0 * k / std::max(1, count - 1));
    out.bodies.push_back(turning);
    return out;
}

double largest_difference(const AnimatedBody& a, const AnimatedBody& b, std::size_t frames) {
    double most = 0;
    Points p, q;
    for (std::size_t k = 0; k < frames; ++k) {
        points_in_frame(a, k, p);
        points_in_frame(b, k, q);
        if (p.size() != q.size())
            return 1e300;
        for (std::size_t i = 0; i < p.size(); ++i)
            most = std::max(most, (p[i] - q[i]).norm());
    }
    return most;
}

} // namespace fascicle::test
