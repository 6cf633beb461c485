#pragma once
// How much the dihedral angles of a muscle's surface have changed since rest.

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle {

/// Over the D dihedrals that have an angle at rest and now (dihedral_angle.hpp says which have none). All
/// values are NaN when there are none.
struct DihedralChange {
    double mean_rad = 0; ///< 1/D sum |wrap(theta - theta0)|, signed atan2 angles (methods.md 7), in [0, pi]
    double p10_rad = 0, p25_rad = 0, p50_rad = 0, p75_rad = 0, p90_rad = 0; ///< of |wrap(theta - theta0)|
    /// 1/D sum ||theta| - |theta0||, degrees: the unsigned acos form of Cervenka & Kohout 2020, blind to a
    /// crease that turned inside out.
    double unsigned_mean_deg = 0;
    double share_above_90_deg = 0; ///< share of dihedrals with |theta| > pi/2, whatever they were at rest
};

class DihedralChangeMeasure {
public:
    DihedralChangeMeasure(const std::vector<Dihedral>& dihedrals, const Points& rest);
    /// points: V positions, as many as at rest.
    DihedralChange measure(const Points& points);

private:
    std::vector<Dihedral> dihedrals_; ///< with an angle at rest
    std::vector<double> rest_angles_;
    std::vector<double> changes_, percentiles_; ///< kept between calls
};

} // namespace fascicle
