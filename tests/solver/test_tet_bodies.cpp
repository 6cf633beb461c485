// What both methods with tetrahedra promise as SoftBodySolvers: fem and xpbd-tet.
#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/rivals/fem_body.hpp"
#include "solver/rivals/tet_statics.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

SolidBody far_solid(const Vec3& at) {
    DistanceGridOptions options;
    options.spacing = 2;
    auto mesh = std::make_shared<TriMesh>(test::box(4, 4, 4));
    for (Vec3& p : mesh->positions)
        p += at;
    return {mesh, std::make_shared<DistanceGrid>(*mesh, options)};
}

/// A rod along z, each end fixed to a solid that is far away.
SoftBodyProblem held_rod(const char* method, double radius = 10, double length = 60) {
    SoftBodyProblem problem;
    problem.surface =
        std::make_shared<TriMesh>(cylinder_mesh(Vec3::Zero(), Vec3(0, 0, length), radius, 16, 12));
    problem.solids = {far_solid(Vec3(200, 0, 0)), far_solid(Vec3(-200, 0, 0))};
    for (const Vec3& p : problem.surface->positions)
        problem.body_of_vertex.push_back(p.z() == 0 ? 0 : p.z() == length ? 1 : -1);
    set_method(problem.parameters, method);
    return problem;
}

double largest(const Points& a, const Points& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

std::unique_ptr<SoftBodySolver> solver_of(const SoftBodyProblem& problem) {
    return find_solver_method(problem.parameters.get_choice("solver.method"))->make(problem);
}

void run(SoftBodySolver& solver, const std::vector<Pose>& from, const std::vector<Pose>& to, int frames) {
    std::vector<Pose> a = from, b(from.size());
    for (int f = 1; f <= frames; ++f) {
        for (std::size_t i = 0; i < from.size(); ++i)
            b[i] = screw_between(from[i], to[i], double(f) / frames);
        solver.advance(a, b);
        a = b;
    }
}

} // namespace

TEST_CASE("fem and xpbd-tet: rest stays rest, and solids that move as one take the body along unchanged",
          "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        SoftBodyProblem problem = held_rod(method);
        const Points& rest = problem.surface->positions;
        auto solver = solver_of(problem);
        run(*solver, std::vector<Pose>(2), std::vector<Pose>(2), 3);
        CHECK(largest(solver->positions(), rest) < 1e-9);

        problem.carry_weights.assign(2 * rest.size(), 0.5);
        solver = solver_of(problem);
        const Pose pose = rotation_about(Vec3(30, 0, 0), Vec3::UnitY(), 0.8);
        run(*solver, std::vector<Pose>(2), {pose, pose}, 4);
        Points moved;
        for (const Vec3& p : rest)
            moved.push_back(pose.apply(p));
        CHECK(largest(solver->positions(), moved) < 1e-7);
        CHECK(solver->report().non_finite == 0);
    }
}

TEST_CASE("fem: without anything to carry it along, a turned body is found again all the same",
          "[solver][tet]") {
    const SoftBodyProblem problem = held_rod("fem");
    const auto solver = solver_of(problem);
    const Pose pose = rotation_about(Vec3(30, 0, 0), Vec3::UnitY(), 0.3);
    run(*solver, std::vector<Pose>(2), {pose, pose}, 3);
    Points moved;
    for (const Vec3& p : problem.surface->positions)
        moved.push_back(pose.apply(p));
    CHECK(largest(solver->positions(), moved) < 0.1); // to the tolerance of a pass
}

