#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/contact/contact_samples.hpp"
#include "support/shapes.hpp"

#include "fascicle/geometry/distance_grid.hpp"
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::solver;

TEST_CASE("contact samples: every face's centroid, and no part of a face far from one", "[solver][contact]") {
    const TriMesh box = test::box(9, 5, 2);
    const MeshTopology topology(box.vertex_count(), box.triangles);
    const std::vector<double> free(box.positions.size(), 1.0);
    const auto samples = make_contact_samples(box.positions, box.triangles, topology, free, 4.0, 3.0);
    for (const Tri& t : box.triangles) {
        Vec3 centroid = Vec3::Zero();
        for (const int v : t)
            centroid += box.positions[std::size_t(v)] / 3.0;
        double nearest = 1e300;
        for (const ContactSample& s : samples)
            nearest = std::min(nearest, (s.at(box.positions) - centroid).norm());
        CHECK(nearest < 1e-5);
        for (int i = 0; i <= 20; ++i)
            for (int j = 0; i + j <= 20; ++j) {
                const Vec3 p = (i * box.positions[std::size_t(t[0])] + j * box.positions[std::size_t(t[1])] +
                                (20 - i - j) * box.positions[std::size_t(t[2])]) /
                               20.0;
                double gap = 1e300;
                for (const ContactSample& s : samples)
                    gap = std::min(gap, (s.at(box.positions) - p).norm());
                for (const Vec3& v : box.positions)
                    gap = std::min(gap, (v - p).norm());
                CHECK(gap < 4.0 / std::sqrt(3.0) + 1e-6);
            }
    }
    for (const ContactSample& s : samples)
        CHECK(double(s.weight[0]) + double(s.weight[1]) + double(s.weight[2]) == Approx(1.0).margin(1e-6));
}

TEST_CASE("contact samples: none where nothing can move, one a face where faces are small",
          "[solver][contact]") {
    const TriMesh ball = test::sphere(5, 4);
    const MeshTopology topology(ball.vertex_count(), ball.triangles);
    const std::vector<double> fixed(ball.positions.size(), 0.0), free(ball.positions.size(), 1.0);
    CHECK(make_contact_samples(ball.positions, ball.triangles, topology, fixed, 4, 3).empty());
    CHECK(make_contact_samples(ball.positions, ball.triangles, topology, free, 4, 3).size() ==
          ball.triangles.size());
}

TEST_CASE("contact samples: one that lies in a solid at rest keeps what it has there", "[solver][contact]") {
    const TriMesh ball = test::sphere(5, 3);
    const MeshTopology topology(ball.vertex_count(), ball.triangles);
    TriMesh plate = test::box(20, 20, 4);
    for (Vec3& p : plate.positions)
        p += Vec3(-10, -10, -8.5); // its top at -4.5 cuts the ball
    const DistanceGrid grid(plate, {});
    const DistanceGrid* const grids[] = {&grid};
    auto samples = make_contact_samples(ball.positions, ball.triangles, topology,
                                        std::vector<double>(ball.positions.size(), 1.0), 4, 3);
    set_sample_limits(samples, ball.positions, grids, 0.01);
    int inside = 0;
    for (const ContactSample& s : samples) {
        const double phi = grid.value(s.at(ball.positions));
        CHECK(double(s.limit) <= phi);
        CHECK(s.near_solid == (phi < 0.011 ? 0 : -1));
        inside += phi < 0 ? 1 : 0;
    }
    CHECK(inside > 0);
}

TEST_CASE("samples: a spike that fits between the vertices does not go through a face", "[solver][contact]") {
    // A coarse ball, held at its top, and a thin rod that comes up from below into the middle of a face.
    const std::string kernel = GENERATE("fast", "reference");
    const int passes = GENERATE(3, 10);
    SoftBodyProblem problem;
    const TriMesh ball = test::sphere(10, 2);
    problem.surface = std::make_shared<TriMesh>(ball);
    for (const Vec3& p : ball.positions)
        problem.body_of_vertex.push_back(p.z() > 7 ? 0 : -1);
    // The lowest face's centroid.
    Vec3 under = Vec3::Zero();
    for (const Tri& t : ball.triangles) {
        Vec3 c = Vec3::Zero();
        for (const int v : t)
            c += ball.positions[std::size_t(v)] / 3.0;
        if (c.z() < under.z())
            under = c;
    }
    DistanceGridOptions options;
    options.spacing = 0.5;
    TriMesh away = test::box(4, 4, 4), rod = test::box(1, 1, 12);
    for (Vec3& p : away.positions)
        p += Vec3(100, 100, 100);
    for (Vec3& p : rod.positions)
        p += under + Vec3(-0.5, -0.5, -12.5); // half a millimetre below
    for (const TriMesh& mesh : {away, rod})
        problem.solids.push_back(
            {std::make_shared<TriMesh>(mesh), std::make_shared<DistanceGrid>(mesh, options)});
    problem.parameters.assign("solver.kernel=" + kernel);
    problem.parameters.set("solver.iterations", passes);
    const auto solver = find_solver_method("xpbd")->make(problem);
    const SolidQuery exact(rod);
    std::vector<Pose> from(2), to(2);
    double deepest = 0;
    for (int f = 1; f <= 30; ++f) {
        to[1].translation = Vec3(0, 0, 0.1 * f); // 3 mm up
        solver->advance(from, to);
        from = to;
        const Points& x = solver->positions();
        for (const Vec3& p : x)
            CHECK_FALSE(exact.inside(to[1].apply_inverse(p)));
        for (const Tri& t : ball.triangles) {
            const Vec3 c = (x[std::size_t(t[0])] + x[std::size_t(t[1])] + x[std::size_t(t[2])]) / 3.0;
            deepest = std::min(deepest, exact.signed_distance(to[1].apply_inverse(c)));
        }
    }
    CHECK(deepest > -0.02);
    CHECK(solver->report().samples_pushed > 0);
    CHECK(solver->report().samples_held == 0);
}
