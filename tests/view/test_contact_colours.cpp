#include "render/drawing.hpp"
#include "support/shapes.hpp"
#include "view/build_draw_list.hpp"
#include "view/render_picture.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <set>

using namespace fascicle;
using namespace fascicle::test;
using namespace fascicle::view;

namespace {

// A floor z <= 0 and a muscle of radius 5 that is attached at its top; frame 1 has the muscle 1 mm into the floor.
ScenePtr make_scene() {
    Scene scene;
    TriMesh floor = test::box(16, 16, 2);
    for (Vec3& p : floor.positions)
        p += Vec3(-8, -8, -2);
    scene.bones = {{"floor", std::make_shared<const TriMesh>(std::move(floor)), {}}};
    Muscle muscle;
    muscle.name = "ball";
    muscle.mesh = std::make_shared<const TriMesh>(test::sphere(5, 4, Vec3(0, 0, 7)));
    Attachment origin{AttachmentKind::origin, 0, {}};
    for (int i = 0; i < muscle.mesh->vertex_count(); ++i)
        if (muscle.mesh->positions[static_cast<std::size_t>(i)].z() > 10)
            origin.vertices.push_back(i);
    muscle.attachments = {origin};
    scene.muscles = {muscle};
    return std::make_shared<const Scene>(std::move(scene));
}

ViewSubject lowered(const ScenePtr& scene, double by) {
    ViewSubject subject = subject_of(scene);
    Frame rest, frame;
    rest.bone_poses = frame.bone_poses = {Pose{}};
    rest.muscle_positions = {mesh_points(scene->muscles[0].mesh)};
    Points moved = *rest.muscle_positions[0];
    for (Vec3& p : moved)
        p.z() -= by;
    frame.muscle_positions = {std::make_shared<const Points>(std::move(moved))};
    subject.rest = std::make_shared<const Frame>(std::move(rest));
    subject.frame = std::make_shared<const Frame>(std::move(frame));
    return subject;
}

const std::vector<render::Rgba>& colours(const render::DrawList& list) {
    for (const render::SurfaceItem& item : list.surfaces)
        if (item.id == muscle_item_id(0))
            return *item.vertex_colours;
    throw std::runtime_error("no muscle");
}

render::Image picture(const ViewSubject& subject, const ViewOptions& options, StandardView from) {
    DrawCache cache;
    const Camera camera = picture_camera(subject, 1.6, options, from);
    return render_picture(build_draw_list(subject, options, camera.pose(1.6), cache), 320, 200);
}

} // namespace

TEST_CASE("The table of colourings is complete", "[view][colouring]") {
    std::set<std::string> keys;
    for (const ColouringRow& row : colourings()) {
        CHECK(&colouring_row(row.colouring) == &row);
        CHECK(keys.insert(row.key).second);
        CHECK(std::string(row.label).size() > 3);
        CHECK(std::string(row.help).size() > 10);
    }
    for (std::size_t i = 0; i < contact_rows().size(); ++i)
        CHECK(static_cast<std::size_t>(contact_rows()[i].state) == i);
    CHECK(contact_state(0.2, false) == ContactState::touching);
    CHECK(contact_state(0.21, false) == ContactState::free);
    CHECK(contact_state(-0.2, false) == ContactState::touching);
    CHECK(contact_state(-0.21, false) == ContactState::inside);
    CHECK(contact_state(-3, true) == ContactState::attached);
}

TEST_CASE("Depth colours are those of the signed distance to the bone", "[view][draw_cache]") {
    const ScenePtr scene = make_scene();
    const ViewSubject subject = lowered(scene, 3.0);
    ViewOptions options;
    options.colouring = Colouring::depth;
    DrawCache cache;
    const std::vector<render::Rgba> seen = colours(build_draw_list(subject, options, {}, cache));
    const Points& points = *subject.frame->muscle_positions[0];
    int inside = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
        const double z = points[v].z();
        const render::Rgba expected = options.scales[Colouring::depth].colour(z);
        inside += z < 0;
        for (std::size_t c = 0; c < 3; ++c)
            CHECK(double(seen[v][c]) == Approx(double(expected[c])).margin(1e-6));
    }
    CHECK(inside > 10);
    // A moved bone changes the distances of the same points.
    Frame frame = *subject.frame;
    frame.bone_poses[0].translation = Vec3(0, 0, 1);
    ViewSubject raised = subject;
    raised.frame = std::make_shared<const Frame>(frame);
    CHECK(colours(build_draw_list(raised, options, {}, cache)) != seen);
    options.scales[Colouring::depth].high = 2.0;
    CHECK(colours(build_draw_list(subject, options, {}, cache)) != seen);
}

