#include "fascicle/geometry/volume.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// Volume over rest of a ball after some frames of wanting 1.3 times its volume.
double swollen(const char* method, const char* kernel, const char* volume) {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(test::sphere(10, 3));
    problem.body_of_vertex.assign(problem.surface->positions.size(), -1);
    set_method(problem.parameters, method);
    problem.parameters.set_text("solver.kernel", kernel);
    problem.parameters.set_text("solver.volume", volume);
    problem.parameters.set("solver.pressure", 1.3);
    const auto solver = find_solver_method(method)->make(problem);
    for (int frame = 0; frame < 20; ++frame)
        solver->advance({}, {});
    const auto& triangles = problem.surface->triangles;
    return signed_volume(solver->positions(), triangles) /
           signed_volume(problem.surface->positions, triangles);
}

} // namespace

TEST_CASE("A free volume is not brought to what the pressure asks for, by any method", "[solver][volume]") {
    CHECK(swollen("xpbd", "reference", "kept") == Approx(1.3).epsilon(0.02));
    CHECK(swollen("xpbd", "reference", "free") == Approx(1.0).epsilon(1e-6));
    CHECK(swollen("xpbd", "fast", "kept") == Approx(1.3).epsilon(0.02));
    CHECK(swollen("xpbd", "fast", "free") == Approx(1.0).epsilon(1e-4));
    CHECK(swollen("classic", "fast", "kept") > 1.05);
    CHECK(swollen("classic", "fast", "free") == Approx(1.0).epsilon(1e-6));
    CHECK(swollen("mass-spring", "fast", "kept") == Approx(1.3).epsilon(0.02));
    CHECK(swollen("mass-spring", "fast", "free") == Approx(1.0).epsilon(1e-6));
}
