#pragma once
// <FieldData> of a VTK XML file, which stands before the points and says things about the whole: 3D Slicer's SPACE, our unit.

#include "fascicle/io/mesh_stamp.hpp"

namespace fascicle::io {

/// SPACE ("LPS", "RAS") and UP ("y", "z") are strings, MILLIMETRES_PER_UNIT is a number.
std::string vtp_field_data_text(const MeshStamp& stamp);

/// Whether the bytes begin as VTP and have FieldData in their first 64 kB.
bool is_vtp_with_field_data(std::string_view bytes);

/// What it says, in any encoding (ascii, inline, appended; zlib). Other fields are passed over, as is what cannot be read: the reader of the
/// mesh tells of errors.
MeshStamp read_vtp_field_data(std::string_view bytes);

} // namespace fascicle::io
