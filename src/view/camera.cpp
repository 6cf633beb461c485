#include "view/camera.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::view {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double border = 1.04;

} // namespace

AnatomicalFrame anatomical_frame(WorldAxes axes) {
    if (axes == WorldAxes::lps)
        return {-Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()};
    return {Vec3::UnitX(), -Vec3::UnitZ(), Vec3::UnitY()};
}

Camera::Camera(WorldAxes axes) : axes_(axes), fov_rad_(35.0 * pi / 180.0) {}

double Camera::half_height() const {
    return std::tan(0.5 * fov_rad_);
}

Vec3 Camera::backward() const {
    const AnatomicalFrame body = anatomical_frame(axes_);
    return std::cos(pitch_) * (std::cos(yaw_) * body.anterior + std::sin(yaw_) * body.left) +
           std::sin(pitch_) * body.superior;
}

Vec3 Camera::up() const {
    const AnatomicalFrame body = anatomical_frame(axes_);
    return -std::sin(pitch_) * (std::cos(yaw_) * body.anterior + std::sin(yaw_) * body.left) +
           std::cos(pitch_) * body.superior;
}

Vec3 Camera::right() const {
    return up().cross(backward());
}

double Camera::units_per_pixel(const ViewSize& size) const {
    return 2.0 * half_height() * distance_ / size.height;
}

void Camera::orbit(double dx_px, double dy_px, const ViewSize& size) {
    orbit_by(-dx_px * pi / size.height, dy_px * pi / size.height);
}

void Camera::orbit_by(double yaw_rad, double pitch_rad) {
    yaw_ = std::remainder(yaw_ + yaw_rad, 2.0 * pi);
    pitch_ = std::clamp(pitch_ + pitch_rad, -0.5 * pi, 0.5 * pi);
}

void Camera::pan(double dx_px, double dy_px, const ViewSize& size) {
    const double scale = units_per_pixel(size);
    pivot_ += scale * (dy_px * up() - dx_px * right());
}

void Camera::zoom(double factor, double x_px, double y_px, const ViewSize& size) {
    FASCICLE_ASSERT(factor > 0);
    // Far outside these limits the numbers of the projection lose their meaning.
    const double reach = scene_radius_ > 0 ? scene_radius_ : 1.0;
    const double wanted = std::clamp(distance_ * factor, 1e-4 * reach, 1e4 * reach);
    factor = wanted / distance_;
    const double scale = units_per_pixel(size);
    const Vec3 offset = scale * ((x_px - 0.5 * size.width) * right() - (y_px - 0.5 * size.height) * up());
    pivot_ += (1.0 - factor) * offset;
    distance_ = wanted;
}

void Camera::look_from(StandardView standard) {
    yaw_ = 0.0;
    pitch_ = 0.0;
    switch (standard) {
    case StandardView::anterior:
        break;
    case StandardView::posterior:
        yaw_ = pi;
        break;
    case StandardView::left:
        yaw_ = 0.5 * pi;
        break;
    case StandardView::right:
        yaw_ = -0.5 * pi;
        break;
    case StandardView::superior:
        yaw_ = pi;
        pitch_ = 0.5 * pi;
        break;
    case StandardView::inferior:
        pitch_ = -0.5 * pi;
        break;
    }
}

void Camera::set_pivot(const Vec3& pivot) {
    const Vec3 from = eye();
    const Vec3 offset = from - pivot;
    const double distance = offset.norm();
    pivot_ = pivot;
    if (!(distance > 0))
        return;
    distance_ = distance;
    const AnatomicalFrame body = anatomical_frame(axes_);
    pitch_ = std::asin(std::clamp(offset.dot(body.superior) / distance, -1.0, 1.0));
    const double towards_front = offset.dot(body.anterior), towards_left = offset.dot(body.left);
    if (std::hypot(towards_front, towards_left) > 1e-9 * distance)
        yaw_ = std::atan2(towards_left, towards_front);
}

// In view axes (x right, y up, z to the eye) and with t the tangent of half the angle of view, an eye at (ex, ez) sees p
// between its side planes when |px - ex| <= t (ez - pz), that is px + t pz <= t ez + ex and -px + t pz <= t ez - ex.
// With a and b the largest left sides over all points, the least ez is (a + b) / 2t, at ex = (a - b) / 2. Likewise in y;
// the larger ez of the two serves both. Orthographic: the same without the terms in pz.
void Camera::frame(const Points& points, double aspect) {
    if (points.empty())
        return;
    const Vec3 x = right(), y = up(), z = backward(), reference = points.front();
    const double tangent_y = half_height() / border, tangent_x = tangent_y * aspect;
    const double depth_counts = orthographic_ ? 0.0 : 1.0;
    constexpr double none = -std::numeric_limits<double>::infinity();
    double a = none, b = none, c = none, d = none, nearest = none, farthest = none;
    for (const Vec3& p : points) {
        const Vec3 offset = p - reference; // keeps digits when the scene is far from the origin
        const double px = offset.dot(x), py = offset.dot(y), pz = offset.dot(z);
        a = std::max(a, px + depth_counts * tangent_x * pz);
        b = std::max(b, -px + depth_counts * tangent_x * pz);
        c = std::max(c, py + depth_counts * tangent_y * pz);
        d = std::max(d, -py + depth_counts * tangent_y * pz);
        nearest = std::max(nearest, pz);
        farthest = std::max(farthest, -pz);
    }
    const double pivot_z = 0.5 * (nearest - farthest);
    pivot_ = reference + 0.5 * (a - b) * x + 0.5 * (c - d) * y + pivot_z * z;
    const double needed =
        std::max((a + b) / (2.0 * tangent_x), (c + d) / (2.0 * tangent_y)) - depth_counts * pivot_z;
    const double reach = scene_radius_ > 0 ? scene_radius_ : 1.0;
    distance_ = needed > 1e-9 * reach ? needed : reach / tangent_y;
}

