#include "io/formats/vtp_array.hpp"

#include "io/base64.hpp"
#include "io/formats/text_scanner.hpp"

#include <bit>
#include <cstdint>
#include <optional>

namespace fascicle::io {
namespace {

struct NumberType {
    char kind = 0; ///< 'f' floating, 'i' signed, 'u' unsigned
    std::size_t size = 0;
};

std::optional<NumberType> number_type(const std::string& name) {
    static constexpr std::pair<std::string_view, NumberType> types[] = {
        {"Float32", {'f', 4}}, {"Float64", {'f', 8}}, {"Int8", {'i', 1}},  {"UInt8", {'u', 1}},
        {"Int16", {'i', 2}},   {"UInt16", {'u', 2}},  {"Int32", {'i', 4}}, {"UInt32", {'u', 4}},
        {"Int64", {'i', 8}},   {"UInt64", {'u', 8}}};
    for (const auto& [known, type] : types)
        if (known == name)
            return type;
    return std::nullopt;
}

std::uint64_t take_bits(std::string_view bytes, std::size_t start, std::size_t size, bool big_endian) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
        bits = (bits << 8) | static_cast<unsigned char>(bytes[start + (big_endian ? i : size - 1 - i)]);
    return bits;
}

double to_number(std::uint64_t bits, const NumberType& type) {
    if (type.kind == 'f')
        return type.size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
                              : std::bit_cast<double>(bits);
    if (type.kind == 'u')
        return static_cast<double>(bits);
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
    return static_cast<double>(static_cast<std::int64_t>((bits ^ sign) - sign));
}

void read_base64(const XmlReader& xml, std::string_view text, const VtpEncoding& encoding,
                 const NumberType& type, std::vector<double>& values) {
    std::string bytes;
    if (!decode_base64(text, bytes))
        xml.fail("bad base64 data", "letters, digits, + and / in groups of four");
    if (bytes.size() < encoding.header_bytes)
        xml.fail("binary data without a length",
                 "a header of " + std::to_string(encoding.header_bytes) + " bytes");
    const std::uint64_t length = take_bits(bytes, 0, encoding.header_bytes, encoding.big_endian);
    if (length != bytes.size() - encoding.header_bytes || length % type.size != 0)
        xml.fail("binary data of " + std::to_string(bytes.size() - encoding.header_bytes) + " bytes",
                 std::to_string(length) + ", as their header says, in whole numbers");
    values.reserve(static_cast<std::size_t>(length) / type.size);
    for (std::size_t i = encoding.header_bytes; i < bytes.size(); i += type.size)
        values.push_back(to_number(take_bits(bytes, i, type.size, encoding.big_endian), type));
}

} // namespace

bool is_number_array(const XmlReader& xml) {
    return number_type(xml.attribute("type")).has_value();
}

NamedArray read_vtp_array(XmlReader& xml, const VtpEncoding& encoding) {
    NamedArray array;
    array.name = xml.attribute("Name");
    const auto type = number_type(xml.attribute("type"));
    if (!type)
        xml.fail("array of unknown type " + shown(xml.attribute("type")), "Float32, Float64, Int8 to UInt64");
    if (const std::string& text = xml.attribute("NumberOfComponents"); !text.empty()) {
        long long components = 0;
        if (to_integer(trimmed(text), components) != NumberCheck::ok || components < 1 || components > 1000)
            xml.fail("NumberOfComponents is " + shown(text), "1 to 1000");
        array.components = static_cast<int>(components);
    }
    const std::string format = xml.attribute("format");
    const bool ascii = format == "ascii" || format.empty();
    if (format == "appended" || (!ascii && encoding.compressed))
        xml.fail(format == "appended" ? "data appended to the file" : "compressed data",
                 "data saved as ascii, or as binary without compression");
    if (!ascii && format != "binary")
        xml.fail("data format " + shown(format), "ascii or binary");

    for (;;) {
        const XmlReader::Event event = xml.next();
        if (event == XmlReader::Event::end)
            return array;
        if (event == XmlReader::Event::start) {
            xml.skip_element(); // <InformationKey> and the like
        } else if (event == XmlReader::Event::finished) {
            xml.fail("the file ends too early", "</DataArray>");
        } else if (ascii) {
            TextScanner words(xml.text(), {});
            for (std::string_view word = words.next_word(); !word.empty(); word = words.next_word()) {
                double value = 0.0;
                if (to_double(word, value) != NumberCheck::ok)
                    xml.fail("got " + shown(word) + " in array " + shown(array.name), "numbers");
                array.values.push_back(value);
            }
        } else {
            read_base64(xml, xml.text(), encoding, *type, array.values);
        }
    }
}

} // namespace fascicle::io
