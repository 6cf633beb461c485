#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

SoftBodyProblem free_ball() {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(test::sphere(10, 3));
    problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
    problem.parameters.assign("solver.kernel=reference"); // the fast one has its own tests
    return problem;
}

/// The lower cap belongs to a solid far below; nothing touches.
SoftBodyProblem held_ball(int solids) {
    SoftBodyProblem problem = free_ball();
    DistanceGridOptions options;
    options.spacing = 2;
    for (int b = 0; b < solids; ++b) {
        auto mesh = std::make_shared<TriMesh>(test::box(4, 4, 4));
        for (Vec3& p : mesh->positions)
            p += Vec3(100, 100 * b, -100);
        problem.solids.push_back({mesh, std::make_shared<DistanceGrid>(*mesh, options)});
    }
    for (std::size_t i = 0; i < problem.body_of_vertex.size(); ++i)
        if (problem.surface->positions[i].z() < -8)
            problem.body_of_vertex[i] = 0;
        else if (solids > 1 && problem.surface->positions[i].z() > 8)
            problem.body_of_vertex[i] = 1;
    return problem;
}

double rms(const Points& a, const Points& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / double(a.size()));
}

void advance(SoftBodySolver& solver, const std::vector<Pose>& from, const std::vector<Pose>& to, int frames) {
    for (int f = 0; f < frames; ++f)
        solver.advance(from, to);
}

} // namespace

TEST_CASE("xpbd: rest stays rest", "[solver][xpbd]") {
    const SoftBodyProblem problem = held_ball(1);
    const auto solver = find_solver_method("xpbd")->make(problem);
    advance(*solver, {Pose{}}, {Pose{}}, 10);
    CHECK(rms(solver->positions(), problem.surface->positions) < 1e-12);
    CHECK(solver->report().contacts == 0);
    CHECK(solver->report().non_finite == 0);
}

TEST_CASE("xpbd: attached vertices are exactly where their solid is", "[solver][xpbd]") {
    const SoftBodyProblem problem = held_ball(2);
    const auto solver = find_solver_method("xpbd")->make(problem);
    const std::vector<Pose> rest(2);
    std::vector<Pose> from = rest, to = rest;
    for (int f = 1; f <= 10; ++f) {
        to[1] = rotation_about(Vec3(0, -5, 0), Vec3::UnitX(), 0.02 * f);
        solver->advance(from, to);
        from = to;
    }
    for (std::size_t i = 0; i < problem.body_of_vertex.size(); ++i)
        if (const int body = problem.body_of_vertex[i]; body >= 0)
            CHECK(solver->positions()[i] == to[std::size_t(body)].apply(problem.surface->positions[i]));
}

TEST_CASE("xpbd: a stretched ball keeps its volume and comes back to rest", "[solver][xpbd]") {
    const SoftBodyProblem problem = held_ball(2);
    const auto solver = find_solver_method("xpbd")->make(problem);
    const double v0 = signed_volume(problem.surface->positions, problem.surface->triangles);
    std::vector<Pose> from(2), to(2);
    double worst = 0;
    for (int f = 1; f <= 120; ++f) {
        const double pull = f <= 30 ? 0.1 * f : f <= 60 ? 0.1 * (60 - f) : 0.0;
        to[1].translation = Vec3(0, 0, pull);
        solver->advance(from, to);
        from = to;
        worst = std::max(worst,
                         std::abs(signed_volume(solver->positions(), problem.surface->triangles) / v0 - 1));
    }
    CHECK(worst < 1e-3);
    CHECK(rms(solver->positions(), problem.surface->positions) < 0.02);
}

