#pragma once
// A moving solid seen through its voxels, and the two responses of the published program (notes 1.3).

#include "fascicle/base/pose.hpp"
#include "solver/classic/voxel_grid.hpp"

#include <optional>

namespace fascicle::classic {

class VoxelObstacle {
public:
    VoxelObstacle(const TriMesh& rest_mesh, bool meant) : grid_(rest_mesh, meant), meant_(meant) {}

    /// Moves the solid from one pose to another, once, at the start of a frame. A solid that does not move
    /// (within rounding) keeps the increment of the last frame in which it did: for the published equations
    /// it stays in force for ever (finding 9), for the meant ones it is the identity.
    void move(const Pose& from, const Pose& to);
    /// meant: the increment has been used up by the first substep of the frame.
    void end_substep();

    /// Where a vertex has to go that was at x and wants to go to p (world frame); nothing when it is not in
    /// the way. B, x is inside: the solid has run over the vertex, which goes along with it.
    ///    published: x in the rest frame, moved by the last increment (which belongs to the world frame:
    ///    right only while increments commute, as turns about one axis do), back to the world. meant: x moved
    ///    by this frame's increment; x itself when the solid does not move.
    /// A, x is outside: from p back towards x in steps of one voxel, until a cell is free: that place (up to
    /// one voxel
    ///    beyond x), or x when there is none. No projection, no sliding, no friction.
    std::optional<Vec3> respond(const Vec3& x, const Vec3& p) const;
    /// Whether a point in the world frame is in an inside cell.
    bool inside(const Vec3& x) const { return grid_.inside(grid_.to_voxels(pose_.apply_inverse(x))); }
    const VoxelGrid& grid() const { return grid_; }

private:
    VoxelGrid grid_;
    bool meant_;
    Pose pose_;
    Pose increment_;
};

} // namespace fascicle::classic
