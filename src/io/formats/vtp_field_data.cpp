#include "io/formats/vtp_field_data.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/vtp_array.hpp"

#include <cmath>

namespace fascicle::io {
namespace {

constexpr std::uint64_t most_numbers =
    65536; ///< of all fields: a few words are looked for, whatever else is there

/// A string array: the characters of each text and a zero.
std::string first_text(const NamedArray& array) {
    std::string text;
    for (const double value : array.values) {
        if (!(value >= 1 && value < 256))
            break;
        text += static_cast<char>(static_cast<unsigned char>(value));
    }
    return lower_case(text);
}

void take(const NamedArray& array, MeshStamp& stamp) {
    const std::string name = lower_case(array.name);
    if (name == "millimetres_per_unit") {
        if (array.values.size() == 1 && array.values[0] > 0 && std::isfinite(array.values[0]))
            stamp.hints.millimetres = array.values[0];
    } else if (const std::string text = first_text(array); name == "space") {
        if (text == "lps" || text == "ras")
            stamp.hints.space = text == "ras" ? MeshSpace::ras : MeshSpace::lps;
    } else if (name == "up" && (text == "y" || text == "z")) {
        stamp.up = text[0];
    }
}

void read_fields(XmlReader& xml, VtpEncoding& encoding, MeshStamp& stamp) {
    for (auto event = xml.next(); event != XmlReader::Event::end && event != XmlReader::Event::finished;
         event = xml.next()) {
        if (event != XmlReader::Event::start)
            continue;
        const std::string name = lower_case(xml.attribute("Name"));
        if (name == "space" || name == "up" || name == "millimetres_per_unit")
            take(read_vtp_array(xml, encoding), stamp);
        else
            xml.skip_element();
    }
}

void read(std::string_view bytes, MeshStamp& stamp) {
    XmlReader xml(bytes, "FieldData");
    VtpEncoding encoding;
    for (auto event = xml.next(); event != XmlReader::Event::finished; event = xml.next()) {
        if (event != XmlReader::Event::start)
            continue;
        if (xml.name() == "VTKFile") {
            encoding.big_endian = xml.attribute("byte_order") == "BigEndian";
            encoding.header_bytes = xml.attribute("header_type") == "UInt64" ? 8 : 4;
            encoding.compressor = xml.attribute("compressor");
            encoding.numbers_left = most_numbers;
            find_appended_data(bytes, "FieldData", encoding);
        } else if (xml.name() == "FieldData") {
            return read_fields(xml, encoding, stamp);
        } else if (xml.name() != "PolyData") {
            return; // it stands before the pieces
        }
    }
}

} // namespace

std::string vtp_field_data_text(const MeshStamp& stamp) {
    std::string text = "<FieldData>\n";
    const auto put_text = [&](const std::string& name, const std::string& value) {
        text += "<Array type=\"String\" Name=\"" + name + "\" NumberOfTuples=\"1\" format=\"ascii\">";
        for (const char c : value)
            text += std::to_string(static_cast<int>(static_cast<unsigned char>(c))) + ' ';
        text += "0</Array>\n";
    };
    if (stamp.hints.space)
        put_text("SPACE", to_text(*stamp.hints.space));
    if (stamp.up)
        put_text("UP", std::string(1, *stamp.up));
    if (stamp.hints.millimetres)
        text += "<DataArray type=\"Float64\" Name=\"MILLIMETRES_PER_UNIT\" NumberOfTuples=\"1\" "
                "format=\"ascii\">" +
                number_text(*stamp.hints.millimetres) + "</DataArray>\n";
    return text + "</FieldData>\n";
}

bool is_vtp_with_field_data(std::string_view bytes) {
    const std::string_view head = bytes.substr(0, std::size_t{1} << 16);
    return trimmed(head).substr(0, 1) == "<" &&
           head.substr(0, 4096).find("<VTKFile") != std::string_view::npos &&
           head.find("<FieldData") != std::string_view::npos;
}

MeshStamp read_vtp_field_data(std::string_view bytes) {
    MeshStamp stamp;
    try {
        read(bytes, stamp);
    } catch (const Error&) {
        return stamp;
    }
    return stamp;
}

} // namespace fascicle::io
