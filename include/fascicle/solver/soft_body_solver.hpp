#pragma once
// A deformable closed surface among moving solids: arrays in, arrays out. Knows no muscles, bones or scenes.
// A method is one class behind this interface and one row in solver_methods().

#include "fascicle/base/pose.hpp"
#include "fascicle/geometry/tri_mesh.hpp"
#include "fascicle/solver/parameters.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fascicle {

class DistanceGrid;

/// A solid that the soft body must not enter. mesh: at its rest pose. grid: signed distance at its rest pose;
/// only methods whose row says so need it, null otherwise.
struct SolidBody {
    MeshPtr mesh;
    std::shared_ptr<const DistanceGrid> grid;
};

/// Everything fixed at the start of a run. Lengths in scene units; `unit_mm` millimetres are one of them.
struct SoftBodyProblem {
    MeshPtr surface;                 ///< rest shape, V vertices, closed
    std::vector<int> body_of_vertex; ///< V: index of the solid a vertex is fixed to, -1 free
    /// Per MeshTopology edge: k = (1 - |u.v|)^a in [0, 1]; empty: 1 everywhere.
    std::vector<double> edge_softness;
    /// Per MeshTopology edge: (u.v)^2 in [0, 1] of its direction and the fibres', for set_active_length(); empty: there are none.
    std::vector<double> edge_along;
    std::vector<SolidBody> solids; ///< B solids
    /// V x B, row-major: share of solid b's motion that a free vertex is predicted to follow; empty: none.
    /// A predictor only: constraints start from the carried positions, velocities do not contain it.
    std::vector<double> carry_weights;
    int threads = 1;
    ParamSet parameters = default_parameters();
    double unit_mm = 1.0;
};

/// A half-space that a vertex must stay in during one frame: (x - p(s)) . normal >= least(s), s the share of the frame; p goes evenly
/// from `from` to `to`, least from least_from to least_to. normal: unit.
struct PointPlane {
    int vertex = -1;
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    Vec3 normal = Vec3::Zero();
    double least_from = 0, least_to = 0;
};

/// Running totals since the start, and seconds per stage.
struct StepReport {
    std::int64_t contacts = 0;   ///< vertices moved by contact, summed over substeps
    std::int64_t unresolved = 0; ///< vertices that contact could not put outside, summed over substeps
    std::int64_t non_finite = 0; ///< new positions that were not finite and were refused
    std::int64_t slid = 0;       ///< vertices that the hard bound stopped at a solid, summed over substeps
    std::int64_t ejected = 0;    ///< vertices put to the nearest place outside of all solids
    std::int64_t impossible = 0; ///< vertices for which there was no such place: the solids leave no room
    std::int64_t samples_pushed = 0; ///< points on edges and faces pushed out of solids
    std::int64_t samples_held =
        0; ///< those that had to be left inside, held by an attachment or by another solid
    std::map<std::string, double> stage_seconds;
    std::int64_t unconverged = 0; ///< passes that a method which seeks equilibrium ended without it
};

class SoftBodySolver {
public:
    virtual ~SoftBodySolver() = default;
    /// Advances one frame; solid b moves from `from[b]` to `to[b]` (poses from its rest pose), by screw motion.
    virtual void advance(std::span<const Pose> from, std::span<const Pose> to) = 0;
    /// Whether the method knows planes.
    virtual bool takes_planes() const { return false; }
    /// Planes for the next frame only, ascending by vertex.
    virtual void set_planes(std::span<const PointPlane> /*planes*/) {}
    /// From the next frame on the fibres are this long without stress, as a share of rest (active_strain.hpp), in (0, 1]; 1 at the
    /// start. Nothing happens without SoftBodyProblem::edge_along, or with a method that knows no such thing.
    virtual void set_active_length(double /*share*/) {}
    /// V positions. Vertices fixed to a solid are exactly where its pose puts them.
    virtual const Points& positions() const = 0;
    virtual const StepReport& report() const = 0;
    /// By how much each point moved in the last substep apart from what the solids carried it: V, what the next substep
    /// starts its prediction from. Empty: the method cannot go on from another solver's state.
    virtual Points last_step() const { return {}; }
    /// Goes on from another solver's positions and last_step(), V each; false (and nothing changes) when the method
    /// cannot. Only before the first frame.
    virtual bool set_state(const Points& /*positions*/, const Points& /*last_step*/) { return false; }
    /// The vertices that the method itself treats as fixed (classic fixes what collides at the start): V, -1 free.
    virtual const std::vector<int>& body_of_vertex() const = 0;
    /// Whether advance() works on SoftBodyProblem::threads threads; else on the caller's alone.
    virtual bool uses_threads() const { return false; }
    /// Bytes that grow with the surface and that the solver holds for itself: points, constraints, indices, scratch. Not
    /// in it: the shared rest mesh, and what belongs to the solids (meshes, grids, voxels).
    virtual std::size_t state_bytes() const = 0;
};

struct SolverMethod {
    std::string name; ///< of --method; parameters whose key begins with it and a dot are the method's own
    std::string line; ///< one line for help texts
    bool needs_grid;
    int passes;             ///< default of solver.iterations
    std::string pass_means; ///< what a pass is, in the plural
    std::unique_ptr<SoftBodySolver> (*make)(const SoftBodyProblem&);
    std::map<std::string, double> defaults = {}; ///< of parameters that differ from the table's
    /// Keys of parameters that the method does not use (or their beginnings, with a dot at the end), each with the reason for people.
    std::vector<std::pair<std::string, std::string>> unused = {};
    std::vector<ParamRow> parameters = {}; ///< the method's own: rows of parameter_table()
};

const std::vector<SolverMethod>& solver_methods();
/// Null when there is no such method.
const SolverMethod* find_solver_method(std::string_view name);

} // namespace fascicle
