#include "solver/classic/voxel_grid.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace fascicle;
using namespace fascicle::test;
using classic::VoxelGrid;

namespace {

constexpr int n = VoxelGrid::size;

template <class Visit>
void for_each_cell(Visit visit) {
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            for (int z = 0; z < n; ++z)
                visit(x, y, z);
}

/// Fine sphere whose published grid has cells of exactly one unit: box [0, 64]^3.
TriMesh unit_cell_sphere() {
    return sphere(32.0, 5, Vec3(32, 32, 32));
}

} // namespace

TEST_CASE("published voxels of a sphere: border by the distance of the lower corner, inside by flood fill",
          "[solver][classic][voxel_grid]") {
    const VoxelGrid grid(unit_cell_sphere(), false);
    CHECK((grid.cell() - Vec3::Ones()).norm() < 1e-12);
    int border = 0;
    for_each_cell([&](int x, int y, int z) {
        const double outwards = (Vec3(x, y, z) - Vec3(32, 32, 32)).norm() - 32.0; // of the lower corner
        INFO(x << ' ' << y << ' ' << z << ' ' << outwards);
        // The facets lie up to 0.02 inside the sphere; half a diagonal is 0.8665.
        if (std::abs(outwards) < 0.8)
            REQUIRE(grid.border(x, y, z));
        if (std::abs(outwards) > 0.95)
            REQUIRE_FALSE(grid.border(x, y, z));
        if (outwards < 0.8)
            REQUIRE(grid.inside(x, y, z));
        if (outwards > 0.95)
            REQUIRE_FALSE(grid.inside(x, y, z));
        border += grid.border(x, y, z);
    });
    CHECK(border > 15000); // 4 pi 32^2 cells of surface, 1.7 thick, less what sticks out of the grid
    // Half a voxel of bias: the obstacle reaches a voxel further down than up.
    CHECK(grid.border(0, 32, 32));
    CHECK_FALSE(grid.border(63, 32, 32));
}

TEST_CASE("meant voxels of a sphere: distance of the cell's centre, two free layers around",
          "[solver][classic][voxel_grid]") {
    const VoxelGrid grid(unit_cell_sphere(), true);
    CHECK(grid.cell()[0] == Approx(64.0 / 60.0));
    int lopsided = 0;
    for_each_cell([&](int x, int y, int z) {
        const Vec3 centre = grid.from_voxels(Vec3(x + 0.5, y + 0.5, z + 0.5));
        const double outwards = ((centre - Vec3(32, 32, 32)).norm() - 32.0) / grid.cell()[0];
        INFO(x << ' ' << y << ' ' << z << ' ' << outwards);
        if (std::abs(outwards) < 0.45) // nearer than the cell's faces: the surface runs through it
            REQUIRE(grid.border(x, y, z));
        if (outwards > 0.95)
            REQUIRE_FALSE(grid.inside(x, y, z));
        if (outwards < -0.95)
            REQUIRE((grid.inside(x, y, z) && !grid.border(x, y, z)));
        lopsided += grid.inside(x, y, z) != grid.inside(n - 1 - x, y, z);
    });
    CHECK(lopsided == 0);
}

TEST_CASE("a box fills its own bounding box: published, everything is inside",
          "[solver][classic][voxel_grid]") {
    const VoxelGrid published(box(64, 128, 32), false);
    CHECK((published.cell() - Vec3(1, 2, 0.5)).norm() < 1e-12); // anisotropic
    int outside = 0;
    for_each_cell([&](int x, int y, int z) { outside += !published.inside(x, y, z); });
    CHECK(outside == 0); // cell (0,0,0), where the fill starts, is border
    CHECK(published.border(0, 20, 20));
    CHECK_FALSE(published.border(1, 20, 20));
    CHECK_FALSE(published.border(63, 20, 20)); // the upper side has no border cells at all

    const VoxelGrid meant(box(64, 128, 32), true);
    CHECK_FALSE(meant.inside(0, 0, 0));
    CHECK_FALSE(meant.inside(0, 30, 30));
    CHECK_FALSE(meant.inside(63, 30, 30));
    CHECK(meant.border(2, 30, 30));
    CHECK(meant.border(61, 30, 30));
    CHECK((meant.inside(30, 30, 30) && !meant.border(30, 30, 30)));
}

TEST_CASE("what a closed surface encloses is inside, also behind a second wall",
          "[solver][classic][voxel_grid]") {
    const bool meant = GENERATE(false, true);
    const TriMesh shell = joined(unit_cell_sphere(), inside_out(sphere(16.0, 4, Vec3(32, 32, 32))));
    const VoxelGrid grid(shell, meant);
    CHECK(grid.inside(32, 32, 32)); // the cavity: no fill gets there
    CHECK_FALSE(grid.border(32, 32, 32));
    const Vec3 wall = grid.to_voxels(Vec3(32, 32, 48));
    CHECK(grid.border(static_cast<int>(wall[0]), static_cast<int>(wall[1]), static_cast<int>(wall[2])));
    CHECK_FALSE(grid.inside(2, 2, 2));
}

TEST_CASE("positions and voxels convert both ways, and beyond the grid nothing is inside",
          "[solver][classic][voxel_grid]") {
    const bool meant = GENERATE(false, true);
    TriMesh mesh = box(30, 20, 10);
    for (Vec3& p : mesh.positions)
        p += Vec3(-400, 17, 3);
    const VoxelGrid grid(mesh, meant);
    const Vec3 p(-390, 20, 8);
    CHECK((grid.from_voxels(grid.to_voxels(p)) - p).norm() < 1e-12);
    CHECK(grid.inside(grid.to_voxels(p)));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Vec3& away : {Vec3(-1e-9, 30, 30), Vec3(30, -0.5, 30), Vec3(30, 30, 64.0), Vec3(1e300, 0, 0),
                             Vec3(-1e300, 0, 0), Vec3(nan, 30, 30), Vec3(30, 30, nan)})
        CHECK_FALSE(grid.inside(away));
}

TEST_CASE("solids without extent, area or triangles make a grid all the same",
          "[solver][classic][voxel_grid]") {
    const bool meant = GENERATE(false, true);
    const VoxelGrid none(TriMesh{}, meant);
    CHECK_FALSE(none.inside(Vec3(1, 1, 1)));
    const VoxelGrid flat(sheet(4, 4), meant);
    CHECK(flat.inside(flat.to_voxels(Vec3(2.1, 2.1, 0.01))));
    const TriMesh point{{Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}, {{0, 1, 2}}};
    const VoxelGrid dot(point, meant);
    CHECK(dot.inside(dot.to_voxels(Vec3(1, 1, 1))));
}
