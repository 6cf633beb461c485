#include "io/formats/array_names.hpp"
#include "io/formats/binary_numbers.hpp"
#include "io/formats/ply.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::io {
namespace {

bool is_bytes(const NamedArray& array) {
    return std::all_of(array.values.begin(), array.values.end(),
                       [](double v) { return v >= 0 && v <= 255 && v == std::floor(v) && !std::signbit(v); });
}

/// The name of an array, changed where it would be read as a coordinate, normal, colour or component.
std::string property_name(const NamedArray& array) {
    static constexpr std::string_view taken[] = {"x",  "y",   "z",     "nx",   "ny",
                                                 "nz", "red", "green", "blue", "alpha"};
    std::string name = encoded_name(array.name);
    if (array.components > 1)
        return name;
    if (std::find(std::begin(taken), std::end(taken), name) != std::end(taken))
        return encoded_byte(name[0]) + name.substr(1);
    const std::size_t bar = name.rfind('_');
    if (bar != std::string::npos && bar + 1 < name.size() &&
        name.find_first_not_of("0123456789", bar + 1) == std::string::npos)
        return name.substr(0, bar) + encoded_byte('_') + name.substr(bar + 1);
    return name;
}

/// An array and how it stands in the file.
struct Column {
    const NamedArray* array;
    bool bytes;
};

std::vector<Column> put_vertex_header(std::string& text, const MeshData& data) {
    std::vector<Column> columns;
    bool normals = false, colours = false;
    for (const NamedArray& array : data.point_arrays) {
        const bool is_normals = !normals && array.name == "Normals" && array.components == 3;
        const bool is_colours = !colours && is_bytes(array) &&
                                ((array.name == "RGB" && array.components == 3) ||
                                 (array.name == "RGBA" && array.components == 4));
        normals = normals || is_normals;
        colours = colours || is_colours;
        static const char* const normal_names[] = {"nx", "ny", "nz"};
        static const char* const colour_names[] = {"red", "green", "blue", "alpha"};
        for (int k = 0; k < array.components; ++k)
            text += std::string("property ") + (is_colours ? "uchar " : "double ") +
                    (is_normals             ? std::string(normal_names[k])
                     : is_colours           ? std::string(colour_names[k])
                     : array.components > 1 ? property_name(array) + "_" + std::to_string(k)
                                            : property_name(array)) +
                    "\n";
        columns.push_back({&array, is_colours});
    }
    return columns;
}

} // namespace

void write_ply(std::ostream& out, const MeshData& data) {
    const Points& points = data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by fascicle\nelement vertex " +
                       std::to_string(points.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
    const std::vector<Column> columns = put_vertex_header(text, data);
    text += "element face " + std::to_string(data.mesh.triangles.size()) +
            "\nproperty list uchar int vertex_indices\n";
    std::size_t edges = 0;
    for (const auto& line : data.lines.lines)
        edges += line.empty() ? 0 : line.size() - 1;
    if (edges > 0)
        text += "element edge " + std::to_string(edges) + "\nproperty int vertex1\nproperty int vertex2\n";
    text += "end_header\n";
    for (std::size_t v = 0; v < points.size(); ++v) {
        for (int k = 0; k < 3; ++k)
            put_little_endian(text, std::bit_cast<std::uint64_t>(points[v][k]), 8);
        for (const Column& column : columns) {
            const auto n = static_cast<std::size_t>(column.array->components);
            for (std::size_t k = 0; k < n; ++k) {
                const double value = column.array->values[n * v + k];
                if (column.bytes)
                    text += static_cast<char>(static_cast<unsigned char>(value));
                else
                    put_little_endian(text, std::bit_cast<std::uint64_t>(value), 8);
            }
        }
    }
    const auto put_index = [&](int v) { put_little_endian(text, static_cast<std::uint32_t>(v), 4); };
    for (const Tri& t : data.mesh.triangles) {
        text += '\3';
        for (const int v : t)
            put_index(v);
    }
    for (const auto& line : data.lines.lines)
        for (std::size_t i = 1; i < line.size(); ++i) {
            put_index(line[i - 1]);
            put_index(line[i]);
        }
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

} // namespace fascicle::io
