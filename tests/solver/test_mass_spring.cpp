#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/volume.hpp"
#include "solver/rivals/mass_spring/mass_spring_body.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using mass_spring::MassSpringBody;

namespace {

/// A strap of 40 x 10 x 8 along x, ends fixed to two small solids that are nowhere near.
SoftBodyProblem strap(std::vector<const char*> settings = {}) {
    SoftBodyProblem problem;
    auto mesh = std::make_shared<TriMesh>(test::sphere(1, 3));
    for (Vec3& p : mesh->positions) // between a ball and a box
        p = Vec3(20 * p.x(), 5 * p.y(), 4 * p.z()) / std::pow(p.array().pow(4).sum(), 0.25);
    problem.surface = mesh;
    problem.body_of_vertex.assign(mesh->positions.size(), -1);
    problem.carry_weights.assign(2 * mesh->positions.size(), 0.0);
    DistanceGridOptions options;
    options.spacing = 2;
    for (int b = 0; b < 2; ++b) {
        auto solid = std::make_shared<TriMesh>(test::box(4, 4, 4));
        for (Vec3& p : solid->positions)
            p += Vec3(200 * b - 100, 100, -100);
        problem.solids.push_back({solid, std::make_shared<DistanceGrid>(*solid, options)});
    }
    for (std::size_t i = 0; i < mesh->positions.size(); ++i) {
        const double share = std::clamp(0.5 + mesh->positions[i].x() / 30, 0.0, 1.0);
        problem.carry_weights[2 * i] = 1 - share;
        problem.carry_weights[2 * i + 1] = share;
        if (share == 0.0 || share == 1.0)
            problem.body_of_vertex[i] = share == 1.0;
    }
    set_method(problem.parameters, "mass-spring");
    problem.parameters.assign("mass-spring.particles=200");
    for (const char* setting : settings)
        problem.parameters.assign(setting);
    return problem;
}

double farthest(const Points& a, const Points& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

Points moved(const Points& points, const Pose& pose) {
    Points result;
    for (const Vec3& p : points)
        result.push_back(pose.apply(p));
    return result;
}

double volume_share(const SoftBodySolver& solver, const SoftBodyProblem& problem) {
    return signed_volume(solver.positions(), problem.surface->triangles) /
           signed_volume(problem.surface->positions, problem.surface->triangles);
}

/// Second solid turned by 1 rad in 20 frames.
Points bent(const SoftBodyProblem& problem, double* worst_volume = nullptr, int frames = 20) {
    const auto solver = make_mass_spring_solver(problem);
    std::vector<Pose> from(2), to(2);
    for (int f = 1; f <= frames; ++f) {
        to[1] = rotation_about(Vec3(0, -8, 0), Vec3::UnitZ(), 0.05 * std::min(f, 20));
        solver->advance(from, to);
        from = to;
        if (worst_volume != nullptr)
            *worst_volume = std::max(*worst_volume, std::abs(volume_share(*solver, problem) - 1));
        for (std::size_t i = 0; i < problem.body_of_vertex.size(); ++i)
            if (const int body = problem.body_of_vertex[i]; body >= 0)
                REQUIRE(solver->positions()[i] == to[std::size_t(body)].apply(problem.surface->positions[i]));
    }
    CHECK(solver->report().non_finite == 0);
    return solver->positions();
}

} // namespace

TEST_CASE("mass-spring: rest stays rest", "[solver][mass-spring]") {
    const SoftBodyProblem problem = strap();
    const auto solver = make_mass_spring_solver(problem);
    for (int f = 0; f < 5; ++f)
        solver->advance(std::vector<Pose>(2), std::vector<Pose>(2));
    CHECK(farthest(solver->positions(), problem.surface->positions) < 1e-9);
    CHECK(solver->report().contacts == 0);
}

TEST_CASE("mass-spring: when all solids move as one the settled shape goes along", "[solver][mass-spring]") {
    for (const bool carried : {true, false}) {
        SoftBodyProblem problem = strap();
        if (!carried) // the springs have to drag it there
            problem.carry_weights.clear();
        const auto solver = make_mass_spring_solver(problem);
        std::vector<Pose> from(2), to(2);
        for (int f = 1; f <= (carried ? 5 : 30); ++f) {
            to[0] = to[1] = rotation_about(Vec3(10, 40, 0), Vec3(1, 1, 0), 0.05 * std::min(f, 5));
            solver->advance(from, to);
            from = to;
        }
        CHECK(farthest(solver->positions(), moved(problem.surface->positions, to[0])) <
              (carried ? 1e-9 : 0.02));
    }
}

TEST_CASE("mass-spring: a bent strap loses volume when it is free, and keeps it when it is kept",
          "[solver][mass-spring]") {
    double lost = 0, kept = 0;
    bent(strap(), &lost);
    bent(strap({"solver.volume=kept"}), &kept);
    CHECK(lost > 0.01);
    CHECK(kept < 0.01);
    const SoftBodyProblem swollen = strap({"solver.volume=kept", "solver.pressure=1.1"});
    const auto solver = make_mass_spring_solver(swollen);
    for (int f = 0; f < 10; ++f)
        solver->advance(std::vector<Pose>(2), std::vector<Pose>(2));
    CHECK(volume_share(*solver, swollen) == Approx(1.1).epsilon(0.01));
}

TEST_CASE("mass-spring: it comes back to rest, and more steps bring it nearer in one frame",
          "[solver][mass-spring]") {
    std::vector<double> away;
    for (const char* steps : {"mass-spring.steps=10", "mass-spring.steps=70", "mass-spring.steps=400"}) {
        const SoftBodyProblem problem = strap({steps});
        const auto solver = make_mass_spring_solver(problem);
        const std::vector<Pose> rest(2);
        std::vector<Pose> pulled(2);
        pulled[1].translation = Vec3(4, 3, 0);
        solver->advance(rest, pulled);
        solver->advance(pulled, rest);
        away.push_back(farthest(solver->positions(), problem.surface->positions));
    }
    CHECK(away[1] < away[0]);
    CHECK(away[2] < away[1]);
    CHECK(away[2] < 0.02);
}

TEST_CASE("mass-spring: the same bits for any number of threads", "[solver][mass-spring]") {
    SoftBodyProblem problem = strap({"solver.volume=kept"});
    const Points one = bent(problem, nullptr, 2);
    problem.threads = 3;
    CHECK(bent(problem, nullptr, 2) == one);
}

TEST_CASE("mass-spring: parameters and layouts act", "[solver][mass-spring]") {
    const Points usual = bent(strap(), nullptr, 2);
    for (const char* other :
         {"mass-spring.springs=lattice6", "mass-spring.springs=nearest15", "mass-spring.particles=150",
          "mass-spring.steps=35", "mass-spring.damping=0.3", "solver.iterations=10", "solver.volume=kept"})
        CHECK(farthest(bent(strap({other}), nullptr, 2), usual) > 1e-4);
}

TEST_CASE("mass-spring: nothing enters a plate that comes up from below", "[solver][mass-spring]") {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(test::sphere(10, 3));
    problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
    set_method(problem.parameters, "mass-spring");
    problem.parameters.assign("mass-spring.particles=400");
    DistanceGridOptions options;
    options.spacing = 1;
    for (const double z : {-15.0, 11.0}) {
        auto plate = std::make_shared<TriMesh>(test::box(60, 60, 4));
        for (Vec3& p : plate->positions)
            p += Vec3(-30, -30, z);
        problem.solids.push_back({plate, std::make_shared<DistanceGrid>(*plate, options)});
    }
    const auto solver = make_mass_spring_solver(problem);
    std::vector<Pose> from(2), to(2);
    for (int f = 1; f <= 30; ++f) {
        to[0].translation = Vec3(0, 0, 0.3 * f); // gap 22 to 13
        solver->advance(from, to);
        from = to;
    }
    double lowest = 1e300, highest = -1e300, widest = 0;
    for (const Vec3& p : solver->positions()) {
        lowest = std::min(lowest, p.z());
        highest = std::max(highest, p.z());
        widest = std::max(widest, p.head<2>().norm());
    }
    CHECK(lowest > -2.0 - 1e-6);
    CHECK(highest < 11.0 + 1e-6);
    CHECK(widest > 10.2);
    CHECK(solver->report().contacts > 0);
    CHECK(solver->report().unresolved == 0);
}

TEST_CASE("mass-spring: odd bodies: tiny, flat, all attached, none attached, two parts, unused vertices",
          "[solver][mass-spring]") {
    const auto run = [](TriMesh mesh, bool attached) {
        SoftBodyProblem problem;
        problem.surface = std::make_shared<TriMesh>(std::move(mesh));
        const std::size_t count = problem.surface->positions.size();
        problem.body_of_vertex.assign(count, attached ? 0 : -1);
        problem.carry_weights.assign(count, 1.0);
        auto solid = std::make_shared<TriMesh>(test::box(4, 4, 4));
        for (Vec3& p : solid->positions)
            p += Vec3(100, 100, 100);
        problem.solids.push_back({solid, std::make_shared<DistanceGrid>(*solid, DistanceGridOptions{})});
        set_method(problem.parameters, "mass-spring");
        problem.parameters.assign("mass-spring.particles=200");
        const auto solver = make_mass_spring_solver(problem);
        const Pose pose = rotation_about(Vec3(3, 0, 0), Vec3::UnitZ(), 0.2);
        solver->advance(std::vector<Pose>(1), std::vector<Pose>{pose});
        const Points wanted = moved(problem.surface->positions, pose);
        const MeshTopology topology(int(count), problem.surface->triangles);
        double most = 0;
        for (std::size_t i = 0; i < count; ++i)
            most = std::max(most, topology.vertex_component(int(i)) < 0 && !attached
                                      ? (solver->positions()[i] - problem.surface->positions[i]).norm()
                                      : (solver->positions()[i] - wanted[i]).norm());
        CHECK(solver->report().non_finite == 0);
        return most;
    };
    TriMesh flat = test::sphere(10, 2), lone = test::sphere(1e-6, 1), far = test::sphere(10, 2), point;
    for (Vec3& p : flat.positions)
        p.z() = 0;
    far = test::joined(far, test::sphere(1, 2, Vec3(1e6, 0, 0)));
    far.positions.emplace_back(5, 5, 5);
    point = test::tetrahedron(1);
    for (Vec3& p : point.positions)
        p.setConstant(2);
    for (const bool attached : {false, true}) {
        CHECK(run(test::tetrahedron(1), attached) < 1e-9);
        CHECK(run(flat, attached) < 1e-9);
        CHECK(run(lone, attached) < 1e-9);
        CHECK(run(far, attached) < 1e-6);
        CHECK(run(test::box(5, 3, 2), attached) < 1e-9);
        CHECK(run(test::inside_out(test::sphere(10, 2)), attached) < 1e-9);
        CHECK(run(test::sheet(8, 3), attached) < 1e-9);
        CHECK(run(point, attached) < 1e-9);
    }
}

TEST_CASE("mass-spring: it goes on from another surface's positions", "[solver][mass-spring]") {
    const SoftBodyProblem problem = strap();
    const Points shape = bent(problem);
    const auto solver = make_mass_spring_solver(problem);
    REQUIRE(solver->set_state(shape, {}));
    CHECK(solver->positions() == shape);
    std::vector<Pose> poses(2);
    poses[1] = rotation_about(Vec3(0, -8, 0), Vec3::UnitZ(), 1.0);
    solver->advance(poses, poses);
    CHECK(farthest(solver->positions(), shape) < 2.0);
}
