#include "io/formats/ply_header.hpp"

#include <limits>

namespace fascicle::io {
namespace {

NumberType ply_type(TextScanner& scanner) {
    static constexpr std::pair<std::string_view, NumberType> types[] = {
        {"char", {'i', 1}},  {"int8", {'i', 1}},    {"uchar", {'u', 1}},  {"uint8", {'u', 1}},
        {"short", {'i', 2}}, {"int16", {'i', 2}},   {"ushort", {'u', 2}}, {"uint16", {'u', 2}},
        {"int", {'i', 4}},   {"int32", {'i', 4}},   {"uint", {'u', 4}},   {"uint32", {'u', 4}},
        {"long", {'i', 8}},  {"int64", {'i', 8}},   {"ulong", {'u', 8}},  {"uint64", {'u', 8}},
        {"float", {'f', 4}}, {"float32", {'f', 4}}, {"double", {'f', 8}}, {"float64", {'f', 8}},
    };
    const std::string_view word = scanner.next_word();
    for (const auto& [known, type] : types)
        if (known == word)
            return type;
    scanner.fail("unknown type " + shown(word) + " of a property", "float, double, uchar, int and the like");
}

std::string next_name(TextScanner& scanner, const char* what) {
    const std::string_view word = scanner.next_word();
    if (word.empty()) // of any length: other formats have no limit, and bytes that are no letters take three each
        scanner.fail("got " + shown(word), what);
    return std::string(word);
}

void read_property(TextScanner& scanner, PlyHeader& header) {
    if (header.elements.empty())
        scanner.fail("a property before any element", "element NAME COUNT");
    PlyProperty property;
    if (scanner.peek_word() == "list") {
        scanner.next_word();
        property.count_type = ply_type(scanner);
        if (property.count_type.kind == 'f')
            scanner.fail("a list with a count that is not whole", "a whole type, such as uchar");
    }
    property.type = ply_type(scanner);
    property.name = next_name(scanner, "the name of a property");
    header.elements.back().properties.push_back(std::move(property));
}

} // namespace

std::size_t PlyElement::least_bytes(bool ascii) const {
    std::size_t sum = 0;
    for (const PlyProperty& property : properties)
        sum += ascii ? 2 : property.is_list() ? property.count_type.size : property.type.size;
    return sum;
}

PlyHeader read_ply_header(TextScanner& scanner) {
    scanner.skip_space();
    scanner.next_word(); // ply
    // Data start right after the line end of end_header. A file that ends lines with a lone CR could start its data with an LF.
    const std::string_view end_of_line = scanner.bytes().substr(scanner.position(), 2);
    const bool lone_cr = end_of_line.substr(0, 1) == "\r" && end_of_line != "\r\n";
    PlyHeader header;
    bool have_format = false;
    for (;;) {
        const std::string_view keyword = scanner.next_word();
        if (keyword.empty())
            scanner.fail("the header ends too early", "end_header");
        if (keyword == "format") {
            const std::string_view format = scanner.next_word();
            header.ascii = format == "ascii";
            header.big_endian = format == "binary_big_endian";
            if (!header.ascii && !header.big_endian && format != "binary_little_endian")
                scanner.fail("got " + shown(format), "ascii, binary_little_endian or binary_big_endian");
            have_format = true;
            scanner.next_line(); // 1.0
        } else if (keyword == "comment" || keyword == "obj_info") {
            scanner.next_line();
        } else if (keyword == "element") {
            PlyElement element;
            element.position = scanner.position();
            element.name = next_name(scanner, "the name of an element");
            const long long count = scanner.next_integer("the number of an element");
            if (count < 0)
                scanner.fail("got " + std::to_string(count), "the number of an element");
            element.count = static_cast<std::size_t>(count);
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            read_property(scanner, header);
        } else if (keyword == "end_header") {
            break;
        } else {
            scanner.fail("unknown word " + shown(keyword) + " in the header",
                         "element, property, comment, obj_info or end_header");
        }
    }
    if (!have_format)
        scanner.fail("no format in the header", "format ascii 1.0, or binary");
    const std::size_t at = scanner.position();
    const std::string_view rest = scanner.bytes().substr(at, 2);
    if (!rest.empty() && rest[0] != '\n' && rest[0] != '\r')
        scanner.fail_at(at, "no line end after end_header", "a line feed");
    scanner.move_to(std::min(at + (rest == "\r\n" && !lone_cr ? 2 : 1), scanner.bytes().size()));
    return header;
}

} // namespace fascicle::io