TEST_CASE("fem and xpbd-tet: a stretched and bent rod keeps its volume, its ends, and comes back",
          "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        const SoftBodyProblem problem = held_rod(method);
        const auto& mesh = *problem.surface;
        const auto solver = solver_of(problem);
        const double v0 = signed_volume(mesh.positions, mesh.triangles);
        Pose away = rotation_about(Vec3(0, 0, 60), Vec3::UnitX(), 0.5);
        away.translation += Vec3(0, 0, 10);
        run(*solver, std::vector<Pose>(2), {Pose{}, away}, 10);
        CHECK(signed_volume(solver->positions(), mesh.triangles) / v0 == Approx(1).epsilon(2e-3));
        double least = 1, most = 0; // the middle has moved about half of what the end has
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            if (problem.body_of_vertex[i] == 1)
                CHECK(solver->positions()[i] == away.apply(mesh.positions[i]));
            if (std::abs(mesh.positions[i].z() - 30) < 1e-9) {
                const double way = (solver->positions()[i] - mesh.positions[i]).z() / 10;
                least = std::min(least, way);
                most = std::max(most, way);
            }
        }
        CHECK(least > 0.0);
        CHECK(most < 1.0);
        run(*solver, {Pose{}, away}, std::vector<Pose>(2), 10);
        run(*solver, std::vector<Pose>(2), std::vector<Pose>(2), method == std::string("fem") ? 2 : 25);
        CHECK(largest(solver->positions(), mesh.positions) < 0.1);
    }
}

TEST_CASE("fem: where it is attached the lattice gives by less than a hundredth of a millimetre",
          "[solver][tet]") {
    const SoftBodyProblem problem = held_rod("fem");
    const TriMesh& mesh = *problem.surface;
    LatticeOptions options;
    options.spacing = 8;
    const EmbeddingLattice lattice = make_embedding_lattice(mesh, options);
    StaticsSettings settings;
    settings.force_scale = 30 * lattice.spacing * lattice.spacing;
    settings.tolerance = 1e-8;
    TetStatics statics(lattice.nodes, lattice.tets, lattice.fill, {}, material_from(30, 0.47), settings);
    std::vector<std::size_t> attached;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (const int body = problem.body_of_vertex[i]; body >= 0) {
            attached.push_back(i);
            const double area = 3.14159 * 100 / 17; // of the end over its vertices
            statics.pulls().push_back({lattice.bindings[i], mesh.positions[i] + Vec3(0, 0, 12.0 * body),
                                       attachment_stiffness(30, area, lattice.spacing)}); // 20 % longer
        }
    Points x = lattice.nodes;
    CHECK(statics.solve(x).converged);
    double gap = 0;
    for (std::size_t k = 0; k < attached.size(); ++k)
        gap = std::max(gap, (lattice.bound_point(attached[k], x) - statics.pulls()[k].target).norm());
    CHECK(gap < 0.01);
    CHECK(gap > 0);
}

TEST_CASE("fem and xpbd-tet: a plate that comes down pushes the body aside and is not entered",
          "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        SoftBodyProblem problem;
        problem.surface = std::make_shared<TriMesh>(test::sphere(10, 3));
        problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
        DistanceGridOptions options;
        for (const double z : {-30.0, 10.3}) {
            auto plate = std::make_shared<TriMesh>(test::box(60, 60, 19.7));
            for (Vec3& p : plate->positions)
                p += Vec3(-30, -30, z);
            problem.solids.push_back({plate, std::make_shared<DistanceGrid>(*plate, options)});
        }
        set_method(problem.parameters, method);
        const auto solver = solver_of(problem);
        Pose down;
        down.translation = Vec3(0, 0, -4);
        run(*solver, std::vector<Pose>(2), {Pose{}, down}, 10);
        run(*solver, {Pose{}, down}, {Pose{}, down}, 10);
        const auto& mesh = *problem.surface;
        for (const Vec3& p : solver->positions()) {
            CHECK(p.z() < 6.3 + 1e-6);
            CHECK(p.z() > -10.3 - 1e-6);
        }
        CHECK(signed_volume(solver->positions(), mesh.triangles) ==
              Approx(signed_volume(mesh.positions, mesh.triangles)).epsilon(0.04));
        CHECK(solver->report().contacts > 0);
        double widest = 0;
        for (const Vec3& p : solver->positions())
            widest = std::max(widest, std::abs(p.x()));
        INFO(method << " " << widest);
        CHECK(widest > 10.05); // it gives way to the side
    }
}

