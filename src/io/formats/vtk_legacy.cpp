#include "io/formats/vtk_legacy.hpp"

#include "fascicle/base/error.hpp"
#include "io/formats/array_names.hpp"
#include "io/formats/vtk_values.hpp"

#include <cmath>

namespace fascicle::io {
namespace {

constexpr VtkType int32{VtkKind::integer, 4};
constexpr const char* sections =
    "POINTS, POLYGONS, TRIANGLE_STRIPS, LINES, VERTICES, FIELD, METADATA, CELL_DATA or "
    "POINT_DATA";

enum class CellKind { vertex, line, polygon, strip };

class LegacyReader {
public:
    LegacyReader(std::string_view bytes, const std::string& file) : scanner_(bytes, file) {}
    MeshData read();

private:
    void header();
    void points();
    void cells(CellKind kind);
    void cells_in_one_list(CellKind kind, std::size_t cell_count, std::size_t size);
    void cells_by_offsets(CellKind kind, std::size_t offset_count, std::size_t index_count);
    void add_cell(CellKind kind, const std::vector<int>& cell);
    void add_triangle(int a, int b, int c);
    int next_index(const VtkType& type);

    bool attribute(const std::string& keyword);
    void attributes();
    void field();
    void metadata();
    /// Keeps numbers of points and of lines as an array, passes over everything else.
    void take(std::string_view name, const VtkType& type, std::size_t components, std::size_t tuples,
              const char* what);
    VtkType next_type(const char* what);
    std::size_t next_components();

