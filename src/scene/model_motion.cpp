#include "fascicle/scene/model_motion.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/motion/joint_track.hpp"
#include "fascicle/scene/line_muscles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

double range_of(const ModelMotion& motion, int coordinate) {
    double low = motion.at(0)[static_cast<std::size_t>(coordinate)], high = low;
    for (int k = 1; k < motion.frame_count(); ++k) {
        low = std::min(low, motion.at(k)[static_cast<std::size_t>(coordinate)]);
        high = std::max(high, motion.at(k)[static_cast<std::size_t>(coordinate)]);
    }
    return high - low;
}

} // namespace

const char* to_text(MeshFrame frame) {
    return frame == MeshFrame::body ? "body" : frame == MeshFrame::ground ? "ground" : "scan";
}

/// In the lead-in a scan's rest, which the model meets only nearly, goes over into the model's own place:
///   S(k) = ground X(q) C, C = screw(X(q_rest)^-1 ground^-1 rest, identity; k / lead_in).
Pose ModelMotion::body_pose(std::size_t body, int frame, std::span<const Pose> poses) const {
    if (frame <= 0)
        return rest[body];
    const Pose place = ground.after(poses[body]);
    if (mesh_frame != MeshFrame::scan || frame >= lead_in)
        return place;
    std::vector<Pose> still;
    place_bodies(model->skeleton, rest_values, still);
    const Pose left_over = ground.after(still[body]).inverse().after(rest[body]);
    return place.after(screw_between(left_over, Pose{}, double(frame) / lead_in));
}

const ModelMotion* model_motion_in_force(const Scene& scene) {
    const ModelMotion* motion = scene.model_motion.get();
    return motion != nullptr && scene.timeline.last_frame < motion->frame_count() &&
                   scene.motion_source.path == motion->trial_source.path &&
                   scene.motion_source.hash == motion->trial_source.hash
               ? motion
               : nullptr;
}

std::string coordinate_column(const Coordinate& coordinate) {
    return coordinate.name + (coordinate.kind == CoordinateKind::rotational ? "_deg" : "_mm");
}

double coordinate_number(const Coordinate& coordinate, double value) {
    return coordinate.kind == CoordinateKind::rotational ? value * 180 / std::numbers::pi : 1000 * value;
}

Timeline model_motion_timeline(const ModelMotion& motion, const Scene& scene) {
    const double units = scene_units_per_metre(scene.unit);
    Timeline timeline;
    timeline.last_frame = motion.frame_count() - 1;
    timeline.bone_tracks.resize(scene.bones.size());
    std::vector<int> body_of(scene.bones.size(), -1);
    for (std::size_t b = 0; b < motion.bone_of_body.size(); ++b)
        if (const int bone = motion.bone_of_body[b].empty() ? -1 : scene.bone_index(motion.bone_of_body[b]);
            bone >= 0 && body_of[static_cast<std::size_t>(bone)] < 0) {
            body_of[static_cast<std::size_t>(bone)] = static_cast<int>(b);
            timeline.bone_tracks[static_cast<std::size_t>(bone)].keys.push_back({0, Pose{}});
        }
    std::vector<Pose> poses;
    for (int k = 0; k < motion.frame_count(); ++k) {
        if (motion.coordinate >= 0)
            timeline.angles.push_back({double(k), motion.at(k)[static_cast<std::size_t>(motion.coordinate)]});
        if (k == 0)
            continue;
        place_bodies(motion.model->skeleton, motion.at(k), poses);
        for (std::size_t bone = 0; bone < body_of.size(); ++bone) {
            if (body_of[bone] < 0)
                continue;
            const auto b = static_cast<std::size_t>(body_of[bone]);
            Pose pose = motion.body_pose(b, k, poses).after(motion.rest[b].inverse());
            if ((pose.rotation - Mat3::Identity()).norm() < 1e-12 && pose.translation.norm() < 1e-12)
                pose = {}; // what is left of a bone that stays
            pose.translation *= units;
            std::vector<PoseKey>& keys = timeline.bone_tracks[bone].keys;
            const PoseKey key{double(k), pose};
            if (!pose.rotation.allFinite() || !pose.translation.allFinite() ||
                check_step(keys.back(), key) != KeyStep::good)
                throw_error(motion.trial_source.path,
                            "bone '" + scene.bones[bone].name +
                                "' would turn by half a turn or more before frame " + std::to_string(k),
                            "smaller steps between rows, or more --trial-frames");
            keys.push_back(key);
        }
    }
    bool any = false;
    for (std::size_t bone = 0; bone < scene.bones.size(); ++bone)
        any = any || timeline.moves(static_cast<int>(bone));
    if (!any)
        throw_error(motion.trial_source.path, "no bone moves in it",
                    "a trial that moves bodies that have a bone");
    return timeline;
}

int main_coordinate(const ModelMotion& motion, const std::vector<int>& bodies) {
    const Skeleton& skeleton = motion.model->skeleton;
    std::vector<int> with_bone;
    for (std::size_t b = 0; b < motion.bone_of_body.size(); ++b)
        if (!motion.bone_of_body[b].empty())
            with_bone.push_back(static_cast<int>(b));
    std::vector<Pose> poses;
    std::vector<double> rates;
    std::vector<Twist> twists;
    const std::span<const double> q = motion.rest_values;
    place_bodies(skeleton, q, poses);
    const auto turns = [&](const std::vector<int>& among, bool against_ground) {
        for (const int b : among)
            for (const int a : among)
                if ((twists[static_cast<std::size_t>(b)].angular -
                     twists[static_cast<std::size_t>(a)].angular)
                            .norm() > 1e-6 ||
                    (against_ground && twists[static_cast<std::size_t>(b)].angular.norm() > 1e-6))
                    return true;
        return false;
    };
    int best = -1, best_rank = 0;
    double best_range = 0;
    for (const int c : motion.moving) {
        if (skeleton.coordinates[static_cast<std::size_t>(c)].kind != CoordinateKind::rotational)
            continue;
        coordinate_rates(skeleton, q, c, rates);
        body_twists(skeleton, q, rates, poses, twists);
        const int rank = turns(bodies, false)      ? 3
                         : turns(with_bone, false) ? 2
                         : turns(with_bone, true)  ? 1
                                                   : 0;
        const double range = range_of(motion, c);
        if (rank > best_rank || (rank == best_rank && rank > 0 && range > best_range)) {
            best = c;
            best_rank = rank;
            best_range = range;
        }
    }
    return best;
}

} // namespace fascicle