void Camera::frame(const BoundingBox& box, double aspect) {
    Points corners;
    for (int corner = 0; corner < 8 && !box.empty(); ++corner)
        corners.emplace_back(corner & 1 ? box.max.x() : box.min.x(), corner & 2 ? box.max.y() : box.min.y(),
                             corner & 4 ? box.max.z() : box.min.z());
    frame(corners, aspect);
}

void Camera::set_scene_bounds(const BoundingBox& box) {
    scene_centre_ = box.center();
    scene_radius_ = box.empty() ? 0.0 : 0.5 * box.diagonal();
}

void Camera::set_fov_deg(double fov_deg) {
    fov_rad_ = std::clamp(fov_deg, 5.0, 120.0) * pi / 180.0;
}

double Camera::fov_deg() const {
    return fov_rad_ * 180.0 / pi;
}

void Camera::clip_range(double& near_plane, double& far_plane) const {
    const double radius = std::max(1.02 * scene_radius_, 1e-3 * distance_);
    const double depth = (eye() - scene_centre_).dot(backward());
    near_plane = depth - radius;
    far_plane = depth + radius;
    if (scene_radius_ <= 0) { // nothing known: around the pivot
        near_plane = 0.05 * distance_;
        far_plane = 20.0 * distance_;
    }
    if (orthographic_)
        return; // planes behind the eye are fine
    if (far_plane <= 0) {
        far_plane = distance_;
    }
    // 24 bits of depth: a ratio of 5,000 still separates surfaces 1/3,000 of the distance apart.
    near_plane = std::max(near_plane, far_plane / 5000.0);
}

render::CameraPose Camera::pose(double aspect) const {
    const Vec3 x = right(), y = up(), z = backward(), from = eye();
    render::CameraPose pose;
    const Vec3 rows[3] = {x, y, z};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            pose.view[static_cast<std::size_t>(4 * column + row)] = static_cast<float>(rows[row][column]);
        pose.view[static_cast<std::size_t>(12 + row)] = static_cast<float>(-rows[row].dot(from));
        pose.eye[static_cast<std::size_t>(row)] = static_cast<float>(from[row]);
    }
    pose.view[15] = 1.0f;

    double near_plane = 0, far_plane = 1;
    clip_range(near_plane, far_plane);
    const double depth = far_plane - near_plane;
    if (orthographic_) {
        const double half = half_height() * distance_;
        pose.projection[0] = static_cast<float>(1.0 / (half * aspect));
        pose.projection[5] = static_cast<float>(1.0 / half);
        pose.projection[10] = static_cast<float>(-2.0 / depth);
        pose.projection[14] = static_cast<float>(-(far_plane + near_plane) / depth);
        pose.projection[15] = 1.0f;
    } else {
        pose.projection[0] = static_cast<float>(1.0 / (half_height() * aspect));
        pose.projection[5] = static_cast<float>(1.0 / half_height());
        pose.projection[10] = static_cast<float>(-(far_plane + near_plane) / depth);
        pose.projection[11] = -1.0f;
        pose.projection[14] = static_cast<float>(-2.0 * far_plane * near_plane / depth);
    }
    return pose;
}

Ray Camera::ray(double x_px, double y_px, const ViewSize& size) const {
    const double x = (2.0 * x_px / size.width - 1.0) * half_height() * size.aspect();
    const double y = (1.0 - 2.0 * y_px / size.height) * half_height();
    if (orthographic_)
        return {eye() + distance_ * (x * right() + y * up()), -backward()};
    return {eye(), (x * right() + y * up() - backward()).normalized()};
}

std::optional<Vec2> Camera::project(const Vec3& point, const ViewSize& size) const {
    const Vec3 offset = point - eye();
    const double depth = orthographic_ ? distance_ : -offset.dot(backward());
    if (!(depth > 0))
        return std::nullopt;
    const double scale = 1.0 / (depth * half_height());
    return Vec2(0.5 * size.width * (1.0 + offset.dot(right()) * scale / size.aspect()),
                0.5 * size.height * (1.0 - offset.dot(up()) * scale));
}

} // namespace fascicle::view
