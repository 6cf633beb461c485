#include "fascicle/base/error.hpp"
#include "render/drawing.hpp"
#include "support/line_model.hpp"
#include "support/shapes.hpp"
#include "view/build_draw_list.hpp"
#include "view/render_picture.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;
using namespace fascicle::view;

namespace {

// A bone of radius 1 at the origin, a ring-shaped muscle about z around it, attached at x < -3.5 (origin) and x > 3.5
// (insertion); a hinge along y. The bone is shifted in frame 1, the muscle stretched along x.
ScenePtr make_scene(double scale = 1.0) {
    auto ring = torus(3.0, 0.8, 48, 24);
    for (Vec3& p : ring.positions)
        p *= scale;
    Scene scene;
    scene.bones = {{"femur", std::make_shared<const TriMesh>(test::sphere(scale, 4)), {}}};
    Muscle muscle;
    muscle.name = "ring";
    Attachment origin{AttachmentKind::origin, 0, {}}, insertion{AttachmentKind::insertion, 0, {}};
    for (int i = 0; i < ring.vertex_count(); ++i) {
        const double x = ring.positions[static_cast<std::size_t>(i)].x();
        if (x < -2.6 * scale)
            origin.vertices.push_back(i);
        if (x > 2.6 * scale)
            insertion.vertices.push_back(i);
    }
    muscle.mesh = std::make_shared<const TriMesh>(std::move(ring));
    muscle.attachments = {origin, insertion};
    scene.muscles = {muscle};
    scene.timeline = make_hinge_timeline({Vec3::Zero(), Vec3::UnitY()}, 0.5, {10, 10, 0}, 1, {0});
    return std::make_shared<const Scene>(std::move(scene));
}

ViewSubject run_of(const ScenePtr& scene) {
    ViewSubject subject = subject_of(scene);
    Frame rest, frame;
    rest.bone_poses = {Pose{}};
    rest.muscle_positions = {mesh_points(scene->muscles[0].mesh)};
    frame.index = 1;
    frame.bone_poses = {Pose{Mat3::Identity(), Vec3(0, 0, 0.5)}};
    Points moved = *rest.muscle_positions[0];
    for (Vec3& p : moved)
        p.x() *= p.x() > 0 ? 1.2 : 0.8;
    frame.muscle_positions = {std::make_shared<const Points>(std::move(moved))};
    subject.rest = std::make_shared<const Frame>(std::move(rest));
    subject.frame = std::make_shared<const Frame>(std::move(frame));
    return subject;
}

const render::SurfaceItem* find(const render::DrawList& list, std::uint64_t id) {
    for (const render::SurfaceItem& item : list.surfaces)
        if (item.id == id)
            return &item;
    return nullptr;
}

render::Image picture(const ViewSubject& subject, const ViewOptions& options,
                      StandardView from = StandardView::superior, int width = 320, int height = 200) {
    DrawCache cache;
    const double aspect = static_cast<double>(width) / height;
    const Camera camera = picture_camera(subject, aspect, options, from);
    return render_picture(build_draw_list(subject, options, camera.pose(aspect), cache), width, height);
}

bool vivid_red(const std::array<int, 4>& c) {
    return c[0] > 150 && c[1] < c[0] / 3 && c[2] < c[0] / 3;
}
bool vivid_blue(const std::array<int, 4>& c) {
    return c[2] > 120 && c[0] < c[2] / 2;
}
bool ivory(const std::array<int, 4>& c) {
    return c[0] > 120 && c[0] >= c[1] && c[1] > c[2] + 8 && c[1] > c[0] * 3 / 4;
}

} // namespace

TEST_CASE("Bones take their pose, muscles the frame's positions", "[view][build_draw_list]") {
    const ScenePtr scene = make_scene();
    const ViewSubject subject = run_of(scene);
    DrawCache cache;
    const render::DrawList list = build_draw_list(subject, {}, {}, cache);
    const render::SurfaceItem* bone = find(list, bone_item_id(0));
    const render::SurfaceItem* muscle = find(list, muscle_item_id(0));
    REQUIRE(bone);
    REQUIRE(muscle);
    CHECK(bone->model[14] == 0.5f);
    CHECK(bone->positions->size() == scene->bones[0].mesh->positions.size());
    const Points& moved = *subject.frame->muscle_positions[0];
    for (const std::size_t i : {std::size_t{0}, std::size_t{100}, moved.size() - 1})
        for (std::size_t c = 0; c < 3; ++c)
            CHECK((*muscle->positions)[i][c] == static_cast<float>(moved[i][static_cast<int>(c)]));
    CHECK(muscle->triangles->size() == scene->muscles[0].mesh->triangles.size());
    CHECK(muscle->vertex_colours != nullptr);
    // Without frames everything is where its mesh is
    DrawCache other;
    const render::DrawList rest = build_draw_list(subject_of(scene), {}, {}, other);
    CHECK(find(rest, bone_item_id(0))->model[14] == 0.0f);
    CHECK((*find(rest, muscle_item_id(0))->positions)[0][0] ==
          static_cast<float>(scene->muscles[0].mesh->positions[0].x()));
}

