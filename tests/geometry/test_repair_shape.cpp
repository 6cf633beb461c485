// Crossing triangles, smoothing, remeshing; and small random meshes through all of repair().
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/repair/self_intersection.hpp"
#include "fascicle/geometry/repair/taubin.hpp"
#include "geometry/repair_shapes.hpp"

#include <Eigen/Geometry>
#include <atomic>

using namespace fascicle;
using namespace fascicle::test;

namespace {

TriMesh moved(TriMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions)
        p += by;
    return mesh;
}

/// Triangles of which no edge comes near the other: the crossing by plain arithmetic, far from any doubt.
bool plainly_cross(const Points& p, const Tri& s, const Tri& t) {
    const auto pierces = [&](int a, int b, const Tri& o) {
        const Vec3 &x = p[static_cast<std::size_t>(o[0])], &y = p[static_cast<std::size_t>(o[1])],
                   &z = p[static_cast<std::size_t>(o[2])];
        const Vec3 d = p[static_cast<std::size_t>(b)] - p[static_cast<std::size_t>(a)];
        Mat3 m;
        m << -d, y - x, z - x;
        const Vec3 r = m.fullPivLu().solve(p[static_cast<std::size_t>(a)] - x);
        return r[0] > 0 && r[0] < 1 && r[1] > 0 && r[2] > 0 && r[1] + r[2] < 1;
    };
    for (std::size_t k = 0; k < 3; ++k)
        if (pierces(s[k], s[(k + 1) % 3], t) || pierces(t[k], t[(k + 1) % 3], s))
            return true;
    return false;
}

} // namespace

TEST_CASE("The side of a plane is exact where doubles alone are not", "[repair]") {
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    CHECK(orientation_sign(a, b, c, Vec3(0, 0, -1)) == 1);
    CHECK(orientation_sign(a, b, c, Vec3(0, 0, 1)) == -1);
    CHECK(orientation_sign(a, b, c, Vec3(5, 7, 0)) == 0);
    // A point moved off a slanted plane by the last bit of one coordinate; the plane x + y + z = 3 passes through all exactly.
    const Vec3 p(1, 1, 1), q(0.5, 2, 0.5), r(0.25, 0.25, 2.5);
    const int above = orientation_sign(p, q, r, Vec3(9, 9, 9));
    REQUIRE(above != 0);
    CHECK(orientation_sign(p, q, r, Vec3(1.5, 0.75, 0.75)) == 0);
    CHECK(orientation_sign(p, q, r, Vec3(1.5, 0.75, 0.75 + 0x1p-52)) == above);
    CHECK(orientation_sign(p, q, r, Vec3(1.5, 0.75, 0.75 - 0x1p-52)) == -above);
}

TEST_CASE("Triangles cross, touch, or share corners", "[repair]") {
    Points p{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 3, 1)};
    CHECK(triangles_cross(p, {0, 1, 2}, {3, 4, 5}));
    p[3].z() = 0; // touches with a corner
    CHECK_FALSE(triangles_cross(p, {0, 1, 2}, {3, 4, 5}));
    p[3].z() = 0.5;
    CHECK_FALSE(triangles_cross(p, {0, 1, 2}, {3, 4, 5}));
    // In one plane: overlapping with an area, along an edge, apart.
    const Points flat{Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1),  Vec3(1, 1, 1),
                      Vec3(5, 1, 1), Vec3(1, 5, 1), Vec3(4, -3, 1), Vec3(9, 9, 1)};
    CHECK(triangles_cross(flat, {0, 1, 2}, {3, 4, 5}));
    CHECK_FALSE(triangles_cross(flat, {0, 1, 2}, {0, 6, 1}));
    CHECK_FALSE(triangles_cross(flat, {0, 1, 2}, {4, 7, 5}));
    CHECK(triangles_cross(flat, {0, 1, 2}, {0, 1, 3})); // folded on its neighbour
    // One common corner.
    const Points corner{Vec3(0, 0, 0), Vec3(4, 0, 0),    Vec3(0, 4, 0),  Vec3(2, 1, -1),
                        Vec3(2, 1, 1), Vec3(-2, -1, -1), Vec3(-2, -1, 1)};
    CHECK(triangles_cross(corner, {0, 1, 2}, {0, 3, 4}));
    CHECK_FALSE(triangles_cross(corner, {0, 1, 2}, {0, 5, 6}));
}

