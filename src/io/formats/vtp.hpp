#pragma once
// VTK XML polydata (.vtp).

#include "fascicle/io/mesh_data.hpp"

#include <ostream>
#include <string_view>

namespace fascicle::io {

/// Reads points, polygons (cut into fans), strips, lines, and the arrays of points and of lines; several
/// pieces are put together. Data arrays in ascii, inline base64 ("binary") or appended (raw and base64), plain or compressed with
/// zlib, either byte order, UInt32 or UInt64 headers; LZ4 and LZMA are refused with an error that says how to save the file
/// instead. Nothing is allocated before counts are compared with what the file holds, and no file may hold more numbers than
/// vtp_number_limit says.
MeshData read_vtp(std::string_view bytes, const std::string& file);

/// ascii, Float64, with the shortest numbers that read back the same: exact, and the one form that OpenSim
/// reads too. Arrays of lines are left out when there are triangles: cell data need a value for every cell.
void write_vtp(std::ostream& out, const MeshData& data);

bool looks_like_vtp(std::string_view bytes);

} // namespace fascicle::io
