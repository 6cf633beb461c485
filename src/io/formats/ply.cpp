#include "io/formats/ply.hpp"

#include "io/formats/array_names.hpp"
#include "io/formats/ply_header.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::io {
namespace {

/// Where the values of a property of vertices go.
struct Target {
    std::size_t array = 0;
    int component = 0;
};
constexpr std::size_t nowhere = static_cast<std::size_t>(-1), position = static_cast<std::size_t>(-2);

/// "NAME_3" is component 3 of NAME; -1 when the name does not end so.
int numbered(const std::string& name, std::string& stem) {
    const std::size_t bar = name.rfind('_');
    long long number = -1;
    if (bar == std::string::npos || bar == 0 || name.size() - bar > 7 ||
        to_integer(std::string_view(name).substr(bar + 1), number) != NumberCheck::ok || number < 0 ||
        std::to_string(number).size() != name.size() - bar - 1)
        return -1;
    stem = name.substr(0, bar);
    return static_cast<int>(number);
}

class PlyReader {
public:
    PlyReader(std::string_view bytes, const std::string& file) : scanner_(bytes, file) {}
    MeshData read();

private:
    void read_element(const PlyElement& element);
    void require(std::size_t count, std::size_t bytes, const PlyElement& element);
    std::vector<Target> targets(const PlyElement& element);
    void vertices(const PlyElement& element);
    void cells(const PlyElement& element);
    void edges(const PlyElement& element);
    void pass_over(const PlyElement& element);

    double number(NumberType type);
    long long integer(NumberType type);
    std::size_t list_length(const PlyProperty& property);
    void pass_over(const PlyProperty& property);
    void list(const PlyProperty& property, std::vector<long long>& values);
    int index(long long value);
    void triangle(int a, int b, int c);

