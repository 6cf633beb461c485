#pragma once
// A finer mesh of exactly the same shape: every triangle cut into four at the middles of its edges.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// mesh: the V old vertices keep their indices, then one new vertex per edge of the old mesh's topology, in its order, at
/// (a + b) / 2. Each old triangle (a, b, c) becomes (a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca), at 4 t .. 4 t + 3;
/// one with a repeated index belongs to no edge and is dropped. Shape, area, volume and orientation stay.
struct Subdivision {
    TriMesh mesh;
    std::vector<Edge> parents; ///< ends of the edge that new vertex V + i sits on
};
Subdivision subdivide(const TriMesh& mesh, const MeshTopology& topology);
Subdivision subdivide(const TriMesh& mesh);

/// Labels of the finer mesh's vertices (e.g. the bone a vertex is fixed to): old vertices keep theirs, a new one has the
/// label that both of its ends have, else -1. labels: V of the old mesh.
std::vector<int> subdivided_labels(const Subdivision& subdivision, const std::vector<int>& labels);

/// Values with `width` numbers a vertex, row-major: a new vertex has the mean of its ends.
std::vector<double> subdivided_values(const Subdivision& subdivision, const std::vector<double>& values,
                                      std::size_t width);

} // namespace fascicle
