#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/rival_scenes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// Without the volume step: the field itself.
SoftBodyProblem field_alone(SoftBodyProblem problem) {
    problem.parameters.assign("solver.volume=free");
    return problem;
}

} // namespace

TEST_CASE("rbf: rest stays rest, and one attachment alone makes it rigid", "[solver][rbf]") {
    const SoftBodyProblem problem = test::held_ball("rbf", 1);
    const auto solver = find_solver_method("rbf")->make(problem);
    test::hold(*solver, {Pose{}}, 2);
    CHECK(test::farthest(solver->positions(), problem.surface->positions) == 0.0);
    const Pose pose = rotation_about(Vec3(0, 40, 0), Vec3::UnitX(), 0.5);
    solver->advance(std::vector<Pose>{Pose{}}, std::vector<Pose>{pose});
    CHECK(test::farthest(solver->positions(), test::moved(problem.surface->positions, pose)) < 1e-9);
}

TEST_CASE("rbf: what all solids share moves everything rigidly", "[solver][rbf]") {
    for (const char* kernel : {"rbf.kernel=linear", "rbf.kernel=cubic"}) {
        SoftBodyProblem problem = test::held_ball("rbf", 2);
        problem.parameters.assign(kernel);
        const auto solver = find_solver_method("rbf")->make(problem);
        const Pose pose = rotation_about(Vec3(0, 40, 0), Vec3(1, 2, 0), 2.0);
        solver->advance(std::vector<Pose>(2), std::vector<Pose>(2, pose));
        CHECK(test::farthest(solver->positions(), test::moved(problem.surface->positions, pose)) < 1e-9);
    }
}

TEST_CASE("rbf: the field goes through the attachments and depends on the pose alone", "[solver][rbf]") {
    const SoftBodyProblem problem = field_alone(test::held_ball("rbf", 2));
    const auto there = find_solver_method("rbf")->make(problem);
    const auto round_about = find_solver_method("rbf")->make(problem);
    const std::vector<Pose> rest(2);
    std::vector<Pose> to = rest, far = rest;
    to[1] = rotation_about(Vec3(0, -5, 0), Vec3::UnitX(), 0.3);
    far[1].translation = Vec3(3, 4, 2);
    there->advance(rest, to);
    round_about->advance(rest, far);
    round_about->advance(far, to);
    CHECK(there->positions() == round_about->positions());
    for (std::size_t i = 0; i < problem.body_of_vertex.size(); ++i)
        if (const int body = problem.body_of_vertex[i]; body >= 0)
            CHECK(there->positions()[i] == to[std::size_t(body)].apply(problem.surface->positions[i]));
    // A free vertex beside an attached one moves nearly as that does.
    const MeshTopology topology(problem.surface->vertex_count(), problem.surface->triangles);
    for (const Edge& edge : topology.edges()) {
        const auto a = std::size_t(edge.a), b = std::size_t(edge.b);
        const double before = (problem.surface->positions[a] - problem.surface->positions[b]).norm();
        CHECK((there->positions()[a] - there->positions()[b]).norm() < 1.6 * before);
    }
    // And back at rest it is at rest.
    there->advance(to, rest);
    CHECK(test::farthest(there->positions(), problem.surface->positions) < 1e-12);
}

TEST_CASE("rbf: attachments in one plane, or two points, still follow their solids", "[solver][rbf]") {
    for (const int points : {2, 3, 5}) {
        SoftBodyProblem problem = field_alone(test::held_ball("rbf", 2));
        std::fill(problem.body_of_vertex.begin(), problem.body_of_vertex.end(), -1);
        int given = 0; // on the ball's equator
        for (std::size_t i = 0; i < problem.body_of_vertex.size() && given < points; ++i)
            if (std::abs(problem.surface->positions[i].z()) < 1e-12)
                problem.body_of_vertex[i] = given++ % 2;
        REQUIRE(given == points);
        const auto solver = find_solver_method("rbf")->make(problem);
        const Pose pose = rotation_about(Vec3(0, 40, 0), Vec3(1, 2, 0), 1.0);
        solver->advance(std::vector<Pose>(2), std::vector<Pose>(2, pose));
        CHECK(test::farthest(solver->positions(), test::moved(problem.surface->positions, pose)) < 1e-6);
        std::vector<Pose> apart(2, pose);
        apart[1].translation += Vec3(1, 0, 0);
        solver->advance(std::vector<Pose>(2, pose), apart);
        CHECK(solver->report().non_finite == 0);
        CHECK(test::farthest(solver->positions(), test::moved(problem.surface->positions, pose)) < 4.0);
    }
}