    TextScanner scanner_;
    PlyHeader header_;
    MeshData data_;
    Points points_;
    bool have_vertices_ = false;
    std::size_t last_ = 0; ///< of the last number
    long long highest_index_ = -1;
    std::size_t highest_index_at_ = 0;
};

double PlyReader::number(NumberType type) {
    if (header_.ascii) {
        scanner_.skip_space();
        last_ = scanner_.position();
        return scanner_.next_double("a number");
    }
    last_ = scanner_.position();
    if (scanner_.remaining() < type.size)
        scanner_.fail_at(last_, "the file ends too early",
                         "a number of " + std::to_string(type.size) + " bytes");
    scanner_.move_to(last_ + type.size);
    return to_number(take_bits(scanner_.bytes(), last_, type.size, header_.big_endian), type);
}

long long PlyReader::integer(NumberType type) {
    const double value = number(type);
    if (!(std::abs(value) < 9e15) || value != std::floor(value))
        scanner_.fail_at(last_, "got a number that is not whole", "an index or a count");
    return static_cast<long long>(value);
}

std::size_t PlyReader::list_length(const PlyProperty& property) {
    const long long count = integer(property.count_type);
    const std::size_t least = header_.ascii ? 2 : property.type.size;
    if (count < 0 || static_cast<unsigned long long>(count) > (scanner_.remaining() + 1) / least)
        scanner_.fail_at(last_, "a list of " + std::to_string(count) + " numbers does not fit the file",
                         "a number from 0 to what is left of it");
    return static_cast<std::size_t>(count);
}

void PlyReader::pass_over(const PlyProperty& property) {
    const std::size_t count = property.is_list() ? list_length(property) : 1;
    if (!header_.ascii && count * property.type.size <= scanner_.remaining())
        return scanner_.move_to(scanner_.position() + count * property.type.size);
    for (std::size_t i = 0; i < count; ++i)
        number(property.type);
}

void PlyReader::list(const PlyProperty& property, std::vector<long long>& values) {
    values.clear();
    for (std::size_t i = list_length(property); i > 0; --i)
        values.push_back(integer(property.type));
}

int PlyReader::index(long long value) {
    if (value < 0 || value >= static_cast<long long>(max_elements))
        scanner_.fail_at(last_, "vertex index " + std::to_string(value) + " is out of range",
                         "an index of a vertex");
    if (value > highest_index_) {
        highest_index_ = value;
        highest_index_at_ = last_;
    }
    return static_cast<int>(value);
}

void PlyReader::triangle(int a, int b, int c) {
    if (data_.mesh.triangles.size() >= max_elements)
        scanner_.fail_at(last_, "too many triangles", "at most " + std::to_string(max_elements));
    data_.mesh.triangles.push_back({a, b, c});
}

/// Error unless the file still holds `count` pieces of `bytes`.
void PlyReader::require(std::size_t count, std::size_t bytes, const PlyElement& element) {
    if (bytes > 0 && count > (scanner_.remaining() + 1) / bytes)
        scanner_.fail_at(scanner_.position(), "the file ends too early",
                         std::to_string(count) + " of the element " + shown(element.name) +
                             ", which do not fit what is left");
}

std::vector<Target> PlyReader::targets(const PlyElement& element) {
    std::vector<Target> out(element.properties.size(), Target{nowhere, 0});
    const auto find = [&](std::string_view name, bool byte) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& p = element.properties[i];
            if (p.name == name && !p.is_list() && (!byte || (p.type.kind == 'u' && p.type.size == 1)))
                return i;
        }
        return nowhere;
    };
    const auto group = [&](const char* name, std::vector<std::string_view> parts, bool byte) {
        std::vector<std::size_t> found;
        for (const std::string_view part : parts)
            if (found.push_back(find(part, byte)); found.back() == nowhere)
                return false;
        for (std::size_t k = 0; k < found.size(); ++k)
            out[found[k]] = {data_.point_arrays.size(), static_cast<int>(k)};
        data_.point_arrays.push_back({name, static_cast<int>(parts.size()), {}});
        return true;
    };
    const char* axes[] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
        const std::size_t i = find(axes[k], false);
        if (i == nowhere)
            scanner_.fail_at(element.position, std::string("vertices without ") + axes[k],
                             "properties x, y and z");
        out[i] = {position, k};
    }
    group("Normals", {"nx", "ny", "nz"}, false);
    if (!group("RGBA", {"red", "green", "blue", "alpha"}, true))
        group("RGB", {"red", "green", "blue"}, true);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const PlyProperty& first = element.properties[i];
        if (out[i].array != nowhere || first.is_list())
            continue;
        std::string stem, other;
        std::size_t end = i + 1;
        if (numbered(first.name, stem) == 0)
            while (end < out.size() && out[end].array == nowhere && !element.properties[end].is_list() &&
                   numbered(element.properties[end].name, other) == static_cast<int>(end - i) &&
                   other == stem)
                ++end;
        for (std::size_t k = i; k < end; ++k)
            out[k] = {data_.point_arrays.size(), static_cast<int>(k - i)};
        data_.point_arrays.push_back(
            {decoded_name(end - i > 1 ? stem : first.name), static_cast<int>(end - i), {}});
    }
    // In the order of the file: groups were found first.
    std::vector<std::size_t> place(data_.point_arrays.size(), nowhere);
    std::vector<NamedArray> ordered;
    for (Target& target : out) {
        if (target.array >= place.size())
            continue;
        if (place[target.array] == nowhere) {
            place[target.array] = ordered.size();
            ordered.push_back(std::move(data_.point_arrays[target.array]));
        }
        target.array = place[target.array];
    }
    data_.point_arrays = std::move(ordered);
    return out;
}

void PlyReader::vertices(const PlyElement& element) {
    if (have_vertices_)
        scanner_.fail_at(element.position, "a second element vertex", "one");
    have_vertices_ = true;
    if (element.count > max_elements)
        scanner_.fail_at(element.position, "too many vertices", "at most " + std::to_string(max_elements));
    const std::vector<Target> where = targets(element);
    points_.resize(element.count);
    for (NamedArray& array : data_.point_arrays)
        array.values.resize(element.count * static_cast<std::size_t>(array.components));
    for (std::size_t v = 0; v < element.count; ++v)
        for (std::size_t i = 0; i < where.size(); ++i) {
            if (where[i].array == nowhere) {
                pass_over(element.properties[i]);
                continue;
            }
            const double value = number(element.properties[i].type);
            if (where[i].array == position) {
                if (!std::isfinite(value))
                    scanner_.fail_at(last_,
                                     "vertex " + std::to_string(v) + " has a coordinate that is not finite",
                                     "finite coordinates");
                points_[v][where[i].component] = value;
            } else {
                NamedArray& array = data_.point_arrays[where[i].array];
                array.values[v * static_cast<std::size_t>(array.components) +
                             static_cast<std::size_t>(where[i].component)] = value;
            }
        }
}

