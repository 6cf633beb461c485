#pragma once
// Cuts the ordered vertices into blocks of records, with room for padding behind each.

#include "solver/fast/plan.hpp"

namespace fascicle::solver::fast {

/// Vertices aimed at per block: two blocks for a muscle of 10,000, so that two threads have one each; the data of a block stays
/// in a core's cache on large meshes.
inline constexpr std::size_t block_target = 5120;

struct BlockLayout {
    std::size_t blocks = 1;
    std::size_t block_records = 0; ///< with padding; all blocks alike
};

/// Fills plan.record_of_vertex, groups, chunks. Nothing when 16-bit indices do not reach.
std::optional<BlockLayout> lay_out_blocks(const MeshTopology& topology, Plan& plan);

/// Rings of all groups: ring_base, ring_first, ring_length, rings.
/// False when a ring does not fit 16-bit indices, or several open fans meet in a vertex.
bool lay_out_rings(const std::vector<Tri>& triangles, const MeshTopology& topology, Plan& plan);

} // namespace fascicle::solver::fast
