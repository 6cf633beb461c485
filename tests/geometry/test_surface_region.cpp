#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/region_border.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "fascicle/geometry/region_ops.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

using namespace fascicle;
using namespace fascicle::test;

namespace {

SurfaceRegion random_region(int count, std::mt19937& random, unsigned one_in) {
    SurfaceRegion region(count);
    for (int v = 0; v < count; ++v)
        if (random() % one_in == 0)
            region.insert(v);
    return region;
}

/// Edges between in and out, each once: what a border on a closed surface must cross.
std::set<std::pair<int, int>> crossing_edges(const SurfaceGraph& graph, const SurfaceRegion& region) {
    std::set<std::pair<int, int>> edges;
    for (const Edge& e : graph.topology().edges())
        if (region.contains(e.a) != region.contains(e.b))
            edges.insert(region.contains(e.a) ? std::pair{e.a, e.b} : std::pair{e.b, e.a});
    return edges;
}

/// Twice the area vector of a closed polyline.
Vec3 area_vector(const Points& points) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < points.size(); ++i)
        sum += points[i].cross(points[(i + 1) % points.size()]);
    return sum;
}

} // namespace

TEST_CASE("a region is a set", "[geometry][region]") {
    std::mt19937 random(1);
    for (const int n : {1, 63, 64, 65, 200}) {
        const SurfaceRegion a = random_region(n, random, 2), b = random_region(n, random, 3);
        const SurfaceRegion both = a & b, any = a | b, rest = a - b, other = a.complement();
        int size = 0;
        for (int v = 0; v < n; ++v) {
            CHECK(both.contains(v) == (a.contains(v) && b.contains(v)));
            CHECK(any.contains(v) == (a.contains(v) || b.contains(v)));
            CHECK(rest.contains(v) == (a.contains(v) && !b.contains(v)));
            CHECK(other.contains(v) == !a.contains(v));
            size += a.contains(v) ? 1 : 0;
        }
        CHECK(a.size() == size);
        CHECK(other.size() == n - size);
        CHECK(other.complement() == a);
        CHECK(SurfaceRegion(n, a.vertices()) == a);
        CHECK(any.includes(a));
        CHECK(a.includes(both));
        CHECK_FALSE(rest.intersects(b));
        CHECK(a.intersects(a) == !a.empty());
    }
    CHECK(SurfaceRegion().empty());
    CHECK(SurfaceRegion().complement().empty());
}

TEST_CASE("the areas of a region and of its complement sum to the surface", "[geometry][region]") {
    std::mt19937 random(3);
    for (const TriMesh& mesh : {sphere(5, 3), torus(), sheet(9, 9)}) {
        const SurfaceGraph graph(shared(mesh));
        for (int k = 0; k < 5; ++k) {
            const SurfaceRegion region = random_region(graph.vertex_count(), random, 2);
            CHECK(measure_region(graph, region).area + measure_region(graph, region.complement()).area ==
                  Approx(graph.area()));
        }
    }
}

TEST_CASE("a disc on a plane and a cap on a sphere have their closed forms", "[geometry][region]") {
    const double pi = std::numbers::pi;
    const SurfaceGraph plane(shared(sheet(60, 60)));
    const auto disc = region_where<SurfaceRegion>(
        plane, [](const Vec3& p) { return (p - Vec3(30, 30, 0)).norm() <= 20.2; });
    const RegionMeasure m = measure_region(plane, disc);
    CHECK(m.area == Approx(pi * 20.2 * 20.2).epsilon(0.01));
    CHECK((m.centroid - Vec3(30, 30, 0)).norm() < 1e-9);
    CHECK((m.islands == 1 && m.holes == 0));
    const auto border = region_border(plane, disc);
    REQUIRE(border.size() == 1);
    CHECK(0.5 * area_vector(border_positions(plane, border[0])).z() == Approx(m.area).epsilon(0.01));

    const SurfaceGraph ball(shared(sphere(20, 5)));
    const double height = 20 * (1 - std::cos(0.5));
    const auto cap = region_where<SurfaceRegion>(ball, [&](const Vec3& p) { return p.z() >= 20 - height; });
    CHECK(measure_region(ball, cap).area == Approx(2 * pi * 20 * height).epsilon(0.03));
    const auto rim = region_border(ball, cap);
    REQUIRE(rim.size() == 1);
    CHECK(area_vector(border_positions(ball, rim[0])).z() > 0); // counter-clockwise from outside
    CHECK(border_length(ball, rim[0]) == Approx(2 * pi * 20 * std::sin(0.5)).epsilon(0.15));
}

