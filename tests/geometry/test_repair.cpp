// repair(): one kind of defect after the other, on shapes whose repaired form is known.
#include "geometry/repair_shapes.hpp"

#include <cmath>
#include <ctime>
#include <limits>
#include <set>

using namespace fascicle;
using namespace fascicle::test;

namespace {

const RepairStep* step(const RepairResult& r, const std::string& key) {
    for (const RepairStep& s : r.steps)
        if (s.key == key)
            return &s;
    return nullptr;
}

int found(const RepairResult& r, const std::string& key) {
    const RepairStep* s = step(r, key);
    return s ? s->found : 0;
}

TriMesh moved(TriMesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions)
        p += by;
    return mesh;
}

/// Index of the vertex at p.
int at(const TriMesh& mesh, const Vec3& p) {
    for (int v = 0; v < mesh.vertex_count(); ++v)
        if ((mesh.positions[static_cast<std::size_t>(v)] - p).norm() < 1e-12)
            return v;
    return -1;
}

/// The second mesh's vertices become those of the first where they lie on them.
TriMesh glued(const TriMesh& a, const TriMesh& b) {
    TriMesh out = joined(a, b);
    for (Tri& t : out.triangles)
        for (int& v : t)
            if (const int same = at(a, out.positions[static_cast<std::size_t>(v)]); same >= 0)
                v = same;
    return out;
}

} // namespace

TEST_CASE("A clean mesh comes back as it is", "[repair]") {
    for (const TriMesh& mesh : {tetrahedron(), box(1, 2, 3), sphere(1, 3), torus(),
                                joined(sphere(1, 2), moved(sphere(1, 2), Vec3(5, 0, 0)))}) {
        const RepairResult r = repair(mesh);
        check_good(r);
        CHECK_FALSE(r.changed());
        CHECK(r.mesh.positions == mesh.positions);
        CHECK(r.mesh.triangles == mesh.triangles);
        CHECK(r.measured_before.volume == r.measured_after.volume);
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            CHECK(r.new_of_old[static_cast<std::size_t>(v)] == v);
            CHECK(r.origins[static_cast<std::size_t>(v)].nearest() == v);
        }
    }
}

TEST_CASE("A soup of triangles becomes one surface, shaken or not", "[repair]") {
    const TriMesh clean = sphere(20, 3);
    for (const double amount : {0.0, 1e-9, 5e-4}) { // edges are 2.8 in the mean
        const RepairResult r = repair(shaken(soup(clean), amount, 1));
        check_good(r);
        CHECK(r.mesh.vertex_count() == clean.vertex_count());
        CHECK(r.mesh.triangle_count() == clean.triangle_count());
        CHECK(volume(r.mesh) == Approx(volume(clean)).epsilon(1e-4));
        CHECK(found(r, "weld") == 3 * clean.triangle_count() - clean.vertex_count());
        std::set<int> used;
        for (const int v : r.new_of_old)
            used.insert(v);
        CHECK(*used.begin() == 0);
        CHECK(static_cast<int>(used.size()) == clean.vertex_count());
    }
    RepairOptions narrow;
    narrow.weld = 1e-6;
    CHECK_FALSE(repair(shaken(soup(clean), 5e-4, 1), narrow).good());
    RepairOptions wide;
    wide.weld = 0.2;
    check_good(repair(shaken(soup(clean), 0.02, 1), wide));
}

TEST_CASE("Welding is for borders: bodies that touch stay bodies", "[repair]") {
    // Two boxes that share four places and no triangle, each closed by itself.
    TriMesh other = box(1, 1, 1);
    for (Tri& t : other.triangles) // other diagonals
        std::rotate(t.begin(), t.begin() + 1, t.end());
    const RepairResult r = repair(joined(box(1, 1, 1), moved(sphere(1, 2), Vec3(-1, 0, 0))));
    check_good(r);
    CHECK(check_mesh(r.mesh).components == 2);
    CHECK(found(r, "weld") == 0);
}

