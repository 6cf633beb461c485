#include "editor/hand_run.hpp"

#include "support/shapes.hpp"

namespace fascicle::test {

Scene small_scene() {
    Scene scene;
    scene.name = "small";
    TriMesh left = box(20, 20, 40), right = left;
    for (Vec3& p : right.positions)
        p += Vec3(60, 0, 0);
    scene.bones.push_back({"fixed", std::make_shared<const TriMesh>(left), {}});
    scene.bones.push_back({"turning", std::make_shared<const TriMesh>(right), {}});
    Muscle muscle;
    muscle.name = "muscle";
    muscle.mesh = std::make_shared<const TriMesh>(sphere(15, 2, Vec3(40, 10, 20)));
    muscle.attachments = {{AttachmentKind::origin, 0, {0, 1, 2}}, {AttachmentKind::insertion, 1, {3, 4, 5}}};
    scene.muscles.push_back(std::move(muscle));
    scene.timeline = make_hinge_timeline({Vec3(50, 10, 20), Vec3::UnitX()}, 1.0, {30, 30, 0}, 2, {1});
    return scene;
}

void HandRun::compute(int count) {
    const Scene& scene = recording_->scene();
    if (recording_->frame_count() == 0) {
        std::vector<std::vector<Attachment>> attachments;
        for (const Muscle& muscle : scene.muscles)
            attachments.push_back(muscle.attachments);
        recording_->set_attachments(std::move(attachments));
    }
    for (int k = recording_->frame_count(); k < count; ++k) {
        auto frame = std::make_shared<Frame>();
        frame->index = k;
        frame->angle_rad = scene.timeline.angle_rad(k);
        frame->report.solve_seconds = k == 0 ? 0 : 0.02;
        for (std::size_t b = 0; b < scene.bones.size(); ++b)
            frame->bone_poses.push_back(scene.timeline.bone_pose(static_cast<int>(b), k));
        for (const Muscle& muscle : scene.muscles) {
            auto points = std::make_shared<Points>(muscle.mesh->positions);
            for (Vec3& p : *points)
                p.z() *= 1 + 0.002 * k;
            frame->muscle_positions.push_back(std::move(points));
        }
        recording_->append(std::move(frame));
    }
}

void HandRun::finish() {
    recording_->finish(RunState::finished);
    finished = true;
}

RecordingPtr small_recording(int count, const Scene& scene) {
    HandRun run(std::make_shared<const Scene>(scene));
    run.compute(count);
    run.finish();
    return run.recording();
}

} // namespace fascicle::test