TEST_CASE("Random triangles cross as plain arithmetic says", "[repair]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> at(0, 1);
    TriMesh mesh;
    for (int i = 0; i < 240; ++i) {
        const Vec3 centre(at(random), at(random), at(random));
        for (int k = 0; k < 3; ++k)
            mesh.positions.push_back(centre + 0.3 * Vec3(at(random), at(random), at(random)));
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    std::vector<std::array<int, 2>> expected;
    for (int s = 0; s < mesh.triangle_count(); ++s)
        for (int t = s + 1; t < mesh.triangle_count(); ++t)
            if (plainly_cross(mesh.positions, mesh.triangles[static_cast<std::size_t>(s)],
                              mesh.triangles[static_cast<std::size_t>(t)]))
                expected.push_back({s, t});
    REQUIRE(expected.size() > 50);
    for (const int threads : {1, 3}) {
        const CrossingReport report = find_crossings(mesh, threads, {}, 100000);
        CHECK(report.pairs == static_cast<int>(expected.size()));
        CHECK(report.first == expected);
    }
}

TEST_CASE("Crossings of bodies are told, and clean ones have none", "[repair]") {
    for (const TriMesh& mesh : {sphere(1, 3), box(1, 2, 3), torus()})
        CHECK(find_crossings(mesh).pairs == 0);
    const RepairResult r = repair(joined(box(2, 2, 2), moved(box(2, 2, 2), Vec3(1, 1, 1))));
    check_good(r); // closed and manifold all the same
    CHECK(r.crossings > 0);
    REQUIRE_FALSE(r.left.empty());
    CHECK(r.left[0].find("cross") != std::string::npos);
}

TEST_CASE("A knot in the surface is smoothed out on request", "[repair]") {
    TriMesh mesh = sphere(10, 3);
    mesh.positions[20] *= -1.02; // pulled through the other side
    RepairOptions options;
    REQUIRE(repair(mesh, options).crossings > 0);
    options.untangle = true;
    const RepairResult r = repair(mesh, options);
    check_good(r);
    CHECK(r.crossings == 0);
    CHECK(r.left.empty());
    CHECK(volume(r.mesh) == Approx(volume(sphere(10, 3))).epsilon(0.02));
}

TEST_CASE("Taubin's smoothing takes noise away and keeps the size", "[repair]") {
    const TriMesh clean = sphere(10, 4);
    TriMesh noisy = clean;
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 0.08);
    for (Vec3& p : noisy.positions)
        p *= 1 + noise(random) / 10;
    const auto roughness = [](const TriMesh& mesh) { // rms of radius - 10
        double sum = 0;
        for (const Vec3& p : mesh.positions)
            sum += std::pow(p.norm() - 10, 2);
        return std::sqrt(sum / mesh.vertex_count());
    };
    TriMesh smooth = noisy;
    taubin_smooth(smooth, {});
    CHECK(roughness(smooth) < 0.5 * roughness(noisy));
    CHECK(volume(smooth) == Approx(volume(noisy)).epsilon(0.01));
    // Laplace's alone, for comparison, shrinks: mu = 0 is lambda only.
    TriMesh shrunk = noisy;
    taubin_smooth(shrunk, {0.5, 0.0, 10});
    CHECK(volume(shrunk) < 0.98 * volume(noisy));
    // A mode of the mesh with umbrella eigenvalue k is multiplied by (1 - lambda k)(1 - mu k) a pass: a ring of a cylinder's
    // zigzag has none, a regular polygon's tent has; here the height of one vertex over a flat hexagonal sheet.
    TriMesh sheet_mesh = sheet(6, 6);
    const Points before = sheet_mesh.positions;
    taubin_smooth(sheet_mesh, {});
    for (const Vec3& p : sheet_mesh.positions)
        CHECK(p.z() == 0);
    CHECK(sheet_mesh.positions[0] == before[0]); // borders stay
    CHECK(sheet_mesh.positions[6] == before[6]);
}

