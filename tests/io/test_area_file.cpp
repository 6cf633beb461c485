#include "fascicle/anatomy/attached_vertices.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/brush.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "fascicle/geometry/region_ops.hpp"
#include "fascicle/geometry/vertex_normals.hpp"
#include "fascicle/io/area_file.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "geometry/surface_shapes.hpp"
#include "support/data_dir.hpp"
#include "support/temp_dir.hpp"

#include "fascicle/io/load_scene.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

/// A plate and a ball as bones, one muscle with an origin of two heads on the plate: a ring with an island in its hole, a disc;
/// and an insertion on the ball.
Scene painted_scene() {
    Scene scene;
    scene.bones.push_back({"plate", shared(box_mesh(Vec3(0, 0, 0), Vec3(60, 50, 3), {60, 50, 3})), {}});
    scene.bones.push_back({"ball", shared(sphere(10, 4, Vec3(100, 0, 0))), {}});
    Muscle muscle;
    muscle.name = "strap";
    muscle.mesh = shared(sphere(5, 2, Vec3(30, 25, 8)));
    const SurfaceGraph plate(scene.bones[0].mesh), ball(scene.bones[1].mesh);
    const auto r = [](const Vec3& p, double x, double y) { return std::hypot(p.x() - x, p.y() - y); };
    muscle.areas.push_back(
        {AttachmentKind::origin, 0, "", region_where<SurfaceRegion>(plate, [&](const Vec3& p) {
             return p.z() > 2.9 && ((r(p, 20, 25) < 15 && r(p, 20, 25) > 8) || r(p, 20, 25) < 3);
         })});
    muscle.areas.push_back(
        {AttachmentKind::origin, 0, "long",
         region_where<SurfaceRegion>(plate, [&](const Vec3& p) { return p.z() > 2.9 && r(p, 48, 25) < 8; })});
    muscle.areas.push_back({AttachmentKind::insertion, 1, "",
                            region_where<SurfaceRegion>(ball, [](const Vec3& p) { return p.x() > 106; })});
    scene.muscles.push_back(muscle);
    return scene;
}

} // namespace

TEST_CASE("areas come back from their outlines to the vertex", "[io][area_file]") {
    for (const LengthUnit unit : {LengthUnit::millimetre, LengthUnit::metre}) {
        Scene scene = painted_scene();
        scene.unit = unit;
        if (unit == LengthUnit::metre)
            for (Bone& bone : scene.bones) {
                TriMesh mesh = *bone.mesh;
                for (Vec3& p : mesh.positions)
                    p *= 1e-3;
                bone.mesh = shared(mesh);
            }
        BoneSurfaces surfaces;
        std::vector<std::string> notes;
        const std::string csv = area_outlines_csv(scene, scene.muscles[0], surfaces, notes);
        CHECK(notes.empty());
        Muscle again;
        again.name = "strap";
        again.outlines = read_attachments(csv, "a.csv", unit);
        CHECK(again.outlines.size() == 5); // ring: two borders, its island, disc, cap
        const auto areas = areas_from_outlines(scene, again, surfaces, notes);
        CHECK(notes.empty());
        CHECK(areas == scene.muscles[0].areas);
    }
}

TEST_CASE("an area without a border, or that outlines cannot tell", "[io][area_file]") {
    Scene scene = painted_scene();
    BoneSurfaces surfaces;
    std::vector<std::string> notes;
    scene.muscles[0].areas[2].vertices =
        scene.muscles[0].areas[2].vertices.complement() | scene.muscles[0].areas[2].vertices;
    CHECK_THROWS_WITH(area_outlines_csv(scene, scene.muscles[0], surfaces, notes),
                      Contains("strap: insertion on 'ball'") && Contains("no border"));
    const SurfaceGraph ball(scene.bones[1].mesh);
    scene.muscles[0].areas[2].vertices =
        region_where<SurfaceRegion>(ball, [](const Vec3& p) { return std::abs(p.x() - 100) < 2; });
    area_outlines_csv(scene, scene.muscles[0], surfaces, notes);
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Contains("the outlines differ from the area"));
}

TEST_CASE("outline tables know heads, loops and holes", "[io][area_file]") {
    const auto outlines = read_attachments("attachment,bone,head,loop,hole,x,y,z\norigin,b,long,1,0,1,2,3\n"
                                           "origin,b,long,1,0,1,2,4\norigin,b,long,2,,1,2,3\n"
                                           "origin,b,long,2,1,1,2,3\norigin,b,short,2,1,1,2,3\n",
                                           "a.csv", LengthUnit::millimetre);
    REQUIRE(outlines.size() == 4);
    CHECK((outlines[0].points.size() == 2 && outlines[0].head == "long" && !outlines[0].hole));
    CHECK((outlines[2].hole && outlines[3].hole && outlines[3].head == "short"));
    CHECK_THROWS_WITH(
        read_attachments("attachment,bone,hole,x,y,z\norigin,b,2,1,2,3\n", "a.csv", LengthUnit::millimetre),
        Contains("hole is") && Contains("0 or 1"));
}

