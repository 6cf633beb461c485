#include "fascicle/geometry/solid_query.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <functional>

using namespace fascicle;

namespace {

std::vector<int> vertices_where(const TriMesh& mesh, const std::function<bool(const Vec3&)>& test) {
    std::vector<int> found;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (test(mesh.positions[i]))
            found.push_back(static_cast<int>(i));
    return found;
}

/// Two balls of 10 mm side by side, `gap` apart (negative: overlapping), each held by a bone behind it. The right bone comes 4 mm
/// nearer over 20 frames, shifts 3 mm along the contact, and goes back.
Scene two_balls(double gap, const std::string& kernel) {
    Scene scene;
    scene.name = "two-balls";
    const double x = 10.0 + 0.5 * gap;
    for (const double side : {-1.0, 1.0}) {
        TriMesh ball = test::sphere(10, 4, Vec3(side * x, 0, 0));
        TriMesh box = test::box(4, 30, 30);
        for (Vec3& p : box.positions)
            p += Vec3(side * (x + 12.5) - 2, -15, -15);
        Bone bone;
        bone.name = side < 0 ? "left" : "right";
        bone.mesh = std::make_shared<TriMesh>(box);
        scene.bones.push_back(bone);
        Muscle muscle;
        muscle.name = side < 0 ? "a" : "b";
        muscle.attachments = {{AttachmentKind::origin, side < 0 ? 0 : 1,
                               vertices_where(ball, [&](const Vec3& p) { return side * p.x() > x + 6.0; })}};
        muscle.mesh = std::make_shared<TriMesh>(std::move(ball));
        scene.muscles.push_back(muscle);
    }
    scene.timeline.last_frame = 60;
    scene.timeline.bone_tracks.resize(2);
    scene.timeline.bone_tracks[1].keys = {{0, {}},
                                          {20, {Mat3::Identity(), Vec3(-4, 0, 0)}},
                                          {30, {Mat3::Identity(), Vec3(-4, 3, 0)}},
                                          {50, {}}};
    scene.parameters.set("solver.iterations", 3);
    scene.parameters.assign("solver.kernel=" + kernel);
    return scene;
}

/// Depth of the deepest vertex of each muscle in the other.
double overlap(const Scene& scene, const Frame& frame) {
    double deepest = 0;
    for (std::size_t m = 0; m < 2; ++m) {
        TriMesh other = *scene.muscles[1 - m].mesh;
        other.positions = *frame.muscle_positions[1 - m];
        const SolidQuery query(other);
        for (const Vec3& p : *frame.muscle_positions[m])
            deepest = std::max(deepest, -query.signed_distance(p, 20.0));
    }
    return deepest;
}

} // namespace

TEST_CASE("muscle contact: two muscles pressed together stay out of each other, and part again",
          "[simulation][contact][slow]") {
    const std::string kernel = GENERATE("fast", "reference");
    const Scene scene = two_balls(0.3, kernel);
    Recording recording(std::make_shared<Scene>(scene));
    run_simulation(recording, {2}, {});
    double deepest = 0, moved = 0;
    for (int f = 0; f < recording.frame_count(); f += 3) {
        const FramePtr frame = recording.frame(f);
        deepest = std::max(deepest, overlap(scene, *frame));
        for (const Vec3& p : *frame->muscle_positions[0])
            REQUIRE(p.allFinite());
        // The left one is pushed in at its front.
        double front = -1e300;
        for (const Vec3& p : *frame->muscle_positions[0])
            front = std::max(front, p.x());
        moved = std::max(moved, -0.15 - front);
    }
    CHECK(deepest < 0.3);
    CHECK(moved > 0.5);
    const FramePtr last = recording.last_frame();
    for (std::size_t m = 0; m < 2; ++m) {
        double far = 0;
        for (std::size_t i = 0; i < scene.muscles[m].mesh->positions.size(); ++i)
            far =
                std::max(far, ((*last->muscle_positions[m])[i] - scene.muscles[m].mesh->positions[i]).norm());
        CHECK(far < 0.3);
    }
}

TEST_CASE("muscle contact: without it the two would be deep in each other", "[simulation][contact]") {
    // The same motion, each muscle alone: what the contact above prevents.
    const Scene scene = two_balls(0.3, "fast");
    auto frame = std::make_shared<Frame>();
    for (std::size_t m = 0; m < 2; ++m) {
        Scene alone = scene;
        alone.muscles = {scene.muscles[m]};
        Recording recording(std::make_shared<Scene>(alone));
        run_simulation(recording, {1}, {});
        frame->muscle_positions.push_back(recording.frame(20)->muscle_positions[0]);
    }
    CHECK(overlap(scene, *frame) > 1.5);
}

TEST_CASE("muscle contact: an overlap of a millimetre at rest is kept and does not explode",
          "[simulation][contact][slow]") {
    Scene scene = two_balls(-1.0, "fast");
    const double at_rest = [&] {
        Frame rest;
        for (const Muscle& muscle : scene.muscles)
            rest.muscle_positions.push_back(std::make_shared<Points>(muscle.mesh->positions));
        return overlap(scene, rest);
    }();
    REQUIRE(at_rest > 0.8);
    SECTION("while nothing moves") {
        scene.timeline.bone_tracks.clear();
        scene.timeline.last_frame = 20;
        Recording recording(std::make_shared<Scene>(scene));
        run_simulation(recording, {2}, {});
        const FramePtr last = recording.last_frame();
        for (std::size_t m = 0; m < 2; ++m)
            for (std::size_t i = 0; i < scene.muscles[m].mesh->positions.size(); ++i)
                CHECK(((*last->muscle_positions[m])[i] - scene.muscles[m].mesh->positions[i]).norm() < 0.05);
    }
    SECTION("while they are pressed together") {
        Recording recording(std::make_shared<Scene>(scene));
        run_simulation(recording, {2}, {});
        // Half of what is too much is mended a frame, and the bone comes on: 4 mm into two balls of 20 mm leave 0.5 to 1 mm for a
        // frame or two, depending on the damping.
        for (int f = 0; f < recording.frame_count(); f += 5)
            CHECK(overlap(scene, *recording.frame(f)) < at_rest + 1.0);
    }
}

TEST_CASE("muscle contact: the same bits for any number of threads", "[simulation][contact]") {
    Scene scene = two_balls(0.3, "fast");
    scene.timeline.last_frame = 20;
    std::vector<Points> results;
    for (const int threads : {1, 2, 4}) {
        Recording recording(std::make_shared<Scene>(scene));
        run_simulation(recording, {threads}, {});
        results.push_back(*recording.last_frame()->muscle_positions[0]);
    }
    CHECK(results[0] == results[1]);
    CHECK(results[0] == results[2]);
}
