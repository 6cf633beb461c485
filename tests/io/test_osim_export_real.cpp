// Gluteus maximus of the hip data as OpenSim muscles.

#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/osim_export.hpp"
#include "fascicle/io/osim_file.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "support/data_dir.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("Gluteus maximus becomes OpenSim muscles within a millimetre of the simulation over 1 rad",
          "[io][osim_export][real][slow]") {
    FASCICLE_NEED_DATA(data);
    SceneRequest request;
    request.muscles = {data / "lhdl/gluteus_maximus.vtk"};
    request.bones = {data / "lhdl/pelvis.obj"};
    request.moving_bones = {data / "lhdl/femur.vtk"};
    request.attachments = {{"gluteus_maximus", data / "lhdl/gluteus_maximus_attachments.csv"}};
    request.hinge = HingeRequest{Vec3(143.86, 243.37, -432.53), Vec3::UnitX()};
    request.angle_deg = -57.29578;
    request.phases = Phases{30, 0, 0}; // the whole run, with 100 fibres, is in docs/formats.md
    LoadedScene loaded = load_scene(request);
    loaded.scene.parameters.set_text("fibres.method", "kukacka");
    loaded.scene.parameters.set("fibres.count", 20);
    Recording recording(std::make_shared<const Scene>(std::move(loaded.scene)));
    run_simulation(recording, {2}, {});
    REQUIRE(recording.state() == RunState::finished);

    const test::TempDir folder;
    const OsimExportReport report = export_osim(folder.path() / "ropes.osim", recording);
    INFO(report.summary);
    REQUIRE(report.fibres.size() == 20);
    CHECK(report.coordinate == "femur_angle");
    CHECK(report.range_max == Approx(1).epsilon(1e-6));
    CHECK(report.bone_mm < 1e-6);
    for (const OsimFibreReport& fibre : report.fibres) {
        INFO(fibre.name);
        CHECK(fibre.length_mm <= 1);
        CHECK(fibre.length_between_mm <= 1);
        CHECK(fibre.moment_arm_mm <= 1);
        CHECK(fibre.exact_moment_arm_mm <= 1.5);
        CHECK(fibre.opensim_moment_arm_mm == Approx(fibre.exact_moment_arm_mm).margin(1e-6));
    }
    // Rajagopal et al. 2016: 3338 N for the whole muscle, hip flexion as a turn about Z.
    const LineModel model = read_osim_file(report.model).model;
    double force = 0;
    for (const LineMuscle& muscle : model.muscles)
        force += muscle.max_isometric_force_n;
    CHECK(force > 1500);
    CHECK(force < 5000);
    CHECK((model.skeleton.joints.at(1).rotations.at(0).axis - Vec3::UnitZ()).norm() < 1e-12);
    CHECK(model.skeleton.bodies.at(static_cast<std::size_t>(model.skeleton.joints.at(1).parent)).name ==
          "pelvis");
}
