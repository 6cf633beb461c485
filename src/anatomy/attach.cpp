#include "fascicle/anatomy/attach.hpp"

#include "fascicle/geometry/inside_polygon.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a;
    const double squared = d.squaredNorm();
    const double s = squared > 0.0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0.0;
    return (a + s * d - p).norm();
}

double distance_to_line(const Vec3& p, const Points& line, bool closed) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        best = std::min(best, distance_to_segment(p, line[i], line[i + 1]));
    if (closed || line.size() == 1)
        best = std::min(best, distance_to_segment(p, line.back(), line.front()));
    return best;
}

Vec3 centroid_of(const Points& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points)
        sum += p;
    return sum / double(points.size());
}

/// The plane through the points' centroid that they spread least from, as two axes in it.
struct PrincipalPlane {
    explicit PrincipalPlane(const Points& points) : origin(centroid_of(points)) {
        Mat3 covariance = Mat3::Zero();
        for (const Vec3& p : points)
            covariance += (p - origin) * (p - origin).transpose();
        const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance); // eigenvalues ascending
        u = solver.eigenvectors().col(2);
        v = solver.eigenvectors().col(1);
    }
    Vec2 project(const Vec3& p) const { return {(p - origin).dot(u), (p - origin).dot(v)}; }

    Vec3 origin, u, v;
};

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = (b - a).cross(c - a);
    const double squared = normal.squaredNorm();
    if (squared > 0.0) {
        const Vec3 q = p - (p - a).dot(normal) / squared * normal;
        const bool over = (b - a).cross(q - a).dot(normal) >= 0 && (c - b).cross(q - b).dot(normal) >= 0 &&
                          (a - c).cross(q - c).dot(normal) >= 0;
        if (over)
            return (p - q).norm();
    }
    return std::min(
        {distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

/// Triangles from the outline's centroid to each of its sides.
double distance_to_fan(const Vec3& p, const Points& outline, const Vec3& centre) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < outline.size(); ++i)
        best = std::min(best, distance_to_triangle(p, centre, outline[i], outline[(i + 1) % outline.size()]));
    return best;
}

template <typename Accept>
std::vector<int> vertices_where(const TriMesh& muscle, const Accept& accept) {
    std::vector<int> vertices;
    for (int i = 0; i < muscle.vertex_count(); ++i)
        if (accept(muscle.positions[static_cast<std::size_t>(i)]))
            vertices.push_back(i);
    return vertices;
}

} // namespace

AttachRules attach_rules(double unit_mm) {
    AttachRules rules;
    for (double* length : {&rules.bone, &rules.border, &rules.open_gap, &rules.line, &rules.fan})
        *length /= unit_mm;
    return rules;
}

std::vector<int> attach_by_outline(const TriMesh& muscle, const Points& outline,
                                   const DistanceToBone& distance, const AttachRules& rules) {
    if (outline.empty())
        return {};
    const bool open = outline.size() < 3 || (outline.front() - outline.back()).norm() > rules.open_gap;
    if (open)
        return vertices_where(
            muscle, [&](const Vec3& p) { return distance_to_line(p, outline, false) <= rules.line; });
    if (!distance) {
        const Vec3 centre = centroid_of(outline);
        return vertices_where(
            muscle, [&](const Vec3& p) { return distance_to_fan(p, outline, centre) <= rules.fan; });
    }
    const PrincipalPlane plane(outline);
    std::vector<Vec2> polygon;
    for (const Vec3& p : outline)
        polygon.push_back(plane.project(p));
    return vertices_where(muscle, [&](const Vec3& p) {
        const bool within =
            inside_polygon(plane.project(p), polygon) || distance_to_line(p, outline, true) <= rules.border;
        return within && distance(p, rules.bone) <= rules.bone;
    });
}

std::vector<int> attach_by_distance(const TriMesh& muscle, const MeshTopology& topology,
                                    const DistanceToBone& distance, double limit) {
    std::vector<char> near(muscle.positions.size(), 0);
    for (std::size_t i = 0; i < near.size(); ++i)
        near[i] = topology.vertex_component(static_cast<int>(i)) >= 0 &&
                  distance(muscle.positions[i], limit) <= limit;
    std::vector<int> largest;
    for (std::size_t start = 0; start < near.size(); ++start) {
        if (near[start] == 0)
            continue;
        std::vector<int> patch{static_cast<int>(start)};
        near[start] = 0;
        for (std::size_t k = 0; k < patch.size(); ++k)
            for (const int neighbour : topology.vertex_neighbours(patch[k]))
                if (near[static_cast<std::size_t>(neighbour)] != 0) {
                    near[static_cast<std::size_t>(neighbour)] = 0;
                    patch.push_back(neighbour);
                }
        if (patch.size() > largest.size())
            largest = std::move(patch);
    }
    std::sort(largest.begin(), largest.end());
    return largest;
}

} // namespace fascicle