TEST_CASE("rbf: a free ball is bent by plates, keeps its volume and comes back", "[solver][rbf]") {
    const SoftBodyProblem problem = test::squeezed_ball("rbf", 2);
    const auto solver = find_solver_method("rbf")->make(problem);
    const std::vector<Pose> squeezed = test::squeeze(*solver, 10, 0.5);
    for (const Vec3& p : solver->positions()) {
        CHECK(p.z() > -10.3);
        CHECK(p.z() < 10.3 - 5.0);
    }
    CHECK(signed_volume(solver->positions(), problem.surface->triangles) ==
          Approx(signed_volume(problem.surface->positions, problem.surface->triangles)).epsilon(1e-3));
    CHECK(solver->report().non_finite == 0);
    for (int f = 9; f >= -20; --f) {
        std::vector<Pose> from(2), to(2);
        from[1].translation.z() = -0.5 * std::max(f + 1, 0);
        to[1].translation.z() = -0.5 * std::max(f, 0);
        solver->advance(from, to);
    }
    // The shape is that of rest, wherever the plates left it.
    double lowest = 100, highest = -100;
    for (const Vec3& p : solver->positions()) {
        lowest = std::min(lowest, p.z());
        highest = std::max(highest, p.z());
    }
    CHECK(highest - lowest == Approx(20).margin(0.1));
}

TEST_CASE("rbf: contact centres bend the field before the step after must", "[solver][rbf]") {
    // A ball held above and below, with a plate that comes from the side.
    const auto run = [](int contacts, int threads) {
        SoftBodyProblem problem = field_alone(test::held_ball("rbf", 2));
        problem.threads = threads;
        auto plate = std::make_shared<TriMesh>(test::box(10, 40, 15));
        for (Vec3& p : plate->positions)
            p += Vec3(10.5, -20, -7.5);
        problem.solids.push_back({plate, std::make_shared<DistanceGrid>(*plate, DistanceGridOptions{})});
        problem.parameters.assign("rbf.contacts=" + std::to_string(contacts));
        auto solver = find_solver_method("rbf")->make(problem);
        std::vector<Pose> from(3), to(3);
        for (int f = 1; f <= 6; ++f) {
            to[2].translation = Vec3(-0.5 * f, 0, 0);
            solver->advance(from, to);
            from = to;
        }
        return std::make_pair(std::move(solver), problem.surface);
    };
    const auto with = run(200, 1), without = run(0, 1);
    // Beside the plate, where it touches nothing: only the field knows of it.
    int beside = 0;
    const Points& rest = with.second->positions;
    for (std::size_t i = 0; i < rest.size(); ++i)
        if (rest[i].x() > 5 && rest[i].x() < 7 && rest[i].z() > -7 && rest[i].z() < 7) {
            ++beside;
            CHECK(without.first->positions()[i] == rest[i]);
            CHECK(with.first->positions()[i].x() < rest[i].x() - 0.05);
        }
    CHECK(beside > 10);
    CHECK(run(1, 1).first->positions() != without.first->positions()); // one centre is not none
    for (const Vec3& p : with.first->positions())
        CHECK_FALSE((p.x() > 7.5 + 1e-9 && std::abs(p.z()) < 7.5));
    CHECK(run(200, 3).first->positions() == with.first->positions());
}
