#include "fascicle/geometry/mesh_topology.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

using namespace fascicle;
using namespace fascicle::test;

namespace {

const Vec3& at(const TriMesh& mesh, int v) {
    return mesh.positions[static_cast<std::size_t>(v)];
}

/// theta of methods.md 1.1, written out here so that the sign convention of dihedrals has its own witness.
double theta(const TriMesh& mesh, const Dihedral& h) {
    const Vec3 e = at(mesh, h.p3) - at(mesh, h.p2);
    const Vec3 n1 = (at(mesh, h.p2) - at(mesh, h.p0)).cross(at(mesh, h.p3) - at(mesh, h.p0)).normalized();
    const Vec3 n2 = (at(mesh, h.p3) - at(mesh, h.p1)).cross(at(mesh, h.p2) - at(mesh, h.p1)).normalized();
    return std::atan2(-n1.cross(n2).dot(e) / e.norm(), n1.dot(n2));
}

/// Every list of the topology against the definition, the slow way.
void check_against_definition(int vertex_count, const std::vector<Tri>& triangles) {
    const MeshTopology topology(vertex_count, triangles);
    std::map<std::pair<int, int>, std::vector<int>> walks; // edge -> half-edges
    std::vector<std::set<int>> neighbours(static_cast<std::size_t>(vertex_count)), around = neighbours;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        if (has_repeated_index(triangles[t]))
            continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
            walks[{std::min(a, b), std::max(a, b)}].push_back(static_cast<int>(3 * t + k));
            neighbours[static_cast<std::size_t>(a)].insert(b);
            neighbours[static_cast<std::size_t>(b)].insert(a);
            around[static_cast<std::size_t>(a)].insert(static_cast<int>(t));
        }
    }
    REQUIRE(topology.edges().size() == walks.size());
    std::vector<int> boundary, nonmanifold, inconsistent, hinged;
    int e = 0;
    for (const auto& [edge, half_edges] : walks) { // a map runs in the order (a, b)
        REQUIRE(topology.edges()[static_cast<std::size_t>(e)] == Edge{edge.first, edge.second});
        const auto row = topology.edge_half_edges(e);
        REQUIRE(std::vector<int>(row.begin(), row.end()) == half_edges);
        int up = 0;
        for (const int h : half_edges)
            up += triangles[static_cast<std::size_t>(h / 3)][static_cast<std::size_t>(h % 3)] == edge.first;
        (half_edges.size() == 1  ? boundary
         : half_edges.size() > 2 ? nonmanifold
         : up == 1               ? hinged
                                 : inconsistent)
            .push_back(e);
        ++e;
    }
    CHECK(topology.boundary_edges() == boundary);
    CHECK(topology.nonmanifold_edges() == nonmanifold);
    CHECK(topology.inconsistent_edges() == inconsistent);
    REQUIRE(topology.dihedrals().size() == hinged.size());
    for (std::size_t i = 0; i < hinged.size(); ++i) {
        const Dihedral& h = topology.dihedrals()[i];
        REQUIRE(h.edge == hinged[i]);
        REQUIRE(Edge{h.p2, h.p3} == topology.edges()[static_cast<std::size_t>(h.edge)]);
        int first = 0, second = 0; // triangles (p0, p2, p3) and (p1, p3, p2) exist, in some rotation
        for (const Tri& t : triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Tri r{t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
                first += r == Tri{h.p0, h.p2, h.p3};
                second += r == Tri{h.p1, h.p3, h.p2};
            }
        REQUIRE(first >= 1);
        REQUIRE(second >= 1);
    }
    for (int v = 0; v < vertex_count; ++v) {
        const auto n = topology.vertex_neighbours(v);
        const auto t = topology.vertex_triangles(v);
        const auto& expected = neighbours[static_cast<std::size_t>(v)];
        const auto& triangles_there = around[static_cast<std::size_t>(v)];
        REQUIRE(std::vector<int>(n.begin(), n.end()) == std::vector<int>(expected.begin(), expected.end()));
        REQUIRE(std::vector<int>(t.begin(), t.end()) ==
                std::vector<int>(triangles_there.begin(), triangles_there.end()));
        REQUIRE((topology.vertex_component(v) == -1) == expected.empty());
        for (const int w : expected)
            REQUIRE(topology.vertex_component(v) == topology.vertex_component(w));
    }
}

} // namespace

TEST_CASE("closed surfaces have Euler's counts", "[geometry][mesh_topology]") {
    const auto euler = [](const TriMesh& mesh) {
        const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
        CHECK(topology.boundary_edges().empty());
        CHECK(topology.dihedrals().size() == topology.edges().size());
        CHECK(topology.component_count() == 1);
        return mesh.vertex_count() - static_cast<int>(topology.edges().size()) + mesh.triangle_count();
    };
    CHECK(euler(tetrahedron()) == 2);
    CHECK(euler(box()) == 2);
    CHECK(euler(sphere(1, 3)) == 2);
    CHECK(euler(torus()) == 0);
}

TEST_CASE("all lists agree with their definition", "[geometry][mesh_topology]") {
    check_against_definition(0, {});
    check_against_definition(5, {});
    for (const TriMesh& mesh :
         {tetrahedron(), box(), sphere(1, 2), torus(), sheet(3, 4), joined(box(), sheet(2, 2))})
        check_against_definition(mesh.vertex_count(), mesh.triangles);
}

TEST_CASE("any triangle soup is taken", "[geometry][mesh_topology]") {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        const int n = 1 + static_cast<int>(random() % 9);
        std::vector<Tri> triangles(random() % 20);
        for (Tri& t : triangles)
            for (int& v : t)
                v = static_cast<int>(random() % static_cast<unsigned>(n));
        check_against_definition(n, triangles);
    }
}

TEST_CASE("dihedral order gives outward normals: zero when flat, negative over a ridge",
          "[geometry][mesh_topology]") {
    const TriMesh cube = box();
    int flat = 0, ridge = 0;
    const MeshTopology outer(8, cube.triangles);
    for (const Dihedral& h : outer.dihedrals()) {
        const double angle = theta(cube, h);
        flat += std::abs(angle) < 1e-14;
        ridge += std::abs(angle + M_PI / 2) < 1e-14;
        const Vec3 n1 = (at(cube, h.p2) - at(cube, h.p0)).cross(at(cube, h.p3) - at(cube, h.p0));
        const Vec3 n2 = (at(cube, h.p3) - at(cube, h.p1)).cross(at(cube, h.p2) - at(cube, h.p1));
        CHECK(n1.dot(at(cube, h.p0) - Vec3(0.5, 0.5, 0.5)) > 0);
        CHECK(n2.dot(at(cube, h.p1) - Vec3(0.5, 0.5, 0.5)) > 0);
    }
    CHECK(flat == 6);
    CHECK(ridge == 12);
    const TriMesh hollow = inside_out(cube); // the same edges seen from inside are valleys
    const MeshTopology inner(8, hollow.triangles);
    for (const Dihedral& h : inner.dihedrals())
        CHECK(theta(hollow, h) > -1e-14);
}

TEST_CASE("components are numbered by their lowest vertex", "[geometry][mesh_topology]") {
    TriMesh two = joined(box(), tetrahedron());
    two.positions.emplace_back(9, 9, 9); // unused
    const MeshTopology topology(two.vertex_count(), two.triangles);
    CHECK(topology.component_count() == 2);
    CHECK(topology.vertex_component(0) == 0);
    CHECK(topology.vertex_component(8) == 1);
    CHECK(topology.vertex_component(12) == -1);
}