TEST_CASE("fem and xpbd-tet: active fibres shorten a rod that nothing holds at one end", "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        SoftBodyProblem problem = held_rod(method);
        for (int& body : problem.body_of_vertex)
            body = body == 1 ? -1 : body;
        const MeshTopology topology(problem.surface->vertex_count(), problem.surface->triangles);
        const auto& x = problem.surface->positions;
        for (const Edge& e : topology.edges()) {
            const Vec3 u = (x[std::size_t(e.b)] - x[std::size_t(e.a)]).normalized();
            problem.edge_along.push_back(u.z() * u.z());
        }
        const auto solver = solver_of(problem);
        solver->set_active_length(0.8);
        run(*solver, std::vector<Pose>(2), std::vector<Pose>(2), method == std::string("fem") ? 3 : 40);
        double end = 0;
        for (const Vec3& p : solver->positions())
            end = std::max(end, p.z());
        CHECK(end < 0.9 * 60);
        CHECK(end > 0.75 * 60);
    }
}

TEST_CASE("fem and xpbd-tet: a scene in another unit deforms as the same one in millimetres",
          "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        SoftBodyProblem problem = held_rod(method);
        problem.parameters.set("fem.spacing_mm", 7);
        const auto millimetres = solver_of(problem);
        auto surface = std::make_shared<TriMesh>(*problem.surface);
        for (Vec3& p : surface->positions)
            p /= 1024;
        problem.surface = surface;
        problem.unit_mm = 1024;
        DistanceGridOptions options;
        options.spacing = 2.0 / 1024;
        options.saturation = 8.0 / 1024;
        for (SolidBody& solid : problem.solids) {
            auto mesh = std::make_shared<TriMesh>(*solid.mesh);
            for (Vec3& p : mesh->positions)
                p /= 1024;
            solid = {mesh, std::make_shared<DistanceGrid>(*mesh, options)};
        }
        const auto other = solver_of(problem);
        Pose pose;
        pose.translation = Vec3(3, 0, 5);
        run(*millimetres, std::vector<Pose>(2), {Pose{}, pose}, 2);
        pose.translation /= 1024;
        run(*other, std::vector<Pose>(2), {Pose{}, pose}, 2);
        Points scaled = other->positions();
        for (Vec3& p : scaled)
            p *= 1024;
        CHECK(largest(scaled, millimetres->positions()) < 1e-6);
    }
}

TEST_CASE("fem and xpbd-tet: the same bits for any number of threads", "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        std::vector<Points> results;
        for (const int threads : {1, 2, 5}) {
            SoftBodyProblem problem = held_rod(method);
            problem.threads = threads;
            const auto solver = solver_of(problem);
            run(*solver, std::vector<Pose>(2), {Pose{}, rotation_about(Vec3(0, 5, 60), Vec3::UnitX(), 0.3)},
                2);
            results.push_back(solver->positions());
        }
        CHECK(results[1] == results[0]);
        CHECK(results[2] == results[0]);
    }
}

TEST_CASE("fem: a finer lattice comes nearer to the finest one's shape", "[solver][tet]") {
    std::vector<Points> results;
    for (const double spacing : {6.5, 4.6, 3.3}) {
        SoftBodyProblem problem = held_rod("fem", 8, 40);
        problem.parameters.set("fem.spacing_mm", spacing);
        const auto solver = solver_of(problem);
        const Pose bent = rotation_about(Vec3(0, 0, 40), Vec3::UnitX(), 0.3);
        run(*solver, std::vector<Pose>(2), {Pose{}, bent}, 2);
        run(*solver, {Pose{}, bent}, {Pose{}, bent}, 4);
        results.push_back(solver->positions());
    }
    const double coarse = largest(results[0], results[2]), fine = largest(results[1], results[2]);
    INFO(coarse << " " << fine);
    CHECK(fine < 0.8 * coarse);
    CHECK(fine < 0.5);
}

