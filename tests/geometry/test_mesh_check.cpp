#include "fascicle/base/error.hpp"
#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <random>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

double volume(const TriMesh& mesh) {
    return signed_volume(mesh.positions, mesh.triangles);
}

Vec3 shift(double x) {
    return Vec3(x, 0, 0);
}

} // namespace

TEST_CASE("a good surface has nothing to report and stays as it is", "[geometry][mesh_check]") {
    for (const TriMesh& mesh : {tetrahedron(), box(), sphere(2, 3), torus()}) {
        const MendedMesh mended = mend(mesh);
        CHECK(mended.report.lines().empty());
        CHECK(mended.report.closed());
        CHECK(mended.report.components == 1);
        CHECK(mended.mesh.triangles == mesh.triangles);
        CHECK(mended.mesh.positions == mesh.positions);
        CHECK_NOTHROW(require_muscle_surface(mended.report, "x.obj"));
        CHECK_NOTHROW(require_bone_surface(mended.report, "x.obj"));
    }
}

TEST_CASE("degenerate and duplicate triangles are dropped", "[geometry][mesh_check]") {
    TriMesh mesh = box();
    const std::vector<Tri> clean = mesh.triangles;
    mesh.triangles.insert(mesh.triangles.begin() + 3, Tri{4, 4, 1});
    mesh.triangles.push_back({3, 0, 2}); // the first triangle, rotated
    mesh.triangles.push_back({5, 5, 5});
    const MendedMesh mended = mend(mesh);
    CHECK(mended.mesh.triangles == clean);
    CHECK(mended.report.degenerate_triangles == 2);
    CHECK(mended.report.duplicate_triangles == 1);
    CHECK(mended.report.triangles == 12);
    CHECK(mended.report.closed());
}

TEST_CASE("triangles of no area are reported and kept", "[geometry][mesh_check]") {
    TriMesh mesh = box();
    // A vertex in the middle of edge 0-1: one side uses it, the other side keeps its edge, a sliver joins
    // them.
    const int v = mesh.vertex_count();
    mesh.positions.emplace_back(0.5, 0, 0);
    const auto side = std::find(mesh.triangles.begin(), mesh.triangles.end(), Tri{0, 3, 1});
    REQUIRE(side != mesh.triangles.end());
    *side = {0, 3, v};
    mesh.triangles.push_back({v, 3, 1});
    mesh.triangles.push_back({0, v, 1});
    const MendedMesh mended = mend(mesh);
    CHECK(mended.report.zero_area_triangles == 1);
    CHECK(mended.report.closed());
    CHECK(mended.report.triangles == 14);
}

TEST_CASE("a few turned triangles are turned back", "[geometry][mesh_check]") {
    TriMesh mesh = sphere(1, 3);
    const double right = volume(mesh);
    std::mt19937 random(3);
    int turned = 0;
    for (Tri& t : mesh.triangles)
        if (random() % 4 == 0) {
            std::swap(t[1], t[2]);
            ++turned;
        }
    const MendedMesh mended = mend(mesh);
    CHECK(mended.report.inconsistent_triangles == turned);
    CHECK(mended.report.closed());
    CHECK(volume(mended.mesh) == Approx(right));
    CHECK(mended.report.inverted_components == 0);
}

TEST_CASE("parts inside out are turned, whatever the majority says", "[geometry][mesh_check]") {
    const MendedMesh ball = mend(inside_out(sphere(1, 2)));
    CHECK(ball.report.inverted_components == 1);
    CHECK(volume(ball.mesh) > 0);

    const MendedMesh two = mend(joined(inside_out(box()), sphere(1, 2, shift(5))));
    CHECK(two.report.inverted_components == 1);
    CHECK(two.report.components == 2);
    CHECK(volume(two.mesh) == Approx(1.0 + volume(sphere(1, 2))));
}

