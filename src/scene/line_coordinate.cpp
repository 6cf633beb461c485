// Which coordinate of a line model turns with the joint of a scene.
#include "fascicle/scene/line_muscles.hpp"

#include "fascicle/base/pose.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr double least_cosine = 0.9; // 25 degrees: joints of models are not quite about the axes of a scene

bool moves(const Scene& scene, const std::string& bone) {
    const int b = scene.bone_index(bone);
    return b >= 0 && b < static_cast<int>(scene.timeline.bone_tracks.size()) &&
           scene.timeline.bone_tracks[static_cast<std::size_t>(b)].moves();
}

} // namespace

LineCoordinate hinge_coordinate(const LineMuscles& lines, const Scene& scene, std::string* note) {
    const auto say = [&](const std::string& text) {
        if (note != nullptr)
            *note = text;
    };
    const std::string held = ": points that are there in a range of a coordinate stay as at rest";
    if (!scene.timeline.hinge || !has_direction(scene.timeline.hinge->axis)) {
        say("the motion has no single joint" + held);
        return {};
    }
    const Vec3 axis = scene.timeline.hinge->axis.normalized();
    const Skeleton& skeleton = lines.model->skeleton;
    const std::vector<char> used = bodies_in_use(*lines.model);
    Posture posture;
    set_posture(skeleton, lines.rest_values, posture);
    int staying = -1;
    std::vector<std::size_t> moving;
    for (std::size_t b = 0; b < used.size(); ++b)
        if (used[b] != 0 && moves(scene, lines.bone_of_body[b]))
            moving.push_back(b);
        else if (used[b] != 0 && staying < 0)
            staying = static_cast<int>(b);

    std::vector<double> rates;
    std::vector<Twist> twists;
    // Angular velocity of a body in the scene's axes: the model's axes are turned as the body's own rest is.
    const auto turning = [&](std::size_t b) -> Vec3 {
        return lines.rest[b].rotation * (posture.poses[b].rotation.transpose() * twists[b].angular);
    };
    LineCoordinate found;
    int candidates = 0;
    for (std::size_t c = 0; c < skeleton.coordinates.size(); ++c) {
        const bool dependent = std::any_of(skeleton.couplers.begin(), skeleton.couplers.end(),
                                           [&](const auto& k) { return k.dependent == static_cast<int>(c); });
        if (skeleton.coordinates[c].kind != CoordinateKind::rotational || skeleton.coordinates[c].locked ||
            dependent)
            continue;
        coordinate_rates(skeleton, posture.q, static_cast<int>(c), rates);
        body_twists(skeleton, posture.q, rates, posture.poses, twists);
        const Vec3 base = staying < 0 ? Vec3::Zero() : turning(static_cast<std::size_t>(staying));
        for (const std::size_t b : moving) {
            const Vec3 turn = turning(b) - base;
            if (turn.norm() < 0.1 || std::abs(turn.dot(axis)) < least_cosine * turn.norm())
                continue;
            found = {static_cast<int>(c), (turn.dot(axis) > 0 ? 1.0 : -1.0) / turn.norm()};
            ++candidates;
            break;
        }
    }
    if (candidates != 1) {
        say((candidates == 0 ? "no coordinate turns" : "several coordinates turn") +
            std::string(" moving bones about the hinge") + held);
        return {};
    }
    say("coordinate " + skeleton.coordinates[static_cast<std::size_t>(found.index)].name +
        " turns with the joint, " + (found.per_angle > 0 ? "in its sense" : "against its sense"));
    return found;
}

} // namespace fascicle
