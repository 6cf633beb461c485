// The dialog that repairs the mesh of a bone or muscle, and the offer to repair one that is being loaded.
#include "editor/dialogs/dialogs.hpp"
#include "editor/driver.hpp"
#include "fascicle/document/actions/repair_actions.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "render/osmesa_context.hpp"
#include "support/shapes.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <thread>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

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

/// Two boxes that share an edge: closed, and not manifold.
TriMesh two_boxes() {
    TriMesh mesh = test::box(10, 10, 10);
    TriMesh other = test::box(10, 10, 10);
    for (Vec3& p : other.positions)
        p += Vec3(10, 10, 0);
    mesh = test::joined(mesh, other);
    for (Tri& t : mesh.triangles)
        for (int& v : t)
            v = v == 8 ? 3 : v == 12 ? 7 : v; // (10, 10, 0) and (10, 10, 10)
    return mesh;
}

Scene scene_with(const TriMesh& mesh) {
    Scene scene = test::small_scene();
    scene.muscles[0].mesh = std::make_shared<const TriMesh>(mesh);
    scene.muscles[0].source = {"/somewhere/strap.vtk", "0123"};
    scene.muscles[0].attachments = {{AttachmentKind::origin, 0, {0, 1, 2, 3}},
                                    {AttachmentKind::insertion, 1, {6, 7}}};
    return scene;
}

void open(Driver& d) {
    const Scene& scene = d.document().scene();
    d.state().selection = {Selection::Kind::muscle, scene.muscles[0].name};
    d.frame(3);
    EditorContext context = d.editor().context();
    run_command(context, Command::repair_mesh);
    d.frame(2);
    const RepairDialog& dialog = d.editor().dialogs().repair;
    REQUIRE(dialog.is_open());
    wait_for(d, [&] { return !dialog.busy() && dialog.outcome() != nullptr; });
}

std::size_t steps(Driver& d) {
    return d.document().history().steps().size();
}

} // namespace

TEST_CASE("The selected muscle is repaired in one step, attachments go with it", "[editor][ui][repair]") {
    Driver d(scene_with(two_boxes()));
    d.frame(3);
    CHECK_FALSE(d.command_state(Command::repair_mesh).enabled); // nothing is selected
    const MeshPtr before = d.document().scene().muscles[0].mesh;
    open(d);
    CHECK(d.editor().dialogs().repair.outcome()->result.good());
    CHECK(d.document().scene().muscles[0].mesh == before); // only tried
    d.click("repair/apply");
    d.frame(3);
    CHECK_FALSE(d.editor().dialogs().repair.is_open());
    CHECK(steps(d) == 2);
    const Muscle& muscle = d.document().scene().muscles[0];
    CHECK(d.document().history().undo_name() == "Repair muscle " + muscle.name);
    CHECK(check_mesh(*muscle.mesh).nonmanifold_edges == 0);
    CHECK(muscle.mesh->vertex_count() == 16);
    CHECK(muscle.source.hash.empty());
    CHECK(muscle.source.path == "/somewhere/strap.vtk");
    CHECK(muscle.attachments[0].vertices.size() == 5); // vertex 3 is two now
    CHECK(muscle.attachments[1].vertices.size() == 3);
    for (const int v : muscle.attachments[0].vertices)
        CHECK(v < 16);
    CHECK(d.editor().log().messages().back().text.find("8 vertices in place of 6") != std::string::npos);
    d.key(key_z, {.ctrl = true});
    CHECK(d.document().scene().muscles[0].mesh == before);
    CHECK(d.document().scene().muscles[0].attachments[0].vertices.size() == 4);
}

TEST_CASE("The repair of a mesh that is there no longer replaces nothing, and says so",
          "[editor][ui][repair]") {
    Driver d(scene_with(two_boxes()));
    d.frame(3);
    open(d);
    const auto other = std::make_shared<const TriMesh>(test::sphere(12, 2));
    actions::replace_muscle_mesh(
        d.document(), 0, other,
        std::vector<VertexOrigin>(
            other->positions.size())); // as when its file is read anew beneath the dialog
    d.frame(3);
    d.click("repair/apply");
    d.frame(3);
    CHECK(d.document().scene().muscles[0].mesh == other);
    CHECK(steps(d) == 2);
    CHECK(d.editor().log().messages().back().text.find("nothing was replaced") != std::string::npos);
}

