#include "fascicle/anatomy/spindle.hpp"

#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

SpindleRequest along_a_bend() {
    SpindleRequest request;
    request.path = {Vec3(0, 0, 0), Vec3(0, 100, 0), Vec3(60, 180, 10)};
    request.volume = 50000;
    return request;
}

} // namespace

TEST_CASE("A spindle is closed, outward, and of the wanted volume", "[anatomy][spindle]") {
    const Spindle spindle = make_spindle(along_a_bend());
    const MeshReport report = check_mesh(spindle.mesh);
    CHECK(report.lines().empty());
    CHECK(report.closed());
    CHECK(signed_volume(spindle.mesh.positions, spindle.mesh.triangles) == Approx(50000).epsilon(1e-3));
    CHECK(spindle.inside == 0);
    // L A_max (1 + e) / 2 with e = 0.12, for a path that is nearly the polyline.
    const double length = 100 + std::sqrt(60.0 * 60 + 80 * 80 + 10 * 10);
    const double radius = std::sqrt(2 * 50000 / (1.12 * length * std::numbers::pi));
    CHECK(spindle.radius == Approx(radius).epsilon(0.03));
    CHECK(spindle.length == Approx(length).epsilon(0.03));
}

TEST_CASE("The ends of a spindle are where the path ends", "[anatomy][spindle]") {
    const SpindleRequest request = along_a_bend();
    const Spindle spindle = make_spindle(request);
    const auto check_end = [&](const std::vector<int>& vertices, const Vec3& end) {
        CHECK(vertices.size() > static_cast<std::size_t>(request.around));
        CHECK(std::is_sorted(vertices.begin(), vertices.end()));
        for (const int v : vertices)
            CHECK((spindle.mesh.positions[static_cast<std::size_t>(v)] - end).norm() < 0.2 * spindle.length);
    };
    check_end(spindle.origin, request.path.front());
    check_end(spindle.insertion, request.path.back());
    std::vector<int> both;
    std::set_intersection(spindle.origin.begin(), spindle.origin.end(), spindle.insertion.begin(),
                          spindle.insertion.end(), std::back_inserter(both));
    CHECK(both.empty());
}

TEST_CASE("A spindle keeps out of a bone in its way and keeps its volume", "[anatomy][spindle]") {
    SpindleRequest request = along_a_bend();
    request.path = {Vec3(-80, 0, 0), Vec3(80, 0, 0)};
    const auto bone = std::make_shared<const SolidQuery>(test::sphere(20, 3, Vec3(0, 5, 0)));
    request.bones = {bone};
    request.clearance = 0.8;
    const Spindle spindle = make_spindle(request);
    CHECK(spindle.inside == 0);
    CHECK(spindle.largest_shift > 10);
    CHECK(spindle.volume == Approx(50000).epsilon(0.02));
    CHECK(check_mesh(spindle.mesh).closed());
    double nearest = 1e9;
    for (const Vec3& p : spindle.mesh.positions)
        nearest = std::min(nearest, bone->signed_distance(p));
    CHECK(nearest > 0.5);
}

TEST_CASE("The volume that a model implies is force over specific tension times fibre length",
          "[anatomy][spindle]") {
    CHECK(line_muscle_volume_m3(600, 0.1) == Approx(1e-4)); // 600 N / 60 N/cm2 = 10 cm2, times 10 cm: 100 cm3
}
