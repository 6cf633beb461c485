#include "fascicle/anatomy/area_from_outline.hpp"
#include "fascicle/anatomy/attached_vertices.hpp"
#include "fascicle/anatomy/attachment_area.hpp"
#include "fascicle/anatomy/outline_bone.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

constexpr double pi = std::numbers::pi;

Points circle(const Vec3& centre, double radius, int count, double from = 0, double to = 2 * pi) {
    Points points;
    for (int i = 0; i < count; ++i) {
        const double t = from + (to - from) * i / count;
        points.push_back(centre + radius * Vec3(std::cos(t), std::sin(t), 0));
    }
    return points;
}

SurfaceRegion from_outline(GeodesicSearch& search, const Points& outline, OutlineAreaRules rules = {}) {
    return area_from_outline(search, outline, rules, "iliacus: origin on 'ilium'");
}

/// Vertices of the plate's upper side within the radius of a point.
SurfaceRegion upper_disc(const SurfaceGraph& graph, const Vec3& centre, double radius) {
    return region_where<SurfaceRegion>(
        graph, [&](const Vec3& p) { return p.z() > centre.z() - 0.1 && (p - centre).norm() <= radius; });
}

SurfaceGraph plate() {
    return SurfaceGraph(shared(box_mesh(Vec3(0, 0, 0), Vec3(60, 50, 2), {60, 50, 2})));
}

} // namespace

TEST_CASE("a circle of points encloses its disc, from above a plate only on its upper side",
          "[anatomy][area]") {
    const SurfaceGraph graph = plate();
    GeodesicSearch search(graph);
    for (const double height : {2.0, 2.8}) { // on the bone, and digitised a little off it
        const SurfaceRegion region = from_outline(search, circle(Vec3(30.2, 24.7, height), 14, 60));
        const RegionMeasure m = measure_region(graph, region);
        CHECK(m.area == Approx(pi * 196).epsilon(0.015));
        CHECK((m.islands == 1 && m.holes == 0));
        CHECK((m.centroid - Vec3(30.2, 24.7, 2)).norm() < 0.3);
        region.for_each([&](int v) { CHECK(graph.position(v).z() > 1.9); });
    }
    // Either direction of digitising, any start.
    Points points = circle(Vec3(30.2, 24.7, 2), 14, 60);
    const SurfaceRegion region = from_outline(search, points);
    std::rotate(points.begin(), points.begin() + 17, points.end());
    CHECK(from_outline(search, points) == region);
    std::reverse(points.begin(), points.end());
    CHECK(from_outline(search, points) == region);
}

TEST_CASE("a cap on a sphere is the smaller side of its rim", "[anatomy][area]") {
    const SurfaceGraph graph(shared(sphere(20, 5)));
    GeodesicSearch search(graph);
    for (const double angle : {0.4, 1.2}) {
        const SurfaceRegion region =
            from_outline(search, circle(Vec3(0, 0, 20 * std::cos(angle)), 20 * std::sin(angle), 48));
        CHECK(measure_region(graph, region).area ==
              Approx(2 * pi * 400 * (1 - std::cos(angle))).epsilon(0.02));
        CHECK(region.contains(4)); // the pole
    }
}

TEST_CASE("open, short and doubled outlines become strips", "[anatomy][area]") {
    const SurfaceGraph graph = plate();
    GeodesicSearch search(graph);
    OutlineAreaRules rules;
    rules.strip = 6;
    const Points line{Vec3(10, 25.3, 2), Vec3(30, 25.3, 2), Vec3(50, 25.3, 2)};
    const SurfaceRegion strip = from_outline(search, line, rules);
    for (int v = 0; v < graph.vertex_count(); ++v) {
        const Vec3& p = graph.position(v);
        const double along = std::max({0.0, 10 - p.x(), p.x() - 50});
        const double d = std::hypot(along, p.y() - 25.3);
        if (p.z() > 1.9 && d < 2.9)
            CHECK(strip.contains(v));
        if (p.z() < 1.9 || d > 3.1)
            CHECK_FALSE(strip.contains(v));
    }
    rules.strip = 0.01; // narrower than the triangles: still a connected line
    const SurfaceRegion thin = from_outline(search, line, rules);
    CHECK(measure_region(graph, thin).islands == 1);
    CHECK(thin.size() >= 40);
    CHECK(from_outline(search, {Vec3(20, 20, 2)}).size() >= 1);
    CHECK(from_outline(search, {Vec3(20, 20, 2), Vec3(20, 20, 2), Vec3(20, 20, 2)}).size() >= 1);
    // There and back again encloses nothing.
    const Points back{Vec3(20, 20, 2), Vec3(30, 20, 2), Vec3(25, 20, 2)};
    CHECK(from_outline(search, back).size() >= 10);
}

