#pragma once
// OFF, the text format of Geomview ("Object File Format"), as MeshLab and CGAL write it.

#include "fascicle/io/mesh_data.hpp"

#include <ostream>
#include <string_view>

namespace fascicle::io {

/// Reads OFF, COFF, NOFF and CNOFF, also with the first word left out; faces of three and more corners become fans, of two a
/// line, of one nothing. Normals are an array "Normals", colours "RGB" or "RGBA" with the numbers of the file; texture
/// coordinates (ST) and colours of faces are passed over. # begins a comment. Error naming file and line, also for the binary
/// form and for four-dimensional points (4OFF, nOFF).
MeshData read_off(std::string_view bytes, const std::string& file);

/// The shortest numbers that read back the same, with arrays of the names above. Lines and other arrays are left out.
void write_off(std::ostream& out, const MeshData& data);

bool looks_like_off(std::string_view bytes);

} // namespace fascicle::io
