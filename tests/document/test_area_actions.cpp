#include "fascicle/document/actions/area_actions.hpp"
#include "fascicle/document/actions/scene_actions.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "fascicle/geometry/region_ops.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;
using actions::AreaKey;
using actions::AreaStroke;

namespace {

const AreaKey origin{0, AttachmentKind::origin, 1, ""}, insertion{0, AttachmentKind::insertion, 1, ""},
    other{1, AttachmentKind::origin, 1, ""};

Document two_plates() {
    Scene scene;
    scene.bones.push_back({"left", shared(box_mesh(Vec3(-70, 0, 0), Vec3(-10, 40, 2), {60, 40, 2})), {}});
    scene.bones.push_back({"right", shared(box_mesh(Vec3(10, 0, 0), Vec3(70, 40, 2), {60, 40, 2})), {}});
    for (const char* name : {"gluteus", "iliacus"}) {
        Muscle muscle;
        muscle.name = name;
        muscle.mesh = shared(tetrahedron());
        scene.muscles.push_back(muscle);
    }
    return Document(std::move(scene));
}

actions::StrokeOptions options_of(double radius, actions::StrokeMode mode = actions::StrokeMode::paint) {
    actions::StrokeOptions options;
    options.mode = mode;
    options.brush.radius = radius;
    return options;
}

SurfaceRegion painted(const Document& document, const AreaKey& key) {
    const AttachmentArea* area = actions::find_area(document.scene(), key);
    return area == nullptr ? SurfaceRegion(document.scene().bones[std::size_t(key.bone)].mesh->vertex_count())
                           : area->vertices;
}

std::size_t steps(const Document& document) {
    return document.history().steps().size();
}

} // namespace

TEST_CASE("A stroke is one step with the area's name, and nothing before the release", "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    const SurfaceGraph& graph = surfaces.graph(document.scene().bones[1].mesh);
    {
        AreaStroke stroke(document, surfaces, insertion, options_of(5));
        SurfaceRegion sum(graph.vertex_count());
        for (int x = 20; x <= 50; x += 3) {
            const auto changed = stroke.step(foot(graph, Vec3(x, 20.5, 2)));
            for (const int v : changed)
                CHECK_FALSE(sum.contains(v)); // only what is new
            sum.insert(changed);
            CHECK(painted(document, insertion) == sum);
            CHECK(steps(document) == 1);
        }
        CHECK(document.head()->muscles[0].areas.empty());
        CHECK(stroke.step(foot(graph, Vec3(50, 20.5, 2))).size() < 5);
        CHECK(stroke.step(SurfacePoint{}).empty());
        CHECK(stroke.finish());
    }
    CHECK(steps(document) == 2);
    CHECK(document.history().undo_name() == "Paint insertion, gluteus");
    const SurfaceRegion all = painted(document, insertion);
    CHECK(measure_region(graph, all).area == Approx(30 * 10 + 3.14159 * 25).epsilon(0.06));
    CHECK(document.undo());
    CHECK(painted(document, insertion).empty());
    CHECK(document.redo());
    CHECK(painted(document, insertion) == all);
}

TEST_CASE("A stroke that changes nothing is no step, Esc leaves no trace", "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    const SurfaceGraph& graph = surfaces.graph(document.scene().bones[1].mesh);
    {
        AreaStroke stroke(document, surfaces, origin, options_of(5, actions::StrokeMode::erase));
        CHECK(stroke.step(foot(graph, Vec3(30, 20, 2))).empty());
        CHECK_FALSE(stroke.finish());
    }
    CHECK_FALSE(document.has_uncommitted_edits());
    {
        AreaStroke stroke(document, surfaces, origin, options_of(5));
        CHECK_FALSE(stroke.step(foot(graph, Vec3(30, 20, 2))).empty());
        stroke.cancel();
    }
    {
        AreaStroke stroke(document, surfaces, origin, options_of(5));
        stroke.step(foot(graph, Vec3(30, 20, 2)));
    } // forgotten: as cancelled
    CHECK(painted(document, origin).empty());
    CHECK(steps(document) == 1);
    CHECK_FALSE(document.has_uncommitted_edits());
    CHECK_FALSE(document.dirty());
}

