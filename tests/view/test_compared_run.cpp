#include "support/shapes.hpp"
#include "view/build_draw_list.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::view;

namespace {

/// A muscle at rest, and the same one of another run, shifted by 3 mm along x (the scene is in metres).
ViewSubject two_muscles() {
    Scene scene;
    scene.unit = LengthUnit::metre;
    Muscle muscle;
    muscle.name = "muscle";
    muscle.mesh = std::make_shared<const TriMesh>(test::sphere(0.05, 1));
    scene.muscles.push_back(muscle);
    ViewSubject subject = subject_of(std::make_shared<const Scene>(scene));
    auto other = std::make_shared<Points>(muscle.mesh->positions);
    for (Vec3& p : *other)
        p.x() += 0.003;
    subject.compared = {other};
    return subject;
}

const render::SurfaceItem& muscle_item(const render::DrawList& list) {
    for (const render::SurfaceItem& item : list.surfaces)
        if (item.id == muscle_item_id(0))
            return item;
    FAIL("no muscle");
    return list.surfaces[0];
}

} // namespace

TEST_CASE("Another run's muscle is a translucent surface or edges over the one shown", "[view][compare]") {
    const ViewSubject subject = two_muscles();
    DrawCache cache;
    ViewOptions options;
    CHECK(build_draw_list(subject, options, {}, cache).surfaces.size() == 1);
    options.compared = Compared::ghost;
    const render::DrawList ghost = build_draw_list(subject, options, {}, cache);
    REQUIRE(ghost.surfaces.size() == 2);
    const render::SurfaceItem& over =
        ghost.surfaces[0].id == muscle_item_id(0) ? ghost.surfaces[1] : ghost.surfaces[0];
    CHECK(over.colour[3] < 1);
    CHECK((*over.positions)[5][0] == Approx((*muscle_item(ghost).positions)[5][0] + 0.003f));
    options.compared = Compared::wire;
    const render::DrawList wire = build_draw_list(subject, options, {}, cache);
    CHECK(wire.surfaces.size() == 1);
    REQUIRE(wire.lines.size() == 1);
    CHECK(wire.lines[0].points->size() == 2 * 48); // 32 triangles have 48 edges
    const int computed = cache.computed();
    build_draw_list(subject, options, {}, cache);
    CHECK(cache.computed() == computed);
}

TEST_CASE("The difference map colours each vertex by its distance in millimetres", "[view][compare]") {
    ViewSubject subject = two_muscles();
    DrawCache cache;
    ViewOptions options;
    options.compared = Compared::difference;
    options.colouring = Colouring::strain; // stands back
    options.difference_scale = {ColourMap::cividis, 0, 6};
    const render::DrawList list = build_draw_list(subject, options, {}, cache);
    CHECK(list.surfaces.size() == 1);
    REQUIRE(muscle_item(list).vertex_colours != nullptr);
    const Rgba expected = options.difference_scale.colour(3);
    for (const Rgba& colour : *muscle_item(list).vertex_colours)
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(colour[c] == Approx(expected[c]).margin(1e-4));
    const int computed = cache.computed();
    build_draw_list(subject, options, {}, cache);
    CHECK(cache.computed() == computed);
    options.difference_scale.high = 3;
    build_draw_list(subject, options, {}, cache);
    CHECK(cache.computed() == computed + 1);
    subject.compared = {nullptr}; // nothing to compare with: as without
    options.colouring = Colouring::anatomy;
    CHECK(muscle_item(build_draw_list(subject, options, {}, cache)).vertex_colours == nullptr);
}
