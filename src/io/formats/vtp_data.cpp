#include "io/formats/vtp_data.hpp"

#include "io/base64.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <zlib.h>

namespace fascicle::io {
namespace {

/// Deflate packs at most 1032 bytes into one (a block of the same byte: 258 of them in two bits).
constexpr std::uint64_t most_inflated = 1032;

[[noreturn]] void fail_ends(const XmlReader& xml, const std::string& what) {
    xml.fail("binary data end too early, or are no good base64", what);
}

std::uint64_t take_number(const XmlReader& xml, VtpByteSource& source, const VtpEncoding& encoding) {
    std::string_view bytes;
    if (!source.take(encoding.header_bytes, bytes))
        fail_ends(xml, "a header of numbers of " + std::to_string(encoding.header_bytes) + " bytes");
    return take_bits(bytes, 0, encoding.header_bytes, encoding.big_endian);
}

/// Takes what an array of `bytes` needs from the limit of the file.
void count_numbers(const XmlReader& xml, VtpEncoding& encoding, std::uint64_t bytes, NumberType type,
                   std::vector<double>& values) {
    if (bytes % type.size != 0)
        xml.fail("binary data of " + std::to_string(bytes) + " bytes",
                 "whole numbers of " + std::to_string(type.size) + " bytes");
    if (bytes / type.size > encoding.numbers_left)
        xml.fail("arrays of more numbers than a file of this size is trusted with",
                 "at most 4 million and 8 for every byte of the file");
    encoding.numbers_left -= bytes / type.size;
    values.reserve(values.size() + static_cast<std::size_t>(bytes / type.size));
}

void add_numbers(std::string_view bytes, NumberType type, bool big_endian, std::vector<double>& values) {
    for (std::size_t i = 0; i < bytes.size(); i += type.size)
        values.push_back(to_number(take_bits(bytes, i, type.size, big_endian), type));
}

void read_plain(const XmlReader& xml, VtpByteSource& source, VtpEncoding& encoding, NumberType type,
                std::vector<double>& values) {
    const std::uint64_t length = take_number(xml, source, encoding);
    if (length > source.most_left())
        xml.fail("binary data of at most " + std::to_string(source.most_left()) + " bytes",
                 std::to_string(length) + ", as their header says");
    count_numbers(xml, encoding, length, type, values);
    std::string_view bytes;
    if (!source.take(static_cast<std::size_t>(length), bytes))
        fail_ends(xml, std::to_string(length) + " bytes, as their header says");
    add_numbers(bytes, type, encoding.big_endian, values);
}

/// [number of blocks][bytes of a block][bytes of the last one, 0: whole][compressed bytes of each], then the blocks.
void read_zlib(const XmlReader& xml, VtpByteSource& source, VtpEncoding& encoding, NumberType type,
               std::vector<double>& values) {
    const std::uint64_t blocks = take_number(xml, source, encoding);
    const std::uint64_t block_bytes = take_number(xml, source, encoding);
    const std::uint64_t last_bytes = take_number(xml, source, encoding);
    if (blocks > source.most_left() / encoding.header_bytes)
        xml.fail(std::to_string(blocks) + " compressed blocks", "as many as the data have room for");
    std::vector<std::uint64_t> sizes(static_cast<std::size_t>(blocks));
    for (std::uint64_t& size : sizes)
        size = take_number(xml, source, encoding);
    source.end_run();
    if (blocks == 0)
        return;
    const std::uint64_t most = most_inflated * source.most_left() + 1024;
    const std::uint64_t whole_blocks = last_bytes > 0 ? blocks - 1 : blocks;
    if (block_bytes == 0 || last_bytes > std::min(block_bytes, most) ||
        (whole_blocks > 0 && block_bytes > most / whole_blocks))
        xml.fail(std::to_string(blocks) + " compressed blocks of " + std::to_string(block_bytes) + " bytes",
                 "no more than zlib can pack into the data");
    const std::uint64_t total = whole_blocks * block_bytes + last_bytes;
    count_numbers(xml, encoding, total, type, values);
    std::string inflated; // a block, after what was left of a number that the one before cut through
    for (std::size_t b = 0; b < sizes.size(); ++b) {
        const std::uint64_t wanted = b + 1 == sizes.size() && last_bytes > 0 ? last_bytes : block_bytes;
        std::string_view packed;
        if (sizes[b] > source.most_left() || !source.take(static_cast<std::size_t>(sizes[b]), packed))
            fail_ends(xml, std::to_string(sizes[b]) + " bytes of a compressed block");
        const std::size_t before = inflated.size();
        inflated.resize(before + static_cast<std::size_t>(wanted));
        uLongf size = static_cast<uLongf>(wanted);
        const int code =
            uncompress(reinterpret_cast<Bytef*>(inflated.data() + before), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
        if (code != Z_OK || size != wanted)
            xml.fail("compressed block " + std::to_string(b) + " is damaged",
                     std::to_string(wanted) + " bytes of zlib data");
        const std::size_t whole = inflated.size() / type.size * type.size;
        add_numbers(std::string_view(inflated).substr(0, whole), type, encoding.big_endian, values);
        inflated.erase(0, whole);
    }
}

} // namespace

bool VtpByteSource::next_quad() {
    char quad[4];
    for (char& c : quad) {
        text_.remove_prefix(std::min(text_.find_first_not_of(" \t\r\n"), text_.size()));
        if (text_.empty())
            return false;
        c = text_.front();
        text_.remove_prefix(1);
    }
    return decode_base64({quad, 4}, run_);
}

bool VtpByteSource::take(std::size_t count, std::string_view& bytes) {
    if (count > most_left())
        return false;
    if (!base64_) {
        bytes = text_.substr(0, count);
        text_.remove_prefix(count);
        return true;
    }
    run_.reserve(count + 3);
    while (run_.size() < count)
        if (!next_quad())
            return false;
    taken_ = run_.substr(0, count);
    run_.erase(0, count);
    bytes = taken_;
    return true;
}

bool VtpByteSource::at_end() {
    return run_.empty() && (base64_ ? trimmed(text_) : text_).empty();
}

void read_vtp_data(const XmlReader& xml, VtpByteSource& source, VtpEncoding& encoding, NumberType type,
                   std::vector<double>& values) {
    if (encoding.compressor.empty())
        return read_plain(xml, source, encoding, type, values);
    if (encoding.compressor == "vtkZLibDataCompressor")
        return read_zlib(xml, source, encoding, type, values);
    const std::string known = encoding.compressor == "vtkLZ4DataCompressor"    ? "LZ4"
                              : encoding.compressor == "vtkLZMADataCompressor" ? "LZMA"
                                                                               : shown(encoding.compressor);
    xml.fail("data compressed with " + known,
             "zlib or none: in ParaView choose the compressor ZLib or None when saving");
}

void find_appended_data(std::string_view bytes, const std::string& file, VtpEncoding& encoding) {
    if (bytes.find("<AppendedData") == std::string_view::npos)
        return;
    XmlReader xml(bytes, file);
    int depth = 0;
    for (auto event = xml.next(); event != XmlReader::Event::finished; event = xml.next()) {
        depth += event == XmlReader::Event::start ? 1 : event == XmlReader::Event::end ? -1 : 0;
        if (event != XmlReader::Event::start || depth != 2 || xml.name() != "AppendedData")
            continue;
        const std::string encoded = xml.attribute("encoding");
        if (encoded != "raw" && encoded != "base64")
            xml.fail("appended data in the encoding " + shown(encoded), "raw or base64");
        const std::size_t start = bytes.find_first_not_of(" \t\r\n", xml.after());
        // Raw bytes may look like anything, also like the end of an element: the last one counts.
        const std::size_t end = bytes.rfind("</AppendedData");
        if (start == std::string_view::npos || bytes[start] != '_')
            xml.fail("appended data without their mark", "an underscore before the data");
        if (end == std::string_view::npos || end <= start)
            xml.fail("the file ends too early", "</AppendedData>");
        encoding.appended = bytes.substr(start + 1, end - start - 1);
        encoding.has_appended = true;
        encoding.appended_is_base64 = encoded == "base64";
        return;
    }
}

} // namespace fascicle::io
