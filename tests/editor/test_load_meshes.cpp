// Meshes through the dialog: one, many, broken and open ones, units, axes, filled holes.
#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "editor/features.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/format_registry.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "render/osmesa_context.hpp"
#include "support/data_dir.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <thread>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;
namespace fs = std::filesystem;

namespace {

void wait_for(Driver& d, const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!done() && std::chrono::steady_clock::now() < end) {
        d.frame();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    REQUIRE(done());
    d.frame(3);
}

fs::path write(const fs::path& file, const TriMesh& mesh) {
    write_mesh_file(file, {mesh, {}, {}, {}, {}});
    return file;
}

/// A sphere without the triangles around its first vertex.
TriMesh open_sphere() {
    TriMesh mesh = test::sphere(20, 2, Vec3(40, 40, 20));
    std::erase_if(mesh.triangles, [](const Tri& t) { return t[0] == 0 || t[1] == 0 || t[2] == 0; });
    return mesh;
}

void drop(Driver& d, const std::vector<fs::path>& files) {
    d.editor().drop_files(files);
    const MeshBatch& batch = d.editor().dialogs().mesh.batch();
    wait_for(d, [&] { return batch.entries().size() == files.size() && !batch.reading(); });
}

std::size_t steps(Driver& d) {
    return d.document().history().steps().size();
}

} // namespace

TEST_CASE("A mesh that is dropped while a question is open waits for the answer", "[editor][ui][load]") {
    const test::TempDir folder;
    const fs::path file = write(folder.path() / "patella.obj", test::box(30, 30, 30));
    Driver d;
    d.frame(3);
    d.editor().dialogs().unsaved.ask("closing the program", [](EditorContext&) {});
    d.frame(3);
    REQUIRE(d.has("unsaved/cancel"));
    d.editor().drop_files({file});
    wait_for(d, [&] { return !d.editor().features().loader.reading(); });
    CHECK(d.has("unsaved/cancel")); // still in front
    CHECK_FALSE(d.has("mesh/bone"));
    d.key(key_escape); // answers the question alone
    wait_for(d, [&] { return d.has("mesh/bone"); });
    CHECK_FALSE(d.has("unsaved/cancel"));
    d.key(key_escape);
    d.frame(3);
    CHECK_FALSE(d.has("mesh/bone"));
    CHECK(d.document().scene().bones.size() == 2);
}

TEST_CASE("A dropped mesh is previewed and added as what the user says", "[editor][ui][load]") {
    const test::TempDir folder;
    const fs::path file = write(folder.path() / "patella.obj", test::box(30, 30, 30));
    Driver d;
    d.frame(3);
    d.editor().drop_files({file});
    wait_for(d, [&] { return d.has("mesh/bone"); });
    d.click("mesh/bone");
    d.click("mesh/add");
    d.frame(3);
    REQUIRE(d.document().scene().bones.size() == 3);
    CHECK(d.document().scene().bones[2].name == "patella");
    CHECK(d.document().scene().timeline.bone_tracks[2].moves());
    CHECK(steps(d) == 2);
    CHECK_FALSE(d.has("mesh/add"));
    CHECK(d.has("tree/patella"));

    d.editor().drop_files({folder.path() / "missing.obj"});
    wait_for(d, [&] { return d.editor().log().unseen_errors() > 0; });
    d.click("mesh/cancel");
    CHECK(d.document().scene().bones.size() == 3);
    d.key(key_z, {.ctrl = true});
    CHECK(d.document().scene().bones.size() == 2);
}

TEST_CASE("Many dropped meshes become bones and muscles in one step", "[editor][ui][load]") {
    const test::TempDir folder;
    Driver d;
    d.frame(3);
    drop(d, {write(folder.path() / "right_femur.obj", test::box(10, 10, 60)),
             write(folder.path() / "iliacus.obj", test::sphere(9, 2)),
             write(folder.path() / "sacrum.vtk", test::box(30, 20, 10))});
    const auto& entries = d.editor().dialogs().mesh.batch().entries();
    CHECK(entries[0].role == actions::MeshRole::bone);
    CHECK(entries[0].moving);
    CHECK(entries[1].role == actions::MeshRole::muscle);
    CHECK(entries[2].role == actions::MeshRole::bone);
    CHECK_FALSE(entries[2].moving);
    d.click("mesh/entry/sacrum.vtk");
    d.click("mesh/name");
    d.key(key_a, {.ctrl = true});
    d.type("fixed"); // is taken
    d.click("mesh/add");
    d.frame(3);
    CHECK(steps(d) == 2);
    CHECK(d.document().history().undo_name() == "Add 3 meshes");
    const Scene& scene = d.document().scene();
    REQUIRE(scene.bones.size() == 4);
    CHECK(scene.bones[2].name == "right_femur");
    CHECK(scene.timeline.moves(2));
    CHECK(scene.bones[3].name == "fixed 2");
    REQUIRE(scene.muscles.size() == 2);
    CHECK(scene.muscles[1].name == "iliacus");
    CHECK_FALSE(scene.muscles[1].source.hash.empty());
    CHECK(scene.fibre_templates != nullptr);
    CHECK(d.state().selection == Selection{Selection::Kind::muscle, "iliacus"});
    d.key(key_z, {.ctrl = true});
    CHECK(d.document().scene().bones.size() == 2);
    CHECK(d.document().scene().muscles.size() == 1);
}

