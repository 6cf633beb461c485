#include "fascicle/geometry/volume.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace fascicle {
namespace {

const Vec3& at(const Points& points, int i) {
    return points[static_cast<std::size_t>(i)];
}

Vec3 corner_mean(const Points& points, const std::vector<Tri>& triangles) {
    Vec3 sum = Vec3::Zero();
    for (const Tri& t : triangles)
        sum += at(points, t[0]) + at(points, t[1]) + at(points, t[2]);
    return triangles.empty() ? sum : Vec3(sum / (3.0 * static_cast<double>(triangles.size())));
}

} // namespace

double signed_volume(const Points& points, const std::vector<Tri>& triangles) {
    const Vec3 c = corner_mean(points, triangles);
    double sum = 0.0;
    for (const Tri& t : triangles)
        sum += (at(points, t[0]) - c).dot((at(points, t[1]) - c).cross(at(points, t[2]) - c));
    return sum / 6.0;
}

void volume_gradient(const Points& points, const std::vector<Tri>& triangles, Points& gradient) {
    const Vec3 origin = corner_mean(points, triangles);
    gradient.assign(points.size(), Vec3::Zero());
    for (const Tri& t : triangles) {
        const Vec3 a = at(points, t[0]) - origin;
        const Vec3 b = at(points, t[1]) - origin;
        const Vec3 c = at(points, t[2]) - origin;
        gradient[static_cast<std::size_t>(t[0])] += b.cross(c) / 6.0;
        gradient[static_cast<std::size_t>(t[1])] += c.cross(a) / 6.0;
        gradient[static_cast<std::size_t>(t[2])] += a.cross(b) / 6.0;
    }
}

double surface_area(const Points& points, const std::vector<Tri>& triangles) {
    double sum = 0.0;
    for (const Tri& t : triangles)
        sum += 0.5 * (at(points, t[1]) - at(points, t[0])).cross(at(points, t[2]) - at(points, t[0])).norm();
    return sum;
}

Vec3 surface_centroid(const Points& points, const std::vector<Tri>& triangles) {
    if (triangles.empty()) {
        Vec3 sum = Vec3::Zero();
        for (const Vec3& p : points)
            sum += p;
        return points.empty() ? sum : Vec3(sum / static_cast<double>(points.size()));
    }
    const Vec3 mean = corner_mean(points, triangles);
    double area = 0.0;
    Vec3 moment = Vec3::Zero();
    for (const Tri& t : triangles) {
        const Vec3 a = at(points, t[0]) - mean;
        const Vec3 b = at(points, t[1]) - mean;
        const Vec3 c = at(points, t[2]) - mean;
        const double weight = (b - a).cross(c - a).norm();
        area += weight;
        moment += weight * (a + b + c) / 3.0;
    }
    return area > 0.0 ? Vec3(mean + moment / area) : mean;
}

double winding_number(const Points& points, const std::vector<Tri>& triangles, const Vec3& x) {
    double sum = 0.0;
    for (const Tri& t : triangles) {
        const Vec3 a = at(points, t[0]) - x;
        const Vec3 b = at(points, t[1]) - x;
        const Vec3 c = at(points, t[2]) - x;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        const double det = a.dot(b.cross(c));
        const double dot = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        if (det != 0.0 || dot != 0.0)
            sum += 2.0 * std::atan2(det, dot);
    }
    return sum / (4.0 * 3.14159265358979323846);
}

} // namespace fascicle
