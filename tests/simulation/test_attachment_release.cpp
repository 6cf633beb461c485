// Attached vertices that a bone comes at during a run, by motions that were not known when it was prepared.

#include "fascicle/geometry/closest_point.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/winding_number.hpp"
#include "fascicle/simulation/scene_solver.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "support/shapes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace fascicle;

namespace {

/// A beam of 40 x 8 x 8 mm lying on a bone at each end of x, and a hammer 20 mm above its first end.
Scene beam_scene(int hammer_frames) {
    Scene scene;
    const auto bone = [&](const char* name, const Vec3& low, const Vec3& high) {
        scene.bones.push_back({name, std::make_shared<TriMesh>(box_mesh(low, high, {4, 4, 4})), {}});
    };
    bone("left", Vec3(-5, -8, -8), Vec3(5, 8, -0.2));
    bone("right", Vec3(35, -8, -8), Vec3(45, 8, -0.2));
    bone("hammer", Vec3(-12, -6, 28), Vec3(3, 6, 40));
    Muscle beam;
    beam.name = "beam";
    beam.mesh = std::make_shared<TriMesh>(box_mesh(Vec3(-4, -4, 0), Vec3(44, 4, 8), {24, 4, 4}));
    beam.attach_automatically = false;
    Attachment left{AttachmentKind::origin, 0, {}}, right{AttachmentKind::insertion, 1, {}};
    for (int i = 0; i < beam.mesh->vertex_count(); ++i) {
        const Vec3& p = beam.mesh->positions[static_cast<std::size_t>(i)];
        if (p.x() < 4.5)
            left.vertices.push_back(i);
        else if (p.x() > 36.5 && p.z() < 1)
            right.vertices.push_back(i);
    }
    beam.attachments = {left, right};
    scene.muscles.push_back(beam);
    scene.timeline = make_shift_timeline(Vec3(0, 0, -23), {hammer_frames, 0, 0}, 3, 2);
    scene.parameters.set_text("solver.kernel", "fast");
    return scene;
}

int inside(const TriMesh& bone, const Pose& pose, const Points& points, const std::vector<int>& body,
           int own) {
    const WindingNumber winding(bone.positions, bone.triangles);
    int count = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (body[i] != own && winding.exact(pose.apply_inverse(points[i])) > 0.5)
            ++count;
    return count;
}

} // namespace

TEST_CASE("attached vertices are released when a bone moved by hand comes at them, and stay out of it",
          "[simulation][release]") {
    Scene scene = beam_scene(40);
    scene.parameters.set_text("solver.kernel", GENERATE(std::string("fast"), std::string("reference")));
    const Timeline motion = scene.timeline;
    scene.timeline = {}; // nobody knows that the hammer will come
    scene.timeline.bone_tracks.resize(3);
    const PreparedScene prepared = prepare_scene(scene, 2, {});
    SceneSolver solver(scene, prepared, 2);
    const std::size_t attached = scene.muscles[0].attachments[0].vertices.size();
    int first = -1;
    for (int frame = 1; frame <= 40; ++frame) {
        std::vector<Pose> from, to;
        for (int b = 0; b < 3; ++b) {
            from.push_back(motion.bone_pose(b, frame - 1));
            to.push_back(motion.bone_pose(b, frame));
        }
        const StepReport before = solver.report();
        solver.advance(from, to);
        CHECK(solver.report().contacts >= before.contacts); // totals go on over a change of solver
        if (first < 0 && !solver.released(0).empty())
            first = frame;
        INFO("frame " << frame);
        const Points& x = solver.muscle(0).positions();
        const std::vector<int>& body = solver.muscle(0).body_of_vertex();
        CHECK(std::all_of(x.begin(), x.end(), [](const Vec3& p) { return p.allFinite(); }));
        for (int b = 0; b < 3; ++b)
            CHECK(inside(*scene.bones[static_cast<std::size_t>(b)].mesh, to[static_cast<std::size_t>(b)], x,
                         body, b) == 0);
    }
    // The hammer's face, at 28 mm, comes within 0.5 mm of the top, at 8 mm, after 19.5 of 23 mm: in frame 34.
    CHECK(first == 34);
    CHECK(solver.released(0).size() > 0);
    CHECK(solver.released(0).size() < attached);
    for (const int v : solver.released(0))
        CHECK(solver.muscle(0).body_of_vertex()[static_cast<std::size_t>(v)] == -1);
}