TEST_CASE("Meshes of every format can be chosen in the dialog, and dropped under any name",
          "[editor][ui][load]") {
    const test::TempDir folder;
    Driver d;
    d.frame(3);
    std::vector<fs::path> lying;
    for (const MeshFormat& format : mesh_formats()) {
        const std::string& extension = format.extensions[0];
        const fs::path file = write(folder.path() / ("bone" + extension), test::box(9, 9, 9));
        lying.push_back(folder.path() / ("bone_" + extension.substr(1) + ".dat"));
        fs::copy_file(file, lying.back());
    }
    write_file(folder.path() / "bone.txt", "no mesh");
    drop(d, lying);
    for (const MeshEntry& entry : d.editor().dialogs().mesh.batch().entries()) {
        INFO(entry.path << ": " << entry.problem);
        REQUIRE(entry.read != nullptr);
        CHECK(entry.read->surface.mesh->triangle_count() == 12);
    }
    d.click("browser/path");
    d.key(key_a, {.ctrl = true});
    d.type(folder.path().string());
    d.key(key_enter);
    d.frame(3);
    for (const MeshFormat& format : mesh_formats())
        CHECK(d.has("browser/bone" + format.extensions[0]));
    CHECK_FALSE(d.has("browser/bone.txt"));
}

TEST_CASE("A file can be left out of the list, and a broken one does not stop the others",
          "[editor][ui][load]") {
    const test::TempDir folder;
    const fs::path broken = folder.path() / "broken.obj";
    write_file(broken, "v 0 0 zero\nf 1 2 3\n");
    Driver d;
    d.frame(3);
    drop(d, {broken, write(folder.path() / "a_bone.obj", test::box(9, 9, 9)),
             write(folder.path() / "b_bone.obj", test::box(8, 8, 8))});
    CHECK(d.editor().log().unseen_errors() == 1);
    d.click("mesh/entry/b_bone.obj/remove");
    CHECK(d.editor().dialogs().mesh.batch().entries().size() == 2);
    d.click("mesh/entry/broken.obj");
    d.click("mesh/add");
    d.frame(2);
    CHECK(d.document().scene().bones.size() == 3);
    CHECK(d.document().history().undo_name() == "Add bone a_bone");
}

TEST_CASE("Metres are guessed and shown, and one click takes the guess back", "[editor][ui][load]") {
    const test::TempDir folder;
    Driver d;
    d.frame(3);
    drop(d, {write(folder.path() / "bone.obj", test::box(0.1, 0.2, 0.4))});
    const MeshBatch& batch = d.editor().dialogs().mesh.batch();
    CHECK(batch.entries()[0].scale == 1000);
    CHECK(batch.entries()[0].scale_guessed);
    d.click("mesh/scale/1");
    CHECK(batch.entries()[0].scale == 1);
    d.click("mesh/scale/0.001");
    CHECK(batch.entries()[0].scale == 0.001);
    d.click("mesh/scale/1000");
    d.click("mesh/add");
    d.frame(2);
    const Bone& bone = d.document().scene().bones.back();
    CHECK(bounding_box(bone.mesh->positions).size().isApprox(Vec3(100, 200, 400)));
    CHECK(bone.source.hash.empty()); // no longer what the file holds
}

