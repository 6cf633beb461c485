#include "io/formats/mesh_bodies.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/float_rounding.hpp"

#include <cmath>
#include <limits>

namespace fascicle::io {

namespace {

/// Leaves out the points that no face (a triangle or line) uses; the others keep their order.
template <typename Faces>
void keep_used(Points& points, Faces& faces) {
    std::vector<int> place(points.size(), -1);
    for (const auto& face : faces)
        for (const int v : face)
            place[static_cast<std::size_t>(v)] = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (place[i] == 0) {
            place[i] = static_cast<int>(kept);
            points[kept++] = points[i];
        }
    points.resize(kept);
    for (auto& face : faces)
        for (int& v : face)
            v = place[static_cast<std::size_t>(v)];
}

} // namespace

std::vector<AnimatedBody> bodies_of_mesh(const MeshData& data, BodyKind surface) {
    std::vector<AnimatedBody> bodies;
    const bool both = !data.mesh.triangles.empty() && !data.lines.lines.empty();
    if (!data.mesh.triangles.empty()) {
        AnimatedBody& body = bodies.emplace_back();
        body.name = "surface";
        body.kind = surface;
        body.triangles = data.mesh.triangles;
        body.rest = data.mesh.positions;
        if (both)
            keep_used(body.rest, body.triangles);
    }
    if (!data.lines.lines.empty()) {
        AnimatedBody& body = bodies.emplace_back();
        body.name = "lines";
        body.kind = BodyKind::fibres;
        body.lines = data.lines.lines;
        body.rest = data.lines.points;
        if (both)
            keep_used(body.rest, body.lines);
    }
    return bodies;
}

void want_finite(const Points& points, const std::string& file) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!points[i].allFinite())
            throw_error(file, "point " + std::to_string(i) + " of a body is moved out of all range",
                        "finite places");
}

float to_float(double value, const std::string& where) {
    constexpr double most = std::numeric_limits<float>::max();
    if (!(std::abs(value) <= most))
        throw_error(where, "a coordinate is beyond " + std::to_string(std::numeric_limits<float>::max()),
                    "coordinates that a float can hold");
    return static_cast<float>(value);
}

Points rounded_to_floats(Points points, const std::string& where) {
    for (const Vec3& p : points)
        for (int k = 0; k < 3; ++k)
            to_float(p[k], where);
    round_to_floats(points);
    return points;
}

} // namespace fascicle::io
