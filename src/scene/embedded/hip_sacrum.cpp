#include "hip_shapes.hpp"

#include "fascicle/geometry/implicit_tube.hpp"

#include <Eigen/Geometry>
#include <memory>

namespace fascicle::embedded {

namespace {

struct Segment {
    double y, z; // middle of the vertebral body
    double half_width, half_depth;
    double foramen; // distance of the foramina from the midline
};
/// Five fused vertebrae and the tail bone, on a curve that is hollow in front.
constexpr Segment segments[] = {{16, 100, 44, 15, 21}, {38, 84, 46, 14, 19}, {60, 62, 40, 11, 17},
                                {77, 38, 31, 8.5, 15}, {85, 14, 23, 7, 0},   {82, -8, 10, 5.5, 0},
                                {72, -24, 6, 4.5, 0}};

} // namespace

ImplicitShape sacrum_shape() {
    auto bone = std::make_shared<ImplicitUnion>();
    std::vector<TubeStation> stations;
    for (const Segment& s : segments)
        stations.push_back({Vec3(midline_x, s.y, s.z), s.half_width, s.half_depth, Vec3::UnitX()});
    bone->add(tube_shape(stations), 0.0);
    auto cuts = std::make_shared<std::vector<ImplicitShape>>();
    const Vec3 up = Vec3(0, -16, 103 - 84 + 3).normalized();
    // First vertebral body with its promontory, and its end plate on top.
    Mat3 axes;
    axes << Vec3::UnitX(), up.cross(Vec3::UnitX()), up;
    bone->add(ellipsoid_shape(Vec3(midline_x, 9, 104), Vec3(28, 18, 22), axes), 8.0);
    for (const double side : {-1.0, 1.0}) {
        // Wings: thick in front at the sacro-iliac joint.
        bone->add(ellipsoid_shape(Vec3(midline_x + side * 34, 27, 91), Vec3(21, 15, 15)), 14.0);
        bone->add(ellipsoid_shape(Vec3(midline_x + side * 38, 40, 81), Vec3(16, 15, 25)), 16.0);
        // Upper articular processes.
        bone->add(round_cone_shape(Vec3(midline_x + side * 19, 40, 104), Vec3(midline_x + side * 22, 38, 116),
                                   9, 6),
                  12.0);
        // Row of tubercles outside the rear foramina.
        for (int i = 1; i < 4; ++i) {
            const Segment& s = segments[i];
            bone->add(sphere_shape(Vec3(midline_x + side * 0.62 * s.half_width, s.y + 9, s.z + 8), 5.5),
                      10.0);
        }
    }
    for (int i = 0; i < 4; ++i) {
        const Segment &s = segments[i], &t = segments[i + 1];
        const Vec3 back(0, 0.78, 0.62);
        // Spines along the middle of the back, melted into a crest.
        const Vec3 foot = Vec3(midline_x, s.y, s.z) + back * (s.half_depth - 2);
        bone->add(round_cone_shape(foot, foot + (12.0 - 2.0 * i) * back, 7, 4), 14.0);
        // Foramina between this vertebra and the next, from the front and from the back.
        const Vec3 between(0, 0.5 * (s.y + t.y), 0.5 * (s.z + t.z));
        const Vec3 normal = Vec3(0, s.z - t.z, t.y - s.y).normalized(); // backwards
        const double depth = 0.5 * (s.half_depth + t.half_depth);
        for (const double side : {-1.0, 1.0}) {
            const Vec3 at =
                between + Vec3(midline_x + side * 0.5 * (s.foramen + (i < 3 ? t.foramen : 13)), 0, 0);
            cuts->push_back(round_cone_shape(at - (depth + 3) * normal + Vec3(side * 8, 0, 0),
                                             at - 4.0 * normal, 6.5, 3.2));
            cuts->push_back(round_cone_shape(at + (depth + 9) * normal, at + 5.0 * normal, 6.5, 2.4));
        }
    }
    // Shallow transverse lines in front where the vertebrae grew together would be lost at this size of triangle.
    const Vec3 top = Vec3(midline_x, 6, 118);
    const auto value = [=](const Vec3& p) {
        double f = (*bone)(p);
        for (const ImplicitShape& cut : *cuts)
            if ((p - cut.centre).norm() < cut.radius + 15.0)
                f = smooth_max(f, -cut(p), 4.0);
        // End plate of the first vertebra: flat and slightly dished.
        const Vec3 q = p - top;
        const double across = Vec3(q.x(), 0, 0).norm();
        return across < 45.0 && q.y() < 22.0 ? smooth_max(f, q.dot(up) - 0.004 * across * across * 0.5, 4.0)
                                             : f;
    };
    return {value, Vec3(midline_x, 48, 45), 110};
}

} // namespace fascicle::embedded
