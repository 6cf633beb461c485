#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/volume.hpp"
#include "solver/fast/fast_solver.hpp"
#include "solver/xpbd/xpbd_solver.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

/// A ball between two plates that close and turn; its lower cap is fixed to the lower plate.
struct Press {
    SoftBodyProblem problem;
    std::vector<Pose> from{2}, to{2};
    int frame = 0;

    explicit Press(int levels, double cap = -9.5) {
        problem.surface = std::make_shared<TriMesh>(test::sphere(10, levels));
        problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
        for (std::size_t i = 0; i < problem.body_of_vertex.size(); ++i)
            if (problem.surface->positions[i].z() < cap)
                problem.body_of_vertex[i] = 0;
        for (const double z : {-30.2, 10.3}) {
            auto plate = std::make_shared<TriMesh>(test::box(80, 80, 19.7));
            for (Vec3& p : plate->positions)
                p += Vec3(-40, -40, z);
            problem.solids.push_back({plate, std::make_shared<DistanceGrid>(*plate, DistanceGridOptions{})});
        }
        for (const Vec3& p : problem.surface->positions) {
            problem.carry_weights.push_back(0.0);
            problem.carry_weights.push_back(
                problem.body_of_vertex[problem.carry_weights.size() / 2] < 0 ? 0.4 + 0.03 * p.z() : 0.0);
        }
    }
    /// Out for 20 frames, back for 20, then rest.
    void step() {
        ++frame;
        const double share = frame <= 20 ? frame / 20.0 : std::max(0.0, 2.0 - frame / 20.0);
        to[1] = rotation_about(Vec3(0, -20, 10), Vec3::UnitX(), -0.05 * share);
        to[1].translation += Vec3(0.5 * share, 0, -2.0 * share);
    }
    void advance(SoftBodySolver& solver) { solver.advance(from, to); }
    void next() { from = to; }
};

double rms(const Points& a, const Points& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / double(a.size()));
}

} // namespace

TEST_CASE("fast solver: rest stays rest", "[solver][fast]") {
    Press press(4);
    const auto solver = make_fast_solver(press.problem);
    REQUIRE(solver);
    for (int f = 0; f < 20; ++f)
        solver->advance(press.from, press.from);
    CHECK(rms(solver->positions(), press.problem.surface->positions) < 5e-4);
    CHECK(solver->report().non_finite == 0);
}

TEST_CASE("fast solver: follows the plain one frame by frame", "[solver][fast]") {
    // They differ in the order of constraints and in rounding: both converge to the same shape, so the difference is small against the
    // motion (the plate moves by 2 to 4 mm), and vanishes at rest.
    for (const auto& [friction, clusters] : {std::pair(0.0, 0), {0.5, 0}, {0.0, 30}}) {
        Press press(4,
                    clusters == 0 ? -9.5 : -5.0); // held well, or it swings where the least difference tells
        press.problem.parameters.set("contact.friction", friction);
        press.problem.parameters.set("solver.coarse", clusters);
        const auto fast = make_fast_solver(press.problem), plain = [&] {
            SoftBodyProblem problem = press.problem;
            problem.parameters.assign("solver.kernel=reference");
            return make_xpbd_solver(problem);
        }();
        REQUIRE(fast);
        const auto& mesh = *press.problem.surface;
        const double v0 = signed_volume(mesh.positions, mesh.triangles);
        double moved = 0;
        for (int f = 0; f < 80; ++f) {
            press.step();
            press.advance(*fast);
            press.advance(*plain);
            press.next();
            INFO("frame " << f << ", friction " << friction << ", clusters " << clusters);
            CHECK(rms(fast->positions(), plain->positions()) < 0.1);
            const double fast_error = std::abs(signed_volume(fast->positions(), mesh.triangles) / v0 - 1.0);
            const double plain_error = std::abs(signed_volume(plain->positions(), mesh.triangles) / v0 - 1.0);
            CHECK(fast_error < plain_error + 2e-4);
            moved = std::max(moved, rms(fast->positions(), mesh.positions));
        }
        INFO("moved " << moved);
        CHECK(moved > 0.5);
        CHECK(fast->report().contacts > 0);
        CHECK(double(fast->report().contacts) == Approx(double(plain->report().contacts)).epsilon(0.15));
        CHECK(fast->report().unresolved == 0);
        CHECK(rms(fast->positions(), mesh.positions) < rms(plain->positions(), mesh.positions) + 0.01);
    }
}