TEST_CASE("Repeated, doubled and back-to-back triangles go", "[repair]") {
    TriMesh mesh = sphere(1, 2);
    const TriMesh clean = mesh;
    mesh.triangles.push_back({3, 3, 5});
    mesh.triangles.push_back(mesh.triangles[4]);
    const RepairResult r = repair(mesh);
    check_good(r);
    CHECK(r.mesh.triangles == clean.triangles);
    CHECK(found(r, "repeated") == 1);
    CHECK(found(r, "doubled") == 1);

    // All of it twice: with the same vertices, with others, with others that lie near, drawn from both sides.
    for (const TriMesh& twice :
         {glued(clean, clean), joined(clean, clean), joined(clean, shaken(clean, 1e-6, 3)),
          glued(clean, inside_out(clean)), joined(clean, inside_out(clean))}) {
        const RepairResult one = repair(twice);
        check_good(one);
        CHECK(one.mesh.triangle_count() == clean.triangle_count());
        CHECK(one.mesh.vertex_count() == clean.vertex_count());
        CHECK(volume(one.mesh) == Approx(volume(clean)).epsilon(1e-5));
    }
}

TEST_CASE("A wall between two glued bodies goes, whether they share its vertices or not", "[repair]") {
    const TriMesh a = box(1, 1, 1);
    TriMesh b = box(1, 1, 1); // mirrored, so that the wall's diagonals agree
    for (Vec3& p : b.positions)
        p.x() = 2 - p.x();
    b = inside_out(b);
    for (const TriMesh& two : {glued(a, b), joined(a, b)}) {
        const RepairResult r = repair(two);
        check_good(r);
        CHECK(found(r, "back_to_back") == 4);
        CHECK(check_mesh(r.mesh).components == 1);
        CHECK(volume(r.mesh) == Approx(2));
    }
}

TEST_CASE("Bodies that share an edge or a vertex are parted, and stay apart", "[repair]") {
    const TriMesh a = box(1, 1, 1);
    const TriMesh at_edge = glued(a, moved(a, Vec3(1, 1, 0)));
    const TriMesh at_vertex = glued(a, moved(a, Vec3(1, 1, 1)));
    REQUIRE(check_mesh(at_edge).nonmanifold_edges == 1);
    REQUIRE(check_mesh(at_vertex).nonmanifold_vertices == 1);
    for (const TriMesh& two : {at_edge, at_vertex}) {
        const RepairResult r = repair(two);
        check_good(r);
        CHECK(check_mesh(r.mesh).components == 2);
        CHECK(r.mesh.vertex_count() == 16);
        CHECK(volume(r.mesh) == Approx(2).epsilon(0.01));
        CHECK(r.crossings == 0);
        CHECK(found(r, "separate") > 0);
        // Also for whoever welds equal places again, in single precision.
        TriMesh single = soup(r.mesh);
        for (Vec3& p : single.positions)
            p = p.cast<float>().cast<double>();
        const RepairResult again = repair(single);
        check_good(again);
        CHECK(check_mesh(again.mesh).components == 2);
        CHECK(found(again, "edges") == 0);
    }
}

TEST_CASE("Two spheres that touch along many edges become two spheres", "[repair]") {
    // Their halves are glued where the plane between them cuts: a row of edges on the equator of one octant.
    TriMesh a = sphere(1, 3), b = a;
    for (Vec3& p : b.positions)
        p.x() = 2 * 0.0 - p.x() + 2;
    b = inside_out(b);
    for (TriMesh* mesh : {&a, &b}) // flatten what lies near x = 1, so that a patch of vertices is shared
        for (Vec3& p : mesh->positions)
            if (std::abs(p.x() - 1) < 0.02)
                p.x() = 1;
    const RepairResult r = repair(glued(a, b));
    check_good(r);
    CHECK(volume(r.mesh) == Approx(volume(a) + volume(b)).epsilon(0.01));
}

TEST_CASE("A body pinched to nothing along an edge stays in one piece", "[repair]") {
    // A plate of 4 x 4 quads, 1 thick, whose upper and lower middle edge meet half way.
    TriMesh mesh;
    const int n = 4;
    const auto id = [&](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                const bool pinched = i == 2 && (j == 2 || j == 3);
                mesh.positions.emplace_back(i, j, pinched ? 0.5 : k);
            }
    const auto quad = [&](int a, int b, int c, int d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            quad(id(i, j, 1), id(i + 1, j, 1), id(i + 1, j + 1, 1), id(i, j + 1, 1));
            quad(id(i, j, 0), id(i, j + 1, 0), id(i + 1, j + 1, 0), id(i + 1, j, 0));
        }
    for (int i = 0; i < n; ++i) {
        quad(id(i, 0, 0), id(i + 1, 0, 0), id(i + 1, 0, 1), id(i, 0, 1));
        quad(id(i, n, 0), id(i, n, 1), id(i + 1, n, 1), id(i + 1, n, 0));
        quad(id(0, i, 0), id(0, i, 1), id(0, i + 1, 1), id(0, i + 1, 0));
        quad(id(n, i, 0), id(n, i + 1, 0), id(n, i + 1, 1), id(n, i, 1));
    }
    for (Tri& t : mesh.triangles) // one vertex for both sides
        for (int& v : t)
            for (const int j : {2, 3})
                if (v == id(2, j, 1))
                    v = id(2, j, 0);
    REQUIRE(check_mesh(mesh).nonmanifold_edges == 1);
    const RepairResult r = repair(mesh);
    check_good(r);
    const MeshTopology topology(r.mesh.vertex_count(), r.mesh.triangles);
    CHECK(r.mesh.vertex_count() - static_cast<int>(topology.edges().size()) + r.mesh.triangle_count() == 2);
    CHECK(check_mesh(r.mesh).components == 1);
    CHECK(r.crossings == 0);
    CHECK(volume(r.mesh) == Approx(volume(mesh)).epsilon(0.001));
}

