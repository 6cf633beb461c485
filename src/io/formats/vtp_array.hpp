#pragma once
// One <DataArray> of a VTK XML file as numbers.

#include "fascicle/io/mesh_data.hpp"
#include "io/formats/xml_reader.hpp"

namespace fascicle::io {

/// What the file's outermost element says about binary data.
struct VtpEncoding {
    bool big_endian = false;
    std::size_t header_bytes = 4;
    bool compressed = false;
};

/// Whether the <DataArray> that has just started holds numbers (not text).
bool is_number_array(const XmlReader& xml);

/// Reads the <DataArray> that has just started, to its end. Error when its numbers are not numbers, its type
/// is unknown or its data are appended or compressed.
NamedArray read_vtp_array(XmlReader& xml, const VtpEncoding& encoding);

} // namespace fascicle::io