TEST_CASE("a cavity stays a cavity, also when the whole is inside out", "[geometry][mesh_check]") {
    const TriMesh shell = joined(sphere(2, 3), inside_out(sphere(1, 3)));
    const double hollow = volume(shell);
    const MendedMesh kept = mend(shell);
    CHECK(kept.report.cavities == 1);
    CHECK(kept.report.inverted_components == 0);
    CHECK(volume(kept.mesh) == Approx(hollow));

    const MendedMesh turned = mend(inside_out(shell));
    CHECK(turned.report.inverted_components == 2);
    CHECK(turned.report.cavities == 0);
    CHECK(volume(turned.mesh) == Approx(hollow));
}

TEST_CASE("holes are found, counted and named", "[geometry][mesh_check]") {
    TriMesh mesh = sphere(1, 3);
    const Tri gone = mesh.triangles[100];
    const auto shares = [](const Tri& t, const Tri& u) {
        return std::count_if(t.begin(), t.end(),
                             [&](int v) { return std::count(u.begin(), u.end(), v) > 0; });
    };
    const auto far = std::find_if(mesh.triangles.begin() + 300, mesh.triangles.end(),
                                  [&](const Tri& t) { return shares(t, gone) == 0; });
    mesh.triangles.erase(far);
    mesh.triangles.erase(mesh.triangles.begin() + 100);
    const MeshReport report = check_mesh(mesh);
    CHECK_FALSE(report.closed());
    CHECK(report.holes == 2);
    CHECK(report.boundary_edges == 6);
    CHECK(report.unbalanced_edges == 6);
    CHECK_THROWS_WITH(require_muscle_surface(report, "ball.obj"),
                      Contains("ball.obj") && Contains("2 holes") && Contains("between vertices") &&
                          Contains("expected a closed surface"));
    CHECK_NOTHROW(require_bone_surface(report, "ball.obj"));
}

TEST_CASE("two bodies sharing an edge are closed and non-manifold, each turned outwards",
          "[geometry][mesh_check]") {
    // Second tetrahedron shares edge 0-1 with the first and lies on the other side, inside out.
    TriMesh mesh = tetrahedron();
    mesh.positions.emplace_back(0, -1, 0);
    mesh.positions.emplace_back(0, 0, -1);
    const std::vector<Tri> second{{0, 4, 1}, {0, 1, 5}, {0, 5, 4}, {1, 4, 5}}; // mirror twice: outwards
    CHECK(signed_volume(mesh.positions, second) == Approx(1.0 / 6.0));
    for (const Tri& t : second)
        mesh.triangles.push_back({t[0], t[2], t[1]});
    const MendedMesh mended = mend(mesh);
    CHECK(mended.report.nonmanifold_edges == 1);
    CHECK(mended.report.first_nonmanifold_edge == Edge{0, 1});
    CHECK(mended.report.closed());
    CHECK(mended.report.inverted_components == 1);
    CHECK(volume(mended.mesh) == Approx(2.0 / 6.0));
    CHECK_NOTHROW(require_muscle_surface(mended.report, "x"));
}

TEST_CASE("two bodies sharing a vertex have a non-manifold vertex", "[geometry][mesh_check]") {
    TriMesh mesh = tetrahedron();
    for (const Vec3& p : {Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)})
        mesh.positions.push_back(p);
    for (const Tri& t : {Tri{0, 5, 4}, Tri{0, 4, 6}, Tri{0, 6, 5}, Tri{4, 5, 6}})
        mesh.triangles.push_back({t[0], t[2], t[1]});
    const MeshReport report = check_mesh(mesh);
    CHECK(report.nonmanifold_vertices == 1);
    CHECK(report.first_nonmanifold_vertex == 0);
    CHECK(report.nonmanifold_edges == 0);
    CHECK(report.components == 1);
    CHECK(report.closed());
}