    TextScanner scanner_;
    VtkValues values_{scanner_};
    MeshData data_;
    Points points_;
    bool have_points_ = false;
    long long highest_index_ = -1;
    std::size_t highest_index_at_ = 0;
    std::size_t tuples_ = 0;   ///< of the CELL_DATA or POINT_DATA being read
    bool point_data_ = false;  ///< which of the two
    bool in_data_ = false;     ///< whether one of them has begun
    std::size_t vertices_ = 0; ///< cells of VERTICES
    std::string cell_arrays_;  ///< names of those that are not kept
};

void LegacyReader::header() {
    scanner_.skip_space(); // a byte order mark is taken off by the caller
    if (!looks_like_vtk_legacy(scanner_.bytes().substr(scanner_.position())))
        scanner_.fail_at(0, "not a legacy VTK file", "a first line '# vtk DataFile Version x.y'");
    scanner_.next_line();
    scanner_.next_line(); // the title, anything
    const std::string_view kind = scanner_.next_word();
    const bool binary = equal_ignoring_case(kind, "BINARY");
    if (!binary && !equal_ignoring_case(kind, "ASCII"))
        scanner_.fail("got " + shown(kind), "ASCII or BINARY in the third line");
    if (!equal_ignoring_case(scanner_.next_word(), "DATASET"))
        scanner_.fail("no DATASET line", "DATASET POLYDATA");
    const std::string_view type = scanner_.next_word();
    if (!equal_ignoring_case(type, "POLYDATA"))
        scanner_.fail("the data set is " + shown(type), "POLYDATA");
    if (binary) {
        values_.set_binary();
        scanner_.name_bytes();
    }
}

MeshData LegacyReader::read() {
    header();
    for (;;) {
        scanner_.skip_space();
        if (scanner_.at_end())
            break;
        const std::size_t start = scanner_.position();
        const std::string keyword = lower_case(scanner_.next_word());
        if (keyword == "points")
            points();
        else if (keyword == "polygons")
            cells(CellKind::polygon);
        else if (keyword == "triangle_strips")
            cells(CellKind::strip);
        else if (keyword == "lines")
            cells(CellKind::line);
        else if (keyword == "vertices")
            cells(CellKind::vertex);
        else if (keyword == "field")
            field();
        else if (keyword == "metadata")
            metadata();
        else if (keyword == "cell_data" || keyword == "point_data") {
            scanner_.move_to(start);
            attributes();
        } else
            scanner_.fail("unknown section " + shown(keyword), sections);
    }
    if (!have_points_)
        scanner_.fail_at(scanner_.position(), "the file ends without points", "a section POINTS");
    if (highest_index_ >= static_cast<long long>(points_.size()))
        scanner_.fail_at(highest_index_at_,
                         "vertex index " + std::to_string(highest_index_) + " is out of range",
                         points_.empty() ? "no cells, since there are no points"
                                         : "0 to " + std::to_string(points_.size() - 1));
    if (!cell_arrays_.empty() && cell_arrays_.size() < 1000)
        data_.notes.push_back("arrays of cells were passed over: " + cell_arrays_);
    if (!data_.lines.lines.empty())
        data_.lines.points = points_;
    if (data_.lines.lines.empty() || !data_.mesh.triangles.empty())
        data_.mesh.positions = std::move(points_);
    return std::move(data_);
}

VtkType LegacyReader::next_type(const char* what) {
    const std::string_view name = scanner_.next_word();
    const auto type = vtk_type(name);
    if (!type)
        scanner_.fail("unknown data type " + shown(name), what);
    return *type;
}

std::size_t LegacyReader::next_components() {
    const std::size_t components = scanner_.next_count("the number of components");
    if (components < 1 || components > 1000)
        scanner_.fail("got " + std::to_string(components), "1 to 1000 components");
    return components;
}

void LegacyReader::points() {
    if (have_points_)
        scanner_.fail("a second section POINTS", "one");
    have_points_ = true;
    const std::size_t count = scanner_.next_count("the number of points");
    const VtkType type = next_type("float, double or an integer type");
    if (type.size == 0)
        scanner_.fail("points of this data type", "float, double or an integer type");
    values_.end_header();
    values_.require(type, 3 * count, "points");
    points_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            points_[i][k] = values_.next_double(type, "the coordinate of a point");
            if (!std::isfinite(points_[i][k]))
                scanner_.fail_at(values_.last_position(),
                                 "vertex " + std::to_string(i) + " has a coordinate that is not finite",
                                 "finite coordinates");
        }
}

int LegacyReader::next_index(const VtkType& type) {
    const long long index = values_.next_integer(type, "a vertex index");
    if (index < 0 || index >= static_cast<long long>(max_elements))
        scanner_.fail_at(values_.last_position(),
                         "vertex index " + std::to_string(index) + " is out of range",
                         have_points_ && !points_.empty() ? "0 to " + std::to_string(points_.size() - 1)
                                                          : "an index into the points");
    if (index > highest_index_) {
        highest_index_ = index;
        highest_index_at_ = values_.last_position();
    }
    return static_cast<int>(index);
}

void LegacyReader::add_triangle(int a, int b, int c) {
    if (data_.mesh.triangles.size() >= max_elements)
        scanner_.fail_at(values_.last_position(), "too many triangles",
                         "at most " + std::to_string(max_elements));
    data_.mesh.triangles.push_back({a, b, c});
}

void LegacyReader::add_cell(CellKind kind, const std::vector<int>& cell) {
    const std::size_t least = kind == CellKind::line ? 2 : 3;
    if (kind == CellKind::vertex)
        ++vertices_;
    if (kind == CellKind::vertex || cell.empty())
        return;
    if (cell.size() < least)
        scanner_.fail_at(values_.last_position(),
                         std::string(kind == CellKind::line ? "line" : "polygon") + " of " +
                             std::to_string(cell.size()) + (cell.size() == 1 ? " point" : " points"),
                         "at least " + std::to_string(least));
    if (kind == CellKind::line)
        data_.lines.lines.push_back(cell);
    else if (kind == CellKind::polygon)
        for (std::size_t i = 2; i < cell.size(); ++i)
            add_triangle(cell[0], cell[i - 1], cell[i]);
    else
        for (std::size_t i = 2; i < cell.size(); ++i) // every other triangle of a strip runs the other way
            i % 2 == 0 ? add_triangle(cell[i - 2], cell[i - 1], cell[i])
                       : add_triangle(cell[i - 1], cell[i - 2], cell[i]);
}

void LegacyReader::cells(CellKind kind) {
    const std::size_t first = scanner_.next_count("the number of cells");
    const std::size_t second = scanner_.next_count("the size of the cell list");
    // Two forms; a number never reads OFFSETS, and neither does the big-endian length of a first cell.
    if (first == 0 && second == 0)
        return;
    if (equal_ignoring_case(scanner_.peek_word(), "OFFSETS"))
        cells_by_offsets(kind, first, second);
    else
        cells_in_one_list(kind, first, second);
}

void LegacyReader::cells_in_one_list(CellKind kind, std::size_t cell_count, std::size_t size) {
    values_.end_header();
    values_.require(int32, size, "cells");
    if (cell_count > size)
        scanner_.fail("cell list of size " + std::to_string(size) + " for " + std::to_string(cell_count) +
                          " cells",
                      "at least one number for each");
    std::vector<int> cell;
    std::size_t left = size;
    for (std::size_t c = 0; c < cell_count; ++c) {
        if (left == 0)
            scanner_.fail_at(scanner_.position(), "the cell list ends with cell " + std::to_string(c),
                             std::to_string(cell_count) + " cells");
        const long long length = values_.next_integer(int32, "the number of points of a cell");
        --left;
        if (length < 0 || static_cast<unsigned long long>(length) > left)
            scanner_.fail_at(values_.last_position(),
                             "cell " + std::to_string(c) + " of " + std::to_string(length) +
                                 " points does not fit the cell list",
                             "at most " + std::to_string(left) + " more numbers");
        cell.clear();
        for (long long k = 0; k < length; ++k)
            cell.push_back(next_index(int32));
        left -= static_cast<std::size_t>(length);
        add_cell(kind, cell);
    }
    if (left != 0)
        scanner_.fail_at(scanner_.position(),
                         "the cells end " + std::to_string(left) + " numbers before their list",
                         "a list of size " + std::to_string(size));
}

void LegacyReader::cells_by_offsets(CellKind kind, std::size_t offset_count, std::size_t index_count) {
    scanner_.next_word(); // OFFSETS
    const VtkType offset_type = next_type("an integer type");
    if (offset_type.size == 0 || offset_type.kind == VtkKind::floating)
        scanner_.fail("offsets of this data type", "an integer type");
    values_.end_header();
    values_.require(offset_type, offset_count, "offsets");
    std::vector<int> offsets(offset_count); // one more than there are cells
    for (std::size_t i = 0; i < offset_count; ++i) {
        const long long offset = values_.next_integer(offset_type, "an offset");
        const long long lowest = i == 0 ? 0 : offsets[i - 1];
        const auto highest = static_cast<long long>(i == 0 ? 0 : index_count);
        if (offset < lowest || offset > highest)
            scanner_.fail_at(values_.last_position(), "offset " + std::to_string(offset) + " is out of order",
                             std::to_string(lowest) + " to " + std::to_string(highest));
        offsets[i] = static_cast<int>(offset);
    }
    if (!equal_ignoring_case(scanner_.next_word(), "CONNECTIVITY"))
        scanner_.fail("no CONNECTIVITY after the offsets", "CONNECTIVITY and a data type");
    const VtkType index_type = next_type("an integer type");
    if (index_type.size == 0 || index_type.kind == VtkKind::floating)
        scanner_.fail("connectivity of this data type", "an integer type");
    values_.end_header();
    values_.require(index_type, index_count, "connectivity");
    if (index_count > 0 && (offsets.empty() || static_cast<std::size_t>(offsets.back()) != index_count))
        scanner_.fail("the offsets end at " + std::to_string(offsets.empty() ? 0 : offsets.back()),
                      std::to_string(index_count) + ", the size of the connectivity");
    std::vector<int> cell;
    for (std::size_t c = 0; c + 1 < offset_count; ++c) {
        cell.clear();
        for (int k = offsets[c]; k < offsets[c + 1]; ++k)
            cell.push_back(next_index(index_type));
        add_cell(kind, cell);
    }
}

void LegacyReader::metadata() {
    // Up to an empty line.
    scanner_.next_line();
    while (!scanner_.at_end() && !trimmed(scanner_.next_line()).empty()) {
    }
}

void LegacyReader::take(std::string_view name, const VtkType& type, std::size_t components,
                        std::size_t tuples, const char* what) {
    // Data of cells run vertices, lines, polygons, strips.
    const std::size_t lines = data_.lines.lines.size(), first = point_data_ ? 0 : vertices_;
    const std::size_t kept = point_data_ ? points_.size() : lines;
    const bool fits = point_data_ ? tuples == kept : lines > 0 && tuples >= first + lines;
    if (!in_data_ || !have_points_ || type.size == 0 || components == 0 || !fits) {
        if (in_data_ && !point_data_)
            cell_arrays_ += (cell_arrays_.empty() ? "" : ", ") + shown(name);
        values_.skip(type, components * tuples, what);
        return;
    }
    values_.require(type, components * tuples, what);
    values_.skip(type, components * first, what);
    NamedArray array{decoded_name(name), static_cast<int>(components), {}};
    array.values.reserve(components * kept);
    for (std::size_t i = 0; i < components * kept; ++i)
        array.values.push_back(values_.next_double(type, what));
    values_.skip(type, components * (tuples - first - kept), what);
    (point_data_ ? data_.point_arrays : data_.line_arrays).push_back(std::move(array));
}

void LegacyReader::field() {
    scanner_.next_word(); // its name
    const std::size_t arrays = scanner_.next_count("the number of arrays");
    for (std::size_t i = 0; i < arrays; ++i) {
        std::string_view name = scanner_.next_word();
        while (equal_ignoring_case(name, "METADATA")) {
            metadata();
            name = scanner_.next_word();
        }
        if (name.empty())
            scanner_.fail("the file ends too early", "an array of the field");
        const std::size_t components = scanner_.next_count("the number of components");
        const std::size_t tuples = scanner_.next_count("the number of tuples");
        const VtkType type = next_type("a data type");
        if (components != 0 && tuples > max_elements / components)
            scanner_.fail("array of " + std::to_string(tuples) + " x " + std::to_string(components) +
                              " values",
                          "fewer than " + std::to_string(max_elements));
        if (!values_.binary() && type.kind == VtkKind::text)
            scanner_.next_line();
        values_.end_header();
        take(name, type, components, tuples, "an array of a field");
    }
}

/// Reads or passes over one attribute of cells or points. False when the keyword is none.
bool LegacyReader::attribute(const std::string& keyword) {
    const auto typed = [&](std::size_t components) {
        const std::string_view name = scanner_.next_word();
        const VtkType type = next_type("a data type");
        values_.end_header();
        take(name, type, components, tuples_, "an attribute");
    };
    if (keyword == "scalars") {
        const std::string_view name = scanner_.next_word();
        const VtkType type = next_type("a data type");
        const std::string_view rest = trimmed(scanner_.next_line());
        long long components = 1;
        if (!rest.empty() &&
            (to_integer(rest, components) != NumberCheck::ok || components < 1 || components > 1000))
            scanner_.fail("got " + shown(rest), "a number of components");
        if (equal_ignoring_case(scanner_.peek_word(), "LOOKUP_TABLE")) {
            scanner_.next_word();
            scanner_.next_word();
            values_.end_header();
        }
        take(name, type, static_cast<std::size_t>(components), tuples_, "scalars");
    } else if (keyword == "color_scalars") {
        const std::string_view name = scanner_.next_word();
        const std::size_t components = next_components();
        values_.end_header();
        const std::size_t before = data_.point_arrays.size() + data_.line_arrays.size();
        take(name, {VtkKind::unsigned_integer, 1}, components, tuples_, "colours");
        // ASCII has shares from 0 to 1, BINARY bytes; VTK makes bytes of both.
        if (!values_.binary() && data_.point_arrays.size() + data_.line_arrays.size() > before)
            for (double& v : (point_data_ ? data_.point_arrays : data_.line_arrays).back().values)
                v = std::floor(255 * v + 0.5);
    } else if (keyword == "lookup_table") {
        scanner_.next_word();
        const std::size_t size = scanner_.next_count("the size of the table");
        values_.end_header();
        values_.skip({VtkKind::unsigned_integer, 1}, 4 * size, "a look-up table");
    } else if (keyword == "texture_coordinates") {
        const std::string_view name = scanner_.next_word();
        const std::size_t dimension = next_components();
        const VtkType type = next_type("a data type");
        values_.end_header();
        take(name, type, dimension, tuples_, "texture coordinates");
    } else if (keyword == "vectors" || keyword == "normals") {
        typed(3);
    } else if (keyword == "tensors") {
        typed(9);
    } else if (keyword == "tensors6") {
        typed(6);
    } else if (keyword == "global_ids" || keyword == "pedigree_ids" || keyword == "edge_flags") {
        typed(1);
    } else if (keyword == "field") {
        field();
    } else if (keyword == "metadata") {
        metadata();
    } else if (keyword == "cell_data" || keyword == "point_data") {
        tuples_ = scanner_.next_count("the number of tuples");
        point_data_ = keyword == "point_data";
        in_data_ = true;
    } else {
        return false;
    }
    return true;
}

void LegacyReader::attributes() {
    try {
        for (;;) {
            scanner_.skip_space();
            if (scanner_.at_end())
                return;
            const std::size_t position = scanner_.position();
            const std::string keyword = lower_case(scanner_.next_word());
            if (keyword == "points" || keyword == "polygons" || keyword == "lines" ||
                keyword == "triangle_strips" || keyword == "vertices") {
                scanner_.move_to(position);
                return;
            }
            if (!attribute(keyword))
                scanner_.fail("unknown attribute " + shown(keyword));
        }
    } catch (const Error& error) {
        if (!have_points_)
            throw;
        data_.notes.push_back(std::string("attributes were not read to the end: ") + error.what());
        scanner_.move_to(scanner_.bytes().size());
    }
}

} // namespace

MeshData read_vtk_legacy(std::string_view bytes, const std::string& file) {
    return LegacyReader(bytes, file).read();
}

bool looks_like_vtk_legacy(std::string_view bytes) {
    TextScanner scanner(bytes, {});
    scanner.skip_space();
    bytes.remove_prefix(scanner.position());
    constexpr std::string_view magic = "# vtk datafile version";
    return equal_ignoring_case(bytes.substr(0, magic.size()), magic);
}

} // namespace fascicle::io
