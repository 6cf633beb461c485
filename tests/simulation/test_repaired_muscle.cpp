// Meshes as they come out of segmentation: repaired, written, read and simulated.

#include "fascicle/geometry/repair/repair.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "support/data_dir.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// Repairs a file of the hip into `folder` and checks what came out, from the mesh as it is read again.
std::filesystem::path repaired(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const TriMesh broken = read_mesh_data(file).mesh;
    MeshReport before = check_mesh(broken);
    CHECK(before.nonmanifold_edges + before.nonmanifold_vertices > 0); // else there is nothing to show
    RepairResult result = repair(broken, {}, {});
    CHECK(result.reason.empty());
    CHECK(result.measured_after.volume ==
          Approx(signed_volume(broken.positions, broken.triangles)).epsilon(0.002));
    MeshData data;
    data.mesh = std::move(result.mesh);
    std::filesystem::path out = folder / file.filename();
    write_mesh_file(out, data);
    const MeshReport after = check_mesh(read_mesh_data(out).mesh);
    CHECK(after.closed());
    CHECK(after.boundary_edges == 0);
    CHECK(after.nonmanifold_edges == 0);
    CHECK(after.nonmanifold_vertices == 0);
    CHECK(after.inconsistent_triangles == 0);
    CHECK(after.zero_area_triangles == 0);
    CHECK(after.components == 1);
    return out;
}

} // namespace

TEST_CASE("raw meshes of the hip are repaired to closed manifolds and simulate",
          "[simulation][repair][data][slow]") {
    FASCICLE_NEED_DATA(data);
    const auto lhdl = data / "lhdl";
    const test::TempDir folder;
    SceneRequest request;
    {
        INFO("iliacus_raw.vtk");
        request.muscles = {repaired(lhdl / "iliacus_raw.vtk", folder.path())};
    }
    for (const char* bone : {"right_iliac.vtk", "sacrum.vtk"}) {
        INFO(bone);
        request.bones.push_back(repaired(lhdl / bone, folder.path()));
    }
    request.moving_bones = {lhdl / "femur.vtk"};
    request.hinge = parse_hinge("143.86,243.37,-432.53;1,0,0");
    request.angle_deg = -2;
    request.phases = parse_phases("4,0,0");
    request.threads = 2;
    Scene scene = load_scene(request).scene;
    scene.parameters.set("contact.grid_mm", 4.0);
    const TriMesh muscle = *scene.muscles[0].mesh;
    const double volume = signed_volume(muscle.positions, muscle.triangles);
    Recording recording(std::make_shared<Scene>(std::move(scene)));
    run_simulation(recording, {2}, {});
    REQUIRE(recording.state() == RunState::finished);
    REQUIRE(recording.frame_count() == 5);
    double moved = 0;
    for (int k = 0; k < 5; ++k) {
        const Points& points = *recording.frame(k)->muscle_positions[0];
        REQUIRE(points.size() == muscle.positions.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            REQUIRE(points[i].allFinite());
            moved = std::max(moved, (points[i] - muscle.positions[i]).norm());
        }
        CHECK(signed_volume(points, muscle.triangles) == Approx(volume).epsilon(0.01));
    }
    CHECK(moved > 0.5); // mm: 2 degrees, some centimetres from the hinge
    CHECK(moved < 30);
}