TEST_CASE("a Moebius strip is reported as what it is", "[geometry][mesh_check]") {
    TriMesh mesh;
    const int n = 12;
    for (int i = 0; i < n; ++i) {
        const double u = 2 * M_PI * i / n;
        for (const double w : {-0.3, 0.3})
            mesh.positions.emplace_back((1 + w * std::cos(u / 2)) * std::cos(u),
                                        (1 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2));
    }
    for (int i = 0; i < n; ++i) {
        const int a = 2 * i, b = 2 * i + 1;
        const int c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0; // ends joined with a twist
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({b, c, d});
    }
    const MeshReport report = check_mesh(mesh);
    CHECK(report.non_orientable_patches == 1);
    CHECK(report.holes == 1);
    CHECK(report.inconsistent_triangles == 0);
    CHECK_FALSE(report.closed());
}

TEST_CASE("unusable meshes are told apart and left alone", "[geometry][mesh_check]") {
    TriMesh mesh = box();
    mesh.positions[5].y() = std::numeric_limits<double>::quiet_NaN();
    mesh.positions[7].x() = std::numeric_limits<double>::infinity();
    const MendedMesh mended = mend(mesh);
    CHECK_FALSE(mended.report.usable());
    CHECK(mended.report.non_finite_points == 2);
    CHECK(mended.report.first_non_finite_point == 5);
    CHECK(mended.mesh.triangles == mesh.triangles);
    CHECK_THROWS_WITH(require_bone_surface(mended.report, "b.vtk"), Contains("b.vtk: vertex 5"));

    mesh = box();
    mesh.triangles[4][1] = 8;
    mesh.triangles[6][0] = -1;
    const MeshReport report = check_mesh(mesh);
    CHECK(report.bad_triangles == 2);
    CHECK(report.first_bad_triangle == 4);
    CHECK_THROWS_WITH(require_muscle_surface(report, "b.vtk"), Contains("triangle 4") && Contains("0 to 7"));
}

TEST_CASE("empty and tiny surfaces are refused where they make no sense", "[geometry][mesh_check]") {
    const MeshReport nothing = check_mesh({});
    CHECK_FALSE(nothing.closed());
    CHECK_THROWS_WITH(require_muscle_surface(nothing, "m"), Contains("no triangles"));
    CHECK_THROWS_WITH(require_bone_surface(nothing, "m"), Contains("0 triangles"));
    CHECK_NOTHROW(require_bone_surface(check_mesh(sheet(2, 1)), "m"));
    CHECK_THROWS(require_bone_surface(check_mesh(sheet(1, 1)), "m"));
}

TEST_CASE("surplus vertices are counted and kept", "[geometry][mesh_check]") {
    TriMesh mesh = joined(box(), box()); // every vertex twice
    mesh.positions.insert(mesh.positions.begin(), Vec3(7, 7, 7));
    for (Tri& t : mesh.triangles)
        for (int& v : t)
            ++v;
    const MendedMesh mended = mend(mesh);
    CHECK(mended.report.unused_vertices == 1);
    CHECK(mended.report.duplicate_vertices == 8);
    CHECK(mended.mesh.vertex_count() == 17);
    CHECK_FALSE(mended.report.lines().empty());
}

TEST_CASE("any triangle soup can be mended, once and for all", "[geometry][mesh_check]") {
    std::mt19937 random(11);
    for (int round = 0; round < 300; ++round) {
        TriMesh mesh;
        const unsigned n = 3 + random() % 8;
        for (unsigned i = 0; i < n; ++i)
            mesh.positions.emplace_back(random() % 5, random() % 5, random() % 5);
        mesh.triangles.resize(random() % 25);
        for (Tri& t : mesh.triangles)
            for (int& v : t)
                v = static_cast<int>(random() % n);
        const MendedMesh once = mend(mesh);
        const MendedMesh twice = mend(once.mesh);
        REQUIRE(once.mesh.positions == mesh.positions);
        REQUIRE(twice.mesh.triangles == once.mesh.triangles);
        REQUIRE(twice.report.degenerate_triangles == 0);
        REQUIRE(twice.report.duplicate_triangles == 0);
        REQUIRE(twice.report.inverted_components == 0);
    }
}
