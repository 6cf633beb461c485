#pragma once
// STL, ascii and binary (3D Systems, 1989).

#include "fascicle/io/mesh_data.hpp"

#include <cstdint>
#include <ostream>
#include <string_view>

namespace fascicle::io {

/// Reads the triangles of all solids; normals, colours and names are passed over. STL has no vertices: corners at equal
/// coordinates become one, numbered in the order of the file, and a note says how many. A file whose size is what the count of a
/// binary file says is binary, also when it begins with "solid". Error naming line (ascii) or byte (binary): a number that is
/// none or not finite, a triangle without three corners, fewer triangles than announced, an ascii file without its end.
MeshData read_stl(std::string_view bytes, const std::string& file);

/// Binary, float: coordinates are rounded, and vertices come back in the order in which triangles use them. Error when there is
/// no triangle, or a coordinate is beyond a float.
void write_stl(std::ostream& out, const MeshData& data);

bool looks_like_stl(std::string_view bytes);
/// Whether a file of `size` bytes that begins with `head` has exactly the triangles that a binary file announces.
bool has_size_of_binary_stl(std::string_view head, std::uintmax_t size);

} // namespace fascicle::io
