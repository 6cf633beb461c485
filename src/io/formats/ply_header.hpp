#pragma once
// The header of a PLY file.

#include "io/formats/binary_numbers.hpp"
#include "io/formats/text_scanner.hpp"

#include <vector>

namespace fascicle::io {

struct PlyProperty {
    std::string name; ///< as in the file
    NumberType type;
    NumberType count_type; ///< of a list; kind 0 otherwise
    bool is_list() const { return count_type.kind != 0; }
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::size_t position = 0; ///< of its line, for messages
    std::vector<PlyProperty> properties;
    /// Bytes that one takes at the least: in ascii a digit and a blank for each number.
    std::size_t least_bytes(bool ascii) const;
};

struct PlyHeader {
    bool ascii = true, big_endian = false;
    std::vector<PlyElement> elements;
};

/// Reads up to the end of the line end_header, where the data start. Error naming the line.
PlyHeader read_ply_header(TextScanner& scanner);

} // namespace fascicle::io
