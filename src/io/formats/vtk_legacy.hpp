#pragma once
// Legacy VTK polydata, file versions 1.0 to 5.1 ("VTK File Formats", Kitware), ASCII and big-endian BINARY.

#include "fascicle/io/mesh_data.hpp"

#include <ostream>
#include <string_view>

namespace fascicle::io {

/// Reads POINTS, POLYGONS (cut into fans), TRIANGLE_STRIPS and LINES, also in the OFFSETS/CONNECTIVITY form
/// of 5.x. Attributes and fields of points are arrays of points (scalars, vectors, normals, texture coordinates, colours as
/// bytes, tensors, ids), those of lines arrays of lines; VERTICES, METADATA, look-up tables, bits, texts and, with a note, the
/// attributes of polygons are passed over. Attributes that cannot be understood end the reading with a note, since the geometry comes before them. Keywords in any
/// case, lines ending in LF or CRLF. Nothing is allocated before the counts are compared with what the file
/// still holds. Error naming file and line (ASCII) or byte (BINARY).
MeshData read_vtk_legacy(std::string_view bytes, const std::string& file);

/// Version 3.0, BINARY, points as double, `POLYGONS n size` and `LINES n size`: the form all tools read. Arrays
/// of points and, when there are no triangles, of lines as fields.
void write_vtk_legacy(std::ostream& out, const MeshData& data);

bool looks_like_vtk_legacy(std::string_view bytes);

} // namespace fascicle::io
