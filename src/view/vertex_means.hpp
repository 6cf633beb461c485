#pragma once
// Quantities of edges as one value per vertex, for colours.

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle::view {

/// Per vertex the mean of its edges' values (E); `without` where it has none.
std::vector<double> vertex_means(const MeshTopology& topology, const std::vector<double>& edge_values,
                                 double without);

/// Per vertex the mean of |wrap(theta - theta0)| in degrees over the dihedrals whose edge ends there, theta the signed angle
/// (geometry/dihedral_angle.hpp), theta0 that at rest: what metrics' mean dihedral change is made of. 0 where there is none.
class VertexDihedralChange {
public:
    VertexDihedralChange(const MeshTopology& topology, const Points& rest);
    /// points: as many as at rest; V values.
    std::vector<double> measure(const Points& points) const;

private:
    std::size_t vertices_;
    std::vector<Dihedral> dihedrals_; ///< with an angle at rest
    std::vector<double> rest_angles_;
};

} // namespace fascicle::view
