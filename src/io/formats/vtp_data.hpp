#pragma once
// Binary data of VTK XML files: raw or base64, plain or in blocks of zlib, as bytes.

#include "io/formats/binary_numbers.hpp"
#include "io/formats/xml_reader.hpp"

#include <cstdint>
#include <vector>

namespace fascicle::io {

/// What the file's outermost element says about binary data, and what its reader keeps for all arrays.
struct VtpEncoding {
    bool big_endian = false;
    std::size_t header_bytes = 4;
    std::string compressor;    ///< as in the file; empty without compression
    std::string_view appended; ///< what follows the underscore of <AppendedData>
    bool has_appended = false;
    bool appended_is_base64 = false;
    /// Numbers that may still be read from binary data. A few bytes can stand for many numbers when they are compressed, and many
    /// arrays can name the same appended bytes: this bounds the memory.
    std::uint64_t numbers_left = 0;
};

/// numbers_left for a file of this size: 4 million (32 MB), and 8 for every byte of the file.
inline std::uint64_t vtp_number_limit(std::size_t file_bytes) {
    return 4'000'000 + 8 * static_cast<std::uint64_t>(file_bytes);
}

/// Bytes from a text, decoded piece by piece.
class VtpByteSource {
public:
    VtpByteSource(std::string_view text, bool base64) : text_(text), base64_(base64) {}
    /// The next `count` bytes; false when there are not as many, or the base64 is bad. The view holds until the next call.
    bool take(std::size_t count, std::string_view& bytes);
    /// Base64 runs end with padding and the next one begins anew; what is left of a run is passed over.
    void end_run() { run_.clear(); }
    /// An upper bound for what is left.
    std::size_t most_left() const { return base64_ ? text_.size() / 4 * 3 + run_.size() : text_.size(); }
    /// Whether nothing but white space is left.
    bool at_end();

private:
    bool next_quad();

    std::string_view text_;
    bool base64_;
    std::string run_;   ///< decoded, not taken yet
    std::string taken_; ///< what the last view looks at
};

/// Appends the numbers of one array, whose data begin with their header. Error naming the place when anything is not as the header
/// says, or beyond encoding.numbers_left, which is lowered.
void read_vtp_data(const XmlReader& xml, VtpByteSource& source, VtpEncoding& encoding, NumberType type,
                   std::vector<double>& values);

/// Finds the appended data of a file, which stand behind the arrays that name them. Error when the file ends within.
void find_appended_data(std::string_view bytes, const std::string& file, VtpEncoding& encoding);

} // namespace fascicle::io
