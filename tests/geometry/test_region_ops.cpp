#include "fascicle/geometry/brush.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/region_border.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "fascicle/geometry/region_mirror.hpp"
#include "fascicle/geometry/region_ops.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;
using namespace fascicle::test;

namespace {

/// A few discs and specks at random.
SurfaceRegion blots(GeodesicSearch& search, std::mt19937& random) {
    const SurfaceGraph& graph = search.graph();
    SurfaceRegion region(graph.vertex_count());
    for (int k = 0; k < 4; ++k) {
        const Vec3 p = graph.position(int(random() % unsigned(graph.vertex_count())));
        region.insert(brush_vertices(search, foot(graph, p), {0.3 + 0.3 * k, {}, {}, false}));
    }
    for (int k = 0; k < 10; ++k)
        region.insert(int(random() % unsigned(graph.vertex_count())));
    return region;
}

double border_length(const SurfaceGraph& graph, const SurfaceRegion& region) {
    double length = 0;
    for (const BorderLoop& loop : region_border(graph, region))
        length += fascicle::border_length(graph, loop);
    return length;
}

} // namespace

TEST_CASE("growing and shrinking: inverse of each other up to closing and opening",
          "[geometry][region_ops]") {
    std::mt19937 random(12);
    for (const TriMesh& mesh : {sphere(4, 4), torus(3, 1, 60, 30), sheet(20, 20)}) {
        const SurfaceGraph graph(shared(mesh));
        GeodesicSearch search(graph);
        for (int k = 0; k < 6; ++k) {
            const SurfaceRegion region = blots(search, random);
            CHECK(shrink_ring(graph, grow_ring(graph, region)).includes(region));
            CHECK(region.includes(grow_ring(graph, shrink_ring(graph, region))));
            CHECK(grow_ring(graph, region).complement() == shrink_ring(graph, region.complement()));
            CHECK(grow(search, region, 0) == region);
            CHECK(shrink(search, region, 0) == region);
            SurfaceRegion last = region;
            const double edge = graph.mean_edge_length();
            for (const double d : {2.0 * edge, 3.5 * edge, 5.0 * edge}) {
                const SurfaceRegion wider = grow(search, region, d), narrower = shrink(search, region, d);
                CHECK(wider.includes(last));
                CHECK(region.includes(narrower));
                CHECK(shrink(search, wider, 0.9 * d - edge).includes(region));
                last = wider;
            }
        }
    }
}

TEST_CASE("growing is by true length: plane and sphere", "[geometry][region_ops]") {
    const SurfaceGraph plane(shared(sheet(40, 40)));
    GeodesicSearch search(plane);
    const auto column = region_where<SurfaceRegion>(plane, [](const Vec3& p) { return p.x() <= 10; });
    CHECK(grow(search, column, 5.6) ==
          region_where<SurfaceRegion>(plane, [](const Vec3& p) { return p.x() <= 16; }));
    CHECK(shrink(search, column, 3.6) ==
          region_where<SurfaceRegion>(plane, [](const Vec3& p) { return p.x() <= 6; }));
    const double inf = std::numeric_limits<double>::infinity();
    CHECK(grow(search, column, inf).size() == plane.vertex_count());
    CHECK(shrink(search, column, inf).empty());
    CHECK(shrink(search, SurfaceRegion(plane.vertex_count()).complement(), 5).size() == plane.vertex_count());

    const SurfaceGraph ball(shared(sphere(20, 5)));
    GeodesicSearch on_ball(ball);
    const auto cap = [&](double angle) {
        return region_where<SurfaceRegion>(
            ball, [&](const Vec3& p) { return std::acos(std::clamp(p.z() / 20, -1.0, 1.0)) <= angle; });
    };
    CHECK(measure_region(ball, grow(on_ball, cap(0.4), 6)).area ==
          Approx(measure_region(ball, cap(0.7)).area).epsilon(0.05));
    CHECK(measure_region(ball, shrink(on_ball, cap(0.9), 6)).area ==
          Approx(measure_region(ball, cap(0.6)).area).epsilon(0.06));
}

TEST_CASE("bucket, island eraser and largest island", "[geometry][region_ops]") {
    std::mt19937 random(13);
    const SurfaceGraph graph(shared(sphere(4, 4)));
    GeodesicSearch search(graph);
    for (int k = 0; k < 10; ++k) {
        const SurfaceRegion region = blots(search, random);
        const auto parts = region_parts(graph, region);
        std::size_t total = 0;
        double most = 0;
        for (const auto& part : parts) {
            total += part.size();
            const SurfaceRegion island(graph.vertex_count(), part);
            CHECK(connected_part(graph, region, part.front()) == island);
            CHECK(bucket_erase(graph, region, part.back()) == region - island);
            CHECK(bucket_fill(graph, region, part.back()) == region);
            most = std::max(most, measure_region(graph, island).area);
        }
        CHECK(int(total) == region.size());
        const SurfaceRegion largest = keep_largest(graph, region);
        CHECK(measure_region(graph, largest).area == Approx(most));
        CHECK(measure_region(graph, largest).islands == 1);
        CHECK(keep_largest(graph, largest) == largest);
        CHECK(fill_holes(graph, fill_holes(graph, region)) == fill_holes(graph, region));
    }
    const auto ring =
        region_where<SurfaceRegion>(graph, [](const Vec3& p) { return std::abs(p.z() - 3) < 0.3; });
    const SurfaceRegion cap = bucket_fill(graph, ring, 4); // the pole
    CHECK(cap.contains(4));
    CHECK_FALSE(cap.contains(5));
    CHECK(measure_region(graph, cap).islands == 1);
    CHECK(keep_largest(graph, SurfaceRegion(graph.vertex_count())).empty());
}

