#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/volume.hpp"
#include "solver/rivals/lines/line_binding.hpp"
#include "support/rival_scenes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

std::unique_ptr<SoftBodySolver> lines_of(const SoftBodyProblem& problem) {
    return find_solver_method("lines")->make(problem);
}

/// A bar of 80 x 10 x 6 from x = 0 (solid 0) to x = 80 (solid 1), and below its middle a round bar (solid 2) of radius 8 across it.
SoftBodyProblem bar(double gap = 5.0) {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(box_mesh(Vec3(0, 0, 0), Vec3(80, 10, 6), {40, 5, 3}));
    set_method(problem.parameters, "lines");
    for (const Vec3& p : problem.surface->positions)
        problem.body_of_vertex.push_back(p.x() < 1e-9 ? 0 : p.x() > 80 - 1e-9 ? 1 : -1);
    DistanceGridOptions options;
    for (const double x : {-30.0, 90.0}) {
        auto mesh = std::make_shared<TriMesh>(test::box(20, 10, 10));
        for (Vec3& p : mesh->positions)
            p.x() += x;
        problem.solids.push_back({mesh, std::make_shared<DistanceGrid>(*mesh, options)});
    }
    auto round =
        std::make_shared<TriMesh>(cylinder_mesh(Vec3(40, -20, -8 - gap), Vec3(40, 30, -8 - gap), 8, 64, 25));
    problem.solids.push_back({round, std::make_shared<DistanceGrid>(*round, options)});
    return problem;
}

/// Lines of a problem, to look at.
struct Seen {
    explicit Seen(const SoftBodyProblem& problem, int count, int via)
        : topology(problem.surface->vertex_count(), problem.surface->triangles),
          shares(end_shares(problem, topology)),
          sheaf(problem, topology, shares, ContactSettings{}, count, via) {}
    MeshTopology topology;
    EndShares shares;
    LineSheaf sheaf;
};

std::vector<ContactSolid> solids_at(const SoftBodyProblem& problem, const std::vector<Pose>& poses) {
    std::vector<ContactSolid> solids;
    for (std::size_t b = 0; b < poses.size(); ++b)
        solids.push_back({problem.solids[b].grid.get(), poses[b], Pose{}});
    return solids;
}

} // namespace

TEST_CASE("lines: rest stays rest to the last bit", "[solver][lines]") {
    for (const SoftBodyProblem& problem : {test::held_ball("lines", 2), bar(), bar(0.2)}) {
        const auto solver = lines_of(problem);
        test::hold(*solver, std::vector<Pose>(problem.solids.size()), 3);
        CHECK(test::farthest(solver->positions(), problem.surface->positions) == 0.0);
    }
}

TEST_CASE("lines: what all solids share moves everything rigidly", "[solver][lines]") {
    for (const SoftBodyProblem& problem : {test::held_ball("lines", 2), bar(), bar(0.2)}) {
        const auto solver = lines_of(problem);
        const std::size_t solids = problem.solids.size();
        const Pose half = rotation_about(Vec3(0, 40, 0), Vec3(1, 2, 0), 1.0);
        Pose pose = half.after(half);
        pose.translation += Vec3(5, -3, 8);
        solver->advance(std::vector<Pose>(solids), std::vector<Pose>(solids, half));
        solver->advance(std::vector<Pose>(solids, half), std::vector<Pose>(solids, pose));
        CHECK(test::farthest(solver->positions(), test::moved(problem.surface->positions, pose)) < 1e-9);
    }
}

TEST_CASE("lines: one attachment alone takes everything with it", "[solver][lines]") {
    const SoftBodyProblem problem = test::held_ball("lines", 1);
    const auto solver = lines_of(problem);
    const Pose pose = rotation_about(Vec3(0, 40, 0), Vec3::UnitX(), 0.5);
    solver->advance(std::vector<Pose>{Pose{}}, std::vector<Pose>{pose});
    CHECK(test::farthest(solver->positions(), test::moved(problem.surface->positions, pose)) < 1e-9);
}

