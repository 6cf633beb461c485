#pragma once
// The steps of repair(), each a function of its own. All are deterministic and take about n log n.

#include "fascicle/base/job_control.hpp"
#include "fascicle/geometry/repair/repair.hpp"
#include "fascicle/geometry/repair/self_intersection.hpp"

namespace fascicle::detail {

/// The mesh under repair. origins: one per vertex; now: by vertex of the input, what has become of it, or -1.
struct RepairMesh {
    TriMesh mesh;
    std::vector<VertexOrigin> origins;
    std::vector<int> now;

    explicit RepairMesh(TriMesh input) : mesh(std::move(input)) {
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            origins.push_back(VertexOrigin::of(v));
            now.push_back(v);
        }
    }
    /// Vertices became these (-1: gone).
    void follow(const std::vector<int>& became) {
        for (int& v : now)
            v = v < 0 ? -1 : became[static_cast<std::size_t>(v)];
    }

    int copy_vertex(int v) {
        return add_vertex(mesh.positions[static_cast<std::size_t>(v)], origins[static_cast<std::size_t>(v)]);
    }
    int add_vertex(const Vec3& p, const VertexOrigin& origin) {
        mesh.positions.push_back(p);
        origins.push_back(origin);
        return mesh.vertex_count() - 1;
    }
};

inline std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// Drops triangles with an index out of range or a corner that is not finite or beyond 1e50. Returns how many.
int drop_unusable(TriMesh& mesh);
/// Drops vertices that no triangle uses; order is kept. Returns how many.
int drop_unused_vertices(RepairMesh& m);
/// Drops the triangles marked with 1.
void drop_triangles(std::vector<Tri>& triangles, const std::vector<char>& gone);

/// Mean length of the sides of the triangles that have three different corners; 0 without any.
double mean_edge_length(const TriMesh& mesh);
/// Whether every edge has two triangles that walk it in opposite directions.
bool closed_and_paired(const TriMesh& mesh);

/// For each vertex the lowest vertex that stands for it: one within `tolerance` that stands for itself (the nearest, of equally
/// near ones the lowest), so that no chain grows longer than the tolerance. 0: exactly equal ones.
std::vector<int> near_vertices(const Points& points, double tolerance);

struct WeldCounts {
    int welded = 0;       ///< vertices that became another
    int repeated = 0;     ///< triangles with a repeated vertex, dropped
    int doubled = 0;      ///< triangles on another one, same orientation, dropped
    int back_to_back = 0; ///< triangles on another one, other orientation, dropped with it or without
};
/// Welds vertices at the border (edges with one triangle) that lie on each other within the tolerance; vertices all round
/// which the surface closes never are, so that bodies that touch stay bodies. A tolerance that does not leave fewer border edges
/// than exactly equal places do is given up. Drops triangles with a repeated vertex and those whose corners lie where another
/// triangle's do. Of back-to-back ones both go when the rest closes without them (a wall inside), one where it needs one (a surface
/// drawn from both sides). Repeats until nothing changes.
WeldCounts weld_and_drop_doubles(RepairMesh& m, double tolerance);

struct SheetCounts {
    int edges = 0;    ///< with more than two triangles
    int vertices = 0; ///< copies made
    int middles = 0;  ///< new vertices in the middle of edges
    std::vector<char>
        hanging; ///< by triangle: lost a side to two others, so belongs to a sheet inside or to a fin
};
/// Parts the surface into sheets: at every edge with more than two triangles these are sorted by their angle around it and
/// paired so that each pair bounds the solid; vertices get one copy per fan. See sheets.cpp.
SheetCounts part_sheets(RepairMesh& m);

struct OrientCounts {
    int turned_triangles = 0, turned_parts = 0, cavities = 0, non_orientable = 0;
};
/// Consistent and outwards (mesh_check's mend()).
OrientCounts orient_outwards(RepairMesh& m);

struct IslandCounts {
    int sheets = 0, islands = 0, flat = 0; ///< parts dropped
    int triangles = 0;                     ///< in them
};
/// Drops open parts that hang on another one, never the largest; then parts below `share` of the largest one's area.
IslandCounts drop_islands(RepairMesh& m, std::vector<char> hanging, double share);
/// Drops closed parts that enclose next to nothing: |V| <= 1e-6 A^(3/2) (a ball: 0.094).
IslandCounts drop_flat_parts(RepairMesh& m);

struct FillCounts {
    int holes = 0, filled = 0, too_large = 0; ///< too_large: more than the share of its part
    int triangles = 0, vertices = 0;          ///< added
    double area = 0;                          ///< of the patches
};
/// Fills holes (fill_holes.hpp); patches over more than a few edges are refined and made fair (patch.cpp).
FillCounts fill_and_fair(RepairMesh& m, int max_edges, double share);
/// Refines the triangles from `first` on of a closed, manifold mesh to the density of their surroundings, and fairs the new
/// vertices. Returns how many vertices are new.
int fair_patches(RepairMesh& m, int first);

struct SliverCounts {
    int found = 0, collapsed = 0, flipped = 0, left = 0;
};
/// Of a closed, manifold, oriented mesh: edges up to `shortest` are collapsed, triangles without area flipped or collapsed away,
/// where the topology stays and nothing folds over.
SliverCounts remove_slivers(RepairMesh& m, double shortest);

/// Moves apart vertices that lie on each other within `tolerance` and yet are different. Returns how many moved.
int separate_sheets(RepairMesh& m, double tolerance);

/// Smooths around crossing triangles until none is left or no more go; keeps the best. Returns what is left.
CrossingReport untangle(RepairMesh& m, CrossingReport crossings, int threads, const JobControl& control);

struct ResampleCounts {
    double volume_before = 0, volume_after = 0;
    double offset = 0;      ///< by which all vertices were moved along their normals
    double edge_length = 0; ///< mean, reached
};
/// Remeshes to a number of triangles, keeps near the surface, and offsets along the normals until the volume is back.
/// Origins become the nearest points of `input`, whose vertices they number.
ResampleCounts resample(RepairMesh& m, const TriMesh& input, int triangles, int threads,
                        const JobControl& control);

} // namespace fascicle::detail
