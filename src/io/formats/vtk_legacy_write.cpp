#include "io/formats/array_names.hpp"
#include "io/formats/vtk_legacy.hpp"

#include <bit>
#include <cstdint>

namespace fascicle::io {
namespace {

void put_big_endian(std::string& out, std::uint64_t bits, int size) {
    for (int i = size - 1; i >= 0; --i)
        out += static_cast<char>((bits >> (8 * i)) & 0xff);
}

void put_arrays(std::string& text, const char* section, const std::vector<NamedArray>& arrays,
                std::size_t tuples) {
    if (arrays.empty())
        return;
    text += section + std::to_string(tuples) + "\nFIELD FieldData " + std::to_string(arrays.size()) + '\n';
    for (const NamedArray& array : arrays) {
        text += encoded_name(array.name) + ' ' + std::to_string(array.components) + ' ' +
                std::to_string(tuples) + " double\n";
        for (const double value : array.values)
            put_big_endian(text, std::bit_cast<std::uint64_t>(value), 8);
        text += '\n';
    }
}

} // namespace

void write_vtk_legacy(std::ostream& out, const MeshData& data) {
    const Points& points = data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
    std::string text = "# vtk DataFile Version 3.0\nwritten by fascicle\nBINARY\nDATASET POLYDATA\nPOINTS " +
                       std::to_string(points.size()) + " double\n";
    for (const Vec3& p : points)
        for (int k = 0; k < 3; ++k)
            put_big_endian(text, std::bit_cast<std::uint64_t>(p[k]), 8);
    text += '\n';
    if (!data.lines.lines.empty()) {
        std::size_t size = 0;
        for (const auto& line : data.lines.lines)
            size += line.size() + 1;
        text += "LINES " + std::to_string(data.lines.lines.size()) + ' ' + std::to_string(size) + '\n';
        for (const auto& line : data.lines.lines) {
            put_big_endian(text, line.size(), 4);
            for (const int v : line)
                put_big_endian(text, static_cast<std::uint64_t>(v), 4);
        }
        text += '\n';
    }
    if (!data.mesh.triangles.empty()) {
        const std::size_t n = data.mesh.triangles.size();
        text += "POLYGONS " + std::to_string(n) + ' ' + std::to_string(4 * n) + '\n';
        for (const Tri& t : data.mesh.triangles) {
            put_big_endian(text, 3, 4);
            for (const int v : t)
                put_big_endian(text, static_cast<std::uint64_t>(v), 4);
        }
        text += '\n';
    }
    if (data.mesh.triangles.empty()) // data of cells need a value for every cell; polygons would have none
        put_arrays(text, "CELL_DATA ", data.line_arrays, data.lines.lines.size());
    put_arrays(text, "POINT_DATA ", data.point_arrays, points.size());
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

} // namespace fascicle::io