TEST_CASE("outlines off the bone name muscle and area", "[anatomy][area]") {
    const SurfaceGraph graph = plate();
    GeodesicSearch search(graph);
    CHECK_THROWS_WITH(from_outline(search, circle(Vec3(30, 25, 12), 14, 30)),
                      Contains("iliacus: origin on 'ilium'") && Contains("10 from the bone on average"));
    Points one_far = circle(Vec3(30, 25, 2), 14, 60);
    one_far[7].z() += 20;
    CHECK_THROWS_WITH(from_outline(search, one_far), Contains("20 at most"));
    CHECK_THROWS_WITH(from_outline(search, {}), Contains("no points"));
    CHECK_THROWS_AS(from_outline(search, {Vec3(std::nan(""), 0, 0)}), Error);
    const SurfaceGraph two(shared(joined(sphere(5, 2), sphere(5, 2, Vec3(12, 0, 0)))));
    GeodesicSearch on_two(two);
    CHECK_THROWS_WITH(from_outline(on_two, {Vec3(4.9, 0, 0), Vec3(7.1, 0, 0), Vec3(4.8, 1, 0)}),
                      Contains("points 1 and 2 lie on parts of the bone that do not hang together"));
    CHECK(outline_area_rules(1000).mean_far == Approx(0.003));
}

TEST_CASE("labels of a point array and areas are two forms of one thing", "[anatomy][area]") {
    std::vector<AttachmentArea> areas;
    const auto add = [&](AttachmentKind kind, int bone, const std::string& head, std::vector<int> vertices) {
        areas.push_back({kind, bone, head, SurfaceRegion(20, vertices)});
    };
    add(AttachmentKind::origin, 1, "", {0, 1, 2});
    add(AttachmentKind::insertion, 1, "", {5, 6});
    add(AttachmentKind::origin, 0, "", {9});
    add(AttachmentKind::insertion, 1, "2", {7});
    add(AttachmentKind::origin, 1, "2", {19});
    const std::vector<double> labels = area_labels(areas, 1, 20);
    CHECK((labels[0] == 1 && labels[5] == 2 && labels[7] == 4 && labels[19] == 3 && labels[9] == 0));
    const auto again = areas_from_labels(labels, 1, "x.vtp");
    REQUIRE(again.size() == 4);
    for (const AttachmentArea& area : again) {
        const int at = find_area(areas, area.kind, area.bone, area.head);
        REQUIRE(at >= 0);
        CHECK(areas[std::size_t(at)] == area);
    }
    CHECK(areas_from_labels(std::vector<double>(20, 0.0), 1, "x").empty());
    for (const double bad : {-1.0, 1.5, 201.0, 1e300, std::nan("")}) {
        std::vector<double> wrong(4, 0.0);
        wrong[2] = bad;
        CHECK_THROWS_WITH(areas_from_labels(wrong, 0, "x.vtp"), Contains("x.vtp") && Contains("vertex 2"));
    }
    areas[1].vertices.insert(1);
    give_vertices(areas, 1);
    CHECK_FALSE(areas[0].vertices.contains(1));
    CHECK(areas[2].vertices.contains(9));
    CHECK(area_text(areas[3], "femur") == "insertion of head '2' on 'femur'");
    CHECK(area_text(areas[0], "femur") == "origin on 'femur'");
}

TEST_CASE("a patch marks the bone under it, on its own side of a thin bone", "[anatomy][area]") {
    const SurfaceGraph graph = plate();
    for (const bool turned : {false, true}) {
        TriMesh patch = sheet(10, 8);
        for (Vec3& p : patch.positions)
            p += Vec3(20.5, 20.5, 2.3);
        if (turned)
            patch = inside_out(patch);
        const SurfaceRegion region = area_from_patch(graph, patch, 3.0); // reaches the lower side as well
        CHECK(region.contains(nearest_corner(graph, foot(graph, Vec3(25, 25, 2)))));
        region.for_each([&](int v) { CHECK(graph.position(v).z() > 1.9); });
        CHECK(region.size() > 10 * 8);
        CHECK(area_from_patch(graph, patch, 0.1).empty());
    }
}

