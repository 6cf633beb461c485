#include "fascicle/geometry/primitives.hpp"
#include "fascicle/simulation/prepare.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

/// A flat muscle lying 0.5 above a plate.
Scene lying_muscle() {
    Scene scene;
    scene.bones.push_back({"plate", shared(box_mesh(Vec3(0, 0, -4), Vec3(40, 30, 0), {20, 15, 2})), {}});
    Muscle muscle;
    muscle.name = "sheet";
    muscle.mesh = shared(box_mesh(Vec3(2, 2, 0.5), Vec3(38, 28, 5), {18, 13, 2}));
    scene.muscles.push_back(muscle);
    scene.parameters.set("contact.grid_mm", 4);
    return scene;
}

AttachmentArea area_where(const Scene& scene, AttachmentKind kind, bool (*accept)(const Vec3&)) {
    const SurfaceGraph graph(scene.bones[0].mesh);
    return {kind, 0, "", region_where<SurfaceRegion>(graph, accept)};
}

} // namespace

TEST_CASE("painted areas come after attachments and before outlines and nearness", "[simulation][areas]") {
    Scene scene = lying_muscle();
    Muscle& muscle = scene.muscles[0];
    const auto attached = [&] { return prepare_scene(scene, 1, {}, nullptr).muscles[0].attachments; };
    const auto near = attached();
    muscle.outlines = {{AttachmentKind::insertion,
                        "plate",
                        {Vec3(4, 4, 0), Vec3(14, 4, 0), Vec3(14, 14, 0), Vec3(4, 14, 0)}}};
    const auto by_outline = attached();
    muscle.areas = {
        area_where(scene, AttachmentKind::origin, [](const Vec3& p) { return p.z() > -0.1 && p.x() > 25; })};
    const auto by_area = attached();
    REQUIRE((near.size() == 1 && by_outline.size() == 1 && by_area.size() == 1));
    CHECK(near[0].vertices != by_outline[0].vertices);
    CHECK(by_outline[0].kind == AttachmentKind::insertion);
    CHECK(by_area[0].kind == AttachmentKind::origin);
    CHECK(by_area[0].vertices.size() > 20);
    for (const int v : by_area[0].vertices) {
        const Vec3& p = muscle.mesh->positions[std::size_t(v)];
        CHECK((p.z() < 0.6 && p.x() > 25 - 1 - 3.5));
    }
    muscle.attachments = {{AttachmentKind::unknown, 0, {0, 1, 2}}};
    CHECK(attached()[0].vertices == std::vector<int>{0, 1, 2});
    muscle.attachments.clear();
    // Not painted yet: as if there were none.
    muscle.areas[0].vertices = SurfaceRegion(scene.bones[0].mesh->vertex_count());
    CHECK(attached()[0].vertices == by_outline[0].vertices);
}

TEST_CASE("an area of another mesh, and one that reaches nothing, are said and left out",
          "[simulation][areas]") {
    Scene scene = lying_muscle();
    Muscle& muscle = scene.muscles[0];
    muscle.areas = {
        area_where(scene, AttachmentKind::origin, [](const Vec3& p) { return p.z() > -0.1 && p.x() > 25; }),
        area_where(scene, AttachmentKind::insertion, [](const Vec3& p) { return p.z() < -3.9; })};
    muscle.areas.push_back({AttachmentKind::insertion, 0, "long", SurfaceRegion(3, std::vector<int>{1})});
    muscle.areas.push_back({AttachmentKind::insertion, 9, "", SurfaceRegion(3, std::vector<int>{1})});
    const PreparedScene prepared = prepare_scene(scene, 1, {}, nullptr);
    CHECK(prepared.muscles[0].attachments.size() == 1);
    std::string notes;
    for (const std::string& note : prepared.notes)
        notes += note + "\n";
    CHECK_THAT(notes, Contains("sheet: insertion on 'plate' reaches no vertex of the muscle"));
    CHECK_THAT(
        notes,
        Contains("sheet: insertion of head 'long' on 'plate' is left out: it was made for another mesh"));
    CHECK_THAT(notes, Contains("sheet: insertion on '?' is left out"));
}
