#include "fascicle/io/mesh_hints.hpp"

#include "fascicle/base/param_table.hpp"
#include "fascicle/io/mesh_stamp.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/vtp_field_data.hpp"

#include <algorithm>
#include <string>

namespace fascicle {

namespace {

constexpr std::size_t head_bytes = 4096;

std::string lower_head(std::string_view bytes) {
    std::string head(bytes.substr(0, head_bytes));
    std::transform(head.begin(), head.end(), head.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return head;
}

/// The number of "1 unit = NUMBER mm", wherever blanks are.
std::optional<double> unit_of(const std::string& head) {
    constexpr std::string_view start = "1 unit";
    const auto blanks = [&](std::size_t& at) {
        while (at < head.size() && (head[at] == ' ' || head[at] == '\t'))
            ++at;
    };
    for (std::size_t at = head.find(start); at != std::string::npos; at = head.find(start, at + 1)) {
        std::size_t next = at + start.size();
        blanks(next);
        if (next >= head.size() || head[next] != '=')
            continue;
        blanks(++next);
        const std::size_t end = head.find_first_not_of("0123456789.e+-", next);
        double value = 0;
        if (end == std::string::npos || !parse_number(head.substr(next, end - next), value) || !(value > 0))
            continue;
        std::size_t word = end;
        blanks(word);
        if (head.compare(word, 2, "mm") == 0)
            return value;
    }
    return std::nullopt;
}

/// The field SPACE of a legacy VTK file, as 3D Slicer writes it: "SPACE 1 1 string", a line of its own with the text, in binary after a byte
/// that is its length.
std::optional<MeshSpace> space_of_vtk_field(const std::string& head) {
    constexpr std::string_view mark = "space 1 1 string";
    if (head.compare(0, 5, "# vtk") != 0)
        return std::nullopt;
    const std::size_t at = head.find(mark);
    if (at == std::string::npos)
        return std::nullopt;
    const std::string text = head.substr(at + mark.size(), 8);
    if (text.find("ras") != std::string::npos)
        return MeshSpace::ras;
    return text.find("lps") != std::string::npos ? std::optional(MeshSpace::lps) : std::nullopt;
}

/// metersPerUnit, in mm; a centimetre where nothing is said.
double metres_of_usd(const std::string& head) {
    constexpr std::string_view key = "metersperunit = ";
    double value = 0;
    if (const std::size_t at = head.find(key); at != std::string::npos) {
        const std::size_t start = at + key.size(), end = head.find_first_not_of("0123456789.e+-", start);
        if (parse_number(head.substr(start, end - start), value) && value > 0)
            return 1000 * value;
    }
    return 10;
}

} // namespace

MeshHints find_mesh_hints(std::string_view bytes) {
    const std::string head = lower_head(bytes);
    if (io::is_vtp_with_field_data(bytes))
        return io::read_vtp_field_data(bytes).hints;
    MeshHints hints;
    if (const auto field = space_of_vtk_field(head))
        hints.space = field;
    else if (head.find("space=ras") != std::string::npos)
        hints.space = MeshSpace::ras;
    else if (head.find("space=lps") != std::string::npos)
        hints.space = MeshSpace::lps;
    hints.millimetres = unit_of(head);
    if (head.substr(0, 4) == "gltf") // which is in metres
        hints.millimetres = 1000;
    else if (io::trimmed(head).substr(0, 5) == "#usda")
        hints.millimetres = metres_of_usd(head);
    return hints;
}

MeshHints read_mesh_hints(const std::filesystem::path& path) {
    return read_mesh_stamp(path).hints;
}

} // namespace fascicle
