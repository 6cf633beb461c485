#include "solver/classic/voxel_obstacle.hpp"

#include <cmath>

namespace fascicle::classic {

void VoxelObstacle::move(const Pose& from, const Pose& to) {
    pose_ = to;
    // Two poses of a resting solid may differ by rounding; that is no motion.
    const double size =
        (grid_.cell() * VoxelGrid::size).norm() + from.translation.norm() + to.translation.norm();
    const bool moved = (to.rotation - from.rotation).norm() > 1e-12 ||
                       (to.translation - from.translation).norm() > 1e-12 * size;
    if (moved)
        increment_ = to.after(from.inverse());
    else if (meant_)
        increment_ = Pose();
}

void VoxelObstacle::end_substep() {
    if (meant_)
        increment_ = Pose();
}

std::optional<Vec3> VoxelObstacle::respond(const Vec3& x, const Vec3& p) const {
    const Vec3 x_rest = pose_.apply_inverse(x);
    const Vec3 x_voxel = grid_.to_voxels(x_rest);
    if (grid_.inside(x_voxel)) {
        if (meant_)
            return increment_.apply(x);
        return pose_.apply(increment_.apply(x_rest));
    }
    Vec3 at = grid_.to_voxels(pose_.apply_inverse(p));
    if (!grid_.inside(at))
        return std::nullopt;
    const Vec3 back = x_voxel - at;
    const double length = back.norm(); // > 0: one end is inside, the other is not
    const Vec3 step = back / length;
    for (double steps = 0.0; steps < length + 1.0; steps += 1.0) {
        if (!grid_.inside(at))
            return pose_.apply(grid_.from_voxels(at));
        at += step;
    }
    return x;
}

} // namespace fascicle::classic
