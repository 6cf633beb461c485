#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/solver/parameters.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/rivals/arap/arap_contact.hpp"
#include "support/rival_scenes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("arap: rest stays rest", "[solver][arap]") {
    const SoftBodyProblem problem = test::held_ball("arap", 2, 2);
    const auto solver = find_solver_method("arap")->make(problem);
    test::hold(*solver, std::vector<Pose>(2), 3);
    CHECK(test::farthest(solver->positions(), problem.surface->positions) < 1e-10);
    CHECK(solver->report().contacts == 0);
}

TEST_CASE("arap: what all solids share moves the surface rigidly", "[solver][arap]") {
    SoftBodyProblem problem = test::held_ball("arap", 2, 2);
    const auto solver = find_solver_method("arap")->make(problem);
    const Pose pose = rotation_about(Vec3(0, 40, 0), Vec3::UnitX(), 0.3);
    solver->advance(std::vector<Pose>(2), std::vector<Pose>(2, pose));
    test::hold(*solver, std::vector<Pose>(2, pose), 20);
    CHECK(test::farthest(solver->positions(), test::moved(problem.surface->positions, pose)) < 1e-6);
}

TEST_CASE("arap: attached vertices are exactly where their solid is, and the volume is kept",
          "[solver][arap]") {
    const SoftBodyProblem problem = test::held_ball("arap", 2, 2);
    const auto solver = find_solver_method("arap")->make(problem);
    std::vector<Pose> from(2), to(2);
    const double v0 = signed_volume(problem.surface->positions, problem.surface->triangles);
    for (int f = 1; f <= 5; ++f) {
        to[1] = rotation_about(Vec3(0, -5, 0), Vec3::UnitX(), 0.05 * f);
        solver->advance(from, to);
        from = to;
        CHECK(signed_volume(solver->positions(), problem.surface->triangles) == Approx(v0).epsilon(1e-5));
    }
    for (std::size_t i = 0; i < problem.body_of_vertex.size(); ++i)
        if (const int body = problem.body_of_vertex[i]; body >= 0)
            CHECK(solver->positions()[i] == to[std::size_t(body)].apply(problem.surface->positions[i]));
    // It has no memory: with its solids back at rest it is at rest again.
    solver->advance(to, std::vector<Pose>(2));
    test::hold(*solver, std::vector<Pose>(2), 40);
    CHECK(test::farthest(solver->positions(), problem.surface->positions) < 1e-3);
}

TEST_CASE("arap: the same bits for any number of threads", "[solver][arap]") {
    std::vector<Points> results;
    for (const int threads : {1, 2, 3}) {
        SoftBodyProblem problem = test::squeezed_ball("arap", threads);
        const auto solver = find_solver_method("arap")->make(problem);
        test::squeeze(*solver, 3, 1.0);
        results.push_back(solver->positions());
    }
    CHECK(results[1] == results[0]);
    CHECK(results[2] == results[0]);
}

TEST_CASE("arap: a free ball goes where it is carried, and is pushed by a plate without being crushed",
          "[solver][arap]") {
    SoftBodyProblem problem = test::squeezed_ball("arap", 1);
    problem.solids.pop_back(); // the upper plate
    const auto solver = find_solver_method("arap")->make(problem);
    std::vector<Pose> from(1), to(1);
    for (int f = 1; f <= 10; ++f) {
        to[0].translation = Vec3(0, 0, 0.5 * f);
        solver->advance(from, to);
        from = to;
    }
    double lowest = 100, highest = -100;
    for (const Vec3& p : solver->positions()) {
        lowest = std::min(lowest, p.z());
        highest = std::max(highest, p.z());
    }
    CHECK(lowest > -5.3); // the plate's face is at -5.3 now
    CHECK(highest - lowest == Approx(20).margin(1.5));
    CHECK(solver->report().non_finite == 0);
    problem.solids.clear(); // nothing at all: stays
    const auto alone = find_solver_method("arap")->make(problem);
    test::hold(*alone, {}, 3);
    CHECK(test::farthest(alone->positions(), problem.surface->positions) < 1e-9);
}

TEST_CASE("arap: between plates no vertex is inside, and shape and contact agree", "[solver][arap]") {
    SoftBodyProblem problem = test::squeezed_ball("arap", 2);
    const auto solver = find_solver_method("arap")->make(problem);
    const std::vector<Pose> squeezed = test::squeeze(*solver, 12, 0.5);
    test::hold(*solver, squeezed, 10);
    const Points settled = solver->positions();
    for (const Vec3& p : settled) {
        CHECK(p.z() > -10.3);
        CHECK(p.z() < 10.3 - 6.0);
    }
    CHECK(signed_volume(settled, problem.surface->triangles) ==
          Approx(signed_volume(problem.surface->positions, problem.surface->triangles)).epsilon(2e-3));
    // Where the alternations ended is where contact left it: in one more frame nothing goes on.
    test::hold(*solver, squeezed, 1);
    CHECK(test::farthest(solver->positions(), settled) < 0.05);
}

TEST_CASE("arap: contact holds a pressed vertex at the offset with a force, and lets go of one that leaves",
          "[solver][arap]") {
    const auto plate = std::make_shared<TriMesh>(test::box(8, 8, 4)); // top at z = 4
    const DistanceGrid grid(*plate, {});
    const std::vector<solver::ContactSolid> solids{{&grid, Pose{}, Pose{}, 1.5}};
    solver::ContactSettings settings;
    const double top = 4 + grid.correction_max();
    // Two vertices, joined by an edge that pulls the first into the plate.
    TriMesh mesh{{Vec3(4, 4, 4.0), Vec3(4, 4, 12), Vec3(5, 4, 12)}, {{0, 1, 2}}};
    const MeshTopology topology(3, mesh.triangles);
    const solver::ArapCells cells(mesh.positions, topology, std::vector<double>(3, 1.0));
    solver::ArapContact contact(3, 2.0, 50.0, 1);
    Points x = mesh.positions;
    REQUIRE(contact.choose(x, {1, 1, 1}, solids, settings, true));
    CHECK(contact.held() == 1);
    CHECK_FALSE(contact.choose(x, {1, 1, 1}, solids, settings, true));
    const double pull = 3.0; // wants to be that much deeper than z = 4
    for (int k = 0; k < 300; ++k) {
        Points b(3, Vec3::Zero());
        contact.add_targets(x, cells, solids, settings, b);
        std::vector<double> penalties(3, 0.0);
        contact.add_penalties(cells, penalties);
        REQUIRE(penalties[0] == Approx(4.0)); // 2 x weights 1 + 1
        x[0] = (b[0] + 2.0 * Vec3(4.5, 4, 4 - pull)) / (2.0 + penalties[0]);
    }
    CHECK(grid.value(x[0]) == Approx(settings.offset).margin(1e-6));
    CHECK(x[0].z() <= top + settings.offset);
    CHECK(x[0].x() == Approx(4.5).margin(1e-6)); // slides to where it is pulled
    CHECK(contact.multipliers()[0] > 0.0);
    x[0].z() = 9;
    Points b(3, Vec3::Zero());
    contact.add_targets(x, cells, solids, settings, b);
    CHECK(contact.multipliers()[0] == 0.0);
    CHECK(contact.choose(x, {1, 1, 1}, solids, settings, true));
    CHECK(contact.held() == 0);
}
