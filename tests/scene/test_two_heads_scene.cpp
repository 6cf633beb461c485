#include "fascicle/geometry/line_hits.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/scene/embedded_scenes.hpp"

#include "../geometry/surface_checks.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("the two-headed muscle has two origins, one belly, fibres on its front, and clears its bones",
          "[scene][embedded][two_heads]") {
    const Scene scene = make_embedded_scene("two-heads", 2);
    REQUIRE(scene.bones.size() == 3);
    const Muscle& muscle = scene.muscles.at(0);
    const TriMesh& mesh = *muscle.mesh;
    CHECK(mesh.triangle_count() == 6000);
    const auto r = test::report(mesh);
    CHECK(r.euler == 2);
    CHECK(r.mean_quality > 0.93);
    CHECK(r.longest_edge / r.shortest_edge < 12.0);

    // One gap between the heads, none further down.
    const TriangleBvh bvh(mesh);
    const auto parts = [&](double z) {
        std::vector<LineHit> hits;
        std::vector<LineInterval> intervals;
        bvh.line_hits(Vec3(-60, -9, z), Vec3::UnitX(), hits);
        inside_intervals(hits, 1e-9, intervals);
        return intervals.size();
    };
    for (const double z : {78.0, 65.0, 50.0, 40.0})
        CHECK(parts(z) == 2);
    for (const double z : {15.0, 0.0, -30.0, -60.0, -80.0})
        CHECK(parts(z) == 1);

    const SolidQuery solid(mesh);
    for (const Bone& bone : scene.bones) {
        const SolidQuery query(*bone.mesh);
        for (const Vec3& p : mesh.positions)
            REQUIRE(query.signed_distance(p, 3.0) > 0.25);
    }
    REQUIRE(muscle.attachments.size() == 3);
    CHECK(muscle.attachments[0].kind == AttachmentKind::origin);
    CHECK(muscle.attachments[1].kind == AttachmentKind::origin);
    CHECK(muscle.attachments[2].kind == AttachmentKind::insertion);
    for (const Attachment& a : muscle.attachments)
        CHECK(a.vertices.size() >= 20);

    REQUIRE(muscle.surface_fibres);
    REQUIRE(muscle.surface_fibres->lines.size() == 6);
    for (const Vec3& p : muscle.surface_fibres->points) {
        CHECK(std::abs(solid.signed_distance(p)) < 0.3);
        CHECK(p.y() < -7.0);
    }
    // The lever pulls: where it is attached goes down and away from the blocks.
    const Vec3 tip(0, -8, -86);
    CHECK(scene.timeline.bone_pose(2, 100).apply(tip).z() < tip.z() - 15.0);
    CHECK(scene.timeline.bone_pose(0, 100).is_identity());
}
