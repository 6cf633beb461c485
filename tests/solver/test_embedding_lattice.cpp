#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/volume.hpp"
#include "solver/rivals/embedding_lattice.hpp"
#include "solver/rivals/lattice_fibres.hpp"
#include "solver/rivals/lattice_fields.hpp"
#include "solver/rivals/tet_overlap.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

double tet_volume(const EmbeddingLattice& lattice, std::size_t t) {
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k)
        x[k] = lattice.nodes[std::size_t(lattice.tets[t][k])];
    return (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0])) / 6;
}

double filled_volume(const EmbeddingLattice& lattice) {
    double sum = 0;
    for (std::size_t t = 0; t < lattice.tets.size(); ++t)
        sum += lattice.fill[t] * tet_volume(lattice, t);
    return sum;
}

EmbeddingLattice lattice_of(const TriMesh& mesh, double spacing, int threads = 1) {
    LatticeOptions options;
    options.spacing = spacing;
    options.threads = threads;
    return make_embedding_lattice(mesh, options);
}

} // namespace

TEST_CASE("A triangle meets a tetrahedron when it cuts, touches or lies in it, and not when it is beside",
          "[solver][tet]") {
    const TetCorners tet{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    const auto at = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        return triangle_meets_tet({a, b, c}, tet);
    };
    CHECK(at({0.1, 0.1, 0.1}, {0.2, 0.1, 0.1}, {0.1, 0.2, 0.1})); // inside
    CHECK(at({-5, -5, 0.2}, {9, -5, 0.2}, {-5, 9, 0.2}));         // cuts right through
    CHECK(at({0, 0, 0}, {-1, 0, 0}, {0, -1, 0}));                 // shares a corner
    CHECK(at({0.5, -1, 0.2}, {0.5, 1, 0.2}, {0.5, 1, 0.2}));      // a segment through it
    CHECK_FALSE(at({1, 1, 1}, {2, 1, 1}, {1, 2, 1}));             // beyond the slanted face
    CHECK_FALSE(at({0.6, 0.6, -1}, {0.6, 0.6, 2}, {2, 2, 0}));    // parted by an edge pair
    CHECK_FALSE(at({-0.01, 0, 0}, {-0.01, 1, 0}, {-0.01, 0, 1})); // just beside a face
    const auto weights = tet_weights(Vec3(0.2, 0.3, 0.1), tet);
    CHECK(weights[0] == Approx(0.4));
    CHECK(weights[1] == Approx(0.2));
    CHECK(weights[2] == Approx(0.3));
    CHECK(weights[3] == Approx(0.1));
}

TEST_CASE("A lattice has good tetrahedra that share faces, and holds every vertex of the surface",
          "[solver][tet]") {
    for (const TriMesh& mesh : {test::sphere(10, 2), test::torus(20, 6), test::box(30, 7, 3),
                                test::joined(test::sphere(5, 2), test::sphere(3, 2, Vec3(40, 0, 0)))}) {
        const EmbeddingLattice lattice = lattice_of(mesh, 3);
        for (std::size_t t = 0; t < lattice.tets.size(); ++t)
            CHECK(tet_volume(lattice, t) == Approx(std::pow(lattice.spacing, 3) / 12));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            CHECK((lattice.bound_point(i, lattice.nodes) - mesh.positions[i]).norm() < 1e-10);
            for (const double w : lattice.bindings[i].weights)
                CHECK(w > -1e-6);
        }
        std::map<std::array<int, 3>, int> faces;
        for (const Tet& tet : lattice.tets)
            for (std::size_t k = 0; k < 4; ++k) {
                std::array<int, 3> face{tet[(k + 1) % 4], tet[(k + 2) % 4], tet[(k + 3) % 4]};
                std::sort(face.begin(), face.end());
                ++faces[face];
            }
        for (const auto& [face, count] : faces)
            CHECK(count <= 2);
        // Fills are sampled: the volume is that of the solid to some percent.
        CHECK(filled_volume(lattice) == Approx(signed_volume(mesh.positions, mesh.triangles)).epsilon(0.12));
    }
}

