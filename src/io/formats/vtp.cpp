#include "io/formats/vtp.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/text.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/vtp_array.hpp"
#include "io/formats/xml_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace fascicle::io {
namespace {

class VtpReader {
public:
    VtpReader(std::string_view bytes, const std::string& file)
        : bytes_(bytes), file_(file), xml_(bytes, file) {}
    MeshData read();

private:
    struct Piece {
        std::size_t points = 0, lines = 0, polys = 0, strips = 0, verts = 0;
        int first_point = 0;
    };
    /// Calls visit for each child element of the one that has just started.
    template <typename Visit>
    void children(Visit visit);
    std::size_t count_attribute(const char* key);
    void piece();
    void points(Piece& piece);
    /// Calls visit(indices) for each cell; a cell of fewer than `least` points is an error.
    template <typename Visit>
    void cells(const Piece& piece, std::size_t count, std::size_t least, Visit visit);
    /// Takes out arrays that not every piece has.
    void drop_partial(std::vector<NamedArray>& arrays, std::size_t count);
    /// Numbers of the arrays of each name, number of components and number of values, so that pieces of very many are read quickly.
    using ArrayIndex = std::map<std::tuple<std::string, int, std::size_t>, std::set<std::size_t>>;
    void arrays(std::vector<NamedArray>& into, ArrayIndex& index, std::size_t before, std::size_t count,
                std::size_t skip);
    NamedArray array() { return read_vtp_array(xml_, encoding_); }

