#include "fascicle/geometry/lasso.hpp"
#include "geometry/surface_shapes.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::test;

namespace {

/// Looks from `eye` along -z, focal length 1: screen place = offset / distance. With pixels of any size.
ScreenMatrix perspective(const Vec3& eye, double pixels = 1) {
    ScreenMatrix m = ScreenMatrix::Zero();
    m.row(0) << pixels, 0, 0, -pixels * eye.x();
    m.row(1) << 0, pixels, 0, -pixels * eye.y();
    m.row(2) << 0, 0, -1, eye.z() - 1; // grows away from the eye
    m.row(3) << 0, 0, -1, eye.z();
    return m;
}

ScreenMatrix parallel_from_above() {
    ScreenMatrix m = ScreenMatrix::Identity();
    m(2, 2) = -1;
    return m;
}

std::vector<Vec2> square(double half) {
    return {Vec2(-half, -half), Vec2(half, -half), Vec2(half, half), Vec2(-half, half)};
}

/// Moeller and Trumbore over every triangle.
bool hidden(const SurfaceGraph& graph, int vertex, const Vec3& eye) {
    const Vec3 p = graph.position(vertex), d = (eye - p).normalized();
    for (int t = 0; t < graph.mesh().triangle_count(); ++t) {
        const Tri& tri = graph.triangle(t);
        const Vec3 a = graph.position(tri[0]), e1 = graph.position(tri[1]) - a,
                   e2 = graph.position(tri[2]) - a;
        const Vec3 h = d.cross(e2);
        const double det = e1.dot(h);
        if (std::abs(det) < 1e-14)
            continue;
        const Vec3 s = p - a, q = s.cross(e1);
        const double u = s.dot(h) / det, v = d.dot(q) / det, along = e2.dot(q) / det;
        if (u >= 0 && v >= 0 && u + v <= 1 && along > 0.01 * graph.mean_edge_length() &&
            along < (eye - p).norm())
            return true;
    }
    return false;
}

} // namespace

TEST_CASE("the eye follows from the matrix", "[geometry][lasso]") {
    for (const double pixels : {1.0, 500.0}) {
        const auto eye = screen_eye(perspective(Vec3(1, 2, 30), pixels));
        REQUIRE(eye);
        CHECK_FALSE(eye->parallel);
        CHECK((eye->place - Vec3(1, 2, 30)).norm() < 1e-9);
    }
    const auto above = screen_eye(parallel_from_above());
    REQUIRE(above);
    CHECK(above->parallel);
    CHECK((above->place - Vec3(0, 0, 1)).norm() < 1e-12);
    CHECK_FALSE(screen_eye(ScreenMatrix::Zero()));
}

TEST_CASE("a lasso over a ball takes the front or both sides", "[geometry][lasso]") {
    const SurfaceGraph ball(shared(sphere(5, 4)));
    const ScreenMatrix view = parallel_from_above();
    for (const LassoReach reach : {LassoReach::visible, LassoReach::front, LassoReach::through}) {
        const SurfaceRegion region = lasso(ball, view, square(2.01), reach);
        for (int v = 0; v < ball.vertex_count(); ++v) {
            const Vec3& p = ball.position(v);
            const bool over = std::abs(p.x()) < 2.01 && std::abs(p.y()) < 2.01;
            CHECK(region.contains(v) == (over && (reach == LassoReach::through || p.z() > 0)));
        }
    }
    CHECK(lasso(ball, view, {Vec2(0, 0), Vec2(1, 1)}).empty());
    CHECK(lasso(ball, perspective(Vec3(0, 0, -20)), square(100), LassoReach::through).empty()); // all behind
}

TEST_CASE("visible vertices are those that a ray over all triangles finds", "[geometry][lasso]") {
    const Vec3 eye(0.4, 0.2,
                   60); // looks down on a torus that stands upright, its near side hides its far side
    TriMesh ring = torus(3, 1, 48, 24);
    for (Vec3& p : ring.positions)
        p = Vec3(p.x(), p.z(), p.y());
    ring = inside_out(ring); // the exchange of axes has turned it
    const SurfaceGraph graph(shared(ring));
    const SurfaceRegion region = lasso(graph, perspective(eye), square(1), LassoReach::visible);
    const SurfaceRegion front = lasso(graph, perspective(eye), square(1), LassoReach::front);
    const ScreenEye from{false, eye};
    int differ = 0;
    for (int v = 0; v < graph.vertex_count(); ++v) {
        CHECK(front.contains(v) == vertex_faces_eye(graph, v, from));
        CHECK(region.contains(v) == (front.contains(v) && !hidden(graph, v, eye)));
        differ += front.contains(v) != region.contains(v) ? 1 : 0;
    }
    CHECK(differ > 50);
}

TEST_CASE("rays through a tree meet what a loop over all triangles meets", "[geometry][lasso]") {
    const SurfaceGraph graph(shared(joined(torus(3, 1, 30, 14), sphere(1, 2, Vec3(0.3, 0, 0)))));
    std::mt19937 random(21);
    std::normal_distribution<double> normal(0, 3);
    int hits = 0;
    for (int k = 0; k < 400; ++k) {
        const Vec3 o(normal(random), normal(random), normal(random));
        Vec3 d(normal(random), normal(random), normal(random));
        if (k % 4 == 0)
            d = Vec3::Unit(k / 4 % 3) * (k % 8 == 0 ? 1 : -1);
        double best = 1e300;
        for (const Tri& tri : graph.mesh().triangles) {
            Mat3 m; // origin + t d = a + u e1 + v e2
            const Vec3 a = graph.position(tri[0]);
            m << d, a - graph.position(tri[1]), a - graph.position(tri[2]);
            if (std::abs(m.determinant()) < 1e-9)
                continue; // seen edge-on
            const Vec3 s = m.inverse() * (a - o);
            if (s[0] > 0 && s[1] >= 0 && s[2] >= 0 && s[1] + s[2] <= 1 && s.allFinite())
                best = std::min(best, s[0]);
        }
        const RayHit hit = graph.tree().ray_hit(o, d);
        CHECK((hit.triangle >= 0) == (best < 1e300));
        if (hit.triangle >= 0) {
            CHECK(hit.distance == Approx(best));
            CHECK(graph.tree().blocked(o, d, 0, best * 1.001));
            CHECK_FALSE(graph.tree().blocked(o, d, 0, best * 0.999));
            ++hits;
        }
    }
    CHECK(hits > 50);
    CHECK(graph.tree().ray_hit(Vec3::Constant(std::nan("")), Vec3::UnitX()).triangle == -1);
    CHECK(TriangleBvh().ray_hit(Vec3::Zero(), Vec3::UnitX()).triangle == -1);
}