TEST_CASE("smart fill stops at creases, at a painted border and at its reach", "[geometry][region_ops]") {
    const SurfaceGraph cube(shared(box_mesh(Vec3::Zero(), Vec3(10, 10, 10), {10, 10, 10})));
    SmartFill fill;
    fill.triangle = foot(cube, Vec3(4, 4, 10)).triangle;
    const auto top = region_where<SurfaceRegion>(cube, [](const Vec3& p) { return p.z() > 9.9; });
    CHECK(smart_fill(cube, fill) == top);
    fill.crease_rad = 1.6; // more than the right angle of the cube
    CHECK(smart_fill(cube, fill).size() == cube.vertex_count());
    fill.crease_rad = 0.5;
    const auto wall =
        region_where<SurfaceRegion>(cube, [](const Vec3& p) { return p.x() > 5.9 && p.x() < 6.1; });
    fill.barrier = &wall;
    CHECK(smart_fill(cube, fill) ==
          region_where<SurfaceRegion>(cube, [](const Vec3& p) { return p.z() > 9.9 && p.x() < 5.1; }));
    fill.barrier = nullptr;
    fill.centre = Vec3(4, 4, 10);
    fill.reach = 2.5;
    const SurfaceRegion near = smart_fill(cube, fill);
    CHECK(near.size() > 12);
    near.for_each([&](int v) { CHECK((cube.position(v) - fill.centre).norm() < 2.5 + 1.5); });
    const SurfaceGraph ball(shared(sphere(4, 3)));
    fill = {};
    fill.triangle = 0;
    CHECK(smart_fill(ball, fill).size() == ball.vertex_count());
}

TEST_CASE("smoothing keeps the area, shortens ragged borders and leaves straight ones",
          "[geometry][region_ops]") {
    std::mt19937 random(14);
    const SurfaceGraph graph(shared(sheet(50, 50)));
    const auto straight = region_where<SurfaceRegion>(graph, [](const Vec3& p) { return p.x() <= 24; });
    CHECK(smooth_border(graph, straight, 6) == straight);
    SurfaceRegion ragged = straight;
    for (int v = 0; v < graph.vertex_count(); ++v)
        if (std::abs(graph.position(v).x() - 24.5) < 3 && random() % 2 == 0)
            ragged.contains(v) ? ragged.erase(v) : ragged.insert(v);
    const SurfaceRegion smooth = smooth_border(graph, ragged, 8);
    CHECK(measure_region(graph, smooth).area == Approx(measure_region(graph, ragged).area).margin(1.0));
    CHECK(border_length(graph, smooth) < 0.45 * border_length(graph, ragged));
    const auto window = region_where<SurfaceRegion>(graph, [](const Vec3& p) { return p.y() < 20; });
    const SurfaceRegion partly = smooth_border(graph, ragged, 8, &window);
    CHECK((partly - window) == (ragged - window));
    CHECK_FALSE((partly & window) == (ragged & window));
    const SurfaceRegion none(graph.vertex_count());
    CHECK(smooth_border(graph, none).empty());
    CHECK(smooth_border(graph, none.complement()) == none.complement());
    CHECK(smooth_border(graph, ragged, 0) == ragged);
}

TEST_CASE("mirroring twice gives the region back, on a pair as well", "[geometry][region_ops]") {
    std::mt19937 random(15);
    const TriMesh left = sphere(4, 3, Vec3(10, 0, 0));
    TriMesh right = inside_out(left);
    for (Vec3& p : right.positions)
        p.x() = -p.x();
    const SurfaceGraph one(shared(left)), pair(shared(right));
    GeodesicSearch search(one);
    const MirrorPlane sagittal{Vec3::Zero(), Vec3(2, 0, 0)}, own{Vec3(10, 0, 0), Vec3::UnitY()};
    for (int k = 0; k < 5; ++k) {
        const SurfaceRegion region = blots(search, random);
        const SurfaceRegion other = mirror_region(one, region, pair, sagittal, 0.1);
        CHECK(other.vertices() == region.vertices());
        CHECK(mirror_region(pair, other, one, sagittal, 0.1) == region);
        const SurfaceRegion turned = mirror_region(one, region, one, own, 0.1);
        CHECK(mirror_region(one, turned, one, own, 0.1) == region);
        CHECK(measure_region(one, turned).area == Approx(measure_region(one, region).area));
    }
    CHECK(mirror_region(one, SurfaceRegion(one.vertex_count()), pair, sagittal, 1).empty());
    const MirrorPlane far{Vec3(100, 0, 0), Vec3::UnitX()};
    CHECK(mirror_region(one, SurfaceRegion(one.vertex_count()).complement(), one, far, 1).empty());
    CHECK(mirror_point(Vec3(14, 0, 0), pair, sagittal, 0.1).point.x() == Approx(-14));
    CHECK(mirror_point(Vec3(14, 0, 0), one, sagittal, 0.1).triangle == -1);
}