TEST_CASE("areas go through the point arrays of a mesh file", "[io][area_file]") {
    Scene scene = painted_scene();
    Muscle other;
    other.name = "other";
    other.mesh = scene.muscles[0].mesh;
    other.areas = {scene.muscles[0].areas[1]}; // overlaps another muscle's: allowed
    other.areas[0].head = "";
    scene.muscles.push_back(other);
    const TempDir dir;
    const auto file = dir.path() / GENERATE("plate.vtp", "plate.vtk");
    scene.muscles[0].name = "strap 50 %";
    write_mesh_file(file, area_mesh(scene, 0));
    auto strap = read_area_mesh(file, scene, 0, "strap 50 %");
    REQUIRE(strap.size() == 2);
    CHECK(strap[0].vertices == scene.muscles[0].areas[0].vertices);
    CHECK(strap[1].vertices == scene.muscles[0].areas[1].vertices);
    CHECK(read_area_mesh(file, scene, 0, "other") == other.areas);
    CHECK_THROWS_WITH(read_area_mesh(file, scene, 0, "third"), Contains("no point array 'attachment'"));
    CHECK_THROWS_WITH(read_area_mesh(file, scene, 1, "strap"), Contains("bone 'ball'"));
    write_mesh_file(file, area_mesh(scene, 0, 1));
    CHECK(read_area_mesh(file, scene, 0, "any name") == other.areas);
    MeshData moved = area_mesh(scene, 0, 1);
    moved.mesh.positions[7].x() += 1;
    CHECK_THROWS_WITH(areas_from_mesh(moved, "m.vtp", scene, 0, "x"),
                      Contains("m.vtp: vertex 7 is not where"));
    moved = area_mesh(scene, 0, 1);
    moved.point_arrays[0].values[3] = -2;
    CHECK_THROWS_WITH(areas_from_mesh(moved, "m.vtp", scene, 0, "x"), Contains("the label of vertex 3"));
}

TEST_CASE("a patch file marks the bone", "[io][area_file]") {
    const Scene scene = painted_scene();
    BoneSurfaces surfaces;
    const TempDir dir;
    MeshData patch;
    patch.mesh = sheet(10, 10);
    for (Vec3& p : patch.mesh.positions)
        p += Vec3(20.2, 20.2, 3.1);
    write_mesh_file(dir.path() / "patch.obj", patch);
    CHECK(read_area_patch(dir.path() / "patch.obj", scene.bones[0], surfaces, 0.5).size() == 121);
    CHECK_THROWS_WITH(read_area_patch(dir.path() / "patch.obj", scene.bones[1], surfaces, 0.5),
                      Contains("no vertex of bone 'ball'"));
}

TEST_CASE("a project keeps areas, and leaves those out whose bone was replaced", "[io][project]") {
    Scene scene = painted_scene();
    const TempDir dir;
    MeshData data;
    for (Bone& bone : scene.bones) {
        bone.source.path = (dir.path() / (bone.name + ".obj")).string();
        data.mesh = *bone.mesh;
        write_mesh_file(bone.source.path, data);
        std::vector<std::string> none;
        bone.source = load_bone(bone.source.path, none).source; // with its hash: named, not carried
    }
    scene.muscles[0].source.path = (dir.path() / "strap.obj").string();
    data.mesh = *scene.muscles[0].mesh;
    write_mesh_file(scene.muscles[0].source.path, data);
    scene.muscles[0].outlines = {{AttachmentKind::origin, "plate", {Vec3(1, 2, 3)}, "long", true}};
    const auto file = dir.path() / "a.fascicle";
    write_project_file(file, scene);
    Project project = read_project_file(file);
    CHECK(project.scene.muscles[0].areas == scene.muscles[0].areas);
    CHECK((project.scene.muscles[0].outlines[0].head == "long" && project.scene.muscles[0].outlines[0].hole));
    project.scene.muscles[0].areas.clear();
    write_project_file(dir.path() / "b.fascicle", project.scene, project.text);
    CHECK(read_project_file(dir.path() / "b.fascicle").scene.muscles[0].areas.empty()); // not kept as unknown

    std::string text = read_file(file);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        const auto at = changed.find(from);
        REQUIRE(at != std::string::npos);
        changed.replace(at, from.size(), to);
        write_file(dir.path() / "bad.fascicle", changed);
        return dir.path() / "bad.fascicle";
    };
    CHECK_THROWS_WITH(read_project_file(with("\"ranges\": [", "\"ranges\": [ 7,")), Contains("ranges"));
    CHECK_THROWS_WITH(read_project_file(with("\"ranges\": [", "\"ranges\": [ 9, 7,")), Contains("ranges"));
    CHECK_THROWS_WITH(read_project_file(with("\"ranges\": [", "\"ranges\": [ -1, 7,")), Contains("ranges"));
    CHECK_THROWS_WITH(read_project_file(with("\"ranges\": [", "\"ranges\": [ 0, 70000000,")),
                      Contains("ranges"));

    data.mesh = sphere(10, 3, Vec3(100, 0, 0));
    write_mesh_file(scene.bones[1].source.path, data);
    project = read_project_file(file);
    CHECK(project.scene.muscles[0].areas.size() == 2);
    std::string notes;
    for (const std::string& note : project.notes)
        notes += note + "\n";
    CHECK_THAT(notes, Contains("strap: insertion on 'ball' is left out: it was made for another mesh"));
}

