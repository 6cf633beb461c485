// The texts of scene options on the command line.
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/pose.hpp"
#include "fascicle/io/load_scene.hpp"
#include "io/formats/text_scanner.hpp"

#include <cmath>

namespace fascicle {
namespace {

constexpr const char* hinge_form = "\"cx,cy,cz;ax,ay,az\": a point and a direction other than 0 "
                                   "(\";ax,ay,az\" fits the point)";
constexpr const char* phases_form = "OUT,BACK,REST, three frame counts from 0 to 1000000, not all 0";

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.push_back(io::trimmed(text.substr(0, end)));
        if (end == std::string_view::npos)
            return parts;
        text.remove_prefix(end + 1);
    }
}

Vec3 parse_vector(std::string_view part, const std::string& whole) {
    const auto numbers = split(part, ',');
    Vec3 v;
    if (numbers.size() != 3)
        throw_error("--hinge", "got '" + whole + "'", hinge_form, ErrorKind::usage);
    for (int k = 0; k < 3; ++k)
        if (!parse_number(numbers[static_cast<std::size_t>(k)], v[k]))
            throw_error("--hinge", "got '" + whole + "'", hinge_form, ErrorKind::usage);
    return v;
}

} // namespace

HingeRequest parse_hinge(const std::string& text) {
    const auto parts = split(text, ';');
    if (parts.size() != 2)
        throw_error("--hinge", "got '" + text + "'", hinge_form, ErrorKind::usage);
    HingeRequest hinge;
    if (!parts[0].empty())
        hinge.centre = parse_vector(parts[0], text);
    hinge.axis = parse_vector(parts[1], text);
    if (!has_direction(hinge.axis))
        throw_error("--hinge", "the axis in '" + text + "' has no direction", hinge_form, ErrorKind::usage);
    hinge.axis.normalize();
    return hinge;
}

Phases parse_phases(const std::string& text) {
    const auto parts = split(text, ',');
    int counts[3] = {};
    bool good = parts.size() == 3;
    for (std::size_t i = 0; good && i < 3; ++i) {
        long long value = 0;
        good = io::to_integer(parts[i], value) == io::NumberCheck::ok && value >= 0 && value <= 1000000;
        counts[i] = static_cast<int>(value);
    }
    if (!good || counts[0] + counts[1] + counts[2] == 0)
        throw_error("--phases", "got '" + text + "'", phases_form, ErrorKind::usage);
    return {counts[0], counts[1], counts[2]};
}

LengthUnit parse_unit(const std::string& text) {
    if (text != "mm" && text != "m")
        throw_error("--units", "got '" + text + "'", "mm or m", ErrorKind::usage);
    return text == "m" ? LengthUnit::metre : LengthUnit::millimetre;
}

std::pair<std::string, std::filesystem::path> parse_named_file(const std::string& option,
                                                               const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw_error(option, "got '" + text + "'", "MUSCLE=FILE", ErrorKind::usage);
    return {text.substr(0, equals), text.substr(equals + 1)};
}

} // namespace fascicle