TEST_CASE("lines: a body that nothing holds keeps its shape and gives way to plates", "[solver][lines]") {
    const SoftBodyProblem problem = test::squeezed_ball("lines", 2);
    const auto solver = lines_of(problem);
    test::squeeze(*solver, 6, 0.5);
    for (const Vec3& p : solver->positions()) {
        CHECK(p.z() > -10.3);
        CHECK(p.z() < 10.3 - 3.0);
    }
    CHECK(solver->report().non_finite == 0);
    std::vector<Pose> from(2), to(2);
    from[1].translation.z() = -3.0;
    solver->advance(from, to);
    test::hold(*solver, to, 60); // contact moves it as a whole little by little
    double lowest = 100, highest = -100;
    for (const Vec3& p : solver->positions()) {
        lowest = std::min(lowest, p.z());
        highest = std::max(highest, p.z());
    }
    CHECK(highest - lowest == Approx(20).margin(0.2));
}

TEST_CASE("lines: a bar stretches evenly and keeps its width", "[solver][lines]") {
    for (const int via : {0, 1, 3, 8}) {
        SoftBodyProblem problem = bar(60);
        problem.parameters.assign("lines.via=" + std::to_string(via));
        const auto solver = lines_of(problem);
        std::vector<Pose> from(3), to(3);
        to[1].translation = Vec3(20, 0, 0);
        solver->advance(from, to);
        const Points& rest = problem.surface->positions;
        for (std::size_t v = 0; v < rest.size(); ++v) {
            const Vec3& now = solver->positions()[v];
            CHECK(now.x() == Approx(rest[v].x() * 1.25).margin(4.0));
            CHECK(std::abs(now.y() - rest[v].y()) < 0.3);
            CHECK(std::abs(now.z() - rest[v].z()) < 0.3);
            if (const int body = problem.body_of_vertex[v]; body >= 0)
                CHECK(now == to[std::size_t(body)].apply(rest[v]));
        }
        CHECK(signed_volume(solver->positions(), problem.surface->triangles) ==
              Approx(1.25 * 4800).epsilon(0.01)); // no volume is kept
        solver->advance(to, from);
        CHECK(test::farthest(solver->positions(), rest) < 0.01);
    }
    SoftBodyProblem kept = bar(60);
    kept.parameters.assign("solver.volume=kept");
    const auto solver = lines_of(kept);
    std::vector<Pose> from(3), to(3);
    to[1].translation = Vec3(5, 0, 0);
    solver->advance(from, to);
    CHECK(signed_volume(solver->positions(), kept.surface->triangles) == Approx(4800).epsilon(1e-4));
}

TEST_CASE("lines: the surface turns with its solids at both ends and with the lines between",
          "[solver][lines]") {
    SoftBodyProblem problem = bar(60);
    problem.parameters.assign("lines.via=0"); // nothing but the ends turns it
    const auto solver = lines_of(problem);
    std::vector<Pose> from(3), to(3);
    to[1] = rotation_about(Vec3(40, 5, 3), Vec3::UnitX(), 1.0); // about the bar's axis
    solver->advance(from, to);
    const Points& rest = problem.surface->positions;
    for (std::size_t v = 0; v < rest.size(); ++v) { // a twist rises along the bar
        const Vec3 r = rest[v] - Vec3(rest[v].x(), 5, 3), now = solver->positions()[v] - Vec3(0, 5, 3);
        const double angle = std::atan2(r.y() * now.z() - r.z() * now.y(), r.y() * now.y() + r.z() * now.z());
        CHECK(angle == Approx(rest[v].x() / 80).margin(0.25));
    }
}

TEST_CASE("lines: a line wraps over a solid that comes, by the closed form", "[solver][lines]") {
    const SoftBodyProblem problem = bar(5.0);
    Seen seen(problem, 4, 0);
    const auto& lines = seen.sheaf.lines();
    REQUIRE(lines.size() == 4);
    for (const MuscleLine& line : lines)
        CHECK(length_of(line.nodes) == Approx(80).epsilon(0.01));
    std::vector<Pose> poses(3);
    poses[2].translation.z() = 20;
    seen.sheaf.move(solids_at(problem, poses), 2);
    for (const MuscleLine& line : lines) {
        // Round the bar's centre at height 7 by its radius and the distance that the line had at rest, capped by the grid.
        const double height = line.nodes.front().z();
        const double clearance = *std::max_element(line.clearance.begin(), line.clearance.end());
        CHECK(clearance > 4.9);
        const double r = 8 + line.clearance[line_nodes / 2], a = std::hypot(40.0, height - 7);
        const double turn = 2 * std::atan2(40.0, height - 7) - 2 * std::acos(r / a);
        REQUIRE(turn > 0.1);
        CHECK(length_of(line.nodes) == Approx(2 * std::sqrt(a * a - r * r) + r * turn).epsilon(0.01));
    }
    // A jump all the way does not leave it on the other side, and the way back ends at rest.
    seen.sheaf.move(solids_at(problem, std::vector<Pose>(3)), 1);
    for (const MuscleLine& line : lines)
        CHECK(test::farthest(line.nodes, line.rest) < 0.01);
}

