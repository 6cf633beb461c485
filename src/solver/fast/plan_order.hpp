#pragma once
// Cuts the ordered vertices into blocks of records, with room for padding behind each.

#include "solver/fast/plan.hpp"

#include <vector>

namespace fascicle::solver::fast {

/// Blocks come in pairs, for two threads or a multiple of that. At most about this many vertices each, so that on large meshes
/// the data of a block stays in a core's cache; at least the other number, or a block is not worth a meeting of threads.
inline constexpr std::size_t largest_block = 8192;
inline constexpr std::size_t smallest_block = 512;

struct BlockLayout {
    std::vector<std::size_t> first_record; ///< of each block, and the end; padding comes last in a block
    std::size_t blocks() const { return first_record.size() - 1; }
};

/// Fills plan.record_of_vertex, groups, chunks. The blocks share the free vertices evenly: attached ones, V flags in `held`, cost
/// next to nothing. Nothing when 16-bit indices do not reach.
std::optional<BlockLayout> lay_out_blocks(const MeshTopology& topology, const std::vector<bool>& held,
                                          Plan& plan);

/// Rings of all groups: ring_base, ring_first, ring_length, rings.
/// False when a ring does not fit 16-bit indices, or several open fans meet in a vertex.
bool lay_out_rings(const std::vector<Tri>& triangles, const MeshTopology& topology, Plan& plan);

} // namespace fascicle::solver::fast