TEST_CASE("Walls inside and fins outside are dropped", "[repair]") {
    const TriMesh clean = box(2, 1, 1);
    TriMesh fin = clean; // a flap on the edge between vertices 4 and 5
    fin.positions.emplace_back(1, 0, 3);
    fin.triangles.push_back({4, 5, 8});
    const RepairResult without = repair(fin);
    check_good(without);
    CHECK(without.mesh.triangles == clean.triangles);
    CHECK(found(without, "hanging") == 1);

    TriMesh wall = sphere(1, 3); // a disc across the equator, single
    const TriMesh ball = wall;
    std::vector<int> equator;
    for (int v = 0; v < ball.vertex_count(); ++v)
        if (std::abs(ball.positions[static_cast<std::size_t>(v)].z()) < 1e-12)
            equator.push_back(v);
    const auto angle = [&](int v) {
        const Vec3& p = ball.positions[static_cast<std::size_t>(v)];
        return std::atan2(p.y(), p.x());
    };
    std::sort(equator.begin(), equator.end(), [&](int x, int y) { return angle(x) < angle(y); });
    const int middle = wall.vertex_count();
    wall.positions.emplace_back(0, 0, 0);
    for (std::size_t i = 0; i < equator.size(); ++i)
        wall.triangles.push_back({middle, equator[i], equator[(i + 1) % equator.size()]});
    REQUIRE(check_mesh(wall).nonmanifold_edges == static_cast<int>(equator.size()));
    for (const bool mixed : {false, true}) {
        TriMesh input = wall;
        if (mixed) // the lower half inside out
            for (Tri& t : input.triangles)
                if (input.positions[static_cast<std::size_t>(t[0])].z() +
                        input.positions[static_cast<std::size_t>(t[1])].z() +
                        input.positions[static_cast<std::size_t>(t[2])].z() <
                    -1e-9)
                    std::swap(t[1], t[2]);
        const RepairResult r = repair(input);
        check_good(r);
        CHECK(r.mesh.vertex_count() == ball.vertex_count());
        CHECK(volume(r.mesh) == Approx(volume(ball)));
    }
}

TEST_CASE("Faces turned the wrong way are turned back", "[repair]") {
    const TriMesh clean = sphere(1, 3);
    TriMesh cap = clean;
    for (Tri& t : cap.triangles)
        if (cap.positions[static_cast<std::size_t>(t[0])].z() > 0.6)
            std::swap(t[1], t[2]);
    TriMesh any = clean;
    std::mt19937 random(7);
    for (Tri& t : any.triangles)
        if (random() % 2 == 0)
            std::swap(t[1], t[2]);
    for (const TriMesh& mesh : {cap, any, inside_out(clean)}) {
        const RepairResult r = repair(mesh);
        check_good(r);
        CHECK(volume(r.mesh) == Approx(volume(clean)));
    }
}

TEST_CASE("Islands and small cavities go, larger ones stay and are told", "[repair]") {
    const TriMesh ball = sphere(1, 3);
    const TriMesh speck = moved(sphere(0.05, 1), Vec3(2, 0, 0)), hollow = inside_out(sphere(0.05, 1));
    const RepairResult r = repair(joined(joined(ball, speck), hollow));
    check_good(r);
    CHECK(found(r, "islands") == 2);
    CHECK(r.mesh.triangles == ball.triangles);
    RepairOptions all;
    all.island_share = 0;
    const RepairResult kept = repair(joined(joined(ball, speck), hollow), all);
    check_good(kept);
    CHECK(check_mesh(kept.mesh).components == 3);
    CHECK(kept.left.size() == 2); // parts, cavity
    CHECK(volume(kept.mesh) == Approx(volume(ball)));
}

