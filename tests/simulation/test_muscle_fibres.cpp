// From a scene to the fibres of its muscles: what is handed to the methods, and what is said when they cannot be made.

#include "fascicle/geometry/primitives.hpp"
#include "fascicle/simulation/muscle_fibres.hpp"
#include "fascicle/simulation/prepare.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

Scene bar_scene() {
    Scene scene;
    scene.bones.push_back(
        {"fixed", std::make_shared<TriMesh>(box_mesh(Vec3(-20, -8, -8), Vec3(-0.5, 8, 8), {4, 4, 4})), {}});
    scene.bones.push_back(
        {"sled", std::make_shared<TriMesh>(box_mesh(Vec3(60.5, -8, -8), Vec3(80, 8, 8), {4, 4, 4})), {}});
    Muscle bar;
    bar.name = "bar";
    bar.mesh = std::make_shared<TriMesh>(box_mesh(Vec3(0, -5, -5), Vec3(60, 5, 5), {24, 4, 4}));
    bar.attach_automatically = false;
    scene.muscles.push_back(bar);
    scene.timeline = make_shift_timeline(Vec3(-5, 0, 0), {10, 0, 0}, 2, 1);
    scene.parameters.set_text("fibres.method", "kukacka");
    scene.parameters.set("fibres.count", 9);
    return scene;
}

AttachmentOutline square(AttachmentKind kind, const char* bone, double x, double size = 4) {
    return {
        kind, bone, {Vec3(x, -size, -size), Vec3(x, size, -size), Vec3(x, size, size), Vec3(x, -size, size)}};
}

} // namespace

TEST_CASE("fibres of a bar by its outlines run from one end to the other", "[simulation][muscle_fibres]") {
    Scene scene = bar_scene();
    scene.muscles[0].outlines = {square(AttachmentKind::origin, "fixed", 0),
                                 square(AttachmentKind::insertion, "sled", 60)};
    const PreparedScene prepared = prepare_scene(scene, 1, {});
    REQUIRE(prepared.muscles[0].fibres != nullptr);
    const FibreSet& fibres = prepared.muscles[0].fibres->rest;
    CHECK(fibres.count == 9);
    for (int f = 0; f < fibres.count; ++f) {
        CHECK(fibres.fibre(f).front().x() == Approx(0.0).margin(0.2));
        CHECK(fibres.fibre(f).back().x() == Approx(60.0).margin(0.2));
    }
    // Both outlines are alone of their kind: the patches know them.
    const auto patches = fibre_patches(scene, scene.muscles[0], prepared.muscles[0].attachments);
    REQUIRE(patches.size() == 2);
    CHECK(patches[0].outline.size() == 4);
    // The direction of the fibres is the muscle's anisotropy: along x.
    const auto& along = prepared.muscles[0].problem.edge_along;
    const MeshTopology topology(scene.muscles[0].mesh->vertex_count(), scene.muscles[0].mesh->triangles);
    REQUIRE(along.size() == topology.edges().size());
    double least = 1;
    for (std::size_t e = 0; e < along.size(); ++e) {
        const Vec3 u = (scene.muscles[0].mesh->positions[static_cast<std::size_t>(topology.edges()[e].b)] -
                        scene.muscles[0].mesh->positions[static_cast<std::size_t>(topology.edges()[e].a)])
                           .normalized();
        if (std::abs(u.x()) > 0.999)
            least = std::min(least, along[e]);
    }
    CHECK(least > 0.9);
}

TEST_CASE("no fibres when none are wanted", "[simulation][muscle_fibres]") {
    Scene scene = bar_scene();
    scene.parameters.set_text("fibres.method", "none");
    scene.muscles[0].outlines = {square(AttachmentKind::origin, "fixed", 0),
                                 square(AttachmentKind::insertion, "sled", 60)};
    CHECK(prepare_scene(scene, 1, {}).muscles[0].fibres == nullptr);
}

TEST_CASE("what is wrong with the attachments is said with the muscle's and the bone's name",
          "[simulation][muscle_fibres]") {
    using Catch::Matchers::Contains;
    Scene scene = bar_scene();
    Muscle& bar = scene.muscles[0];
    const AttachmentOutline origin = square(AttachmentKind::origin, "fixed", 0);
    const AttachmentOutline insertion = square(AttachmentKind::insertion, "sled", 60);
    SECTION("an outline far away") {
        bar.outlines = {square(AttachmentKind::origin, "fixed", -100), insertion};
        CHECK_THROWS_WITH(prepare_scene(scene, 1, {}),
                          Contains("bar") && Contains("origin outline on 'fixed'") && Contains("mm away"));
    }
    SECTION("both on the same spot") {
        AttachmentOutline same = origin;
        same.kind = AttachmentKind::insertion;
        same.bone = "sled";
        bar.outlines = {origin, same};
        CHECK_THROWS_WITH(prepare_scene(scene, 1, {}), Contains("bar") && Contains("insertion"));
    }
    SECTION("no insertion") {
        bar.outlines = {origin};
        CHECK_THROWS_WITH(prepare_scene(scene, 1, {}), Contains("bar") && Contains("insertion"));
    }
    SECTION("no attachments at all") {
        CHECK_THROWS_WITH(prepare_scene(scene, 1, {}), Contains("bar") && Contains("origin"));
    }
    SECTION("no superficial fibres") {
        bar.outlines = {origin, insertion};
        scene.parameters.set_text("fibres.method", "chmd");
        CHECK_THROWS_WITH(prepare_scene(scene, 1, {}), Contains("bar") && Contains("superficial fibres"));
    }
    SECTION("a template that is not there") {
        bar.outlines = {origin, insertion};
        scene.parameters.set_text("fibres.template", "fanned");
        CHECK_THROWS_WITH(prepare_scene(scene, 1, {}), Contains("fanned"));
    }
}