TEST_CASE("Blocks are drawn flat, round bones smooth", "[view][build_draw_list]") {
    Scene scene = *make_scene();
    scene.bones.push_back({"block", std::make_shared<const TriMesh>(test::box(20, 20, 40)), {}});
    DrawCache cache;
    const render::DrawList list =
        build_draw_list(subject_of(std::make_shared<const Scene>(std::move(scene))), {}, {}, cache);
    CHECK(find(list, bone_item_id(0))->normals != nullptr);
    CHECK(find(list, bone_item_id(1))->normals == nullptr);
}

TEST_CASE("Nothing is computed twice while nothing changes", "[view][draw_cache]") {
    const ScenePtr scene = make_scene();
    const ViewSubject subject = run_of(scene);
    ViewOptions options;
    options.rest_ghost = true;
    for (const ColouringRow& row : colourings()) {
        INFO(row.key);
        options.colouring = row.colouring;
        DrawCache cache;
        const render::DrawList first = build_draw_list(subject, options, {}, cache);
        const int computed = cache.computed();
        CHECK(computed > 0);
        const render::DrawList second = build_draw_list(subject, options, {}, cache);
        CHECK(cache.computed() == computed);
        REQUIRE(first.surfaces.size() == second.surfaces.size());
        for (std::size_t i = 0; i < first.surfaces.size(); ++i) {
            CHECK(first.surfaces[i].positions == second.surfaces[i].positions);
            CHECK(first.surfaces[i].normals == second.surfaces[i].normals);
            CHECK(first.surfaces[i].vertex_colours == second.surfaces[i].vertex_colours);
        }
        // Another frame: the bone's arrays and all triangles stay
        ViewSubject at_rest = subject;
        at_rest.frame = subject.rest;
        const render::DrawList third = build_draw_list(at_rest, options, {}, cache);
        CHECK(cache.computed() > computed);
        CHECK(find(third, bone_item_id(0))->positions == find(first, bone_item_id(0))->positions);
        CHECK(find(third, muscle_item_id(0))->triangles == find(first, muscle_item_id(0))->triangles);
        CHECK(find(third, muscle_item_id(0))->positions != find(first, muscle_item_id(0))->positions);
    }
}

TEST_CASE("Changed attachments and scales change the colours", "[view][draw_cache]") {
    const ScenePtr scene = make_scene();
    ViewSubject subject = run_of(scene);
    DrawCache cache;
    ViewOptions options;
    const auto before = find(build_draw_list(subject, options, {}, cache), muscle_item_id(0))->vertex_colours;
    subject.attachments = {{{AttachmentKind::unknown, 0, {0, 1, 2}}}};
    const auto after = find(build_draw_list(subject, options, {}, cache), muscle_item_id(0))->vertex_colours;
    CHECK((*after)[0] == palette::attachment);
    CHECK(*after != *before);
    options.colouring = Colouring::strain;
    const auto narrow = find(build_draw_list(subject, options, {}, cache), muscle_item_id(0))->vertex_colours;
    options.scales[Colouring::strain].high = 3.0;
    CHECK(*find(build_draw_list(subject, options, {}, cache), muscle_item_id(0))->vertex_colours != *narrow);
}

TEST_CASE("Visibility, opacity, wireframe, selection and ghost reach the items", "[view][build_draw_list]") {
    const ScenePtr scene = make_scene();
    const ViewSubject subject = run_of(scene);
    DrawCache cache;
    ViewOptions options;
    options.hidden_bones = {true};
    CHECK(find(build_draw_list(subject, options, {}, cache), bone_item_id(0)) == nullptr);
    options.hidden_bones = {};
    options.hidden_muscles = {true};
    const render::DrawList bones_only = build_draw_list(subject, options, {}, cache);
    CHECK(find(bones_only, muscle_item_id(0)) == nullptr);
    CHECK(bones_only.lines.size() == 2); // the axis alone, without the hidden muscle's borders
    options.hidden_muscles = {};
    options.bone_opacity = 0.3f;
    options.wireframe = true;
    options.selected_muscle = 0;
    options.attachments = false;
    const render::DrawList list = build_draw_list(subject, options, {}, cache);
    CHECK(find(list, bone_item_id(0))->colour[3] == 0.3f);
    CHECK(find(list, muscle_item_id(0))->colour[3] == 1.0f);
    CHECK(find(list, bone_item_id(0))->wireframe);
    CHECK(find(list, muscle_item_id(0))->vertex_colours == nullptr);
    CHECK(find(list, muscle_item_id(0))->colour[1] > palette::muscle[1]);
    CHECK(list.surfaces.size() == 2);
    options.rest_ghost = true;
    options.joint_axis = false;
    const render::DrawList with_ghost = build_draw_list(subject, options, {}, cache);
    REQUIRE(with_ghost.surfaces.size() == 3);
    CHECK(with_ghost.surfaces[2].colour[3] < 1.0f);
    CHECK(with_ghost.lines.empty());
    ViewSubject at_rest = subject;
    at_rest.frame = subject.rest;
    CHECK(build_draw_list(at_rest, options, {}, cache).surfaces.size() ==
          2); // no ghost of what is shown anyway
}

