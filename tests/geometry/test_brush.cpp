#include "fascicle/geometry/brush.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;
using namespace fascicle::test;

namespace {

Brush brush_of(double radius) {
    Brush brush;
    brush.radius = radius;
    return brush;
}

double painted_area(const SurfaceGraph& graph, const std::vector<int>& vertices) {
    return measure_region(graph, SurfaceRegion(graph.vertex_count(), vertices)).area;
}

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + s * (b - a) - p).norm();
}

} // namespace

TEST_CASE("a dab has the area of a disc on a plane and of a cap on a sphere", "[geometry][brush]") {
    const double pi = std::numbers::pi;
    const SurfaceGraph plane(shared(sheet(80, 80)));
    GeodesicSearch search(plane);
    const double dab =
        painted_area(plane, brush_vertices(search, foot(plane, Vec3(40.3, 40.2, 0)), brush_of(20)));
    CHECK(dab == Approx(pi * 400).epsilon(0.02));
    const SurfaceGraph ball(shared(sphere(20, 6)));
    GeodesicSearch on_ball(ball);
    for (const double radius : {4.0, 10.0, 30.0}) {
        const double cap =
            painted_area(ball, brush_vertices(on_ball, foot(ball, Vec3(3, 8, 18)), brush_of(radius)));
        CHECK(cap == Approx(2 * pi * 400 * (1 - std::cos(radius / 20))).epsilon(0.03));
    }
    CHECK(int(brush_vertices(on_ball, foot(ball, Vec3(3, 8, 18)), brush_of(1e9)).size()) ==
          ball.vertex_count());
    CHECK(brush_vertices(on_ball, foot(ball, Vec3(3, 8, 18)), brush_of(1e-9)).size() == 1);
    CHECK(brush_vertices(on_ball, SurfacePoint{}, brush_of(1)).empty());
}

TEST_CASE("painting the front of a thin plate leaves its back alone", "[geometry][brush]") {
    const SurfaceGraph plate(shared(box_mesh(Vec3(0, 0, 0), Vec3(60, 60, 1.5), {60, 60, 2})));
    GeodesicSearch search(plate);
    Brush brush = brush_of(8);
    const auto on_back = [&](const std::vector<int>& vertices) {
        return std::count_if(vertices.begin(), vertices.end(),
                             [&](int v) { return plate.position(v).z() < 0.1; });
    };
    const SurfacePoint middle = foot(plate, Vec3(30, 30, 2));
    CHECK(on_back(brush_vertices(search, middle, brush)) == 0);
    brush.reach = BrushReach::sphere;
    CHECK(on_back(brush_vertices(search, middle, brush)) > 100); // what the connected brush is for
    // At the rim the back is nearer than the radius along the surface too: there the eye decides.
    const SurfacePoint rim = foot(plate, Vec3(57, 30, 2));
    brush.reach = BrushReach::connected;
    CHECK(on_back(brush_vertices(search, rim, brush)) > 10);
    for (const BrushReach reach : {BrushReach::connected, BrushReach::sphere}) {
        brush.reach = reach;
        brush.eye = Vec3(30, 30, 500);
        const auto seen = brush_vertices(search, rim, brush);
        CHECK(seen.size() > 100);
        CHECK(on_back(seen) == 0);
    }
}

TEST_CASE("hidden vertices are not painted when only visible ones are wanted", "[geometry][brush]") {
    // A roof over half of the floor, joined to it by nothing.
    TriMesh roof = sheet(10, 20);
    for (Vec3& p : roof.positions)
        p.z() = 3;
    const SurfaceGraph graph(shared(joined(sheet(20, 20), roof)));
    GeodesicSearch search(graph);
    Brush brush = brush_of(6);
    brush.eye = Vec3(10.5, 10, 1e5);
    const SurfacePoint at = foot(graph, Vec3(12, 10, 0));
    const auto all = brush_vertices(search, at, brush);
    brush.visible_only = true;
    const auto visible = brush_vertices(search, at, brush);
    CHECK(visible.size() < all.size());
    for (const int v : visible)
        CHECK(graph.position(v).x() > 9.9);
    for (const int v : all)
        if (graph.position(v).x() > 10.1)
            CHECK(std::binary_search(visible.begin(), visible.end(), v));
}

TEST_CASE("a stroke paints everything within the radius of its way", "[geometry][brush]") {
    const SurfaceGraph plane(shared(sheet(80, 40)));
    GeodesicSearch search(plane);
    const Vec3 a(15.2, 20.1, 0), b(61.7, 22.4, 0);
    const auto painted = stroke_vertices(search, foot(plane, a), foot(plane, b), brush_of(8));
    CHECK(std::is_sorted(painted.begin(), painted.end()));
    for (int v = 0; v < plane.vertex_count(); ++v) {
        const double d = to_segment(plane.position(v), a, b);
        if (d < 7.95)
            CHECK(std::binary_search(painted.begin(), painted.end(), v));
        if (d > 8.2)
            CHECK_FALSE(std::binary_search(painted.begin(), painted.end(), v));
    }
    CHECK(stroke_vertices(search, SurfacePoint{}, foot(plane, b), brush_of(8)) ==
          brush_vertices(search, foot(plane, b), brush_of(8)));
    CHECK(stroke_vertices(search, foot(plane, a), SurfacePoint{}, brush_of(8)).empty());
}

TEST_CASE("a stroke jumps where there is no short way", "[geometry][brush]") {
    const SurfaceGraph plate(shared(box_mesh(Vec3(0, 0, 0), Vec3(60, 60, 1), {60, 60, 1})));
    GeodesicSearch search(plate);
    const SurfacePoint front = foot(plate, Vec3(30, 30, 2)), back = foot(plate, Vec3(31, 30, -1));
    CHECK(stroke_vertices(search, front, back, brush_of(5)) == brush_vertices(search, back, brush_of(5)));
}
