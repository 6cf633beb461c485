#pragma once
// The published method as the published program runs it: the yardstick (paper: Cervenka & Kohout 2020;
// program and quirks: notes 1.3 and docs/classic.md). In double, on one thread, one thing after the other.

#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/classic/classic_bending.hpp"
#include "solver/classic/classic_edges.hpp"
#include "solver/classic/classic_volume.hpp"
#include "solver/classic/voxel_obstacle.hpp"

namespace fascicle {

/// For the table of methods. Parameters read: solver.iterations (substeps of 1 ms a frame, default 3),
/// .stiffness, .bending, .pressure, .damping (velocity factor exp(-damping 1 ms) a substep) and
/// classic.equations. edge_softness multiplies the raw correction of an edge. When no vertex of the problem
/// is fixed, those that the voxels of a solid hold at rest are (last solid wins), as in the program's
/// scenarios.
std::unique_ptr<SoftBodySolver> make_classic_solver(const SoftBodyProblem& problem);

namespace classic {

/// Which constraints act; all, but in the program's three tests on a single tetrahedron (scenarios 3 to 5).
struct Switches {
    bool edges = true;
    bool volume = true;
    bool bending = true;
    bool contact = true;
};

class ClassicSolver final : public SoftBodySolver {
public:
    explicit ClassicSolver(const SoftBodyProblem& problem, Switches switches = {});

    void advance(std::span<const Pose> from, std::span<const Pose> to) override;
    const Points& positions() const override { return state_.position; }
    const StepReport& report() const override { return report_; }
    const std::vector<int>& body_of_vertex() const override { return state_.body; }
    std::size_t state_bytes() const override;

    /// Outer forces, one per vertex, held until changed; zero at first.
    Points& forces() { return state_.force; }
    const Points& velocities() const { return state_.velocity; }
    const std::vector<DirectedEdge>& edges() const { return edges_; }
    const std::vector<VoxelObstacle>& obstacles() const { return obstacles_; }

private:
    void move_solids(std::span<const Pose> from, std::span<const Pose> to);
    void substep();
    void resolve_contacts();

    bool meant_;
    Switches switches_;
    int substeps_;
    double velocity_factor_;
    double bending_;
    Points rest_;
    std::vector<bool> used_; ///< vertices of some triangle; others take no part
    std::vector<VoxelObstacle> obstacles_;
    ClassicState state_;
    std::vector<DirectedEdge> edges_;
    std::vector<BendingPair> pairs_;
    VolumeConstraint volume_;
    StepReport report_;
};

} // namespace classic
} // namespace fascicle