TEST_CASE("borders cross every edge between in and out once, closed", "[geometry][region]") {
    std::mt19937 random(6);
    for (const TriMesh& mesh : {sphere(5, 3), torus(), inside_out(sphere(5, 2))}) {
        const SurfaceGraph graph(shared(mesh));
        for (const unsigned one_in : {2u, 5u, 40u}) {
            const SurfaceRegion region = random_region(graph.vertex_count(), random, one_in);
            auto left = crossing_edges(graph, region);
            for (const BorderLoop& loop : region_border(graph, region)) {
                CHECK(loop.closed);
                CHECK(loop.points.size() >= 3);
                for (std::size_t i = 0; i < loop.points.size(); ++i) {
                    const BorderPoint &p = loop.points[i], &q = loop.points[(i + 1) % loop.points.size()];
                    CHECK(left.erase({p.inside, p.outside}) == 1);
                    CHECK((p.inside == q.inside || p.outside == q.outside)); // the two edges share a corner
                }
            }
            CHECK(left.empty());
        }
    }
}

TEST_CASE("on an open surface a border follows the surface's own", "[geometry][region]") {
    const SurfaceGraph graph(shared(sheet(10, 10)));
    const SurfaceRegion all = SurfaceRegion(graph.vertex_count()).complement();
    auto border = region_border(graph, all);
    REQUIRE(border.size() == 1);
    CHECK(border[0].closed);
    CHECK(border[0].points.size() == 40);
    CHECK(0.5 * area_vector(border_positions(graph, border[0])).z() == Approx(100));
    const auto half = region_where<SurfaceRegion>(graph, [](const Vec3& p) { return p.x() <= 4; });
    border = region_border(graph, half);
    REQUIRE(border.size() == 1);
    CHECK(border[0].closed);
    CHECK(0.5 * area_vector(border_positions(graph, border[0])).z() == Approx(45));
    CHECK(region_border(graph, SurfaceRegion(graph.vertex_count())).empty());
    const SurfaceGraph ball(shared(sphere(1, 2)));
    CHECK(region_border(ball, SurfaceRegion(ball.vertex_count()).complement()).empty());
}

TEST_CASE("islands and holes are counted, a belt has none", "[geometry][region]") {
    const SurfaceGraph plane(shared(sheet(60, 40)));
    const auto from = [](const Vec3& p, double x, double y) { return std::hypot(p.x() - x, p.y() - y); };
    const auto rings = region_where<SurfaceRegion>(plane, [&](const Vec3& p) {
        return (from(p, 15, 20) <= 10 && from(p, 15, 20) >= 4) || from(p, 45, 20) <= 5 ||
               from(p, 15, 20) <= 1.5;
    });
    RegionMeasure m = measure_region(plane, rings);
    CHECK(m.islands == 3);
    CHECK(m.holes == 1);
    CHECK(region_border(plane, rings).size() == 4);
    const SurfaceRegion filled = fill_holes(plane, rings);
    m = measure_region(plane, filled);
    CHECK((m.islands == 2 && m.holes == 0));
    CHECK(filled.includes(rings));
    CHECK(fill_holes(plane, rings, 10.0) == rings);
    const SurfaceRegion largest = keep_largest(plane, filled);
    CHECK(measure_region(plane, largest).islands == 1);
    CHECK(largest.contains(20 * 61 + 15));

    const SurfaceGraph shaft(shared(cylinder_mesh(Vec3::Zero(), Vec3(0, 0, 100), 10, 40, 60)));
    const auto belt =
        region_where<SurfaceRegion>(shaft, [](const Vec3& p) { return std::abs(p.z() - 60) < 8; });
    CHECK(measure_region(shaft, belt).holes == 0);
    CHECK(fill_holes(shaft, belt) == belt);
    CHECK(region_border(shaft, belt).size() == 2);
}

TEST_CASE("regions on loose, non-manifold and empty surfaces", "[geometry][region]") {
    TriMesh fin = sheet(6, 6);
    fin.positions.emplace_back(3, 3, 2);
    fin.triangles.push_back({24, 25, 49});  // a third triangle at an edge
    fin.positions.emplace_back(50, 50, 50); // used by none
    const SurfaceGraph graph(shared(fin));
    SurfaceRegion region(graph.vertex_count());
    region.insert(std::vector<int>{24, 50});
    const RegionMeasure m = measure_region(graph, region);
    CHECK(m.vertices == 2);
    CHECK(m.islands == 2);
    CHECK(std::isfinite(m.area));
    CHECK_FALSE(region_border(graph, region).empty());
    CHECK(fill_holes(graph, region).includes(region));
    const SurfaceGraph none(shared(TriMesh{}));
    CHECK(measure_region(none, SurfaceRegion(0)).area == 0);
    CHECK(measure_region(graph, SurfaceRegion(graph.vertex_count())).centroid == Vec3::Zero());
}