/// Faces, or strips of triangles, in which -1 begins a new one.
void PlyReader::cells(const PlyElement& element) {
    std::vector<long long> cell;
    const bool strips = element.name == "tristrips";
    const auto is_cell = [](const PlyProperty& p) {
        return p.is_list() && (p.name == "vertex_indices" || p.name == "vertex_index");
    };
    const auto found = std::find_if(element.properties.begin(), element.properties.end(), is_cell);
    if (found == element.properties.end()) {
        if (element.count > 0)
            scanner_.fail_at(element.position, "faces without vertices", "a list vertex_indices");
        return;
    }
    if (element.properties.size() > 1)
        data_.notes.push_back("properties of faces other than their vertices were passed over");
    for (std::size_t f = 0; f < element.count; ++f)
        for (const PlyProperty& property : element.properties) {
            if (&property != &*found) {
                pass_over(property);
                continue;
            }
            list(property, cell);
            std::size_t start = 0; // of the strip
            for (std::size_t i = 0; i < cell.size(); ++i) {
                if (strips && cell[i] == -1) {
                    start = i + 1;
                    continue;
                }
                const int c = index(cell[i]);
                if (i < start + 2)
                    continue;
                const int a = static_cast<int>(strips ? cell[i - 2] : cell[0]),
                          b = static_cast<int>(cell[i - 1]);
                // Every other triangle of a strip runs the other way.
                strips && (i - start) % 2 == 1 ? triangle(b, a, c) : triangle(a, b, c);
            }
            if (!strips && cell.size() < 3)
                scanner_.fail_at(last_, "face of " + std::to_string(cell.size()) + " vertices", "at least 3");
        }
}

void PlyReader::edges(const PlyElement& element) {
    for (std::size_t e = 0; e < element.count; ++e) {
        int ends[2] = {-1, -1};
        for (const PlyProperty& property : element.properties)
            if (!property.is_list() && property.name == "vertex1")
                ends[0] = index(integer(property.type));
            else if (!property.is_list() && property.name == "vertex2")
                ends[1] = index(integer(property.type));
            else
                pass_over(property);
        if (ends[0] < 0 || ends[1] < 0)
            scanner_.fail_at(element.position, "edges without ends", "properties vertex1 and vertex2");
        data_.lines.lines.push_back({ends[0], ends[1]});
    }
}

void PlyReader::pass_over(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties)
            pass_over(property);
}

void PlyReader::read_element(const PlyElement& element) {
    if (element.properties.empty()) {
        if (element.count > 0 && (element.name == "vertex" || element.name == "face"))
            scanner_.fail_at(element.position, "an element without properties", "property TYPE NAME");
        return; // it takes no bytes, however many there are
    }
    require(element.count, element.least_bytes(header_.ascii), element);
    if (element.name == "vertex")
        vertices(element);
    else if (element.name == "face" || element.name == "tristrips")
        cells(element);
    else if (element.name == "edge")
        edges(element);
    else
        pass_over(element);
}

MeshData PlyReader::read() {
    scanner_.skip_space();
    if (!looks_like_ply(scanner_.bytes()))
        scanner_.fail_at(0, "not a PLY file", "a first line 'ply'");
    header_ = read_ply_header(scanner_);
    if (!header_.ascii)
        scanner_.name_bytes();
    for (const PlyElement& element : header_.elements)
        read_element(element);
    if (highest_index_ >= static_cast<long long>(points_.size()))
        scanner_.fail_at(highest_index_at_,
                         "vertex index " + std::to_string(highest_index_) + " is out of range",
                         points_.empty() ? "no faces, since there are no vertices"
                                         : "0 to " + std::to_string(points_.size() - 1));
    if (!data_.lines.lines.empty())
        data_.lines.points = points_;
    if (data_.lines.lines.empty() || !data_.mesh.triangles.empty())
        data_.mesh.positions = std::move(points_);
    return std::move(data_);
}

} // namespace

MeshData read_ply(std::string_view bytes, const std::string& file) {
    return PlyReader(bytes, file).read();
}

bool looks_like_ply(std::string_view bytes) {
    TextScanner scanner(bytes, {});
    return scanner.next_word() == "ply" &&
           (scanner.at_end() || bytes[scanner.position()] == '\n' || bytes[scanner.position()] == '\r' ||
            bytes[scanner.position()] == ' ');
}

} // namespace fascicle::io