TEST_CASE("fem and xpbd-tet: a run that goes on from another solver's state is the run that never stopped",
          "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        INFO(method);
        SoftBodyProblem problem = held_rod(method);
        problem.carry_weights.assign(2 * problem.surface->positions.size(), 0.5);
        const auto whole = solver_of(problem);
        Pose middle = rotation_about(Vec3(0, 0, 60), Vec3::UnitX(), 0.3), away = middle;
        middle.translation += Vec3(4, 0, 6);
        away.translation += Vec3(8, 0, 12);
        run(*whole, std::vector<Pose>(2), {Pose{}, middle}, 6);
        const auto second = solver_of(problem);
        REQUIRE(second->set_state(whole->positions(), whole->last_step()));
        CHECK(second->positions() == whole->positions());
        const Points before = whole->positions();
        run(*whole, {Pose{}, middle}, {Pose{}, away}, 3);
        run(*second, {Pose{}, middle}, {Pose{}, away}, 3);
        CHECK(largest(whole->positions(), before) > 5); // far beside what follows
        CHECK(largest(second->positions(), whole->positions()) < (method == std::string("fem") ? 0.02 : 0.2));
        // At rest there is nothing to find: not a bit is changed.
        const auto third = solver_of(problem), fourth = solver_of(problem);
        REQUIRE(third->set_state(fourth->positions(), fourth->last_step()));
        run(*third, std::vector<Pose>(2), {Pose{}, middle}, 2);
        run(*fourth, std::vector<Pose>(2), {Pose{}, middle}, 2);
        CHECK(third->positions() == fourth->positions());
    }
}

TEST_CASE(
    "fem and xpbd-tet: a free ball between plates that come nearer by a third keeps its volume and its place",
    "[solver][tet]") {
    for (const char* method : {"fem", "xpbd-tet"}) {
        INFO(method);
        SoftBodyProblem problem;
        problem.surface = std::make_shared<TriMesh>(test::sphere(10, 3));
        problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
        DistanceGridOptions options;
        for (const double z : {-30.0, 10.3}) {
            auto plate = std::make_shared<TriMesh>(test::box(60, 60, 19.7));
            for (Vec3& p : plate->positions)
                p += Vec3(-30, -30, z);
            problem.solids.push_back({plate, std::make_shared<DistanceGrid>(*plate, options)});
        }
        problem.carry_weights.assign(2 * problem.surface->positions.size(), 0.5);
        set_method(problem.parameters, method);
        const auto solver = solver_of(problem);
        const auto& mesh = *problem.surface;
        const double v0 = signed_volume(mesh.positions, mesh.triangles);
        Pose down;
        down.translation = Vec3(0, 0, -6.9);
        run(*solver, std::vector<Pose>(2), {Pose{}, down}, 20);
        CHECK(signed_volume(solver->positions(), mesh.triangles) == Approx(v0).epsilon(0.004));
        run(*solver, {Pose{}, down}, std::vector<Pose>(2), 20);
        Vec3 middle = Vec3::Zero();
        for (const Vec3& p : solver->positions())
            middle += p / double(mesh.positions.size());
        CHECK(std::abs(middle.x()) < 0.2);
        CHECK(std::abs(middle.y()) < 0.2);
        CHECK(solver->report().non_finite == 0);
    }
}

TEST_CASE("fem: a pass that ends without equilibrium is counted, one that finds it is not", "[solver][tet]") {
    const SoftBodyProblem problem = held_rod("fem");
    const auto solver = solver_of(problem);
    Pose pose;
    pose.translation = Vec3(0, 0, 3);
    run(*solver, std::vector<Pose>(2), {Pose{}, pose}, 2);
    CHECK(solver->report().unconverged == 0);
    // Turned inside out at a stroke, pressed to less than nothing: no few steps find that.
    const Pose turned = rotation_about(Vec3(0, 0, 30), Vec3::UnitX(), 3.0);
    solver->advance(std::vector<Pose>{Pose{}, pose}, std::vector<Pose>{Pose{}, turned});
    CHECK(solver->report().unconverged == 1);
}