TEST_CASE("The joint axis goes through the hinge and beyond the scene", "[view][build_draw_list]") {
    DrawCache cache;
    const render::DrawList list = build_draw_list(subject_of(make_scene()), {}, {}, cache);
    const render::LineItem& axis = list.lines.back();
    REQUIRE(axis.points->size() == 2);
    CHECK((*axis.points)[0][0] == 0.0f);
    CHECK((*axis.points)[0][1] < -3.9f);
    CHECK((*axis.points)[1][1] > 3.9f);
}

TEST_CASE("A recording gives its frames, the last one beyond its end", "[view][build_draw_list]") {
    const ScenePtr scene = make_scene();
    const ViewSubject run = run_of(scene);
    Recording recording(scene);
    CHECK(subject_of(recording, 0).frame == nullptr);
    recording.set_attachments({{{AttachmentKind::insertion, 0, {5}}}});
    recording.append(run.rest);
    recording.append(run.frame);
    CHECK(subject_of(recording, 0).frame == run.rest);
    CHECK(subject_of(recording, 1).frame == run.frame);
    CHECK(subject_of(recording, 7).frame == run.frame);
    CHECK(subject_of(recording, 1).rest == run.rest);
    CHECK(subject_of(recording, 1).attachments[0][0].vertices == std::vector<int>{5});
}

TEST_CASE("Bounds follow visibility, poses and the motion", "[view][build_draw_list]") {
    const ScenePtr scene = make_scene();
    const ViewSubject subject = run_of(scene);
    ViewOptions options;
    options.hidden_muscles = {true};
    const BoundingBox bone = visible_bounds(subject, options);
    CHECK(bone.max.z() == Approx(1.5));
    CHECK(bone.max.x() == Approx(1.0));
    options.hidden_bones = {true};
    CHECK(visible_bounds(subject, options).max.x() ==
          Approx(3.8 * 1.2).epsilon(0.01)); // all hidden: everything
    CHECK(visible_bounds(subject_of(std::make_shared<const Scene>())).empty());

    auto moving = std::make_shared<Scene>(*scene);
    moving->timeline = make_shift_timeline(Vec3(0, 0, 20), {10, 10, 0}, 1, 0);
    CHECK(motion_bounds(*moving).max.z() == Approx(21.0));
}

TEST_CASE("An empty scene and objects without mesh draw nothing", "[view][build_draw_list]") {
    Scene scene;
    scene.bones.resize(1);
    scene.muscles.resize(1);
    DrawCache cache;
    const ViewSubject subject = subject_of(std::make_shared<const Scene>(scene));
    const render::DrawList list = build_draw_list(subject, {}, picture_camera(subject, 1.6).pose(1.6), cache);
    CHECK(list.surfaces.empty());
    CHECK(render_picture(list, 32, 20).rgba.size() == 32 * 20 * 4);
}

TEST_CASE("Areas, bones and muscles are seen in their colours", "[view][picture]") {
    const ViewSubject subject = subject_of(make_scene());
    const render::Image image = picture(subject, {});
    // From above with the front at the top, the left (+x) side is on the left: the insertion.
    const auto left = [&](auto&& predicate) {
        int count = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width / 2; ++x)
                count += predicate(pixel(image, x, y)) ? 1 : 0;
        return count / (static_cast<double>(image.width) * image.height);
    };
    CHECK(share(image, vivid_red) > 0.02);
    CHECK(share(image, vivid_blue) > 0.02);
    CHECK(share(image, ivory) > 0.02);
    CHECK(left(vivid_blue) == Approx(share(image, vivid_blue)));
    CHECK(left(vivid_red) < 0.002);
    ViewOptions plain;
    plain.attachments = false;
    CHECK(share(picture(subject, plain), vivid_blue) == 0.0);
}