    std::string_view bytes_;
    std::string file_;
    XmlReader xml_;
    VtpEncoding encoding_;
    MeshData data_;
    Points points_;
    ArrayIndex point_index_, line_index_;
    std::string cell_arrays_; ///< names of those of polygons
    bool done_ = false;       ///< nothing that follows is looked at
};

template <typename Visit>
void VtpReader::children(Visit visit) {
    for (;;) {
        switch (xml_.next()) {
        case XmlReader::Event::start:
            visit(xml_.name());
            if (done_)
                return;
            break;
        case XmlReader::Event::end:
            return;
        case XmlReader::Event::finished:
            xml_.fail("the file ends too early", "the end of an element");
        case XmlReader::Event::text:
            break;
        }
    }
}

std::size_t VtpReader::count_attribute(const char* key) {
    long long value = 0;
    const std::string& text = xml_.attribute(key);
    if (!text.empty() && (to_integer(trimmed(text), value) != NumberCheck::ok || value < 0 ||
                          static_cast<std::size_t>(value) > max_elements))
        xml_.fail(std::string(key) + " is " + shown(text), "a count");
    return static_cast<std::size_t>(value);
}

MeshData VtpReader::read() {
    bool found = false;
    for (auto event = xml_.next(); !done_ && event != XmlReader::Event::finished; event = xml_.next()) {
        if (event != XmlReader::Event::start)
            continue;
        if (xml_.name() != "VTKFile")
            xml_.fail("the outermost element is <" + shown(xml_.name()) + ">", "<VTKFile type=\"PolyData\">");
        if (xml_.attribute("type") != "PolyData")
            xml_.fail("the data set is " + shown(xml_.attribute("type")), "PolyData");
        encoding_.big_endian = xml_.attribute("byte_order") == "BigEndian";
        encoding_.header_bytes = xml_.attribute("header_type") == "UInt64" ? 8 : 4;
        encoding_.compressor = xml_.attribute("compressor");
        encoding_.numbers_left = vtp_number_limit(bytes_.size());
        find_appended_data(bytes_, file_, encoding_);
        children([&](const std::string& name) {
            if (name == "AppendedData" && encoding_.has_appended) {
                done_ = true; // bytes that are no XML; the arrays that name them stand before
                return;
            }
            if (name != "PolyData")
                return xml_.skip_element();
            found = true;
            children([&](const std::string& inner) { inner == "Piece" ? piece() : xml_.skip_element(); });
        });
    }
    if (!found)
        xml_.fail("no polydata in the file", "<VTKFile type=\"PolyData\"><PolyData>");
    if (!cell_arrays_.empty() && cell_arrays_.size() < 1000)
        data_.notes.push_back("arrays of polygons were passed over: " + cell_arrays_);
    drop_partial(data_.point_arrays, points_.size());
    drop_partial(data_.line_arrays, data_.lines.lines.size());
    if (!data_.lines.lines.empty())
        data_.lines.points = points_;
    if (data_.lines.lines.empty() || !data_.mesh.triangles.empty())
        data_.mesh.positions = std::move(points_);
    return std::move(data_);
}

void VtpReader::drop_partial(std::vector<NamedArray>& arrays, std::size_t count) {
    std::erase_if(arrays, [&](const NamedArray& array) {
        const bool partial = array.values.size() != count * static_cast<std::size_t>(array.components);
        if (partial)
            data_.notes.push_back("array " + shown(array.name) +
                                  " is not in every piece and was passed over");
        return partial;
    });
}

void VtpReader::piece() {
    Piece piece;
    piece.points = count_attribute("NumberOfPoints");
    piece.verts = count_attribute("NumberOfVerts");
    piece.lines = count_attribute("NumberOfLines");
    piece.strips = count_attribute("NumberOfStrips");
    piece.polys = count_attribute("NumberOfPolys");
    piece.first_point = static_cast<int>(points_.size());
    const std::size_t lines_before = data_.lines.lines.size();
    bool have_points = false;
    const auto triangle = [&](int a, int b, int c) {
        if (data_.mesh.triangles.size() >= max_elements)
            xml_.fail("too many triangles", "at most " + std::to_string(max_elements));
        data_.mesh.triangles.push_back({a, b, c});
    };
    const auto fan = [&](const std::vector<int>& cell) {
        for (std::size_t i = 2; i < cell.size(); ++i)
            triangle(cell[0], cell[i - 1], cell[i]);
    };
    const auto strip =
        [&](const std::vector<int>& cell) { // every other triangle of a strip runs the other way
            for (std::size_t i = 2; i < cell.size(); ++i)
                i % 2 == 0 ? triangle(cell[i - 2], cell[i - 1], cell[i])
                           : triangle(cell[i - 1], cell[i - 2], cell[i]);
        };
    children([&](const std::string& name) {
        if (name == "Points") {
            points(piece);
            have_points = true;
        } else if (name == "Polys") {
            cells(piece, piece.polys, 3, fan);
        } else if (name == "Strips") {
            cells(piece, piece.strips, 3, strip);
        } else if (name == "Lines") {
            cells(piece, piece.lines, 2,
                  [&](const std::vector<int>& cell) { data_.lines.lines.push_back(cell); });
        } else if (name == "PointData") {
            arrays(data_.point_arrays, point_index_, static_cast<std::size_t>(piece.first_point),
                   piece.points, 0);
        } else if (name == "CellData" && piece.lines > 0) {
            arrays(data_.line_arrays, line_index_, lines_before, piece.lines,
                   piece.verts); // cells run verts, lines, polys, strips
        } else if (name == "CellData") {
            children([&](const std::string& inner) {
                if (inner == "DataArray")
                    cell_arrays_ += (cell_arrays_.empty() ? "" : ", ") + shown(xml_.attribute("Name"));
                xml_.skip_element();
            });
        } else {
            xml_.skip_element();
        }
    });
    if (!have_points && piece.points > 0)
        xml_.fail("a piece without <Points>", std::to_string(piece.points) + " points");
}

void VtpReader::points(Piece& piece) {
    bool found = false;
    children([&](const std::string& name) {
        if (name != "DataArray" || found)
            return xml_.skip_element();
        found = true;
        const NamedArray values = array();
        if (values.values.size() != 3 * piece.points)
            xml_.fail("the points have " + std::to_string(values.values.size()) + " coordinates",
                      "3 times " + std::to_string(piece.points));
        if (points_.size() + piece.points > max_elements)
            xml_.fail("too many points", "at most " + std::to_string(max_elements));
        for (std::size_t i = 0; i < piece.points; ++i) {
            points_.emplace_back(values.values[3 * i], values.values[3 * i + 1], values.values[3 * i + 2]);
            if (!points_.back().allFinite())
                xml_.fail("vertex " + std::to_string(points_.size() - 1) +
                              " has a coordinate that is not finite",
                          "finite coordinates");
        }
    });
    if (!found && piece.points > 0)
        xml_.fail("<Points> without a <DataArray>", std::to_string(piece.points) + " points");
}

template <typename Visit>
void VtpReader::cells(const Piece& piece, std::size_t count, std::size_t least, Visit visit) {
    NamedArray connectivity, offsets;
    children([&](const std::string& name) {
        if (name == "DataArray" && xml_.attribute("Name") == "connectivity")
            connectivity = array();
        else if (name == "DataArray" && xml_.attribute("Name") == "offsets")
            offsets = array();
        else
            xml_.skip_element();
    });
    if (offsets.values.size() != count)
        xml_.fail(std::to_string(offsets.values.size()) + " offsets for " + std::to_string(count) + " cells",
                  "one for each cell");
    std::vector<int> cell;
    double begin = 0;
    for (std::size_t c = 0; c < count; ++c) {
        cell.clear();
        const double end = offsets.values[c];
        if (!(end >= begin) || end != std::floor(end) ||
            end > static_cast<double>(connectivity.values.size()))
            xml_.fail("offset " + number_text(end) + " of cell " + std::to_string(c) + " is out of order",
                      number_text(begin) + " to " + std::to_string(connectivity.values.size()));
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const double index = connectivity.values[i];
            if (!(index >= 0) || index != std::floor(index) || index >= static_cast<double>(piece.points))
                xml_.fail("vertex index " + number_text(index) + " in cell " + std::to_string(c) +
                              " is out of range",
                          piece.points == 0 ? "no cells, since there are no points"
                                            : "0 to " + std::to_string(piece.points - 1));
            cell.push_back(piece.first_point + static_cast<int>(index));
        }
        if (cell.size() < least)
            xml_.fail("cell " + std::to_string(c) + " has " + std::to_string(cell.size()) + " points",
                      "at least " + std::to_string(least));
        visit(cell);
        begin = end;
    }
}

