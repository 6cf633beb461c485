#pragma once
// Closed curves on a surface along which a field has one value.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// A closed curve (no point twice). Seen against the outward normal, lower values lie on its left: so loops of one field
/// are all turned the same way about its gradient.
struct Isoline {
    Points points;
    double length = 0;
};

/// Isolines of a piecewise linear field (V values). Vertices at exactly the level count as above it. Curves that end at a
/// border are closed by a straight line. Longest first.
class IsolineFinder {
public:
    IsolineFinder(const TriMesh& mesh, const MeshTopology& topology, const std::vector<double>& field);
    std::vector<Isoline> at(double level);

private:
    const TriMesh& mesh_;
    const MeshTopology& topology_;
    const std::vector<double>& field_;
    std::vector<int> edge_of_;                 ///< by half-edge 3 t + corner
    std::vector<std::array<double, 2>> range_; ///< lowest and highest value of each triangle
    std::vector<int> next_, seen_;             ///< by edge: of the current level
};

/// Points at `count` equal steps along a closed curve, the first at its first point.
Points resampled_loop(const Isoline& loop, std::size_t count);

} // namespace fascicle