TEST_CASE("lines: via points go with the solid of the nearer attachment", "[solver][lines]") {
    const SoftBodyProblem problem = bar(60);
    Seen seen(problem, 3, 4);
    REQUIRE(seen.sheaf.lines().size() == 3);
    std::vector<Pose> poses(3);
    poses[1].translation = Vec3(0, 0, 30);
    seen.sheaf.move(solids_at(problem, poses), 1);
    for (const MuscleLine& line : seen.sheaf.lines()) {
        CHECK(std::count(line.held.begin(), line.held.end(), 1) == 6);
        for (std::size_t k = 0; k < line_nodes; ++k)
            if (line.solid[k] >= 0) {
                CHECK(line.solid[k] == (k < line_nodes / 2 ? 0 : 1));
                CHECK((line.nodes[k] - poses[std::size_t(line.solid[k])].apply(line.rest[k])).norm() < 1e-12);
            }
    }
}

TEST_CASE("lines: any number of attachments and parts, holes and flat pieces are borne", "[solver][lines]") {
    std::vector<SoftBodyProblem> problems;
    SoftBodyProblem three = test::held_ball("lines", 3);
    for (std::size_t v = 0; v < three.body_of_vertex.size(); ++v)
        if (three.surface->positions[v].x() > 8)
            three.body_of_vertex[v] = 2;
    problems.push_back(three);
    SoftBodyProblem open = test::held_ball("lines", 2);
    auto holed = std::make_shared<TriMesh>(*open.surface);
    std::erase_if(holed->triangles, [&](const Tri& t) { // the attached caps and a window
        const Vec3& p = holed->positions[std::size_t(t[0])];
        return std::abs(p.z()) > 9.0 || (p.x() > 6 && p.y() > 0);
    });
    open.surface = holed;
    problems.push_back(open);
    SoftBodyProblem apart = test::held_ball("lines", 2);
    auto parts = std::make_shared<TriMesh>(*apart.surface);
    const int count = parts->vertex_count();
    for (const Vec3& p : apart.surface->positions) {
        parts->positions.push_back(0.3 * p + Vec3(20, 0, 0)); // that nothing holds
        apart.body_of_vertex.push_back(-1);
    }
    for (const Vec3& p : apart.surface->positions) {
        parts->positions.push_back(0.3 * p + Vec3(-20, 0, 0)); // that one solid holds
        apart.body_of_vertex.push_back(p.z() < -8 ? 0 : -1);
    }
    for (const int shift : {count, 2 * count})
        for (const Tri& t : apart.surface->triangles)
            parts->triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    apart.surface = parts;
    problems.push_back(apart);
    SoftBodyProblem full = test::held_ball("lines", 2); // nothing is free
    for (std::size_t v = 0; v < full.body_of_vertex.size(); ++v)
        full.body_of_vertex[v] = full.surface->positions[v].z() < 0 ? 0 : 1;
    problems.push_back(full);
    SoftBodyProblem point = test::held_ball("lines", 2); // everything at one place
    point.surface = std::make_shared<TriMesh>(
        TriMesh{Points(std::size_t(count), Vec3(1, 2, 3)), point.surface->triangles});
    problems.push_back(point);
    for (const SoftBodyProblem& problem : problems) {
        const auto solver = lines_of(problem);
        const Points& rest = problem.surface->positions;
        const std::size_t solids = problem.solids.size();
        test::hold(*solver, std::vector<Pose>(solids), 1);
        CHECK(test::farthest(solver->positions(), rest) == 0.0);
        std::vector<Pose> poses(solids);
        poses[1] = rotation_about(Vec3(0, 0, 5), Vec3::UnitX(), 0.5);
        solver->advance(std::vector<Pose>(solids), poses);
        CHECK(solver->report().non_finite == 0);
        for (std::size_t v = 0; v < rest.size(); ++v) {
            CHECK(solver->positions()[v].allFinite());
            CHECK((solver->positions()[v] - rest[v]).norm() < 25.0);
            if (const int body = problem.body_of_vertex[v]; body >= 0)
                CHECK(solver->positions()[v] == poses[std::size_t(body)].apply(rest[v]));
        }
        solver->advance(poses, std::vector<Pose>(solids));
        CHECK(test::farthest(solver->positions(), rest) < 0.05);
    }
    // The part that only solid 0 holds stays with it; the loose one goes along with the lines.
    const auto solver = lines_of(apart);
    std::vector<Pose> poses(2);
    poses[1].translation = Vec3(0, 0, 4);
    solver->advance(std::vector<Pose>(2), poses);
    for (std::size_t v = 0; v < std::size_t(count); ++v) {
        CHECK((solver->positions()[2 * std::size_t(count) + v] - parts->positions[2 * std::size_t(count) + v])
                  .norm() < 1e-9);
        const double rise =
            solver->positions()[std::size_t(count) + v].z() - parts->positions[std::size_t(count) + v].z();
        CHECK((rise > 0.2 && rise < 3.8));
    }
    // Three solids: lines from one of them to each other one.
    Seen seen(three, 12, 1);
    std::vector<int> to(3, 0);
    for (const MuscleLine& line : seen.sheaf.lines())
        ++to[std::size_t(line.to)];
    CHECK(std::count(to.begin(), to.end(), 0) == 1);
    CHECK(seen.sheaf.lines().size() >= 11);
    // Or, where two of them are known to move, from the one that stays.
    three.carry_weights.assign(3 * three.body_of_vertex.size(), 0.0);
    three.carry_weights[3] = three.carry_weights[5] = 0.5;
    Seen told(three, 12, 1);
    for (const MuscleLine& line : told.sheaf.lines())
        CHECK(line.from == 1);
}