TEST_CASE("Strain is red where longer and blue where shorter", "[view][picture]") {
    ViewOptions options;
    options.colouring = Colouring::strain;
    options.attachments = false;
    const render::Image image = picture(run_of(make_scene()), options);
    const auto reddish = [](const auto& c) { return c[0] > c[2] + 50; };
    const auto bluish = [](const auto& c) { return c[2] > c[0] + 50; };
    int red_left = 0, red_right = 0, blue_left = 0, blue_right = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto c = pixel(image, x, y);
            (x < image.width / 2 ? red_left : red_right) += reddish(c) ? 1 : 0;
            (x < image.width / 2 ? blue_left : blue_right) += bluish(c) ? 1 : 0;
        }
    CHECK(red_left > 500);           // +x was stretched and is on the left
    CHECK(red_right < red_left / 4); // a part of the stretched half reaches over the picture's middle
    CHECK(blue_right > 500);
    CHECK(blue_left < blue_right / 20);
}

TEST_CASE("Scenes of 2 and of 2000 units fill the same part of the picture", "[view][picture]") {
    const render::Image small = picture(subject_of(make_scene(0.25)), {}, StandardView::anterior);
    const render::Image large = picture(subject_of(make_scene(250.0)), {}, StandardView::anterior);
    CHECK(render::differing_share(small, large, 8) < 0.01);
    // Its outline comes within 8 % of the sides
    int first = small.width, last = 0;
    for (int x = 0; x < small.width; ++x)
        if (const auto c = pixel(small, x, small.height / 2); c[0] > c[2] + 30 || c[2] > c[0] + 60) {
            first = std::min(first, x);
            last = std::max(last, x);
        }
    CHECK(first < small.width * 8 / 100);
    CHECK(last > small.width * 92 / 100);
}

TEST_CASE("Pictures change size and impossible ones are errors", "[view][picture]") {
    PictureRenderer renderer;
    DrawCache cache;
    const ViewSubject subject = subject_of(make_scene());
    for (const auto& [width, height] : {std::pair{64, 48}, {48, 64}, {64, 48}}) {
        const double aspect = static_cast<double>(width) / height;
        const render::Image image = renderer.draw(
            build_draw_list(subject, {}, picture_camera(subject, aspect).pose(aspect), cache), width, height);
        CHECK(image.width == width);
        CHECK(image.height == height);
        CHECK(share(image, ivory) > 0.01);
    }
    CHECK_THROWS_AS(renderer.draw({}, 100000, 100000), Error);
    CHECK_NOTHROW(renderer.draw({}, 16, 16));
}

TEST_CASE("Golden: a scene at rest, deformed, strained and transparent", "[view][golden]") {
    const ViewSubject subject = run_of(make_scene());
    const double aspect = 1.6;
    PictureRenderer renderer;
    const auto check = [&](const ViewOptions& options, const std::string& name) {
        DrawCache cache;
        const Camera camera = picture_camera(subject, aspect, options);
        check_golden(renderer.draw(build_draw_list(subject, options, camera.pose(aspect), cache), 320, 200),
                     name);
    };
    ViewOptions options;
    check(options, "scene");
    options.colouring = Colouring::strain;
    check(options, "scene_strain");
    options.colouring = Colouring::anatomy;
    options.bone_opacity = 0.35f;
    options.rest_ghost = true;
    options.wireframe = true;
    check(options, "scene_ghost_wireframe");
}

TEST_CASE("Line muscles are drawn where the bones of the frame take them, once faintly over everything",
          "[view]") {
    Scene arm = arm_scene(0.8);
    std::vector<std::string> notes;
    arm.line_muscles = std::make_shared<const LineMuscles>(
        place_line_muscles(std::make_shared<const LineModel>(arm_model()), arm, "arm", notes));
    const auto scene = std::make_shared<const Scene>(arm);
    ViewSubject subject = subject_of(scene);
    ViewOptions options;
    options.joint_axis = false;
    DrawCache cache;
    const auto lines = [&] { return build_draw_list(subject, options, {}, cache).lines; };
    const auto end = [&] { return lines().at(0).points->at(1); };
    REQUIRE(lines().size() == 2);
    CHECK_FALSE(lines()[0].on_top);
    CHECK(lines()[1].on_top);
    CHECK(lines()[1].colour[3] < 0.5f);
    CHECK(lines()[0].points->size() == 2);
    CHECK(lines()[0].points->at(0)[0] == Approx(200));
    CHECK(end()[1] == Approx(50));
    Frame frame;
    frame.index = 10;
    frame.angle_rad = 0.8;
    frame.bone_poses = {scene->timeline.bone_pose(0, 10), scene->timeline.bone_pose(1, 10)};
    subject.frame = std::make_shared<const Frame>(frame);
    CHECK(end()[0] == Approx(-50 * std::sin(0.8)));
    CHECK(end()[1] == Approx(50 * std::cos(0.8)));
    const int computed = cache.computed();
    lines();
    CHECK(cache.computed() == computed);
    options.line_muscles = false;
    CHECK(lines().empty());
}
