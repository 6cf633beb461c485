#include "fascicle/anatomy/attach.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;

namespace {

/// A muscle lying on a bone that fills z < 0: the lower side of the sheet is 0.5 above it.
TriMesh flat_muscle() {
    TriMesh mesh = test::sheet(40, 40);
    for (Vec3& p : mesh.positions)
        p.z() = 0.5;
    return mesh;
}

double above_ground(const Vec3& p, double) {
    return std::abs(p.z());
}

Points circle(double radius, int count) {
    Points points;
    for (int i = 0; i < count; ++i) {
        const double t = 2 * std::numbers::pi * i / count;
        points.emplace_back(20 + radius * std::cos(t), 20 + radius * std::sin(t), 0);
    }
    return points;
}

double from_centre(const TriMesh& mesh, int v) {
    return (mesh.positions[std::size_t(v)] - Vec3(20, 20, 0.5)).norm();
}

} // namespace

TEST_CASE("a closed outline takes what lies in it and a little beyond, on that side only",
          "[anatomy][attach]") {
    TriMesh mesh = flat_muscle();
    mesh.positions.emplace_back(20, 20, 30); // over the outline but far from the bone
    const auto vertices = attach_by_outline(mesh, circle(10, 40), above_ground, attach_rules(1));
    CHECK(std::is_sorted(vertices.begin(), vertices.end()));
    int expected = 0;
    for (int v = 0; v + 1 < mesh.vertex_count(); ++v) {
        const bool taken = std::binary_search(vertices.begin(), vertices.end(), v);
        const double r = from_centre(mesh, v);
        if (r < 12.7)
            CHECK(taken);
        if (r > 13.1)
            CHECK_FALSE(taken);
        expected += taken ? 1 : 0;
    }
    CHECK(static_cast<int>(vertices.size()) == expected); // so not the far one
}

TEST_CASE("units: the same scene in metres attaches the same vertices", "[anatomy][attach]") {
    TriMesh mesh = flat_muscle();
    Points outline = circle(10, 40);
    const auto in_mm = attach_by_outline(mesh, outline, above_ground, attach_rules(1));
    for (Points* points : {&mesh.positions, &outline})
        for (Vec3& p : *points)
            p *= 1e-3;
    CHECK(attach_by_outline(mesh, outline, above_ground, attach_rules(1000)) == in_mm);
    CHECK(in_mm.size() > 400);
}

TEST_CASE("an outline with its ends far apart is a line", "[anatomy][attach]") {
    const TriMesh mesh = flat_muscle();
    const Points line{Vec3(5, 20, 0), Vec3(20, 20, 0), Vec3(35, 20, 0)};
    const auto vertices = attach_by_outline(mesh, line, above_ground, attach_rules(1));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Vec3& p = mesh.positions[std::size_t(v)];
        const double along = std::max({0.0, 5 - p.x(), p.x() - 35});
        const double distance = std::hypot(along, p.y() - 20, 0.5);
        CHECK(std::binary_search(vertices.begin(), vertices.end(), v) == (distance <= 4.0));
    }
}

TEST_CASE("without its bone an outline takes what is near the fan over it", "[anatomy][attach]") {
    const TriMesh mesh = flat_muscle();
    const auto vertices = attach_by_outline(mesh, circle(10, 40), {}, attach_rules(1));
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const bool taken = std::binary_search(vertices.begin(), vertices.end(), v);
        if (from_centre(mesh, v) < 14.5)
            CHECK(taken);
        if (from_centre(mesh, v) > 15.1)
            CHECK_FALSE(taken);
    }
}

TEST_CASE("odd outlines: empty, a point, collinear points", "[anatomy][attach]") {
    const TriMesh mesh = flat_muscle();
    CHECK(attach_by_outline(mesh, {}, above_ground, attach_rules(1)).empty());
    CHECK_FALSE(attach_by_outline(mesh, {Vec3(20, 20, 0)}, above_ground, attach_rules(1)).empty());
    const Points collinear{Vec3(18, 20, 0), Vec3(20, 20, 0), Vec3(22, 20, 0), Vec3(19, 20, 0)};
    const auto vertices = attach_by_outline(mesh, collinear, above_ground, attach_rules(1));
    CHECK(vertices.size() > 10);
    CHECK(vertices.size() < 80);
}

TEST_CASE("attachment by distance takes the largest connected patch", "[anatomy][attach]") {
    const TriMesh mesh = flat_muscle();
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const auto two_hills = [](const Vec3& p, double) {
        const double small = std::hypot(p.x() - 5, p.y() - 5) - 3,
                     large = std::hypot(p.x() - 28, p.y() - 28) - 8;
        return std::max(0.0, std::min(small, large));
    };
    const auto vertices = attach_by_distance(mesh, topology, two_hills, 0.25);
    CHECK(vertices.size() > 150);
    for (const int v : vertices)
        CHECK(std::hypot(mesh.positions[std::size_t(v)].x() - 28, mesh.positions[std::size_t(v)].y() - 28) <=
              8.25);
    CHECK(attach_by_distance(
              mesh, topology, [](const Vec3&, double) { return 1e9; }, 1)
              .empty());
}
