#include "solver/fast/packing.hpp"
#include "solver/fast/plan.hpp"
#include "solver/fast/thread_choice.hpp"
#include "solver/fast/vertex_order.hpp"
#include "solver/fast/worker_team.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace fascicle;
using namespace fascicle::solver::fast;

namespace {

SoftBodyProblem ball(int levels) {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(test::sphere(10, levels));
    problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
    return problem;
}

Plan plan_of(const SoftBodyProblem& problem) {
    const MeshTopology topology(problem.surface->vertex_count(), problem.surface->triangles);
    auto plan = make_plan(problem, topology);
    REQUIRE(plan);
    return *plan;
}

} // namespace

TEST_CASE("fast plan: the vertex order is a permutation that brings neighbours together", "[solver][fast]") {
    const TriMesh mesh = test::sphere(1, 5);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const std::vector<int> order = vertex_order(topology);
    REQUIRE(order.size() == mesh.positions.size());
    CHECK(std::set<int>(order.begin(), order.end()).size() == order.size());
    std::vector<int> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        place[std::size_t(order[i])] = int(i);
    int span = 0;
    for (const Edge& e : topology.edges())
        span = std::max(span, std::abs(place[std::size_t(e.a)] - place[std::size_t(e.b)]));
    CHECK(span < int(order.size()) / 12); // 4,098 vertices, 128 edges round the equator
}

TEST_CASE("fast plan: rest positions are floats in all three coordinates, far from the origin, too",
          "[solver][fast]") {
    SoftBodyProblem problem = ball(3);
    auto moved = std::make_shared<TriMesh>(*problem.surface);
    for (Vec3& p : moved->positions)
        p = 1.7 * p + Vec3(1234.567, -765.4321, 998.001);
    problem.surface = moved;
    const Plan plan = plan_of(problem);
    REQUIRE(plan.rest.size() == moved->positions.size());
    int unrounded = 0;
    for (std::size_t i = 0; i < plan.rest.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const volatile auto stored = static_cast<float>(plan.rest[i][k]);
            unrounded += static_cast<double>(stored) == plan.rest[i][k] ? 0 : 1;
            CHECK(std::abs(plan.rest[i][k] - (moved->positions[i] - plan.origin)[k]) < 2e-6); // 2^-24 of 17
        }
    CHECK(unrounded == 0);
}

TEST_CASE("fast plan: packing shares no movable vertex in a row and loses no constraint", "[solver][fast]") {
    const TriMesh mesh = test::sphere(1, 3);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<int> corners;
    for (const Dihedral& d : topology.dihedrals())
        corners.insert(corners.end(), {d.p0, d.p1, d.p2, d.p3});
    std::vector<bool> movable(mesh.positions.size(), true);
    for (std::size_t i = 0; i < movable.size(); i += 9)
        movable[i] = false;
    std::vector<int> rows;
    REQUIRE(pack(corners, 4, movable, rows));
    REQUIRE(rows.size() % packet == 0);
    std::set<int> seen;
    std::size_t padding = 0;
    for (std::size_t r = 0; r < rows.size(); r += packet) {
        std::set<int> touched;
        for (std::size_t i = r; i < r + packet; ++i) {
            if (rows[i] < 0) {
                ++padding;
                continue;
            }
            CHECK(seen.insert(rows[i]).second);
            for (std::size_t k = 0; k < 4; ++k)
                if (const int v = corners[4 * std::size_t(rows[i]) + k]; movable[std::size_t(v)])
                    CHECK(touched.insert(v).second);
        }
    }
    CHECK(seen.size() == topology.dihedrals().size());
    CHECK(padding < rows.size() / 4);
}

TEST_CASE("fast plan: a hub with more neighbours than colours is refused, a smaller one is packed",
          "[solver][fast]") {
    for (const std::size_t spokes : {std::size_t{900}, max_colours + 1}) {
        std::vector<int> corners;
        for (std::size_t i = 1; i <= spokes; ++i)
            corners.insert(corners.end(), {0, int(i)});
        std::vector<int> rows;
        CHECK(pack(corners, 2, std::vector<bool>(spokes + 1, true), rows) == (spokes <= max_colours));
    }
}

TEST_CASE("fast plan: blocks of a large mesh keep to themselves", "[solver][fast]") {
    const SoftBodyProblem problem = ball(6); // 16,386 vertices
    const Plan plan = plan_of(problem);
    REQUIRE(plan.interiors.size() > 1);
    REQUIRE(plan.interfaces.size() + 1 == plan.interiors.size());
    std::vector<int> owner(plan.records(), -1);
    const auto visit = [&](const ConstraintSet& set, int number, bool shared) {
        for (std::size_t h = set.first_hinge; h < set.first_hinge + set.hinges; ++h)
            for (const auto& role : plan.hinges[h].p)
                for (const std::uint16_t i : role) {
                    const std::size_t r = set.first_record + i;
                    REQUIRE(r < plan.records());
                    if (plan.inverse_mass[r] == 0.0f)
                        continue;
                    if (owner[r] < 0)
                        owner[r] = number;
                    shared = shared && owner[r] == number;
                }
        return shared;
    };
    for (std::size_t s = 0; s < plan.interiors.size(); ++s)
        CHECK(visit(plan.interiors[s], int(s), true));
    std::fill(owner.begin(), owner.end(), -1);
    for (std::size_t s = 0; s < plan.interfaces.size(); ++s)
        CHECK(visit(plan.interfaces[s], int(s), true));
    CHECK(plan.padding < plan.hinges.size() * packet / 5);
}

TEST_CASE("fast plan: the same for any number of threads", "[solver][fast]") {
    SoftBodyProblem problem = ball(5);
    const Plan one = plan_of(problem);
    problem.threads = 8;
    CHECK(plan_of(problem).record_of_vertex == one.record_of_vertex);
}

TEST_CASE("worker team: every thread runs, and none passes a meeting before the others",
          "[solver][fast][thread]") {
    for (const int size : {1, 2, 5}) {
        WorkerTeam team(size);
        REQUIRE(team.size() == size);
        std::vector<int> counts(std::size_t(size), 0);
        std::atomic<int> early{0};
        auto body = [&](int thread) {
            for (int round = 1; round <= 200; ++round) {
                counts[std::size_t(thread)] = round;
                team.meet();
                for (const int c : counts)
                    early += c == round ? 0 : 1;
                team.meet();
            }
        };
        for (int job = 0; job < 20; ++job)
            team.run(body);
        CHECK(early == 0);
    }
}

TEST_CASE("thread choice: leaves the team while that is slow, and comes back", "[solver][fast][thread]") {
    ThreadChoice choice;
    // The machine gets busy after 100 frames, for 400; one thread always takes 1.8 ms.
    int alone_idle = 0, alone_busy = 0, alone_after = 0;
    for (int f = 0; f < 1000; ++f) {
        const bool busy = f >= 100 && f < 500;
        (f < 100 ? alone_idle : busy ? alone_busy : alone_after) += choice.alone() ? 1 : 0;
        choice.record(choice.alone() ? 1.8e-3 : busy ? 5e-3 : 1e-3);
    }
    CHECK(alone_idle == 0);
    CHECK(alone_busy > 320);
    CHECK(alone_after < 80);
}