TEST_CASE("fast solver: the same bits for any number of threads and from run to run",
          "[solver][fast][slow]") {
    Press press(6); // 16,386 vertices in blocks
    REQUIRE(press.problem.parameters.get_int("solver.coarse") > 0);
    std::vector<std::unique_ptr<SoftBodySolver>> solvers;
    for (const int threads : {1, 1, 2, 3, 8}) {
        press.problem.threads = threads;
        solvers.push_back(make_fast_solver(press.problem));
        REQUIRE(solvers.back());
    }
    for (int f = 0; f < 6; ++f) {
        press.step();
        for (const auto& solver : solvers)
            press.advance(*solver);
        press.next();
        for (const auto& solver : solvers)
            CHECK(solver->positions() == solvers.front()->positions());
    }
    CHECK(solvers.front()->report().contacts > 0);
}

TEST_CASE("fast solver: all instruction sets agree", "[solver][fast]") {
    Press press(4);
    press.problem.parameters.set("solver.coarse",
                                 0); // whose choices multiply the least difference in rounding
    std::vector<const fast::Kernels*> kernels(4);
    kernels.resize(fast::available_kernels(kernels.data(), kernels.size()));
    std::vector<std::unique_ptr<SoftBodySolver>> solvers;
    for (const fast::Kernels* k : kernels)
        solvers.push_back(make_fast_solver(press.problem, k));
    for (int f = 0; f < 30; ++f) {
        press.step();
        for (const auto& solver : solvers)
            press.advance(*solver);
        press.next();
        for (const auto& solver : solvers)
            CHECK(rms(solver->positions(), solvers.front()->positions()) < 2e-3);
    }
}

TEST_CASE("fast solver: no vertex enters a plate, attached vertices ride exactly", "[solver][fast]") {
    Press press(5);
    press.problem.parameters.set("solver.iterations", 3);
    const auto solver = make_fast_solver(press.problem);
    for (int f = 0; f < 60; ++f) {
        press.step();
        press.advance(*solver);
        press.next();
        for (std::size_t i = 0; i < solver->positions().size(); ++i) {
            const int body = press.problem.body_of_vertex[i];
            const Vec3 &p = solver->positions()[i], &rest = press.problem.surface->positions[i];
            if (body >= 0)
                CHECK(p == press.to[std::size_t(body)].apply(rest));
            else
                for (std::size_t b = 0; b < 2; ++b)
                    CHECK(press.problem.solids[b].grid->value(press.to[b].apply_inverse(p)) > 0.05);
        }
    }
}

TEST_CASE("fast solver: a vertex of no triangle and two fans in a point are no obstacle", "[solver][fast]") {
    SoftBodyProblem problem;
    auto mesh = std::make_shared<TriMesh>(test::sphere(5, 3, Vec3(0, 0, 5)));
    const TriMesh other = test::sphere(5, 3, Vec3(0, 0, -5));
    const auto south =
        std::size_t(std::min_element(mesh->positions.begin(), mesh->positions.end(),
                                     [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); }) -
                    mesh->positions.begin());
    const int count = mesh->vertex_count();
    for (const Vec3& p : other.positions)
        mesh->positions.push_back(p);
    for (Tri t : other.triangles) {
        for (int& v : t)
            v = other.positions[std::size_t(v)].norm() < 1e-9 ? int(south) : v + count;
        mesh->triangles.push_back(t);
    }
    mesh->positions.emplace_back(50, 50, 50);
    problem.surface = mesh;
    problem.body_of_vertex.assign(mesh->positions.size(), -1);
    problem.parameters.set("solver.pressure", 1.2);
    const auto solver = make_fast_solver(problem);
    REQUIRE(solver);
    for (int f = 0; f < 40; ++f)
        solver->advance({}, {});
    CHECK(solver->positions().back() == Vec3(50, 50, 50));
    const double v0 = signed_volume(mesh->positions, mesh->triangles);
    CHECK(signed_volume(solver->positions(), mesh->triangles) == Approx(1.2 * v0).epsilon(1e-3));
}

