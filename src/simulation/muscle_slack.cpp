#include "simulation/muscle_slack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr int sections = 15;

/// A third of the area of the triangles at each vertex.
std::vector<double> vertex_areas(const TriMesh& mesh) {
    std::vector<double> areas(mesh.positions.size(), 0.0);
    for (const Tri& t : mesh.triangles) {
        const Vec3 &a = mesh.positions[static_cast<std::size_t>(t[0])],
                   &b = mesh.positions[static_cast<std::size_t>(t[1])],
                   &c = mesh.positions[static_cast<std::size_t>(t[2])];
        for (const int v : t)
            areas[static_cast<std::size_t>(v)] += (b - a).cross(c - a).norm() / 6.0;
    }
    return areas;
}

} // namespace

Pose blended_pose(std::span<const Pose> poses, std::span<const double> shares) {
    // A dual quaternion q + e (t q) / 2, of the sign nearest to the pose that counts most.
    std::size_t main = 0;
    for (std::size_t b = 0; b < poses.size(); ++b)
        if (shares[b] > shares[main])
            main = b;
    const Eigen::Quaterniond reference(poses[main].rotation);
    Eigen::Vector4d real = Eigen::Vector4d::Zero(), dual = Eigen::Vector4d::Zero();
    for (std::size_t b = 0; b < poses.size(); ++b) {
        if (shares[b] == 0.0)
            continue;
        const Eigen::Quaterniond q(poses[b].rotation);
        const Vec3& t = poses[b].translation;
        const Eigen::Quaterniond d = Eigen::Quaterniond(0.0, t.x(), t.y(), t.z()) * q;
        const double w = q.dot(reference) < 0.0 ? -shares[b] : shares[b];
        real += w * q.coeffs();
        dual += 0.5 * w * d.coeffs();
    }
    const double norm = real.norm();
    if (!(norm > 1e-9)) // opposite turns: no blend
        return poses[main];
    const Eigen::Quaterniond q(Eigen::Vector4d(real / norm)), d(Eigen::Vector4d(dual / norm));
    const Eigen::Quaterniond t = d * q.conjugate();
    return {q.toRotationMatrix(), 2.0 * t.vec()};
}

MuscleSlack::MuscleSlack(const Scene& scene, const PreparedMuscle& muscle) {
    const std::size_t bones = scene.bones.size();
    const TriMesh& mesh = *muscle.problem.surface;
    const std::vector<double>& shares = muscle.bone_shares;
    std::vector<bool> held(bones, false), far(bones, false); // far: of the insertion's end
    for (const Attachment& attachment : muscle.attachments) {
        const auto b = static_cast<std::size_t>(attachment.bone);
        held[b] = true;
        far[b] = attachment_end(scene, attachment) == AttachmentKind::insertion;
    }
    if (shares.empty() || std::count(held.begin(), held.end(), true) < 2 ||
        std::count(far.begin(), far.end(), true) == 0)
        return;
    const std::vector<double> areas = vertex_areas(mesh);
    std::vector<Level> levels(sections + 1);
    std::vector<double> weights(levels.size(), 0.0);
    for (Level& level : levels)
        level.shares.assign(bones, 0.0);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        double u = 0; // 0 at the origin, 1 at the insertion
        for (std::size_t b = 0; b < bones; ++b)
            u += far[b] ? shares[i * bones + b] : 0.0;
        const double place = sections * std::clamp(u, 0.0, 1.0);
        const auto low = static_cast<std::size_t>(std::min(place, sections - 1.0));
        for (const std::size_t k : {low, low + 1}) {
            const double w = areas[i] * std::max(0.0, 1.0 - std::abs(place - double(k)));
            weights[k] += w;
            levels[k].centre += w * mesh.positions[i];
            for (std::size_t b = 0; b < bones; ++b)
                levels[k].shares[b] += w * shares[i * bones + b];
        }
    }
    for (std::size_t k = 0; k < levels.size(); ++k) {
        double sum = 0;
        for (const double s : levels[k].shares)
            sum += s;
        if (!(weights[k] > 0.0) || !(sum > 0.0))
            continue;
        levels[k].centre /= weights[k];
        for (double& s : levels[k].shares)
            s /= sum;
        levels_.push_back(levels[k]);
    }
    rest_length_ = length(std::vector<Pose>(bones));
}

double MuscleSlack::length(std::span<const Pose> poses) const {
    if (levels_.size() < 2)
        return 1.0;
    double sum = 0;
    Vec3 before = Vec3::Zero();
    for (std::size_t k = 0; k < levels_.size(); ++k) {
        const Vec3 p = blended_pose(poses, levels_[k].shares).apply(levels_[k].centre);
        if (k > 0)
            sum += (p - before).norm();
        before = p;
    }
    return rest_length_ > 0.0 ? sum / rest_length_ : sum;
}

} // namespace fascicle