/// Arrays with one entry for each of `count` items after the first `skip`. Later pieces append to arrays of
/// the same name; an array that some piece lacks, or of another length, is left out.
void VtpReader::arrays(std::vector<NamedArray>& into, ArrayIndex& index, std::size_t before,
                       std::size_t count, std::size_t skip) {
    children([&](const std::string& name) {
        if (name != "DataArray" || !is_number_array(xml_))
            return xml_.skip_element();
        NamedArray values = array();
        const auto n = static_cast<std::size_t>(values.components);
        if (values.values.size() < n * (skip + count)) {
            data_.notes.push_back("array " + shown(values.name) + " is too short and was not read");
            return;
        }
        values.values.erase(values.values.begin(),
                            values.values.begin() + static_cast<std::ptrdiff_t>(n * skip));
        values.values.resize(n * count);
        const auto known = index.find({values.name, values.components, n * before});
        if (known != index.end()) {
            const std::size_t number = *known->second.begin(); // of several of one name the first that waits
            std::vector<double>& grown = into[number].values;
            grown.insert(grown.end(), values.values.begin(), values.values.end());
            known->second.erase(known->second.begin());
            if (known->second.empty())
                index.erase(known);
            index[{values.name, values.components, grown.size()}].insert(number);
        } else if (before == 0) {
            index[{values.name, values.components, values.values.size()}].insert(into.size());
            into.push_back(std::move(values));
        }
    });
}

template <typename Values, typename Text>
void put_array(std::string& out, const std::string& attributes, const Values& values, std::size_t per_line,
               Text text) {
    out += "<DataArray " + attributes + " format=\"ascii\">\n";
    std::size_t i = 0;
    for (const auto& value : values) {
        out += text(value);
        out += ++i % per_line == 0 ? '\n' : ' ';
    }
    out += "</DataArray>\n";
}

std::string point_text(const Vec3& p) {
    return number_text(p.x()) + ' ' + number_text(p.y()) + ' ' + number_text(p.z());
}

std::string int_text(std::size_t i) {
    return std::to_string(i);
}

void put_named(std::string& out, const std::vector<NamedArray>& arrays, const char* element) {
    if (arrays.empty())
        return;
    // Readers find normals by this attribute; Simbody's (OpenSim's) does not open a mesh without.
    const bool normals = std::any_of(arrays.begin(), arrays.end(), [](const NamedArray& a) {
        return a.name == "Normals" && a.components == 3;
    });
    out += std::string("<") + element + (normals ? " Normals=\"Normals\"" : "") + ">\n";
    for (const NamedArray& a : arrays)
        put_array(out,
                  "type=\"Float64\" Name=\"" + xml_escaped(valid_utf8(a.name)) + "\" NumberOfComponents=\"" +
                      std::to_string(a.components) + "\"",
                  a.values, 12, [](double v) { return number_text(v); });
    out += std::string("</") + element + ">\n";
}

template <typename Cells>
void put_cells(std::string& out, const char* element, const Cells& cells) {
    out += std::string("<") + element + ">\n";
    put_array(out, "type=\"Int32\" Name=\"connectivity\"", cells, 4, [](const auto& cell) {
        std::string text;
        for (const int v : cell)
            text.append(text.empty() ? 0 : 1, ' ').append(std::to_string(v));
        return text;
    });
    std::vector<std::size_t> offsets;
    std::size_t end = 0;
    for (const auto& cell : cells)
        offsets.push_back(end += cell.size());
    put_array(out, "type=\"Int32\" Name=\"offsets\"", offsets, 12, int_text);
    out += std::string("</") + element + ">\n";
}

} // namespace

MeshData read_vtp(std::string_view bytes, const std::string& file) {
    return VtpReader(bytes, file).read();
}

void write_vtp(std::ostream& out, const MeshData& data) {
    const Points& points = data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
    for (const NamedArray& a : data.point_arrays)
        FASCICLE_ASSERT(a.values.size() == points.size() * static_cast<std::size_t>(a.components));
    for (const NamedArray& a : data.line_arrays)
        FASCICLE_ASSERT(a.values.size() == data.lines.lines.size() * static_cast<std::size_t>(a.components));
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
                       "byte_order=\"LittleEndian\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
                       std::to_string(points.size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
                       std::to_string(data.lines.lines.size()) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
                       std::to_string(data.mesh.triangles.size()) + "\">\n";
    put_named(text, data.point_arrays, "PointData");
    if (data.mesh.triangles.empty()) // cell data need a value for every cell; polygons would have none
        put_named(text, data.line_arrays, "CellData");
    text += "<Points>\n";
    put_array(text, "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", points, 1, point_text);
    text += "</Points>\n";
    put_cells(text, "Lines", data.lines.lines);
    put_cells(text, "Polys", data.mesh.triangles);
    text += "</Piece>\n</PolyData>\n</VTKFile>\n";
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

bool looks_like_vtp(std::string_view bytes) {
    const std::string_view head = trimmed(bytes.substr(0, 4096));
    return head.substr(0, 1) == "<" && head.find("<VTKFile") != std::string_view::npos;
}

} // namespace fascicle::io