TEST_CASE("tetrahedral methods, too, let go of what a bone comes at and go on from where they are",
          "[simulation][release][tet]") {
    Scene scene = beam_scene(20);
    set_method(scene.parameters, GENERATE(std::string("fem"), std::string("xpbd-tet")));
    const Timeline motion = scene.timeline;
    scene.timeline = {};
    scene.timeline.bone_tracks.resize(3);
    const PreparedScene prepared = prepare_scene(scene, 2, {});
    SceneSolver solver(scene, prepared, 2);
    Points last = solver.muscle(0).positions();
    for (int frame = 1; frame <= 20; ++frame) {
        std::vector<Pose> from, to;
        for (int b = 0; b < 3; ++b) {
            from.push_back(motion.bone_pose(b, frame - 1));
            to.push_back(motion.bone_pose(b, frame));
        }
        solver.advance(from, to);
        const Points& x = solver.muscle(0).positions();
        double step = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            step = std::max(step, (x[i] - last[i]).norm());
        CHECK(step < 4); // the hammer comes by 1.15 mm a frame: nothing jumps where the solver is another one
        CHECK(inside(*scene.bones[2].mesh, to[2], x, solver.muscle(0).body_of_vertex(), 2) == 0);
        last = x;
    }
    CHECK(solver.released(0).size() > 0);
}

TEST_CASE("a known motion releases before the run what would be released in it", "[simulation][release]") {
    const Scene scene = beam_scene(40);
    const PreparedScene prepared = prepare_scene(scene, 1, {});
    SceneSolver solver(scene, prepared, 1);
    for (int frame = 1; frame <= 40; ++frame)
        solver.advance(bone_poses(scene, frame - 1), bone_poses(scene, frame));
    CHECK(solver.released(0).empty());
    CHECK(prepared.muscles[0].attachments[0].vertices.size() <
          scene.muscles[0].attachments[0].vertices.size());
}

TEST_CASE("a solver goes on from another one's state as if it were itself", "[simulation][release][solver]") {
    Scene scene = beam_scene(40);
    scene.parameters.set("solver.coarse", 0);
    scene.parameters.set_text("solver.kernel", GENERATE(std::string("fast"), std::string("reference")));
    scene.timeline = make_shift_timeline(Vec3(6, 3, 2), {30, 0, 0}, 3, 1);
    const PreparedScene prepared = prepare_scene(scene, 1, {});
    const SoftBodyProblem& problem = prepared.muscles[0].problem;
    auto one = prepared.method->make(problem);
    std::unique_ptr<SoftBodySolver> other;
    for (int frame = 1; frame <= 12; ++frame) {
        const auto from = bone_poses(scene, frame - 1), to = bone_poses(scene, frame);
        one->advance(from, to);
        if (other != nullptr)
            other->advance(from, to);
        if (frame == 8) {
            other = prepared.method->make(problem);
            REQUIRE(other->set_state(one->positions(), one->last_step()));
        }
    }
    double worst = 0, moved = 0;
    for (std::size_t i = 0; i < one->positions().size(); ++i) {
        worst = std::max(worst, (one->positions()[i] - other->positions()[i]).norm());
        moved = std::max(moved, (one->positions()[i] - problem.surface->positions[i]).norm());
    }
    CHECK(moved > 1.0);
    CHECK(worst < 1e-3); // contact's memory of normals is not part of the state
}

TEST_CASE("a method that knows no state says so", "[simulation][release][solver]") {
    Scene scene = beam_scene(4);
    set_method(scene.parameters, "classic");
    const PreparedScene prepared = prepare_scene(scene, 1, {});
    auto solver = prepared.method->make(prepared.muscles[0].problem);
    CHECK(solver->last_step().empty());
    CHECK_FALSE(solver->set_state(solver->positions(), solver->positions()));
}
