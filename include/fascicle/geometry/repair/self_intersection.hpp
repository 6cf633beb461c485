#pragma once
// Triangles of one surface that run through each other.

#include "fascicle/base/job_control.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Sign of the volume of the tetrahedron a, b, c, d: +1 when d is on the side from which a, b, c run clockwise (below), -1 above,
/// 0 when they are in a plane. Doubles with Shewchuk's error bound (1997, "Adaptive precision floating-point arithmetic",
/// eq. for ORIENT3D A), and numbers of 113 bits where that does not decide; what is below their rounding counts as a plane.
int orientation_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether two triangles cross: an edge of one goes from one side of the other to the other side, through it or its border;
/// or both lie in one plane and overlap with an area. Touching is not crossing. Triangles that share a vertex cross when the
/// edge opposite to it goes through the other; those that share an edge when they lie folded on each other.
/// The corners are compared by index, then placed by `points`.
bool triangles_cross(const Points& points, const Tri& s, const Tri& t);

struct CrossingReport {
    int pairs = 0;
    bool complete = true;                  ///< false: there may be more than `pairs`
    std::vector<std::array<int, 2>> first; ///< up to `keep` pairs of triangles, ascending
    std::vector<int> triangles;            ///< all that take part, ascending
};

/// All pairs, each once, found through a tree of boxes; of a hopeless tangle some: each run of 1024 triangles ends after 20,000
/// pairs or 4 million neighbours, so that work and memory stay in proportion to the mesh. Triangles with a repeated index are passed over.
/// Any number of threads gives the same report. Cancelled when asked.
CrossingReport find_crossings(const TriMesh& mesh, int threads = 1, const JobControl& control = {},
                              std::size_t keep = 10);

} // namespace fascicle