TEST_CASE("Choices of the repair dialog are tried at once, and Cancel leaves everything",
          "[editor][ui][repair]") {
    Driver d(scene_with(test::sphere(10, 3)));
    d.frame(3);
    open(d);
    const RepairDialog& dialog = d.editor().dialogs().repair;
    CHECK_FALSE(dialog.outcome()->result.changed());
    d.click("repair/apply"); // there is nothing to apply
    d.frame(2);
    CHECK(dialog.is_open());
    CHECK(steps(d) == 1);
    d.click("repair/by_number");
    d.frame(2);
    d.click("repair/triangles");
    d.key(key_a, {.ctrl = true});
    d.type("200");
    d.frame();
    CHECK(dialog.busy());
    d.wait(1);
    wait_for(d, [&] { return !dialog.busy(); });
    REQUIRE(dialog.outcome() != nullptr);
    CHECK(dialog.outcome()->after.mesh->triangle_count() == 200);
    d.click("repair/cancel");
    d.frame(3);
    CHECK_FALSE(dialog.is_open());
    CHECK(steps(d) == 1);
    open(d); // and again, with the defaults
    CHECK_FALSE(dialog.outcome()->result.changed());
    d.key(key_escape);
    d.frame(3);
    CHECK_FALSE(dialog.is_open());
}

TEST_CASE("A mesh that cannot be made solid says why in the dialog, until large holes are allowed",
          "[editor][ui][repair]") {
    Scene scene = test::small_scene();
    TriMesh half = test::sphere(10, 2);
    std::erase_if(half.triangles, [&](const Tri& t) {
        return half.positions[static_cast<std::size_t>(t[0])].z() +
                   half.positions[static_cast<std::size_t>(t[1])].z() +
                   half.positions[static_cast<std::size_t>(t[2])].z() >
               0;
    });
    scene.bones[0].mesh = std::make_shared<const TriMesh>(half);
    Driver d(scene);
    d.frame(3);
    d.state().selection = {Selection::Kind::bone, scene.bones[0].name};
    EditorContext context = d.editor().context();
    run_command(context, Command::repair_mesh);
    const RepairDialog& dialog = d.editor().dialogs().repair;
    wait_for(d, [&] { return dialog.outcome() != nullptr; });
    CHECK_FALSE(dialog.outcome()->result.good());
    d.click("repair/apply");
    CHECK(steps(d) == 1);
    d.click("repair/fill_large");
    d.frame();
    d.wait(1);
    wait_for(d, [&] { return !dialog.busy(); });
    d.click("repair/apply");
    d.frame(2);
    CHECK(steps(d) == 2);
    CHECK(check_mesh(*d.document().scene().bones[0].mesh).closed());
}

TEST_CASE("The repair dialog fits every window and draws what it found", "[editor][picture][repair]") {
    const render::OsmesaContext gl;
    for (const auto& [width, height, scale] :
         {std::tuple{1280.0f, 800.0f, 1.0f}, {1800.0f, 1200.0f, 1.5f}, {400.0f, 300.0f, 1.0f}}) {
        Driver d(scene_with(two_boxes()), width, height, scale);
        d.editor().use_gl();
        d.frame(2);
        open(d);
        const Rect dialog = d.rect("repair");
        CHECK(dialog.min.x >= 0);
        CHECK(dialog.max.x <= width);
        CHECK(dialog.max.y <= height);
        if (width < 1000)
            continue;
        const int drawn = d.editor().dialogs().repair.preview().drawn();
        CHECK(drawn > 0);
        d.click("repair/before");
        d.frame(2);
        CHECK(d.editor().dialogs().repair.preview().drawn() > drawn);
    }
}

TEST_CASE("A mesh that is refused for its defects is offered repaired", "[editor][ui][repair]") {
    const test::TempDir folder;
    const auto file = folder.path() / "strap 2.obj";
    TriMesh mesh = two_boxes(); // with a flap, so that it does not close
    mesh.positions.emplace_back(0, 0, 30);
    mesh.triangles.push_back({4, 5, 16});
    write_mesh_file(file, {mesh, {}, {}, {}, {}});
    Driver d;
    d.frame(3);
    d.editor().drop_files({file});
    const MeshBatch& batch = d.editor().dialogs().mesh.batch();
    wait_for(d, [&] { return batch.entries().size() == 1 && !batch.reading(); });
    d.click("mesh/muscle");
    std::string why;
    CHECK_FALSE(batch.ready(why));
    d.click("mesh/repair");
    CHECK(batch.ready(why));
    d.click("mesh/add");
    d.frame(2);
    REQUIRE(d.document().scene().muscles.size() == 2);
    const MeshReport report = check_mesh(*d.document().scene().muscles.back().mesh);
    CHECK(report.closed());
    CHECK(report.nonmanifold_edges == 0);
}
