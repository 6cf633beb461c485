#include "simulation/clean_up.hpp"

#include <algorithm>

namespace fascicle {

namespace {

/// Largest violation of the offset over the solids at rest, and where it pushes to.
double push_once(Vec3& p, std::span<const DistanceGrid* const> grids, double offset) {
    double worst = 0;
    for (const DistanceGrid* grid : grids) {
        const DistanceSample sample = grid->sample(p);
        const double depth = offset - sample.value;
        if (depth <= 0.0)
            continue;
        worst = std::max(worst, depth);
        if (const double squared = sample.gradient.squaredNorm();
            squared > 0.09) // else no direction to trust
            p += depth / squared * sample.gradient;
    }
    return worst;
}

} // namespace

CleanUpResult push_out_at_rest(Points& positions, const std::vector<int>& body_of_vertex,
                               std::span<const DistanceGrid* const> grids, double offset) {
    CleanUpResult result;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (body_of_vertex[i] >= 0)
            continue;
        Vec3 p = positions[i];
        double depth = push_once(p, grids, offset);
        if (depth == 0.0)
            continue;
        for (int step = 0; step < 20 && depth > 1e-3 * offset; ++step)
            depth = push_once(p, grids, offset);
        if (depth > offset || !p.allFinite()) {
            ++result.still_inside;
            continue; // better left than thrown about
        }
        ++result.moved;
        result.largest_shift = std::max(result.largest_shift, (p - positions[i]).norm());
        positions[i] = p;
    }
    return result;
}

int release_swept_attachments(std::vector<Attachment>& attachments, const Points& rest,
                              const Timeline& timeline, std::span<const DistanceGrid* const> grids,
                              double clearance) {
    const int samples = std::min(timeline.last_frame, 150);
    std::vector<std::vector<Pose>> poses; // per sample, per bone
    for (int s = 0; s <= samples && samples > 0; ++s) {
        poses.emplace_back();
        for (std::size_t b = 0; b < grids.size(); ++b)
            poses.back().push_back(
                timeline.bone_pose(static_cast<int>(b), double(s) * timeline.last_frame / samples));
    }
    int released = 0;
    for (Attachment& attachment : attachments) {
        const auto own = static_cast<std::size_t>(attachment.bone);
        const auto is_hit = [&](int vertex) {
            const Vec3& p = rest[static_cast<std::size_t>(vertex)];
            for (std::size_t b = 0; b < grids.size(); ++b) {
                if (b == own)
                    continue;
                const double at_rest = grids[b]->value(p);
                for (const auto& pose : poses) {
                    const double now = grids[b]->value(pose[b].apply_inverse(pose[own].apply(p)));
                    if (now < clearance && now < at_rest - 1e-6 * clearance)
                        return true;
                }
            }
            return false;
        };
        released += static_cast<int>(std::erase_if(attachment.vertices, is_hit));
    }
    std::erase_if(attachments, [](const Attachment& a) { return a.vertices.empty(); });
    return released;
}

} // namespace fascicle
