#include "fascicle/geometry/geodesic_line.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "geometry/funnel.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::test;

namespace {

/// Every piece of the line lies in its triangle.
void check_on_surface(const SurfaceGraph& graph, const GeodesicLine& line) {
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        const LinePoint& p = line.points[i];
        REQUIRE(p.triangle >= 0);
        const Tri& tri = graph.triangle(p.triangle);
        const SurfaceGraph one(
            shared({{graph.position(tri[0]), graph.position(tri[1]), graph.position(tri[2])}, {{0, 1, 2}}}));
        for (const Vec3& q : {p.point, line.points[i + 1].point})
            CHECK(std::sqrt(one.tree().closest(q).squared_distance) < 1e-9);
        if (p.edge >= 0)
            CHECK((p.share >= 0 && p.share <= 1));
    }
}

} // namespace

TEST_CASE("a line on a plane is straight", "[geometry][geodesic_line]") {
    const auto roughness = GENERATE(0.0, 0.22);
    const SurfaceGraph graph(shared(rough_sheet(30, roughness, 9)));
    GeodesicSearch search(graph);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(0.0, 30.0);
    for (int k = 0; k < 60; ++k) {
        const double x0 = place(random), y0 = place(random), x1 = place(random), y1 = place(random);
        Vec3 a(x0, y0, 0), b(x1, y1, 0);
        if (k % 5 == 1) { // from the middle of an edge to that of another
            const auto middle = [&] {
                const Edge& e = graph.topology().edges()[random() % graph.topology().edges().size()];
                return Vec3(0.5 * (graph.position(e.a) + graph.position(e.b)));
            };
            a = middle();
            b = middle();
        }
        if (k % 5 == 0) // from vertex to vertex
            a = graph.position(int(random() % 961)), b = graph.position(int(random() % 961));
        const GeodesicLine line = geodesic_line(search, foot(graph, a), foot(graph, b));
        REQUIRE(line.points.size() >= 2);
        CHECK(line.length == Approx((a - b).norm()).margin(1e-6));
        check_on_surface(graph, line);
    }
}

TEST_CASE("a line on a sphere is a great circle", "[geometry][geodesic_line]") {
    const SurfaceGraph graph(shared(sphere(20, 4)));
    GeodesicSearch search(graph);
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 40; ++k) {
        const Vec3 a = Vec3(normal(random), normal(random), normal(random)).normalized();
        Vec3 b = Vec3(normal(random), normal(random), normal(random)).normalized();
        if (a.dot(b) < -0.9)
            b = -b;
        const GeodesicLine line = geodesic_line(search, foot(graph, 20 * a), foot(graph, 20 * b));
        const double exact = 20 * std::atan2(a.cross(b).norm(), a.dot(b));
        CHECK(line.length == Approx(exact).epsilon(0.006).margin(0.02));
        check_on_surface(graph, line);
    }
}

TEST_CASE("a line round a box's edge is straight in its unfolding", "[geometry][geodesic_line]") {
    const SurfaceGraph graph(shared(box_mesh(Vec3::Zero(), Vec3(10, 10, 10), {7, 7, 7})));
    GeodesicSearch search(graph);
    const Vec3 a(2, 3, 10), b(10, 5, 6); // over the edge x = 10, z = 10
    const GeodesicLine line = geodesic_line(search, foot(graph, a), foot(graph, b));
    CHECK(line.length == Approx(std::hypot(8 + 4, 2)).epsilon(1e-6));
    check_on_surface(graph, line);
}

TEST_CASE("a line goes round a hole and is never longer than the edges' way", "[geometry][geodesic_line]") {
    TriMesh mesh = sheet(20, 20);
    std::erase_if(mesh.triangles, [&](const Tri& t) {
        const Vec3 c = (mesh.positions[std::size_t(t[0])] + mesh.positions[std::size_t(t[1])] +
                        mesh.positions[std::size_t(t[2])]) /
                       3;
        return c.x() > 8 && c.x() < 12 && c.y() > 2 && c.y() < 18;
    });
    const SurfaceGraph graph(shared(mesh));
    GeodesicSearch search(graph);
    const Vec3 a(5, 9, 0), b(15, 9, 0);
    const GeodesicLine line = geodesic_line(search, foot(graph, a), foot(graph, b));
    // Round the corners (8, 2) and (12, 2).
    CHECK(line.length == Approx(2 * std::hypot(3, 7) + 4).epsilon(1e-6));
    check_on_surface(graph, line);
    CHECK(geodesic_line(search, foot(graph, a), foot(graph, b), 10.0).points.empty());
}

TEST_CASE("no line between parts, a straight one within a triangle", "[geometry][geodesic_line]") {
    const SurfaceGraph graph(shared(joined(sphere(5, 2), sphere(5, 2, Vec3(20, 0, 0)))));
    GeodesicSearch search(graph);
    CHECK(geodesic_line(search, foot(graph, Vec3(5, 0, 0)), foot(graph, Vec3(15, 0, 0))).points.empty());
    const Tri& t = graph.triangle(0);
    const Vec3 middle = (graph.position(t[0]) + graph.position(t[1]) + graph.position(t[2])) / 3;
    const Vec3 near = 0.9 * middle + 0.1 * graph.position(t[0]);
    const GeodesicLine line = geodesic_line(search, foot(graph, middle), foot(graph, near));
    CHECK(line.points.size() == 2);
    CHECK(line.length == Approx((middle - near).norm()));
}

TEST_CASE("lines on random triangles and a torus end, no longer than edges", "[geometry][geodesic_line]") {
    std::mt19937 random(8);
    for (int round = 0; round < 12; ++round) {
        TriMesh mesh = torus(3.0, 1.0, 14, 9);
        if (round % 2 == 1) // bends, doubles and holes
            for (int k = 0; k < 30; ++k)
                mesh.triangles[random() % mesh.triangles.size()] =
                    mesh.triangles[random() % mesh.triangles.size()];
        const SurfaceGraph graph(shared(mesh));
        GeodesicSearch search(graph);
        for (int k = 0; k < 30; ++k) {
            const int a = int(random() % mesh.positions.size()), b = int(random() % mesh.positions.size());
            const SurfacePoint from = foot(graph, graph.position(a)), to = foot(graph, graph.position(b));
            const GeodesicLine line = geodesic_line(search, from, to);
            GeodesicLimits limits;
            limits.distance = 1e9;
            search.run(std::span(&from, 1), limits, WaveFront::edges);
            if (line.points.empty())
                continue;
            CHECK(line.length <= search.distance(b) + (graph.position(b) - to.point).norm() + 1e-9);
            check_on_surface(graph, line);
        }
    }
}

TEST_CASE("the funnel bends at the corners of its gates", "[geometry][geodesic_line]") {
    // A corridor upwards, then to the right round (1, 2).
    const std::vector<FunnelGate> gates{
        {Vec2(0, 1), Vec2(1, 1)}, {Vec2(0, 3), Vec2(1, 2)}, {Vec2(3, 3), Vec2(3, 2)}};
    const auto shares = funnel_shares(Vec2(0.5, 0), gates, Vec2(5, 1));
    REQUIRE(shares.size() == 3);
    CHECK(shares[0] == Approx(0.75));
    CHECK(shares[1] == 1.0);
    CHECK(shares[2] == 1.0); // (3, 2) is passed on the way down
    CHECK(funnel_shares(Vec2(0, 0), {}, Vec2(1, 1)).empty());
}
