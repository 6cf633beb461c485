#pragma once
// PLY, the Stanford polygon format (G. Turk, 1994): ascii, binary of both byte orders.

#include "fascicle/io/mesh_data.hpp"

#include <ostream>
#include <string_view>

namespace fascicle::io {

/// Reads the elements vertex, face (polygons become fans), tristrips and edge (lines of two points), in any order, with
/// properties in any order and lists anywhere; other elements, lists of vertices and properties of faces are passed over, the last
/// with a note. Every other property of vertices is an array of points: nx ny nz are "Normals", red green blue (alpha) of one
/// byte "RGB" or "RGBA" (VTK's names), NAME_0 NAME_1 ... one array NAME, the rest arrays of one number under their own names.
/// Nothing is allocated before counts are compared with what the file still holds. Error naming line (ascii) or byte (binary).
MeshData read_ply(std::string_view bytes, const std::string& file);

/// Binary little-endian: positions and arrays of points as double, "RGB" and "RGBA" of whole numbers from 0 to 255 as bytes, so
/// that other programs show them; names that read_ply would take for something else with a letter as % and two digits. Lines are
/// written as edges, arrays of lines left out.
void write_ply(std::ostream& out, const MeshData& data);

bool looks_like_ply(std::string_view bytes);

} // namespace fascicle::io
