#include "bench/bullet_body.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("Bullet's body keeps its fixed points on their bones and its volume", "[bench][bullet]") {
    if (!bench::bullet_missing().empty()) {
        WARN("fascicle-skip: " << bench::bullet_missing());
        return;
    }
    const TriMesh ball = test::sphere(40.0, 3);
    PreparedScene prepared;
    prepared.muscles.resize(1);
    SoftBodyProblem& problem = prepared.muscles[0].problem;
    problem.surface = std::make_shared<TriMesh>(ball);
    for (const Vec3& p : ball.positions)
        problem.body_of_vertex.push_back(p.z() < -30 ? 0 : p.z() > 30 ? 1 : -1);
    const auto body = bench::make_bullet_body(prepared, 3);
    std::vector<Pose> from(2), to(2);
    for (int frame = 1; frame <= 60; ++frame) {
        to[1].translation = Vec3(0, 0, 0.1 * std::min(frame, 40));
        body->advance(from, to);
        from = to;
    }
    const std::vector<Points> all = body->positions();
    REQUIRE(all.size() == 1);
    double moved = 0;
    for (std::size_t i = 0; i < ball.positions.size(); ++i) {
        REQUIRE(all[0][i].allFinite());
        const int bone = problem.body_of_vertex[i];
        if (bone >= 0) // single precision
            CHECK((all[0][i] - to[std::size_t(bone)].apply(ball.positions[i])).norm() < 1e-4);
        else
            moved = std::max(moved, (all[0][i] - ball.positions[i]).norm());
    }
    CHECK(moved > 0.5);
    CHECK(signed_volume(all[0], ball.triangles) / signed_volume(ball.positions, ball.triangles) ==
          Approx(1.0).margin(0.1));
}
