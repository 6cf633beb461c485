#pragma once
// A muscle and bones with frames made by hand.

#include "fascicle/scene/recording.hpp"

namespace fascicle::test {

inline MeshPtr shared(TriMesh mesh) {
    return std::make_shared<const TriMesh>(std::move(mesh));
}

/// One muscle and any number of bones, nothing moves by itself.
inline std::shared_ptr<Scene> scene_of(TriMesh muscle, std::vector<TriMesh> bones = {},
                                       LengthUnit unit = LengthUnit::millimetre) {
    auto scene = std::make_shared<Scene>();
    scene->unit = unit;
    scene->muscles.emplace_back();
    scene->muscles[0].name = "muscle";
    scene->muscles[0].mesh = shared(std::move(muscle));
    for (TriMesh& mesh : bones) {
        Bone bone;
        bone.name = "bone" + std::to_string(scene->bones.size());
        bone.mesh = shared(std::move(mesh));
        scene->bones.push_back(std::move(bone));
    }
    return scene;
}

/// The frame in which the first muscle has these positions; bones at rest unless poses are given.
inline Frame frame_of(const Scene& scene, Points points, std::vector<Pose> poses = {}) {
    Frame frame;
    frame.bone_poses = poses.empty() ? std::vector<Pose>(scene.bones.size()) : std::move(poses);
    frame.muscle_positions.push_back(std::make_shared<const Points>(std::move(points)));
    return frame;
}

inline Frame rest_frame(const Scene& scene) {
    return frame_of(scene, scene.muscles[0].mesh->positions);
}

template <typename Map>
Points mapped(const Points& points, const Map& map) {
    Points result;
    for (const Vec3& p : points)
        result.push_back(map(p));
    return result;
}

} // namespace fascicle::test