TEST_CASE("fast solver: a point that flies off to infinity is refused and counted", "[solver][fast]") {
    Press press(3);
    press.problem.carry_weights.assign(press.problem.carry_weights.size(), 1e38);
    const auto solver = make_fast_solver(press.problem);
    press.step();
    press.advance(*solver);
    for (const Vec3& p : solver->positions())
        CHECK(p.allFinite());
}

TEST_CASE(
    "fast solver: at any corner of the parameter table positions stay finite, and outside of the plates",
    "[solver][fast]") {
    std::mt19937 random(11);
    const auto pick = [&](std::initializer_list<double> values) {
        return *(values.begin() + std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random));
    };
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    const int runs = 20; // ten times as slow there
#else
    const int runs = 200;
#endif
    for (int run = 0; run < runs; ++run) {
        Press press(3, -7.0);
        ParamSet& p = press.problem.parameters;
        const int substeps = static_cast<int>(pick({1, 3, 10}));
        p.set("solver.iterations", substeps);
        p.set("solver.stiffness", pick({0, 0.2, 0.9, 0.99, 1}));
        p.set("solver.bending", pick({0, 0.3, 1}));
        p.set("solver.pressure", pick({0.5, 1, 2}));
        p.set("solver.damping", pick({0, 6, 1000}));
        p.set("solver.coarse", pick({0, 5, 100}));
        p.set("solver.frame_time", pick({1e-4, 1.0 / 60, 1}));
        p.set("contact.friction", pick({0, 1, 2}));
        p.set("contact.offset_mm", pick({0, 0.1, 0.15}));
        INFO("run " << run << ", substeps " << substeps << ", stiffness " << p.get("solver.stiffness")
                    << ", bending " << p.get("solver.bending") << ", pressure " << p.get("solver.pressure")
                    << ", clusters " << p.get_int("solver.coarse") << ", frame " << p.get("solver.frame_time")
                    << " s, friction " << p.get("contact.friction"));
        const auto solver = make_fast_solver(press.problem);
        REQUIRE(solver);
        for (int f = 0; f < 15; ++f) {
            press.step();
            press.advance(*solver);
            press.next();
        }
        CHECK(solver->report().non_finite == 0);
        bool finite = true;
        int inside = 0;
        for (const Vec3& x : solver->positions()) {
            finite = finite && x.allFinite();
            for (std::size_t b = 0; b < 2; ++b)
                inside += press.problem.solids[b].grid->value(press.to[b].apply_inverse(x)) < -1e-4;
        }
        const auto& triangles = press.problem.surface->triangles;
        const double volume = signed_volume(solver->positions(), triangles);
        CHECK(std::isfinite(volume));
        for (const Tri& t : triangles) {
            if (press.problem.body_of_vertex[std::size_t(t[0])] >= 0 ||
                press.problem.body_of_vertex[std::size_t(t[1])] >= 0 ||
                press.problem.body_of_vertex[std::size_t(t[2])] >= 0)
                continue;
            const Vec3 centroid =
                (solver->positions()[std::size_t(t[0])] + solver->positions()[std::size_t(t[1])] +
                 solver->positions()[std::size_t(t[2])]) /
                3.0;
            for (std::size_t b = 0; b < 2; ++b)
                inside += press.problem.solids[b].grid->value(press.to[b].apply_inverse(centroid)) < -1e-4;
        }
        CHECK(finite);
        CHECK(inside == 0);
    }
}
