#include "fascicle/geometry/line_hits.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/winding_number.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// Every triangle, by solving a + u (b - a) + v (c - a) = origin + t direction.
std::vector<LineHit> brute_force(const TriMesh& mesh, const Vec3& origin, const Vec3& direction) {
    std::vector<LineHit> hits;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto at = [&](std::size_t k) -> const Vec3& {
            return mesh.positions[static_cast<std::size_t>(mesh.triangles[t][k])];
        };
        Mat3 system;
        system << at(1) - at(0), at(2) - at(0), -direction;
        const double determinant = system.determinant();
        if (determinant == 0.0)
            continue;
        const Vec3 x = system.inverse() * (origin - at(0));
        if (x.x() >= 0.0 && x.y() >= 0.0 && x.x() + x.y() <= 1.0)
            hits.push_back(
                {x.z(), static_cast<int>(t), (at(1) - at(0)).cross(at(2) - at(0)).dot(direction) < 0.0});
    }
    return hits;
}

void sort_by_triangle(std::vector<LineHit>& hits) {
    std::sort(hits.begin(), hits.end(),
              [](const LineHit& a, const LineHit& b) { return a.triangle < b.triangle; });
}

} // namespace

TEST_CASE("lines cross the triangles that brute force finds", "[geometry][line_hits]") {
    TriMesh mesh = test::joined(test::torus(), test::sphere(1.0, 2, Vec3(1, 0, 2)));
    mesh.triangles.push_back({7, 7, 7}); // without area
    const TriangleBvh bvh(mesh);
    test::Random random(3);
    std::size_t found = 0;
    for (int i = 0; i < 600; ++i) {
        const Vec3 p = random.in_box(Vec3::Constant(-5), Vec3::Constant(5));
        const Vec3 direction = random.real(0.01, 20.0) * random.direction();
        std::vector<LineHit> hits, exact = brute_force(mesh, p, direction);
        bvh.line_hits(p, direction, hits);
        sort_by_triangle(hits);
        REQUIRE(hits.size() == exact.size());
        for (std::size_t k = 0; k < hits.size(); ++k) {
            CHECK(hits[k].triangle == exact[k].triangle);
            CHECK(hits[k].position == Approx(exact[k].position).epsilon(1e-9).margin(1e-9));
            CHECK(hits[k].entering == exact[k].entering);
        }
        found += hits.size();
    }
    CHECK(found > 300);
}

TEST_CASE("what lies between crossings is what the winding number calls inside", "[geometry][line_hits]") {
    const TriMesh mesh = test::joined(test::torus(), test::sphere(1.2, 3, Vec3(3, 0, 0.5))); // they overlap
    const TriangleBvh bvh(mesh);
    const WindingNumber winding(mesh);
    test::Random random(9);
    int inside_count = 0;
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = random.in_box(Vec3(-4, -4, -1.5), Vec3(4, 4, 1.5)), direction = random.direction();
        std::vector<LineHit> hits;
        std::vector<LineInterval> intervals;
        bvh.line_hits(p, direction, hits);
        inside_intervals(hits, 1e-9, intervals);
        for (int k = 0; k < 10; ++k) {
            const double t = random.real(-6, 6);
            bool inside = false;
            double nearest = 1;
            for (const LineInterval& interval : intervals) {
                CHECK(interval.begin < interval.end);
                inside = inside || (t > interval.begin && t < interval.end);
                nearest = std::min({nearest, std::abs(t - interval.begin), std::abs(t - interval.end)});
            }
            if (nearest > 1e-6)
                CHECK(inside == (winding.exact(p + t * direction) > 0.5));
            inside_count += inside ? 1 : 0;
        }
    }
    CHECK(inside_count > 100);
}

TEST_CASE("no line slips through edges and corners of a closed surface", "[geometry][line_hits]") {
    const TriMesh mesh = test::sphere(1.0, 3);
    const TriangleBvh bvh(mesh);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<Vec3> aims = mesh.positions;
    for (const Edge& edge : topology.edges())
        aims.push_back(0.5 * (mesh.positions[static_cast<std::size_t>(edge.a)] +
                              mesh.positions[static_cast<std::size_t>(edge.b)]));
    for (const Vec3& aim : aims) {
        std::vector<LineHit> hits;
        std::vector<LineInterval> intervals;
        bvh.line_hits(3.0 * aim, -aim, hits); // through the centre and so through the opposite point too
        inside_intervals(hits, 1e-9, intervals);
        REQUIRE(intervals.size() == 1);
        CHECK(intervals[0].end - intervals[0].begin == Approx(2.0).epsilon(1e-9));
    }
}

TEST_CASE("lines along axes and in faces of a box", "[geometry][line_hits]") {
    const TriangleBvh bvh(test::box(2, 3, 4));
    const auto inside = [&](const Vec3& p, const Vec3& direction) {
        std::vector<LineHit> hits;
        std::vector<LineInterval> intervals;
        bvh.line_hits(p, direction, hits);
        inside_intervals(hits, 1e-9, intervals);
        return intervals;
    };
    REQUIRE(inside(Vec3(1, 1, -5), Vec3(0, 0, 2)).size() == 1); // through the diagonals of two faces
    CHECK(inside(Vec3(1, 1.5, -5), Vec3(0, 0, 2))[0].begin == Approx(2.5));
    CHECK(inside(Vec3(1, 1.5, -5), Vec3(0, 0, 2))[0].end == Approx(4.5));
    CHECK(inside(Vec3(1, 1.5, 5), Vec3(0, 0, -1))[0].end == Approx(5.0));
    CHECK(inside(Vec3(5, 1, 1), Vec3(0, 1, 0)).empty());
    CHECK(inside(Vec3(2, 5, 1), Vec3(1, 0, 0)).empty());
    std::vector<LineHit> none;
    TriangleBvh().line_hits(Vec3::Zero(), Vec3::UnitX(), none);
    bvh.line_hits(Vec3::Constant(std::nan("")), Vec3::UnitX(), none);
    CHECK(none.empty());
}