TEST_CASE("Holes are filled with a fair patch, and large ones are not unless asked for", "[repair]") {
    const TriMesh clean = sphere(1, 4);
    TriMesh holed = clean;
    std::erase_if(holed.triangles, [&](const Tri& t) {
        const Vec3 m = (clean.positions[static_cast<std::size_t>(t[0])] +
                        clean.positions[static_cast<std::size_t>(t[1])] +
                        clean.positions[static_cast<std::size_t>(t[2])]) /
                       3;
        return m.z() > 0.8 || m.x() < -0.99;
    });
    const RepairResult r = repair(holed);
    check_good(r);
    CHECK(found(r, "holes") == 2);
    // The lid is 10 % of the area; cut off flat it would be 2.8 % of the volume.
    CHECK(volume(r.mesh) == Approx(volume(clean)).epsilon(0.008));
    CHECK(r.crossings == 0);
    double longest = 0;
    for (const Tri& t : r.mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, (r.mesh.positions[static_cast<std::size_t>(t[k])] -
                                         r.mesh.positions[static_cast<std::size_t>(t[(k + 1) % 3])])
                                            .norm());
    CHECK(longest < 0.3); // edges of the sphere: 0.06 to 0.11
    for (const VertexOrigin& o : r.origins)
        CHECK(o.nearest() >= 0);

    const RepairResult flat = repair(sheet(10, 10));
    CHECK_FALSE(flat.good());
    CHECK(flat.reason.find("1 hole that was not filled (40 edges in all), 1 larger than 15 % of its part") !=
          std::string::npos);
    RepairOptions none;
    none.fill_edges = 0;
    CHECK_FALSE(repair(holed, none).good());
    RepairOptions few;
    few.fill_edges = 10;
    CHECK(repair(holed, few).after.holes == 1);
}

TEST_CASE("T-junctions and triangles without area leave no crack", "[repair]") {
    TriMesh mesh = box(1, 1, 1); // a vertex in the middle of the edge 4-5 that only one side knows
    const double clean = volume(mesh);
    mesh.positions.emplace_back(0.5, 0, 1);
    std::vector<Tri> triangles;
    bool cut = false;
    for (const Tri& t : mesh.triangles) {
        bool here = false;
        for (std::size_t k = 0; k < 3 && !cut; ++k)
            if (t[k] == 4 && t[(k + 1) % 3] == 5) {
                triangles.push_back({4, 8, t[(k + 2) % 3]});
                triangles.push_back({8, 5, t[(k + 2) % 3]});
                here = cut = true;
            }
        if (!here)
            triangles.push_back(t);
    }
    mesh.triangles = triangles;
    REQUIRE(check_mesh(mesh).boundary_edges == 3);
    const RepairResult r = repair(mesh);
    check_good(r);
    CHECK(r.after.zero_area_triangles == 0);
    CHECK(volume(r.mesh) == Approx(clean));
    CHECK(r.mesh.vertex_count() == 9);
    CHECK(found(r, "slivers") == 1);

    // A needle: one vertex of a sphere twice, joined by an edge of nearly no length.
    TriMesh needle = sphere(1, 2);
    const MeshTopology topology(needle.vertex_count(), needle.triangles);
    const auto row = topology.vertex_triangles(0);
    const int twin = needle.vertex_count();
    needle.positions.push_back(needle.positions[0] + Vec3(1e-9, 0, 0));
    const auto fan = std::vector<int>(row.begin(), row.end()); // split the fan along two of its edges
    const Tri first = needle.triangles[static_cast<std::size_t>(fan[0])];
    const std::size_t k = first[0] == 0 ? 0 : first[1] == 0 ? 1 : 2;
    const int left = first[(k + 1) % 3], right = first[(k + 2) % 3];
    needle.triangles[static_cast<std::size_t>(fan[0])][k] = twin;
    needle.triangles.push_back({0, left, twin});
    needle.triangles.push_back({0, twin, right});
    const RepairResult thin = repair(needle);
    check_good(thin);
    CHECK(thin.mesh.vertex_count() == sphere(1, 2).vertex_count());
    CHECK(thin.mesh.triangle_count() == sphere(1, 2).triangle_count());
    CHECK(thin.new_of_old[static_cast<std::size_t>(twin)] == thin.new_of_old[0]);
}

