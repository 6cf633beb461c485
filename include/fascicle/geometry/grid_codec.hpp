#pragma once
// Distance grids as bytes, to be kept between runs.

#include "fascicle/geometry/distance_grid.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace fascicle {

/// Hash of all that a grid depends on: the mesh, the options but for the threads, and the version of how grids are made
/// and written. Meshes that differ in anything have different keys.
std::string grid_key(const TriMesh& mesh, const DistanceGridOptions& options);

/// Numbers in the machine's own byte order. Saturated runs of a row, most of a grid, take 4 bytes.
std::string encode_grid(const DistanceGrid& grid);

/// The grid to the last bit, or nothing when the bytes are none or the grid has more than max_nodes nodes. Never reads
/// beyond the bytes.
std::optional<DistanceGrid> decode_grid(std::string_view bytes, std::size_t max_nodes, int threads = 1);

} // namespace fascicle
