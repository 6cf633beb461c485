#include "io/formats/vtp_array.hpp"

#include "io/formats/binary_numbers.hpp"
#include "io/formats/text_scanner.hpp"

#include <optional>

namespace fascicle::io {
namespace {

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

void read_appended(const XmlReader& xml, VtpEncoding& encoding, NumberType type,
                   std::vector<double>& values) {
    const std::string text = xml.attribute("offset");
    long long offset = 0;
    if (to_integer(trimmed(text), offset) != NumberCheck::ok || offset < 0)
        xml.fail("offset is " + shown(text), "a place in the appended data");
    if (!encoding.has_appended)
        xml.fail("data appended to the file, which has none", "<AppendedData>");
    if (static_cast<unsigned long long>(offset) > encoding.appended.size())
        xml.fail("offset is " + shown(text),
                 "at most " + std::to_string(encoding.appended.size()) + ", the size of the appended data");
    VtpByteSource source(encoding.appended.substr(static_cast<std::size_t>(offset)),
                         encoding.appended_is_base64);
    read_vtp_data(xml, source, encoding, type, values);
}

void read_inline(const XmlReader& xml, VtpEncoding& encoding, NumberType type, std::vector<double>& values) {
    VtpByteSource source(xml.text(), true);
    read_vtp_data(xml, source, encoding, type, values);
    if (!source.at_end())
        xml.fail("more binary data than their header says", "</DataArray>");
}

} // namespace

bool is_number_array(const XmlReader& xml) {
    return number_type(xml.attribute("type")).has_value();
}

NamedArray read_vtp_array(XmlReader& xml, VtpEncoding& encoding) {
    NamedArray array;
    array.name = xml.attribute("Name");
    // Texts are the bytes of their characters, with a zero behind each.
    const auto type = number_type(xml.attribute("type") == "String" ? "UInt8" : xml.attribute("type"));
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
    if (!ascii && format != "binary" && format != "appended")
        xml.fail("data format " + shown(format), "ascii, binary or appended");
    if (format == "appended")
        read_appended(xml, encoding, *type, array.values);

    for (;;) {
        const XmlReader::Event event = xml.next();
        if (event == XmlReader::Event::end)
            return array;
        if (event == XmlReader::Event::start) {
            xml.skip_element(); // <InformationKey> and the like
        } else if (event == XmlReader::Event::finished) {
            xml.fail("the file ends too early", "</DataArray>");
        } else if (format == "appended") {
            xml.fail("text in an array whose data are appended", "</DataArray>");
        } else if (ascii) {
            TextScanner words(xml.text(), {});
            for (std::string_view word = words.next_word(); !word.empty(); word = words.next_word()) {
                double value = 0.0;
                if (to_double(word, value) != NumberCheck::ok)
                    xml.fail("got " + shown(word) + " in array " + shown(array.name), "numbers");
                array.values.push_back(value);
            }
        } else {
            read_inline(xml, encoding, *type, array.values);
        }
    }
}

} // namespace fascicle::io