TEST_CASE("Contact colours tell free, touching, inside and attached vertices apart", "[view][draw_cache]") {
    const ScenePtr scene = make_scene();
    ViewSubject subject = lowered(scene, 3.0);
    ViewOptions options;
    options.colouring = Colouring::contact;
    DrawCache cache;
    const std::vector<render::Rgba> seen = colours(build_draw_list(subject, options, {}, cache));
    const Points& points = *subject.frame->muscle_positions[0];
    std::map<ContactState, int> counts;
    for (std::size_t v = 0; v < points.size(); ++v) {
        const ContactState state = contact_state(points[v].z(), points[v].z() + 3.0 > 10);
        ++counts[state];
        CHECK(seen[v] == contact_rows()[static_cast<std::size_t>(state)].colour);
    }
    CHECK(counts.size() == 4);
    subject.attachments = {{}};
    CHECK(colours(build_draw_list(subject, options, {}, cache)) != seen);
}

TEST_CASE("Distances are looked for only when a colouring shows them", "[view][draw_cache]") {
    const ScenePtr scene = make_scene();
    const ViewSubject subject = lowered(scene, 3.0);
    DrawCache plain, both;
    ViewOptions options;
    build_draw_list(subject, options, {}, plain);
    build_draw_list(subject, options, {}, both);
    const int before = both.computed();
    CHECK(before == plain.computed());
    options.colouring = Colouring::depth;
    build_draw_list(subject, options, {}, both);
    CHECK(both.computed() == before + 3); // tree of the bone, distances, colours
    options.colouring = Colouring::contact;
    build_draw_list(subject, options, {}, both);
    CHECK(both.computed() == before + 4); // the same distances
    build_draw_list(subject, options, {}, both);
    CHECK(both.computed() == before + 4);
}

TEST_CASE("Depth is red below and blue above, contact shows the attached top", "[view][picture]") {
    const ViewSubject subject = lowered(make_scene(), 3.0);
    ViewOptions options;
    options.attachments = false;
    options.hidden_bones = {true};
    options.colouring = Colouring::depth;
    const auto red = [](const auto& c) { return c[0] > c[2] + 60; };
    const auto blue = [](const auto& c) { return c[2] > c[0] + 50; };
    const render::Image below = picture(subject, options, StandardView::inferior);
    CHECK(share(below, red) > 0.03);
    CHECK(share(picture(subject, options, StandardView::superior), red) < 0.001);
    CHECK(share(picture(subject, options, StandardView::superior), blue) > 0.1);
    options.colouring = Colouring::contact;
    CHECK(share(picture(subject, options, StandardView::superior), blue) > 0.03);
    CHECK(share(picture(subject, options, StandardView::inferior), blue) < 0.001);
    CHECK(share(picture(subject, options, StandardView::inferior), red) > 0.03);
}

TEST_CASE("Golden: distance to bone and contact", "[view][golden]") {
    const ViewSubject subject = lowered(make_scene(), 3.0);
    PictureRenderer renderer;
    for (const Colouring colouring : {Colouring::depth, Colouring::contact}) {
        ViewOptions options;
        options.colouring = colouring;
        options.hidden_bones = {true}; // seen from below, through the floor
        DrawCache cache;
        Camera camera = picture_camera(subject, 1.6, options);
        camera.orbit_by(0, -0.9);
        check_golden(renderer.draw(build_draw_list(subject, options, camera.pose(1.6), cache), 320, 200),
                     std::string("scene_") + colouring_row(colouring).key);
    }
}