TEST_CASE("A lattice is the same for any number of threads, and grows with the body's unit",
          "[solver][tet]") {
    TriMesh mesh = test::sphere(10, 2, Vec3(400, -300, 900));
    const EmbeddingLattice one = lattice_of(mesh, 4), four = lattice_of(mesh, 4, 4);
    CHECK(one.nodes == four.nodes);
    CHECK(one.tets == four.tets);
    CHECK(one.fill == four.fill);
    for (Vec3& p : mesh.positions)
        p /= 1024; // a power of two: the same digits
    const EmbeddingLattice small = lattice_of(mesh, 4.0 / 1024);
    CHECK(small.tets == one.tets);
    CHECK(small.fill == one.fill);
}

TEST_CASE("A lattice stays within its bound of tetrahedra, and a small body gets a finer one",
          "[solver][tet]") {
    LatticeOptions options;
    options.spacing = 0.5;
    options.most_tets = 2000;
    const EmbeddingLattice bounded = make_embedding_lattice(test::sphere(10, 2), options);
    CHECK(bounded.tets.size() <= 2000);
    CHECK(bounded.tets.size() > 800);
    CHECK(bounded.spacing > 0.5);
    const EmbeddingLattice small = lattice_of(test::sphere(1, 2), 100);
    CHECK(small.spacing < 1);
    CHECK_THROWS_WITH(lattice_of(TriMesh{{Vec3(1, 1, 1)}, {}}, 1), Catch::Contains("no extent"));
}

TEST_CASE("Vertices of no triangle are not bound to the lattice", "[solver][tet]") {
    TriMesh mesh = test::sphere(10, 2);
    mesh.positions.emplace_back(1000, 0, 0);
    const EmbeddingLattice lattice = lattice_of(mesh, 4);
    CHECK(lattice.bindings.back().tet == -1);
    CHECK(lattice.tets.size() == lattice_of(test::sphere(10, 2), 4).tets.size());
}

TEST_CASE("Values of vertices reach every node, and a constant stays one", "[solver][tet]") {
    const TriMesh mesh = test::joined(test::sphere(12, 2), test::sphere(3, 2, Vec3(40, 0, 0)));
    const EmbeddingLattice lattice = lattice_of(mesh, 3);
    const std::vector<double> values(mesh.positions.size(), 2.5), counts(mesh.positions.size(), 1.0);
    for (const double v : node_values(lattice, values, 1, counts, 3))
        CHECK(v == Approx(2.5));
    const std::vector<int> parts = lattice_parts(lattice);
    CHECK(*std::max_element(parts.begin(), parts.end()) == 1);
}

TEST_CASE("The direction of fibres is found again from what they leave on the edges", "[solver][tet]") {
    const TriMesh mesh = cylinder_mesh(Vec3(0, 0, 0), Vec3(0, 0, 60), 8, 16, 20);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const Vec3 v = Vec3(0.1, 0, 1).normalized();
    SoftBodyProblem problem;
    for (const Edge& e : topology.edges()) {
        const Vec3 u = (mesh.positions[std::size_t(e.b)] - mesh.positions[std::size_t(e.a)]).normalized();
        problem.edge_along.push_back(std::pow(u.dot(v), 2));
        problem.edge_softness.push_back(std::pow(1 - std::abs(u.dot(v)), 1.5));
    }
    problem.parameters.set("solver.anisotropy", 1.5);
    const EmbeddingLattice lattice = lattice_of(mesh, 5);
    const auto squares = edge_squares(problem, topology.edges().size());
    problem.edge_along.clear();
    const auto from_softness = edge_squares(problem, topology.edges().size());
    for (std::size_t e = 0; e < squares.size(); ++e)
        CHECK(from_softness[e] == Approx(squares[e]).margin(1e-9));
    const auto fibres = lattice_fibres(lattice, vertex_fibre_matrices(mesh, topology, squares));
    int looked_at = 0;
    for (std::size_t t = 0; t < fibres.size(); ++t) {
        CHECK(fibres[t].norm() == Approx(1));
        const double z = lattice.nodes[std::size_t(lattice.tets[t][0])].z();
        if (z < 15 || z > 45) // the flat ends know only what lies in them
            continue;
        ++looked_at;
        CHECK(fibres[t].dot(v) > std::cos(0.15));
    }
    CHECK(looked_at > 100);
    problem.edge_softness.clear();
    CHECK(edge_squares(problem, topology.edges().size()).empty());
    const std::vector<Mat3> none(mesh.positions.size(), Mat3::Zero());
    for (const Vec3& a : lattice_fibres(lattice, none))
        CHECK(a.norm() == 0);
}