TEST_CASE("LHDL: areas from the digitised outlines", "[io][area_file][data]") {
    FASCICLE_NEED_DATA(data);
    Scene scene;
    for (const char* name : {"right_iliac.vtk", "femur.vtk"})
        scene.bones.push_back({std::string(name).substr(0, std::string(name).find('.')),
                               shared(read_mesh_file(data / "lhdl" / name).mesh),
                               {}});
    Muscle iliacus, gluteus;
    iliacus.name = "iliacus";
    iliacus.mesh = shared(read_mesh_file(data / "lhdl/iliacus.vtk").mesh);
    iliacus.outlines = read_attachment_file(data / "lhdl/iliacus_attachments.csv", LengthUnit::millimetre);
    gluteus.name = "gluteus_maximus";
    gluteus.outlines =
        read_attachment_file(data / "lhdl/gluteus_maximus_attachments.csv", LengthUnit::millimetre);
    BoneSurfaces surfaces;
    std::vector<std::string> notes;
    const auto areas = areas_from_outlines(scene, iliacus, surfaces, notes);
    CHECK(notes.empty());
    REQUIRE(areas.size() == 2);
    // The iliac fossa; 62 cm2, one piece. Its vertices attach what the outline attaches.
    const SurfaceGraph& ilium = surfaces.graph(scene.bones[0].mesh);
    const RegionMeasure m = measure_region(ilium, areas[0].vertices);
    CHECK(m.area == Approx(6197).epsilon(0.02));
    CHECK((m.islands == 1 && m.holes == 0));
    const auto by_area = vertices_of(attached_vertices(
        areas[0].vertices, surfaces.search(scene.bones[0].mesh), *iliacus.mesh, attach_rules(1)));
    const auto by_outline = attach_by_outline(
        *iliacus.mesh, iliacus.outlines[0].points,
        [&](const Vec3& p, double limit) {
            return std::sqrt(ilium.tree().closest(p, limit * 1.0001).squared_distance);
        },
        attach_rules(1));
    std::vector<int> both;
    std::set_intersection(by_outline.begin(), by_outline.end(), by_area.begin(), by_area.end(),
                          std::back_inserter(both));
    CHECK(double(both.size()) > 0.98 * double(std::max(by_outline.size(), by_area.size())));

    // The sacrum is not in this scene: its outline is left out, and says so.
    CHECK(areas_from_outlines(scene, gluteus, surfaces, notes).size() == 2);
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Contains("gluteus_maximus: origin on 'sacrum' is left out"));
    // A bone of the outline's name that lies elsewhere is a mistake.
    scene.bones[1].name = "sacrum";
    CHECK_THROWS_WITH(areas_from_outlines(scene, gluteus, surfaces, notes),
                      Contains("gluteus_maximus: origin on 'sacrum'") &&
                          Contains("from the bone on average"));
}

TEST_CASE("LHDL: the brush on the iliac fossa leaves the outer side of the blade alone",
          "[io][area_file][data]") {
    FASCICLE_NEED_DATA(data);
    const MeshPtr mesh = shared(read_mesh_file(data / "lhdl/right_iliac.vtk").mesh);
    const SurfaceGraph graph(mesh);
    GeodesicSearch search(graph);
    const Points normals = vertex_normals(mesh->positions, mesh->triangles);
    const auto outlines = read_attachment_file(data / "lhdl/iliacus_attachments.csv", LengthUnit::millimetre);
    const SurfaceRegion fossa =
        area_from_outline(search, outlines[0].points, outline_area_rules(1), "iliacus");
    Vec3 outward = Vec3::Zero();
    fossa.for_each([&](int v) { outward += normals[std::size_t(v)]; });
    Brush brush;
    brush.radius = 8;
    int near_back = 0;
    const std::vector<int> inner = shrink(search, fossa, 12).vertices();
    REQUIRE(inner.size() > 100);
    for (std::size_t k = 0; k < inner.size(); k += inner.size() / 20) {
        const Vec3& p = graph.position(inner[k]);
        for (const int v : brush_vertices(search, foot(graph, p), brush)) {
            CHECK(fossa.contains(v));
            CHECK(normals[std::size_t(v)].dot(outward) > 0);
        }
        brush.reach = BrushReach::sphere;
        for (const int v : brush_vertices(search, foot(graph, p), brush))
            near_back += normals[std::size_t(v)].dot(outward) < 0 ? 1 : 0;
        brush.reach = BrushReach::connected;
    }
    CHECK(near_back > 100); // the other side is within the radius in a straight line
}
