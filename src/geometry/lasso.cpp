#include "fascicle/geometry/lasso.hpp"

#include "fascicle/geometry/inside_polygon.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace fascicle {
namespace {

Vec3 towards(const ScreenEye& eye, const Vec3& p) {
    return eye.parallel ? eye.place : Vec3(eye.place - p);
}

} // namespace

std::optional<ScreenEye> screen_eye(const ScreenMatrix& world_to_screen) {
    Eigen::Matrix<double, 3, 4> rows;
    rows << world_to_screen.row(0), world_to_screen.row(1), world_to_screen.row(3);
    if (!rows.allFinite())
        return std::nullopt;
    for (int r = 0; r < 3; ++r) // screens in pixels, scenes in metres: compare directions only
        if (const double size = rows.row(r).norm(); size > 0.0)
            rows.row(r) /= size;
    // The vector orthogonal to three: its components are the 3 x 3 minors.
    Eigen::Vector4d null;
    for (int k = 0; k < 4; ++k) {
        Mat3 minor;
        for (int c = 0, to = 0; c < 4; ++c)
            if (c != k)
                minor.col(to++) = rows.col(c);
        null[k] = (k % 2 == 0 ? 1.0 : -1.0) * minor.determinant();
    }
    const double size = null.norm();
    if (!(size > 1e-14))
        return std::nullopt;
    null /= size;
    if (std::abs(null[3]) > 1e-12)
        return ScreenEye{false, null.head<3>() / null[3]};
    const Vec3 direction = null.head<3>().normalized();
    const double deeper = world_to_screen.row(2).head<3>().dot(direction);
    return ScreenEye{true, deeper > 0.0 ? Vec3(-direction) : direction};
}

bool faces_eye(const SurfaceGraph& graph, int triangle, const ScreenEye& eye) {
    return graph.normal(triangle).dot(towards(eye, graph.position(graph.triangle(triangle)[0]))) > 0.0;
}

bool vertex_faces_eye(const SurfaceGraph& graph, int vertex, const ScreenEye& eye) {
    const auto triangles = graph.topology().vertex_triangles(vertex);
    return std::any_of(triangles.begin(), triangles.end(), [&](int t) { return faces_eye(graph, t, eye); });
}

bool vertex_visible(const SurfaceGraph& graph, int vertex, const ScreenEye& eye) {
    const Vec3& p = graph.position(vertex);
    const Vec3 ray = towards(eye, p);
    const double length = ray.norm();
    if (!(length > 0.0))
        return true;
    const double near = 0.01 * graph.mean_edge_length();
    const double far = eye.parallel ? std::numeric_limits<double>::infinity() : length;
    return !graph.tree().blocked(p, ray / length, near, far);
}

SurfaceRegion lasso(const SurfaceGraph& graph, const ScreenMatrix& world_to_screen,
                    const std::vector<Vec2>& polygon, LassoReach reach) {
    SurfaceRegion result(graph.vertex_count());
    if (polygon.size() < 3)
        return result;
    const std::optional<ScreenEye> eye = screen_eye(world_to_screen);
    if (!eye && reach != LassoReach::through)
        return result;
    Vec2 low = polygon[0], high = polygon[0];
    for (const Vec2& p : polygon) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    for (int v = 0; v < graph.vertex_count(); ++v) {
        const Eigen::Vector4d clip = world_to_screen * graph.position(v).homogeneous();
        if (!(clip[3] > 0.0) || graph.topology().vertex_component(v) < 0)
            continue;
        const Vec2 place = clip.head<2>() / clip[3];
        if ((place.array() < low.array()).any() || (place.array() > high.array()).any() ||
            !inside_polygon(place, polygon))
            continue;
        if (reach != LassoReach::through && !vertex_faces_eye(graph, v, *eye))
            continue;
        if (reach == LassoReach::visible && !vertex_visible(graph, v, *eye))
            continue;
        result.insert(v);
    }
    return result;
}

} // namespace fascicle