TEST_CASE("nearness marks the largest part that a muscle touches", "[anatomy][area]") {
    const SurfaceGraph graph = plate();
    const TriMesh muscle = joined(sphere(10, 3, Vec3(20, 25, 12.5)), sphere(4, 3, Vec3(50, 25, 6.5)));
    const SurfaceRegion region = area_from_nearness(graph, muscle, 1.0);
    CHECK(measure_region(graph, region).islands == 1);
    region.for_each([&](int v) {
        const Vec3& p = graph.position(v);
        CHECK((p - Vec3(20, 25, 12.5)).norm() - 10 < 1.05);
    });
    CHECK(region.size() > 5);
    CHECK(area_from_nearness(graph, muscle, 0.01).empty());
}

TEST_CASE("attached vertices lie over the area or a little beyond, on that side only", "[anatomy][area]") {
    const SurfaceGraph graph = plate();
    GeodesicSearch search(graph);
    TriMesh muscle = sheet(60, 50);
    for (Vec3& p : muscle.positions)
        p.z() = 2.5;
    TriMesh below = muscle;
    for (Vec3& p : below.positions)
        p.z() = -0.5; // 2.5 below the upper side: the plate is thinner than the limit
    muscle = joined(muscle, below);
    muscle.positions.emplace_back(30, 25, 8); // over the area, but far
    const SurfaceRegion area = upper_disc(graph, Vec3(30, 25, 2), 10);
    const auto attached = attached_vertices(area, search, muscle, attach_rules(1));
    const auto vertices = vertices_of(attached);
    CHECK(std::is_sorted(vertices.begin(), vertices.end()));
    for (int v = 0; v < muscle.vertex_count(); ++v) {
        const Vec3& p = muscle.positions[std::size_t(v)];
        const double r = std::hypot(p.x() - 30, p.y() - 25);
        const bool held = std::binary_search(vertices.begin(), vertices.end(), v);
        if (p.z() != 2.5)
            CHECK_FALSE(held);
        else if (r < 12.2)
            CHECK(held);
        else if (r > 14)
            CHECK_FALSE(held);
    }
    int beyond = 0;
    for (const AttachedVertex& a : attached) {
        const Vec3& p = muscle.positions[std::size_t(a.vertex)];
        CHECK(a.distance == Approx(0.5));
        CHECK((a.foot - Vec3(p.x(), p.y(), 2)).norm() < 1e-9);
        beyond += a.in_border ? 1 : 0;
        CHECK(a.in_border == (std::hypot(p.x() - 30, p.y() - 25) > 10.01));
    }
    CHECK(beyond > 100);
    CHECK(attached_vertices(SurfaceRegion(graph.vertex_count()), search, muscle, attach_rules(1)).empty());
}

TEST_CASE("an area and its outline attach nearly the same vertices", "[anatomy][area]") {
    const SurfaceGraph graph = plate();
    GeodesicSearch search(graph);
    TriMesh muscle = sheet(60, 50);
    for (Vec3& p : muscle.positions)
        p.z() = 2.5 + 0.05 * std::abs(p.x() - 30);
    const Points outline = circle(Vec3(30, 25, 2), 12, 50);
    const auto by_outline = attach_by_outline(
        muscle, outline,
        [&](const Vec3& p, double limit) {
            return std::sqrt(graph.tree().closest(p, limit * 1.0001).squared_distance);
        },
        attach_rules(1));
    const auto by_area =
        vertices_of(attached_vertices(from_outline(search, outline), search, muscle, attach_rules(1)));
    std::vector<int> both;
    std::set_intersection(by_outline.begin(), by_outline.end(), by_area.begin(), by_area.end(),
                          std::back_inserter(both));
    CHECK(by_outline.size() > 500);
    CHECK(double(both.size()) > 0.93 * double(std::max(by_outline.size(), by_area.size())));
}

TEST_CASE("an outline's bone: by name, else by nearness", "[anatomy][area]") {
    const std::vector<DistanceToBone> distances{[](const Vec3& p, double) { return std::abs(p.z()); },
                                                [](const Vec3& p, double) { return std::abs(p.z() - 10); }};
    const AttachmentOutline outline{AttachmentKind::origin, "ilium", circle(Vec3(0, 0, 9), 3, 12)};
    CHECK(find_outline_bone(outline, {"a", "b"}, distances, 3, 1e6).bone == 1);
    CHECK(find_outline_bone(outline, {"a", "b"}, distances, 3, 1e6).on_bone);
    const OutlineBone named = find_outline_bone(outline, {"ilium", "b"}, distances, 3, 1e6);
    CHECK((named.bone == 0 && !named.on_bone && named.mean_distance == Approx(9)));
    CHECK(find_outline_bone(outline, {}, {}, 3, 1e6).bone == -1);
    CHECK(find_outline_bone({}, {"a", "b"}, distances, 3, 1e6).bone == -1);
}