TEST_CASE("lines: its parameters act, and threads do not", "[solver][lines]") {
    const auto run = [](const std::vector<std::string>& settings, int threads) {
        SoftBodyProblem problem = bar(1.0);
        problem.threads = threads;
        for (const std::string& setting : settings)
            problem.parameters.assign(setting);
        const auto solver = lines_of(problem);
        std::vector<Pose> from(3), to(3);
        for (int f = 1; f <= 5; ++f) {
            to[1] = rotation_about(Vec3(40, 5, -10), Vec3::UnitY(), 0.1 * f);
            solver->advance(from, to);
            from = to;
        }
        return solver->positions();
    };
    const Points usual = run({}, 1);
    CHECK(run({}, 3) == usual);
    CHECK(test::farthest(run({"lines.count=2"}, 1), usual) > 0.01);
    CHECK(test::farthest(run({"lines.via=0"}, 1), usual) > 0.1);
    CHECK(test::farthest(run({"contact.offset_mm=1.5"}, 1), usual) > 0.01);
    CHECK(test::farthest(run({"solver.volume=kept"}, 1), usual) > 0.01);
    CHECK(run({"lines.count=100", "lines.via=8"}, 2).size() == usual.size());
}

TEST_CASE("lines: it goes on from another solver's state as if it had come there itself", "[solver][lines]") {
    const SoftBodyProblem problem = bar(60);
    std::vector<Pose> rest(3), there(3), on(3);
    there[1] = rotation_about(Vec3(40, 5, -30), Vec3::UnitY(), 0.4);
    on[1] = rotation_about(Vec3(40, 5, -30), Vec3::UnitY(), 0.45);
    const auto came = lines_of(problem);
    came->advance(rest, there);
    const auto took = lines_of(problem);
    REQUIRE(took->set_state(came->positions(), came->last_step()));
    CHECK(took->positions() == came->positions());
    came->advance(there, on);
    took->advance(there, on);
    CHECK(test::farthest(took->positions(), came->positions()) < 0.01);
}