TEST_CASE("What cannot be made solid says why", "[repair]") {
    const RepairResult moebius = repair(band(40, 1));
    CHECK_FALSE(moebius.good());
    CHECK(moebius.reason.find("Moebius") != std::string::npos);
    const RepairResult ring = repair(band(40, 0)); // open, two borders
    CHECK_FALSE(ring.good());
    CHECK(ring.reason.find("2 holes") != std::string::npos);
    RepairOptions wide;
    wide.fill_share = 1e9;
    const RepairResult flat = repair(sheet(3, 3), wide);
    CHECK_FALSE(flat.good());
    CHECK(flat.reason.find("no surface is left") != std::string::npos);
    for (const TriMesh& nothing : {TriMesh{}, TriMesh{{Vec3(0, 0, 0)}, {}},
                                   TriMesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}}}) {
        const RepairResult r = repair(nothing);
        CHECK_FALSE(r.good());
        CHECK(r.mesh.triangle_count() == r.measured_after.triangles);
    }
}

TEST_CASE("Coordinates that are no numbers, indices out of range and huge numbers are survived", "[repair]") {
    TriMesh mesh = sphere(1, 3);
    const double clean = volume(mesh);
    mesh.positions.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    mesh.positions.emplace_back(1e200, 0, 0);
    const int n = mesh.vertex_count();
    mesh.triangles.push_back({0, 1, n - 2});
    mesh.triangles.push_back({0, 1, n - 1});
    mesh.triangles.push_back({0, 1, n});
    mesh.triangles.push_back({0, -1, 3});
    const RepairResult r = repair(mesh);
    check_good(r);
    CHECK(found(r, "unusable") == 4);
    CHECK(volume(r.mesh) == Approx(clean));
    TriMesh holed = sphere(1, 3);
    holed.positions[10].x() = std::numeric_limits<double>::infinity();
    check_good(repair(holed)); // its triangles go, the hole is filled
    for (const double size : {1e-30, 1e38})
        check_good(repair(soup(sphere(size, 2))));
}

TEST_CASE("A million triangles on one point are gone in no time", "[repair]") {
    TriMesh mesh;
    const int n = 100000; // a tenth of it here: tests run under sanitizers
    mesh.positions.assign(3 * n, Vec3(1, 2, 3));
    for (int t = 0; t < n; ++t)
        mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    const RepairResult r = repair(mesh);
    CHECK(r.reason == "no surface is left that encloses anything");
    CHECK(r.new_of_old[0] == -1);
}

TEST_CASE("Wheels with very many spokes are repaired in no time", "[repair]") {
    // Two hubs over one rim, whose edges are so short that they collapse.
    constexpr int spokes = 50000;
    TriMesh wheel;
    wheel.positions = {{0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < spokes; ++i) {
        const double u = 2 * 3.14159265358979323846 * i / spokes;
        wheel.positions.emplace_back(std::cos(u), std::sin(u), 0);
        const int a = 2 + i, b = 2 + (i + 1) % spokes;
        wheel.triangles.push_back({0, a, b});
        wheel.triangles.push_back({1, b, a});
    }
    const std::clock_t start = std::clock();
    const RepairResult r = repair(wheel);
    CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 20); // once round the hub for each spoke: minutes
    check_good(r);
    CHECK(volume(r.mesh) == Approx(2 * 3.14159265358979323846 / 3).epsilon(1e-3));
    CHECK(r.mesh.vertex_count() < spokes / 4);
}

TEST_CASE("Values and labels follow the vertices", "[repair]") {
    const std::vector<VertexOrigin> origins{VertexOrigin::of(2), {{0, 1, -1}, {0.75, 0.25, 0}}, {}};
    CHECK(carried_values(origins, {1.5, 2.5, 3.5}, 1) ==
          std::vector<double>{3.5, 0.75 * 1.5 + 0.25 * 2.5, 0});
    CHECK(carried_values(origins, {1, 2, 3}, 1) == std::vector<double>{3, 1, 0}); // labels: no means
    CHECK(carried_values(origins, {1.5, 0, 2.5, 1, 3.5, 2}, 2).size() == 6);
    CHECK(carried_members(origins, {0, 2}) == std::vector<int>{0, 1});
    const VertexOrigin mean =
        mean_origin({VertexOrigin::of(4), VertexOrigin::of(4), VertexOrigin::of(1)}, {1, 1, 1});
    CHECK(mean.nearest() == 4);
    CHECK(mean.weights[0] == Approx(2.0 / 3));
    CHECK(mean.vertices[2] == -1);
}