TEST_CASE("Axes of a file are taken from its header, can be chosen, and never mirror", "[editor][ui][load]") {
    const test::TempDir folder;
    const fs::path file = folder.path() / "ras_bone.obj";
    write_file(file,
               "# SPACE=RAS\nv 0 0 0\nv 30 0 0\nv 0 20 0\nv 0 0 10\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    Driver d;
    d.frame(3);
    drop(d, {file});
    const MeshBatch& batch = d.editor().dialogs().mesh.batch();
    CHECK(batch.entries()[0].axes == AxisMapping::ras_to_lps);
    CHECK(bounding_box(batch.entries()[0].placed->positions).min.isApprox(Vec3(-30, -20, 0)));
    for (const AxisMappingRow& row : axis_mappings()) {
        d.click("mesh/axes");
        d.click(std::string("mesh/axes/") + row.label);
        CHECK(batch.entries()[0].axes == row.mapping);
        const TriMesh& mesh = *batch.entries()[0].placed;
        CHECK(signed_volume(mesh.positions, mesh.triangles) == Approx(1000));
    }
}

TEST_CASE("A muscle with a hole says why it cannot be one, until the hole is filled", "[editor][ui][load]") {
    const test::TempDir folder;
    Driver d;
    d.frame(3);
    drop(d, {write(folder.path() / "open.obj", open_sphere())});
    const MeshBatch& batch = d.editor().dialogs().mesh.batch();
    CHECK(batch.entries()[0].role == actions::MeshRole::bone); // an open surface can be nothing else
    d.click("mesh/muscle");
    std::string why;
    CHECK_FALSE(batch.ready(why));
    CHECK(why == "open cannot be a muscle: it has 1 hole, so it encloses no volume.");
    d.click("mesh/add");
    CHECK(d.document().scene().muscles.size() == 1);
    d.click("mesh/fill");
    CHECK(batch.ready(why));
    d.click("mesh/add");
    d.frame(2);
    REQUIRE(d.document().scene().muscles.size() == 2);
    const Muscle& muscle = d.document().scene().muscles.back();
    CHECK(check_mesh(*muscle.mesh).closed());
    CHECK(muscle.mesh->vertex_count() == open_sphere().vertex_count());
    CHECK(muscle.source.hash.empty());
}

TEST_CASE("Esc and Cancel leave the mesh dialog with nothing added", "[editor][ui][load]") {
    const test::TempDir folder;
    const fs::path file = write(folder.path() / "bone.obj", test::box(9, 9, 9));
    Driver d;
    d.frame(3);
    for (const bool by_key : {true, false}) {
        drop(d, {file});
        if (by_key)
            d.key(key_escape);
        else
            d.click("mesh/cancel");
        d.frame(2);
        CHECK_FALSE(d.has("mesh/add"));
        CHECK(d.editor().dialogs().mesh.batch().entries().empty());
    }
    CHECK(steps(d) == 1);
}

TEST_CASE("The mesh dialog draws its states at every size, and its picture only when something changes",
          "[editor][picture][load]") {
    const render::OsmesaContext gl;
    const test::TempDir folder;
    const fs::path file = write(folder.path() / "open_bone.obj", open_sphere());
    for (const auto& [width, height, scale] :
         {std::tuple{1280.0f, 800.0f, 1.0f}, {1800.0f, 1200.0f, 1.5f}, {320.0f, 240.0f, 1.0f}}) {
        Driver d(test::small_scene(), width, height, scale);
        d.editor().use_gl();
        d.frame(2);
        d.editor().dialogs().mesh.open();
        d.frame(3); // nothing chosen
        drop(d, {file, folder.path() / "missing.obj"});
        d.editor().state().dark = false;
        d.frame(3);
        const Rect dialog = d.rect("mesh");
        CHECK(dialog.min.x >= 0);
        CHECK(dialog.max.x <= width);
        CHECK(dialog.max.y <= height);
        if (width < 1000)
            continue; // no room for a picture
        const int before = d.editor().dialogs().mesh.preview().drawn();
        CHECK(before > 0);
        d.frame(5);
        CHECK(d.editor().dialogs().mesh.preview().drawn() == before);
        const ImVec2 middle = d.middle("mesh/preview");
        d.drag(middle, {middle.x + 50 * scale, middle.y});
        CHECK(d.editor().dialogs().mesh.preview().drawn() > before);
    }
}

TEST_CASE("Real meshes of the hip go through the dialog", "[editor][ui][load]") {
    FASCICLE_NEED_DATA(data);
    Scene scene;
    scene.name = "empty";
    Driver d(scene);
    d.frame(3);
    drop(d, {data / "lhdl" / "iliacus.vtk", data / "lhdl" / "right_iliac.vtk", data / "lhdl" / "femur.vtk"});
    const auto& entries = d.editor().dialogs().mesh.batch().entries();
    CHECK(entries[0].role == actions::MeshRole::muscle);
    CHECK(entries[1].role == actions::MeshRole::bone);
    CHECK(entries[2].role == actions::MeshRole::bone);
    for (const MeshEntry& entry : entries)
        CHECK(entry.scale == 1);
    d.click("mesh/add");
    d.frame(3);
    CHECK(d.document().scene().bones.size() == 2);
    CHECK(d.document().scene().muscles.size() == 1);
    CHECK(d.document().history().undo_name() == "Add 3 meshes");
}
