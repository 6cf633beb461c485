#pragma once
// Makes a closed, manifold, consistently oriented surface of a triangle list with defects, or says why it cannot.

#include "fascicle/base/job_control.hpp"
#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/geometry/repair/vertex_origin.hpp"

namespace fascicle {

/// Lengths in units of the mesh.
struct RepairOptions {
    /// Border vertices that are nearer than this become one. Below 0: a thousandth of the mean edge length.
    double weld = -1;
    /// Holes with up to this many edges are filled; 0: none. At most longest_hole.
    int fill_edges = 100;
    /// ... unless a hole is larger than this share of its part's area: then the surface is a sheet rather than a solid.
    double fill_share = 0.15;
    /// Parts with less than this share of the largest part's area go: specks, and cavities that small. 0: all stay.
    double island_share = 0.01;
    /// Taubin's smoothing, passes; 0: none.
    int smooth_passes = 0;
    /// Remeshes to this edge length, or to this number of triangles; 0: as it is. Not both.
    double edge_length = 0;
    int triangles = 0;
    /// Largest share by which remeshing may change the volume.
    double volume_share = 0.005;
    /// Tries to part crossing triangles by smoothing what is around them.
    bool untangle = false;
    int threads = 1;  ///< never changes a result
    std::string unit; ///< of lengths, for texts alone: "mm"

    static constexpr int longest_hole = 1000; ///< the filler's work grows with the third power of the edges
};

/// What one step did. Steps that had nothing to do are not listed.
struct RepairStep {
    std::string key;  ///< for programs: "weld", "duplicates", ...
    std::string text; ///< for people: one sentence without a full stop
    int found = 0;    ///< of what the step looks for
    int done = 0;     ///< of these put right; the rest is left
};

struct SurfaceMeasures {
    int vertices = 0, triangles = 0; ///< vertices: those that triangles use
    double area = 0;
    double volume = 0; ///< 0 and `closed` false when the surface encloses none
    bool closed = false;
};

struct RepairResult {
    TriMesh mesh;
    /// By vertex of the input: its number in `mesh`, the first of its copies when it has several, or -1 when it is gone.
    std::vector<int> new_of_old;
    /// By vertex of `mesh`: where its values come from.
    std::vector<VertexOrigin> origins;
    MeshReport before, after;
    SurfaceMeasures measured_before, measured_after;
    std::vector<RepairStep> steps;
    int crossings = 0;                               ///< pairs of triangles of the result that cross
    std::vector<std::array<int, 2>> first_crossings; ///< up to 1000
    /// What is still worth knowing of the result, a sentence each: crossings, several parts, cavities.
    std::vector<std::string> left;
    /// Empty: closed, manifold, consistently oriented, outward. Else why not, half a sentence ("the surface has ...").
    std::string reason;

    bool good() const { return reason.empty(); }
    bool changed() const { return !steps.empty(); }
};

/// Steps, in this order: triangles with indices out of range or coordinates that are not finite (or beyond 1e50) are dropped; border
/// vertices welded; repeated, doubled and back-to-back triangles dropped; edges with more than two triangles parted into
/// sheets, vertices given one copy per fan; orientation made consistent; hanging sheets and islands dropped; holes filled, large
/// ones with a fair patch; needles collapsed and caps flipped; smoothing, remeshing, untangling where asked for; vertices of
/// different sheets that lie on each other moved apart by a thousandth of their edges, so that a file format without indices
/// keeps them apart; crossings found; everything turned outwards and checked. docs/formats.md, "Repair", tells each rule.
/// Vertices that stay keep their order, new ones come behind them; after remeshing all are new. A mesh without findings comes
/// back as it is, apart from unused vertices.
/// Any input is allowed. Cost: n log n of the triangles, n^3 of a hole's edges. Deterministic.
/// Cancelled when `control` asks for it. Error when options contradict each other.
RepairResult repair(TriMesh mesh, const RepairOptions& options = {}, const JobControl& control = {});

} // namespace fascicle
