#include "fascicle/geometry/fit_sphere.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "support/data_dir.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;

TEST_CASE("a sphere is found exactly, also from a cap of it", "[geometry][fit_sphere]") {
    const Vec3 centre(100, -200, 300);
    Points all = sphere(7.0, 3, centre).positions, cap;
    for (const Vec3& p : all)
        if (p.x() > centre.x() + 5.0)
            cap.push_back(p);
    REQUIRE(cap.size() > 10);
    for (const Points& points : {all, cap}) {
        const auto fit = fit_sphere(points);
        REQUIRE(fit);
        CHECK((fit->centre - centre).norm() < 1e-8);
        CHECK(fit->radius == Approx(7.0).epsilon(1e-10));
    }
}

TEST_CASE("the fit is where the sum of squared misses is smallest", "[geometry][fit_sphere]") {
    Points points = sphere(5.0, 2).positions;
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] *= 1.0 + 0.05 * std::sin(3.7 * static_cast<double>(i));
    points.resize(points.size() / 2);
    const auto sum = [&](const Sphere& s) {
        double total = 0;
        for (const Vec3& p : points)
            total += std::pow((p - s.centre).norm() - s.radius, 2);
        return total;
    };
    const auto fit = fit_sphere(points);
    REQUIRE(fit);
    const double least = sum(*fit);
    for (int k = 0; k < 8; ++k) {
        Sphere other = *fit;
        (k < 6 ? other.centre[k / 2] : other.radius) += k % 2 == 0 ? 1e-3 : -1e-3;
        CHECK(sum(other) > least);
    }
}

TEST_CASE("no sphere is the best for a plane, a line or three points", "[geometry][fit_sphere]") {
    CHECK_FALSE(fit_sphere({}));
    CHECK_FALSE(fit_sphere({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
    CHECK_FALSE(fit_sphere(sheet(4, 4).positions));
    CHECK_FALSE(fit_sphere({Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}));
}

TEST_CASE("the centre of a ball joint", "[geometry][fit_sphere]") {
    // A ball on a long rod, in half a bowl.
    const Vec3 centre(3, 4, 5);
    TriMesh moving = sphere(10.0, 4, centre);
    for (Vec3& p : moving.positions)
        if (p.z() < centre.z() - 8.0) // draws the lower cap out into a shaft
            p.z() = centre.z() - 8.0 - 30.0 * (centre.z() - 8.0 - p.z());
    TriMesh bowl = inside_out(sphere(11.0, 4, centre));
    std::erase_if(bowl.triangles,
                  [&](const Tri& t) { return bowl.positions[static_cast<std::size_t>(t[0])].z() < 6.0; });
    const auto fit = fit_joint_centre(moving, {&bowl});
    REQUIRE(fit);
    CHECK((fit->head.centre - centre).norm() < 1e-6);
    CHECK(fit->head.radius == Approx(10.0).epsilon(1e-6));
    CHECK(fit->clearance == Approx(1.0).epsilon(0.05));

    CHECK_FALSE(fit_joint_centre(box(100, 100, 100), {&bowl}));
    CHECK_FALSE(fit_joint_centre(moving, {}));
}

TEST_CASE("LHDL: the femoral head", "[geometry][fit_sphere][data]") {
    FASCICLE_NEED_DATA(data);
    const MeshFile femur = read_mesh_file(data / "lhdl/femur.vtk");
    const MeshFile pelvis = read_mesh_file(data / "lhdl/pelvis.obj");
    const auto fit = fit_joint_centre(femur.mesh, {&pelvis.mesh});
    REQUIRE(fit);
    CAPTURE(fit->head.centre.transpose(), fit->head.radius, fit->rms, fit->vertices, fit->coverage,
            fit->clearance);
    CHECK((fit->head.centre - Vec3(143.86, 243.37, -432.53)).norm() < 0.5);
    CHECK(fit->head.radius == Approx(23.02).margin(0.3));
    CHECK(fit->clearance == Approx(0.9).margin(0.15));
}
