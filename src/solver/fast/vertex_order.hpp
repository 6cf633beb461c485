#pragma once
// An order of vertices in which neighbours are close: reverse Cuthill-McKee from a far end of every component.
// Source: Cuthill & McKee 1969; George & Liu 1979 (pseudo-peripheral start).

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle::solver::fast {

/// V vertices in their new order; lone vertices come at the end. The same input gives the same order.
std::vector<int> vertex_order(const MeshTopology& topology);

} // namespace fascicle::solver::fast
