#pragma once
// One <DataArray> of a VTK XML file as numbers.

#include "fascicle/io/mesh_data.hpp"
#include "io/formats/vtp_data.hpp"

namespace fascicle::io {

/// Whether the <DataArray> that has just started holds numbers (not text).
bool is_number_array(const XmlReader& xml);

/// Reads the <DataArray> (or the <Array> of texts, as the bytes of its characters) that has just started, to its end: ascii, inline base64, or from the appended data. Error when its numbers
/// are not numbers, its type is unknown, or its data are not what their header says.
NamedArray read_vtp_array(XmlReader& xml, VtpEncoding& encoding);

} // namespace fascicle::io