TEST_CASE("Remeshing keeps the volume and reaches edge length or number", "[repair]") {
    const TriMesh ball = sphere(10, 4);
    RepairOptions options;
    options.triangles = 400;
    const RepairResult coarse = repair(ball, options);
    check_good(coarse);
    CHECK(coarse.mesh.triangle_count() == 400);
    CHECK(volume(coarse.mesh) == Approx(volume(ball)).epsilon(1e-6));
    for (const int v : coarse.new_of_old)
        CHECK(v == -1);
    const TriangleBvh surface(ball);
    for (const Vec3& p : coarse.mesh.positions)
        CHECK(surface.closest(p).squared_distance < 0.25 * 0.25);
    // A value that is linear in space follows through the origins.
    std::vector<double> x;
    for (const Vec3& p : ball.positions)
        x.push_back(p.x());
    const std::vector<double> carried = carried_values(coarse.origins, x, 1);
    for (std::size_t v = 0; v < carried.size(); ++v)
        CHECK(carried[v] == Approx(coarse.mesh.positions[v].x()).margin(0.3));

    RepairOptions edges;
    edges.edge_length = 2;
    const RepairResult r = repair(ball, edges);
    check_good(r);
    double sum = 0;
    for (const Tri& t : r.mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            sum += (r.mesh.positions[static_cast<std::size_t>(t[k])] -
                    r.mesh.positions[static_cast<std::size_t>(t[(k + 1) % 3])])
                       .norm();
    CHECK(sum / (3 * r.mesh.triangle_count()) == Approx(2).epsilon(0.05));

    RepairOptions both = edges;
    both.triangles = 100;
    CHECK_THROWS_AS(repair(ball, both), Error);
    edges.edge_length = 1e-9;
    CHECK_THROWS_AS(repair(ball, edges), Error);
}

TEST_CASE("A volume that remeshing cannot keep is a reason", "[repair]") {
    // Two cubes joined by a thread: with 40 triangles the offset that would be needed is out of reach.
    RepairOptions options;
    options.triangles = 8;
    options.volume_share = 1e-13;
    TriMesh shape = torus(10, 1, 48, 12);
    const RepairResult r = repair(shape, options);
    CHECK((r.good() || r.reason.find("volume") != std::string::npos));
    if (r.good())
        CHECK(volume(r.mesh) == Approx(volume(shape)).epsilon(1e-12));
}

TEST_CASE("Repair can be cancelled at any stage, tells its progress, and any number of threads does the same",
          "[repair]") {
    TriMesh mesh = soup(joined(sphere(1, 2), moved(sphere(1, 2), Vec3(0.5, 0, 0))));
    RepairOptions options;
    options.smooth_passes = 2;
    options.triangles = 200;
    options.untangle = true;
    const RepairResult one = repair(mesh, options);
    options.threads = 3;
    double last = 0;
    int calls = 0;
    JobControl control;
    control.report = [&](std::string_view, double) { ++calls; };
    const RepairResult many = repair(mesh, options, control);
    CHECK(one.mesh.positions == many.mesh.positions);
    CHECK(one.mesh.triangles == many.mesh.triangles);
    CHECK(one.crossings == many.crossings);
    REQUIRE(calls > 8);
    for (int stop = 1; stop < calls; stop += 3) {
        std::atomic<bool> cancel{false};
        int seen = 0;
        JobControl stopped;
        stopped.cancel = &cancel;
        stopped.report = [&](std::string_view, double fraction) {
            last = fraction;
            if (++seen == stop)
                cancel = true;
        };
        CHECK_THROWS_AS(repair(mesh, options, stopped), Cancelled);
        CHECK(seen == stop);
    }
}

TEST_CASE("Random broken meshes come out right or with a reason, and a second repair finds nothing",
          "[repair]") {
    std::mt19937 random(2024);
    int good = 0;
    for (int round = 0; round < 400; ++round) {
        TriMesh mesh;
        if (round % 2 == 0) { // nothing but triangles among few points
            const int points = 4 + static_cast<int>(random() % 12),
                      triangles = 4 + static_cast<int>(random() % 40);
            for (int v = 0; v < points; ++v)
                mesh.positions.emplace_back(random() % 4, random() % 4, random() % 4);
            for (int t = 0; t < triangles; ++t)
                mesh.triangles.push_back({static_cast<int>(random() % 16u),
                                          static_cast<int>(random() % static_cast<unsigned>(points)),
                                          static_cast<int>(random() % static_cast<unsigned>(points))});
        } else { // a body with some of everything
            mesh = round % 4 == 1 ? torus(3, 1, 9, 6)
                                  : joined(box(2, 2, 2),
                                           moved(box(2, 2, 2), Vec3(2, 2, static_cast<double>(round % 3))));
            if (random() % 2 == 0)
                mesh = soup(mesh);
            for (int k = 0; k < 6; ++k) {
                Tri& t = mesh.triangles[random() % mesh.triangles.size()];
                switch (random() % 5) {
                case 0:
                    std::swap(t[0], t[1]);
                    break;
                case 1:
                    t[2] = static_cast<int>(random() % mesh.positions.size());
                    break;
                case 2:
                    mesh.triangles.push_back(Tri(t));
                    break;
                case 3:
                    mesh.triangles.pop_back();
                    break;
                default:
                    mesh.positions[static_cast<std::size_t>(t[0])] =
                        mesh.positions[static_cast<std::size_t>(t[1])];
                }
            }
        }
        INFO("round " << round);
        RepairOptions options;
        if (round % 3 == 0)
            options.fill_share = 1e9;
        const RepairResult r = repair(mesh, options);
        CHECK(r.origins.size() == r.mesh.positions.size());
        if (!r.good())
            continue;
        ++good;
        check_good(r);
        const RepairResult again = repair(r.mesh, options);
        check_good(again);
        if (r.after.zero_area_triangles == 0) // one that could not be helped may be helped from another side
            CHECK(again.mesh.triangle_count() == r.mesh.triangle_count());
    }
    CHECK(good > 100);
}