TEST_CASE("Areas of one muscle never overlap on a bone, those of two may", "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    const SurfaceGraph& graph = surfaces.graph(document.scene().bones[1].mesh);
    const auto dab = [&](const AreaKey& key, double x, actions::StrokeOptions options) {
        AreaStroke stroke(document, surfaces, key, std::move(options));
        stroke.step(foot(graph, Vec3(x, 20, 2)));
        return stroke.finish();
    };
    CHECK(dab(origin, 30, options_of(8)));
    const SurfaceRegion first = painted(document, origin);
    CHECK(dab(other, 36, options_of(8)));
    CHECK(painted(document, origin) == first); // another muscle's
    CHECK(dab(insertion, 36, options_of(8)));
    CHECK_FALSE(painted(document, origin).intersects(painted(document, insertion)));
    CHECK((painted(document, origin) | painted(document, insertion)).includes(first));
    CHECK(painted(document, insertion) == painted(document, other));
    // Locked: nothing is taken from it.
    actions::StrokeOptions options = options_of(11);
    options.locked = {insertion};
    const SurfaceRegion kept = painted(document, insertion);
    CHECK(dab(origin, 36, options));
    CHECK(painted(document, insertion) == kept);
    // Erased to the last vertex an area is gone.
    CHECK(dab(insertion, 36, options_of(30, actions::StrokeMode::erase)));
    CHECK(actions::find_area(document.scene(), insertion) == nullptr);
    CHECK(document.history().undo_name() == "Erase insertion, gluteus");
}

TEST_CASE("Shift smooths the border under the brush alone", "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    const SurfaceGraph& graph = surfaces.graph(document.scene().bones[1].mesh);
    std::mt19937 random(4);
    SurfaceRegion ragged = region_where<SurfaceRegion>(graph, [&](const Vec3& p) {
        return p.z() > 1.9 && (p.x() < 37 || (p.x() < 43 && random() % 2 == 0));
    });
    CHECK(actions::set_area(document, origin, ragged));
    AreaStroke stroke(document, surfaces, origin, options_of(8, actions::StrokeMode::smooth));
    const auto changed = stroke.step(foot(graph, Vec3(40, 20, 2)));
    CHECK(changed.size() > 5);
    for (const int v : changed)
        CHECK((graph.position(v) - Vec3(40, 20, 2)).norm() < 8.3);
    CHECK(stroke.finish());
    CHECK(measure_region(graph, painted(document, origin)).islands < measure_region(graph, ragged).islands);
}

TEST_CASE("A mirrored stroke paints the pair, as one step", "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    const SurfaceGraph& graph = surfaces.graph(document.scene().bones[1].mesh);
    const AreaKey left{1, AttachmentKind::origin, 0, ""};
    actions::StrokeOptions options = options_of(6);
    options.mirror = actions::StrokeMirror{left, {Vec3::Zero(), Vec3::UnitX()}, 1.0};
    options.brush.eye = Vec3(30, 20, 1000);
    AreaStroke stroke(document, surfaces, origin, options);
    for (const double x : {25.0, 32.0, 38.0}) {
        stroke.step(foot(graph, Vec3(x, 20, 2)));
        CHECK_FALSE(stroke.mirrored_changes().empty());
    }
    CHECK(stroke.finish());
    CHECK(steps(document) == 2);
    const SurfaceGraph& pair = surfaces.graph(document.scene().bones[0].mesh);
    const RegionMeasure a = measure_region(graph, painted(document, origin)),
                        b = measure_region(pair, painted(document, left));
    CHECK(a.area == Approx(b.area).epsilon(0.03)); // the diagonals are not mirrored
    CHECK((mirrored(a.centroid, options.mirror->plane) - b.centroid).norm() < 0.2);
    CHECK(document.undo());
    CHECK(painted(document, left).empty());
}

