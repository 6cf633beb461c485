#pragma once
// bind_inside() for callers that have the lines already.

#include "anatomy/fibres/line_crossings.hpp"
#include "fascicle/anatomy/fibre_carrier.hpp"

namespace fascicle {

/// lines: one for each of chord_directions(), over the surface. Else as bind_inside().
FibreCarrier bind_to_chords(const TriMesh& surface, const MeshTopology& topology,
                            const std::vector<LineCrossings>& lines, std::span<const Vec3> rest_points,
                            int threads);

} // namespace fascicle
