// The files of ../shared/data, against the counts of its README.
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "support/data_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>

using namespace fascicle;

TEST_CASE("LHDL meshes read with the counts of their README", "[io][data]") {
    FASCICLE_NEED_DATA(data);
    struct Expected {
        const char* file;
        int triangles;
        int nonmanifold_edges;
        int inconsistent;
    };
    for (const auto& [file, triangles, nonmanifold_edges, inconsistent] :
         {Expected{"gluteus_maximus.vtk", 19752, 0, 0},
          {"iliacus.vtk", 13858, 0, 0},
          {"iliacus_raw.vtk", 7966, 1, 0},
          {"femur.vtk", 42456, 0, 5},
          {"pelvis.obj", 95256, 0, 0},
          {"right_iliac.vtk", 89996, 1, 0},
          {"sacrum.vtk", 89980, 2, 0}}) {
        INFO(file);
        const MeshFile mesh = read_mesh_file(data / "lhdl" / file);
        CHECK(mesh.mesh.triangle_count() == triangles);
        CHECK(mesh.report.nonmanifold_edges == nonmanifold_edges);
        CHECK(mesh.report.closed());
        CHECK(mesh.notes.empty());
        CHECK(mesh.report.inconsistent_triangles == inconsistent); // the README passes over the femur's five
        CHECK(signed_volume(mesh.mesh.positions, mesh.mesh.triangles) > 0);
    }
}

TEST_CASE("LHDL pelvis is two bones and reads fast", "[io][data]") {
    FASCICLE_NEED_DATA(data);
    const auto start = std::chrono::steady_clock::now();
    const MeshFile pelvis = read_mesh_file(data / "lhdl/pelvis.obj");
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    CHECK(pelvis.report.components == 2);
    CHECK(pelvis.mesh.vertex_count() == 47628);
    CHECK(pelvis.mesh.positions[0] == Vec3(94.5093, 216.1596, -323.0611));
    CHECK(seconds < 3.0); // 0.15 s in release on an idle machine; sanitizers and other jobs take their share
    WARN("pelvis.obj read and checked in " << seconds << " s");
}

TEST_CASE("LHDL muscle volumes", "[io][data]") {
    FASCICLE_NEED_DATA(data);
    const TriMesh gluteus = read_mesh_file(data / "lhdl/gluteus_maximus.vtk").mesh;
    CHECK(signed_volume(gluteus.positions, gluteus.triangles) / 1000 == Approx(746.6).margin(0.05)); // cm^3
    CHECK(gluteus.vertex_count() == 9878);
}

TEST_CASE("LHDL surface fibres are segments over 30 points", "[io][data]") {
    FASCICLE_NEED_DATA(data);
    const MeshFile fibres = read_mesh_file(data / "lhdl/gluteus_maximus_surface_fibres.vtk");
    CHECK(fibres.lines.points.size() == 30);
    CHECK(fibres.lines.lines.size() == 25);
    CHECK(fibres.mesh.positions.empty());
}

TEST_CASE("squish-box meshes read", "[io][data]") {
    FASCICLE_NEED_DATA(data);
    const MeshFile box = read_mesh_file(data / "squish-box/box.vtk");
    CHECK(box.mesh.triangle_count() == 5292);
    CHECK(box.mesh.vertex_count() == 2648);
    CHECK(box.report.closed());
    CHECK(signed_volume(box.mesh.positions, box.mesh.triangles) == Approx(100.0 * 80 * 100).epsilon(1e-6));
    for (const char* plate : {"squish-box/plate_top.vtk", "squish-box/plate_bottom.vtk"})
        CHECK(read_mesh_file(data / plate).mesh.triangle_count() == 12);
}

TEST_CASE("OpenSim bone meshes read", "[io][data]") {
    FASCICLE_NEED_DATA(data);
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data / "opensim/Geometry")) {
        INFO(entry.path());
        const MeshFile bone = read_mesh_file(entry.path());
        CHECK(bone.format == "VTK XML");
        CHECK(bone.mesh.triangle_count() >= 100);
        ++count;
    }
    CHECK(count == 6);
}
