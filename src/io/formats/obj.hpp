#pragma once
// Wavefront OBJ: vertices, faces of any size, polylines.

#include "fascicle/io/mesh_data.hpp"

#include <ostream>
#include <string_view>

namespace fascicle::io {

/// Reads v, f and l; everything else (normals, texture coordinates, groups, materials, curves) is passed
/// over. Polygons become triangle fans. Indices count from 1, or backwards from -1; v/vt/vn triples are taken
/// apart. Error naming file and line for a bad number, a bad index, a coordinate that is not finite, a face
/// of fewer than three vertices.
///
/// Who does what: faces are taken apart by tinyobjloader. What it reads is checked first, line by line,
/// because it takes bad numbers for 0, lets indices overflow, knows no line numbers, and goes on where it
/// should stop. Coordinates are kept from that check: tinyobjloader's decimal conversion is off in the last
/// digits, so that a file written and read again would not be the same mesh.
MeshData read_obj(std::string_view bytes, const std::string& file);

/// v with the shortest numbers that read back the same, f, and l.
void write_obj(std::ostream& out, const MeshData& data);

/// Whether the text looks like OBJ: a line of v and three numbers before anything that cannot stand in one.
bool looks_like_obj(std::string_view bytes);

} // namespace fascicle::io