TEST_CASE("Setting an area, and areas when bones go", "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    const SurfaceGraph& graph = surfaces.graph(document.scene().bones[1].mesh);
    const SurfaceRegion half = region_where<SurfaceRegion>(graph, [](const Vec3& p) { return p.x() < 40; });
    CHECK_FALSE(actions::set_area(document, origin, SurfaceRegion(graph.vertex_count())));
    CHECK(actions::set_area(document, origin, half));
    CHECK_FALSE(actions::set_area(document, origin, half));
    CHECK(actions::set_area(document, insertion, grow_ring(graph, half.complement()), "Grow"));
    CHECK(document.history().undo_name() == "Grow insertion, gluteus");
    CHECK_FALSE(painted(document, origin).intersects(painted(document, insertion)));
    CHECK(actions::set_area(document, insertion, SurfaceRegion(graph.vertex_count()), "Clear"));
    CHECK(actions::find_area(document.scene(), insertion) == nullptr);
    CHECK(steps(document) == 4);
    const SurfaceRegion before = painted(document, origin);
    actions::remove_bone(document, 0);
    REQUIRE(document.scene().muscles[0].areas.size() == 1);
    CHECK(document.scene().muscles[0].areas[0].bone == 0);
    CHECK(document.scene().muscles[0].areas[0].vertices == before);
    actions::remove_bone(document, 0);
    CHECK(document.scene().muscles[0].areas.empty());
}

TEST_CASE("Outlines become areas in one step", "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    std::vector<std::string> notes;
    CHECK(actions::areas_from_outlines(document, 0, surfaces, notes) == 0);
    Scene scene = document.scene();
    scene.muscles[0].outlines = {
        {AttachmentKind::origin,
         "right",
         {Vec3(20.5, 10.5, 2), Vec3(40.5, 10.5, 2), Vec3(40.5, 22.5, 2), Vec3(22.5, 22.5, 2)}},
        {AttachmentKind::insertion, "elsewhere", {Vec3(0, 0, 90), Vec3(1, 0, 90)}}};
    Document with(scene);
    CHECK(actions::areas_from_outlines(with, 0, surfaces, notes) == 1);
    CHECK(notes.size() == 1);
    CHECK(with.history().undo_name() == "Areas from outlines, gluteus");
    CHECK(measure_region(surfaces.graph(scene.bones[1].mesh), painted(with, origin)).area ==
          Approx(0.5 * (20 + 18) * 12).epsilon(0.07));
    CHECK(steps(with) == 2);
}

TEST_CASE("A stroke takes vertices that another tool found, with locks, mirror and a name of its own",
          "[document][areas]") {
    Document document = two_plates();
    BoneSurfaces surfaces;
    const MeshPtr mesh = document.scene().bones[1].mesh;
    actions::set_area(document, origin, SurfaceRegion(mesh->vertex_count(), std::vector<int>{3, 4, 5}));
    actions::StrokeOptions options;
    options.what = "Lasso";
    options.locked = {origin};
    AreaKey left = insertion;
    left.bone = 0;
    options.mirror = actions::StrokeMirror{left, {}, 5};
    AreaStroke stroke(document, surfaces, insertion, options);
    CHECK(stroke.touch({1, 2, 3, 4, 8}, {6, 7}) == std::vector<int>{1, 2, 8});
    CHECK(stroke.touch({1, 2, 9}, {}) == std::vector<int>{9});
    CHECK(stroke.finish());
    CHECK(document.history().undo_name() == "Lasso insertion, gluteus");
    CHECK(painted(document, insertion).vertices() == std::vector<int>{1, 2, 8, 9});
    CHECK(painted(document, left).vertices() == std::vector<int>{6, 7});
    CHECK(painted(document, origin).size() == 3);
}

TEST_CASE("A head goes with all its areas, given attachments give way to areas", "[document][areas]") {
    Document document = two_plates();
    const int count = document.scene().bones[1].mesh->vertex_count();
    AreaKey of_head = insertion;
    of_head.head = "long";
    actions::set_area(document, insertion, SurfaceRegion(count, std::vector<int>{1}));
    actions::set_area(document, of_head, SurfaceRegion(count, std::vector<int>{2}));
    const std::size_t before = steps(document);
    CHECK_FALSE(actions::remove_head(document, 0, "short"));
    CHECK(steps(document) == before);
    CHECK(actions::remove_head(document, 0, "long"));
    CHECK(document.history().undo_name() == "Remove head long, gluteus");
    CHECK(document.scene().muscles[0].areas.size() == 1);
    CHECK_FALSE(actions::drop_fixed_attachments(document, 0));
    document.edit().muscles[0].attachments = {{AttachmentKind::origin, 0, {0}}};
    document.commit("Given");
    CHECK(actions::drop_fixed_attachments(document, 0));
    CHECK(document.scene().muscles[0].attachments.empty());
    CHECK(document.undo());
    CHECK(document.scene().muscles[0].attachments.size() == 1);
}