TEST_CASE("xpbd: a squeezed free ball keeps its momentum and springs back", "[solver][xpbd]") {
    SoftBodyProblem problem = free_ball();
    const auto solver = find_solver_method("xpbd")->make(problem);
    // Without solids nothing moves it; so start from another rest: pressure inflates it about its centre.
    problem.parameters.set("solver.pressure", 1.3);
    const auto inflated = find_solver_method("xpbd")->make(problem);
    advance(*inflated, {}, {}, 60);
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : inflated->positions())
        centre += p / double(inflated->positions().size());
    CHECK(centre.norm() < 1e-6);
    CHECK(signed_volume(inflated->positions(), problem.surface->triangles) ==
          Approx(1.3 * signed_volume(problem.surface->positions, problem.surface->triangles)).epsilon(1e-3));
}

TEST_CASE("xpbd: the carried part of a rigid motion is exact, and leaves no velocity behind",
          "[solver][xpbd]") {
    SoftBodyProblem problem = held_ball(1);
    problem.carry_weights.assign(problem.body_of_vertex.size(), 1.0);
    const auto solver = find_solver_method("xpbd")->make(problem);
    const Pose pose = rotation_about(Vec3(0, 40, 0), Vec3::UnitX(), 0.5);
    solver->advance(std::vector<Pose>{Pose{}}, std::vector<Pose>{pose});
    Points expected;
    for (const Vec3& p : problem.surface->positions)
        expected.push_back(pose.apply(p));
    CHECK(rms(solver->positions(), expected) < 1e-9);
    advance(*solver, {pose}, {pose}, 3);
    CHECK(rms(solver->positions(), expected) < 1e-9);
}

TEST_CASE("xpbd: the same bits for any number of threads", "[solver][xpbd]") {
    std::vector<Points> results;
    for (const int threads : {1, 2, 3, 8}) {
        SoftBodyProblem problem = held_ball(2);
        problem.threads = threads;
        const auto solver = find_solver_method("xpbd")->make(problem);
        const Pose pose = rotation_about(Vec3(0, 5, 0), Vec3::UnitX(), 0.3);
        solver->advance(std::vector<Pose>(2), std::vector<Pose>{Pose{}, pose});
        results.push_back(solver->positions());
    }
    CHECK(results[1] == results[0]);
    CHECK(results[2] == results[0]);
    CHECK(results[3] == results[0]);
}

TEST_CASE("xpbd: no vertex enters a plate that squeezes the ball", "[solver][xpbd]") {
    SoftBodyProblem problem = free_ball();
    DistanceGridOptions options;
    for (const double z : {-30.0, 10.3}) {
        auto plate = std::make_shared<TriMesh>(test::box(80, 80, 19.7));
        for (Vec3& p : plate->positions)
            p += Vec3(-40, -40, z);
        problem.solids.push_back({plate, std::make_shared<DistanceGrid>(*plate, options)});
    }
    const auto solver = find_solver_method("xpbd")->make(problem);
    std::vector<Pose> from(2), to(2);
    for (int f = 1; f <= 40; ++f) {
        to[1].translation = Vec3(0, 0, -0.3 * f); // 12 of the ball's 20 away
        solver->advance(from, to);
        from = to;
        double lowest = 0, highest = -100;
        for (const Vec3& p : solver->positions()) {
            lowest = std::min(lowest, p.z());
            highest = std::max(highest, p.z());
        }
        CHECK(lowest > -10.3);
        CHECK(highest < 10.3 - 0.3 * f);
    }
    CHECK(solver->report().contacts > 0);
    CHECK(solver->report().non_finite == 0);
}

TEST_CASE("xpbd: a vertex that no triangle uses stays where it is", "[solver][xpbd]") {
    SoftBodyProblem problem = held_ball(1);
    auto mesh = std::make_shared<TriMesh>(*problem.surface);
    mesh->positions.emplace_back(50, 50, 50);
    problem.surface = mesh;
    problem.body_of_vertex.push_back(-1);
    problem.carry_weights.assign(problem.body_of_vertex.size(), 1.0);
    const auto solver = find_solver_method("xpbd")->make(problem);
    solver->advance(std::vector<Pose>{Pose{}}, std::vector<Pose>{Pose{Mat3::Identity(), Vec3(1, 0, 0)}});
    CHECK(solver->positions().back() == Vec3(50, 50, 50));
}
