#include "editor/paint/paint_view.hpp"

#include <cmath>
#include <numbers>

namespace fascicle::editor {

SurfacePoint PaintView::pick(const SurfaceGraph& graph, double x, double y) const {
    const view::Ray ray = camera.ray(x, y, size);
    const Vec3 origin = pose.apply_inverse(ray.origin), direction = pose.rotation.transpose() * ray.direction;
    SurfacePoint at;
    const RayHit hit = graph.tree().ray_hit(origin, direction);
    // The inside of an open surface is no place to paint.
    if (hit.triangle < 0 || !(graph.normal(hit.triangle).dot(direction) < 0))
        return at;
    at.triangle = hit.triangle;
    at.squared_distance = 0;
    at.point = origin + hit.distance * direction;
    const Tri& tri = graph.triangle(hit.triangle);
    const Vec3& a = graph.position(tri[0]);
    const Vec3 ab = graph.position(tri[1]) - a, ac = graph.position(tri[2]) - a, n = ab.cross(ac);
    const double v = (at.point - a).cross(ac).dot(n) / n.squaredNorm(),
                 w = ab.cross(at.point - a).dot(n) / n.squaredNorm();
    at.weights = Vec3(1 - v - w, v, w);
    return at;
}

Vec3 PaintView::eye() const {
    const Vec3 world = camera.orthographic()
                           ? Vec3(camera.pivot() + 1e5 * camera.distance() * camera.backward())
                           : camera.eye();
    return pose.apply_inverse(world);
}

double PaintView::units_per_pixel(const Vec3& point) const {
    const double at_pivot = camera.units_per_pixel(size);
    if (camera.orthographic())
        return at_pivot;
    const double depth = (camera.eye() - pose.apply(point)).dot(camera.backward());
    return at_pivot * std::max(depth, 1e-9 * camera.distance()) / camera.distance();
}

// Clip coordinates (x, y, z, w) become pixels: x_px = width (x / w + 1) / 2, y_px = height (1 - y / w) / 2.
ScreenMatrix PaintView::matrix() const {
    const render::CameraPose c = camera.pose(size.aspect());
    const auto wide = [](const render::Mat4f& m) {
        Eigen::Matrix4d result;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                result(row, column) = double(m[static_cast<std::size_t>(4 * column + row)]);
        return result;
    };
    Eigen::Matrix4d place = Eigen::Matrix4d::Identity();
    place.topLeftCorner<3, 3>() = pose.rotation;
    place.topRightCorner<3, 1>() = pose.translation;
    Eigen::Matrix4d pixels = Eigen::Matrix4d::Identity();
    pixels(0, 0) = 0.5 * size.width;
    pixels(0, 3) = 0.5 * size.width;
    pixels(1, 1) = -0.5 * size.height;
    pixels(1, 3) = 0.5 * size.height;
    return pixels * wide(c.projection) * wide(c.view) * place;
}

std::vector<Vec2> swept_circle(const Vec2& a, const Vec2& b, double radius) {
    constexpr int half = 20;
    const Vec2 way = b - a;
    const double heading = way.norm() > 0 ? std::atan2(way.y(), way.x()) : 0.0, pi = std::numbers::pi;
    std::vector<Vec2> polygon;
    for (const auto& [centre, start] : {std::pair{b, heading - pi / 2}, std::pair{a, heading + pi / 2}})
        for (int i = 0; i <= half; ++i) {
            const double angle = start + pi * i / half;
            polygon.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
        }
    return polygon;
}

} // namespace fascicle::editor
