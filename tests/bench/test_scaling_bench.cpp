#include "bench/scaling_bench.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// A box fixed to solid 0 at the bottom and to solid 1 at the top; softness of an edge: its direction along z, squared.
SoftBodyProblem box_problem(const TriMesh& mesh) {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(mesh);
    problem.solids.resize(2);
    for (const Vec3& p : mesh.positions) {
        problem.body_of_vertex.push_back(p.z() == 0 ? 0 : p.z() == 1 ? 1 : -1);
        problem.carry_weights.push_back(1 - p.z());
        problem.carry_weights.push_back(p.z());
    }
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    for (const Edge& edge : topology.edges()) {
        const Vec3 d = mesh.positions[std::size_t(edge.b)] - mesh.positions[std::size_t(edge.a)];
        problem.edge_softness.push_back(d.z() * d.z() / d.squaredNorm());
    }
    return problem;
}

} // namespace

TEST_CASE("a refined problem is the problem of the refined surface", "[bench][scaling]") {
    const SoftBodyProblem coarse = box_problem(test::box());
    SoftBodyProblem fine = bench::refined(coarse);
    for (int level = 0; level < 2; ++level, fine = bench::refined(fine)) {
        // Every input depends on place and direction alone, so making it anew must give the same.
        const SoftBodyProblem anew = box_problem(*fine.surface);
        CHECK(fine.body_of_vertex == anew.body_of_vertex);
        CHECK(fine.carry_weights == anew.carry_weights);
        REQUIRE(fine.edge_softness.size() == anew.edge_softness.size());
        for (std::size_t e = 0; e < fine.edge_softness.size(); ++e)
            CHECK(fine.edge_softness[e] == Approx(anew.edge_softness[e]).margin(1e-14));
        CHECK(signed_volume(fine.surface->positions, fine.surface->triangles) == Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("empty inputs stay empty", "[bench][scaling]") {
    SoftBodyProblem problem = box_problem(test::box());
    problem.edge_softness.clear();
    problem.carry_weights.clear();
    const SoftBodyProblem fine = bench::refined(problem);
    CHECK(fine.edge_softness.empty());
    CHECK(fine.carry_weights.empty());
    CHECK(fine.body_of_vertex.size() == fine.surface->positions.size());
}
