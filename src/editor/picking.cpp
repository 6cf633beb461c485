#include "editor/picking.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace fascicle::editor {

namespace {

/// Distance along the ray to the nearest triangle, or nothing. Moeller & Trumbore 1997: solves
/// origin + t direction = (1 - u - v) a + u b + v c. Triangles seen edge-on (determinant below 1e-12 of the
/// product of the lengths) are missed.
std::optional<double> nearest(const Points& points, const std::vector<Tri>& triangles, const view::Ray& ray) {
    std::optional<double> best;
    for (const Tri& tri : triangles) {
        const Vec3& a = points[static_cast<std::size_t>(tri[0])];
        const Vec3 e1 = points[static_cast<std::size_t>(tri[1])] - a;
        const Vec3 e2 = points[static_cast<std::size_t>(tri[2])] - a;
        const Vec3 p = ray.direction.cross(e2);
        const double determinant = e1.dot(p);
        if (!(std::abs(determinant) > 1e-12 * e1.norm() * e2.norm()))
            continue;
        const Vec3 s = ray.origin - a;
        const double u = s.dot(p) / determinant;
        if (u < 0 || u > 1)
            continue;
        const Vec3 q = s.cross(e1);
        const double v = ray.direction.dot(q) / determinant;
        if (v < 0 || u + v > 1)
            continue;
        const double t = e2.dot(q) / determinant;
        if (t > 0 && (!best || t < *best))
            best = t;
    }
    return best;
}

} // namespace

std::optional<Hit> pick(const view::ViewSubject& subject, const view::ViewOptions& options,
                        const view::Ray& ray) {
    std::optional<Hit> hit;
    const auto offer = [&](std::optional<double> distance, int bone, int muscle) {
        if (distance && (!hit || *distance < hit->distance))
            hit = Hit{bone, muscle, ray.origin + *distance * ray.direction, *distance};
    };
    const Scene& scene = *subject.scene;
    for (std::size_t i = 0; i < scene.bones.size(); ++i)
        if (options.bone_visible(i)) {
            const Pose pose = subject.frame != nullptr ? subject.frame->bone_poses[i] : Pose{};
            const view::Ray local{pose.apply_inverse(ray.origin), pose.rotation.transpose() * ray.direction};
            const TriMesh& mesh = *scene.bones[i].mesh;
            offer(nearest(mesh.positions, mesh.triangles, local), static_cast<int>(i), -1);
        }
    for (std::size_t i = 0; i < scene.muscles.size(); ++i)
        if (options.muscle_visible(i)) {
            const TriMesh& mesh = *scene.muscles[i].mesh;
            const Points& points =
                subject.frame != nullptr ? *subject.frame->muscle_positions[i] : mesh.positions;
            offer(nearest(points, mesh.triangles, ray), -1, static_cast<int>(i));
        }
    return hit;
}

} // namespace fascicle::editor
