#include "io/osim_scene/osim_frame.hpp"

#include "fascicle/scene/line_posture.hpp"

namespace fascicle::io {

namespace {

/// A copy in which the coordinates are locked that move the bodies all alike: a fit of bodies to each other leaves those.
Skeleton only_between(const Skeleton& skeleton, const std::vector<char>& used, const Posture& posture) {
    Skeleton locked = skeleton;
    std::vector<double> rates;
    std::vector<Twist> twists;
    for (std::size_t c = 0; c < locked.coordinates.size(); ++c) {
        coordinate_rates(skeleton, posture.q, static_cast<int>(c), rates);
        body_twists(skeleton, posture.q, rates, posture.poses, twists);
        const Twist* first = nullptr;
        bool between = false;
        for (std::size_t b = 0; b < used.size(); ++b) {
            if (used[b] == 0)
                continue;
            if (first == nullptr)
                first = &twists[b];
            between = between || (twists[b].angular - first->angular).norm() > 1e-9 ||
                      (twists[b].linear - first->linear).norm() > 1e-9;
        }
        locked.coordinates[c].locked = locked.coordinates[c].locked || !between;
    }
    return locked;
}

} // namespace

FramePlacement place_frame(const LineModel& model, MeshFrame frame, const Mat3& axes,
                           const std::vector<char>& bodies_with_bone) {
    const Pose turned{axes, Vec3::Zero()};
    FramePlacement placement;
    placement.frame = frame;
    placement.ground = turned;
    placement.rest_values = model.skeleton.default_values();
    Posture posture;
    set_posture(model.skeleton, placement.rest_values, posture);
    if (frame == MeshFrame::scan) {
        // All bodies are where the first one with a bone is, and that is the scene's origin.
        std::size_t base = 0;
        while (base + 1 < bodies_with_bone.size() && bodies_with_bone[base] == 0)
            ++base;
        std::vector<Points> centres;
        for (const Body& body : model.skeleton.bodies)
            centres.push_back({body.mass_centre});
        fit_posture(only_between(model.skeleton, bodies_with_bone, posture), bodies_with_bone, centres,
                    std::vector<Pose>(bodies_with_bone.size()), placement.rest_values);
        set_posture(model.skeleton, placement.rest_values, posture);
        placement.ground = turned.after(posture.poses[base].inverse());
        placement.rest.assign(bodies_with_bone.size(), turned);
        return placement;
    }
    for (const Pose& pose : posture.poses)
        placement.rest.push_back(turned.after(pose));
    return placement;
}

Pose file_pose(const FramePlacement& placement, int body) {
    return placement.frame == MeshFrame::ground ? placement.ground
                                                : placement.rest[static_cast<std::size_t>(body)];
}

Misfit misfit(const FramePlacement& placement, const LineModel& model,
              const std::vector<TriedMuscle>& muscles, const std::vector<TriedBone>& bones) {
    constexpr double everywhere = std::numeric_limits<double>::infinity();
    Misfit result;
    double count = 0, ends = 0;
    const auto bone_pose = [&](const TriedBone& bone) {
        return bone.in_body_frame ? placement.rest[static_cast<std::size_t>(bone.body)]
                                  : file_pose(placement, bone.body);
    };
    for (const TriedMuscle& muscle : muscles)
        for (const int body : muscle.bodies)
            for (const TriedBone& bone : bones) {
                if (bone.body != body)
                    continue;
                const Pose to_bone =
                    bone_pose(bone).inverse().after(file_pose(placement, muscle.bodies.front()));
                double least = everywhere;
                int hint = -1;
                for (const Vec3& p : muscle.points)
                    least = std::min(least, bone.solid->signed_distance(to_bone.apply(p), everywhere, hint));
                result.muscles += std::abs(least);
                ++count;
            }
    for (const LineMuscle& line : model.muscles)
        for (const PathPoint* point : {&line.points.front(), &line.points.back()})
            for (const TriedBone& bone : bones) {
                if (point->kind == PathPointKind::moving || point->body != bone.body || bone.in_body_frame)
                    continue;
                const Vec3 p = placement.rest[static_cast<std::size_t>(bone.body)].apply(point->location);
                result.ends += std::abs(bone.solid->signed_distance(bone_pose(bone).apply_inverse(p)));
                ++ends;
            }
    result.muscles /= std::max(1.0, count);
    result.ends /= std::max(1.0, ends);
    return result;
}

} // namespace fascicle::io
