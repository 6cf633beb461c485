// The geometry queries on real bones.

#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/geometry/sphere_fit.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/data_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

MeshPtr read(const std::filesystem::path& path) {
    return std::make_shared<const TriMesh>(read_mesh_file(path).mesh);
}

} // namespace

TEST_CASE("the hip joint centre is found without a guess", "[geometry][sphere_fit][data]") {
    FASCICLE_NEED_DATA(dir);
    const MeshPtr femur = read(dir / "lhdl/femur.vtk"), pelvis = read(dir / "lhdl/pelvis.obj");
    // The data's README: a sphere fitted to the femoral head by hand.
    const Vec3 known(143.86, 243.37, -432.53);
    const JointFit fit = fit_joint_centre(*femur, {pelvis});
    REQUIRE(fit.sphere);
    CHECK((fit.sphere->centre - known).norm() < 0.5);
    CHECK(fit.sphere->radius == Approx(23.02).margin(0.3));
    CHECK(fit.rms < 0.6);
    CHECK(fit.ball_on_moving_bone);
    const JointFit other = fit_joint_centre(*pelvis, {femur});
    REQUIRE(other.sphere);
    CHECK((other.sphere->centre - known).norm() < 0.5);
    CHECK_FALSE(other.ball_on_moving_bone);
}

TEST_CASE("no ball between the plates of the squish box", "[geometry][sphere_fit][data]") {
    FASCICLE_NEED_DATA(dir);
    const MeshPtr top = read(dir / "squish-box/plate_top.vtk");
    const MeshPtr bottom = read(dir / "squish-box/plate_bottom.vtk");
    const JointFit fit = fit_joint_centre(*top, {bottom});
    CHECK_FALSE(fit.sphere);
    CHECK_FALSE(fit.reason.empty());
}

TEST_CASE("grids of real bones: sign, distance, no surface outside", "[geometry][distance_grid][data]") {
    FASCICLE_NEED_DATA(dir);
    const char* name = GENERATE("femur.vtk", "right_iliac.vtk"); // the second has a non-manifold edge
    const MeshPtr mesh = read(dir / "lhdl" / name);
    DistanceGridOptions options;
    options.spacing = 2.0;
    options.saturation = 4.0;
    options.threads = 2;
    const DistanceGrid grid(*mesh, options);
    test::Random random(8);
    double highest = -1e300;
    for (int i = 0; i < 200000; ++i)
        highest = std::max(highest, grid.value(random.on_surface(*mesh)));
    CHECK(highest <= 0.0);
    const SolidQuery solid(*mesh);
    int near = 0;
    for (int i = 0; i < 20000 && near < 2000; ++i) {
        // Nodes around a point of the surface.
        const Vec3 p = random.on_surface(*mesh) + 6.0 * random.direction();
        const Vec3 cell = ((p - grid.low()) / grid.spacing()).array().round();
        const std::array<int, 3> n{static_cast<int>(cell.x()), static_cast<int>(cell.y()),
                                   static_cast<int>(cell.z())};
        if (cell.minCoeff() < 0 || n[0] >= grid.nodes()[0] || n[1] >= grid.nodes()[1] ||
            n[2] >= grid.nodes()[2])
            continue;
        ++near;
        const double truth = solid.signed_distance(grid.low() + grid.spacing() * cell, grid.saturation());
        const double value = grid.node_value(n[0], n[1], n[2]);
        CHECK(value <= truth + 1e-5);
        CHECK(value >= truth - grid.correction_max() - 1e-5);
    }
    CHECK(near == 2000);
}
