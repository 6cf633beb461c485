#include "io/formats/off.hpp"

#include "fascicle/base/param_table.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::io {
namespace {

/// What the first word says: [ST][C][N][4][n]OFF.
struct OffKind {
    bool texture = false, colours = false, normals = false, other_dimension = false;
    std::size_t length = 0; ///< of the word
};

/// False when the text does not begin so. Some files have no blank between the word and the counts.
bool off_kind(std::string_view text, OffKind& kind) {
    const auto take = [&](std::string_view part) {
        const bool there = text.substr(kind.length, part.size()) == part;
        kind.length += there ? part.size() : 0;
        return there;
    };
    kind.texture = take("ST");
    kind.colours = take("C");
    kind.normals = take("N");
    kind.other_dimension = take("4");
    kind.other_dimension = take("n") || kind.other_dimension;
    if (!take("OFF"))
        return false;
    const char next = kind.length < text.size() ? text[kind.length] : '\n';
    return next == ' ' || next == '\t' || next == '\r' || next == '\n' || next == '#' ||
           (next >= '0' && next <= '9');
}

/// Lines of words, without comments and empty lines.
class WordLines {
public:
    explicit WordLines(TextScanner& scanner) : scanner_(scanner) {}

    /// Error naming `expected` at the end of the file.
    void next(const char* expected) {
        for (;;) {
            scanner_.skip_space();
            start_ = scanner_.position();
            if (scanner_.at_end())
                fail("the file ends too early", expected);
            const std::string_view line = scanner_.next_line();
            rest_ = trimmed(line.substr(0, line.find('#')));
            if (!rest_.empty())
                return;
        }
    }
    std::string_view word() {
        std::size_t end = 0;
        while (end < rest_.size() && rest_[end] != ' ' && rest_[end] != '\t')
            ++end;
        const std::string_view word = rest_.substr(0, end);
        while (end < rest_.size() && (rest_[end] == ' ' || rest_[end] == '\t'))
            ++end;
        rest_.remove_prefix(end);
        return word;
    }
    bool at_end() const { return rest_.empty(); }
    double number(const char* expected) {
        const std::string_view text = word();
        double value = 0;
        if (to_double(text, value) != NumberCheck::ok)
            fail(text.empty() ? "the line ends too early" : "got " + shown(text), expected);
        return value;
    }
    long long integer(const char* expected) {
        const std::string_view text = word();
        long long value = 0;
        if (to_integer(text, value) != NumberCheck::ok)
            fail(text.empty() ? "the line ends too early" : "got " + shown(text), expected);
        return value;
    }
    std::size_t count(const char* expected) {
        const long long value = integer(expected);
        if (value < 0 || value > static_cast<long long>(max_elements))
            fail("got " + std::to_string(value),
                 std::string(expected) + ", from 0 to " + std::to_string(max_elements));
        return static_cast<std::size_t>(value);
    }
    [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
        scanner_.fail_at(start_, what, expected);
    }

private:
    TextScanner& scanner_;
    std::string_view rest_;
    std::size_t start_ = 0;
};

const NamedArray* array_named(const MeshData& data, std::string_view name, int components) {
    for (const NamedArray& array : data.point_arrays)
        if (array.name == name && array.components == components)
            return &array;
    return nullptr;
}

void read_vertices(WordLines& lines, const OffKind& kind, std::size_t count, MeshData& data) {
    NamedArray normals{"Normals", 3, {}}, colours{"RGBA", 4, {}};
    for (std::size_t v = 0; v < count; ++v) {
        lines.next("a vertex");
        Vec3 p;
        for (int k = 0; k < 3; ++k)
            p[k] = lines.number("three coordinates");
        if (!p.allFinite())
            lines.fail("vertex " + std::to_string(v) + " has a coordinate that is not finite",
                       "finite coordinates");
        data.mesh.positions.push_back(p);
        for (int k = 0; k < 3 && kind.normals; ++k)
            normals.values.push_back(lines.number("a normal after the coordinates"));
        if (!kind.colours)
            continue; // whatever else stands there
        double colour[4];
        int components = 0;
        while (components < 4 && !lines.at_end())
            colour[components++] = lines.number("a colour of 3 or 4 numbers");
        if (v == 0 && components == 3)
            colours = {"RGB", 3, {}};
        if (components < colours.components)
            lines.fail("a colour of " + std::to_string(components) + " numbers",
                       std::to_string(colours.components));
        colours.values.insert(colours.values.end(), colour, colour + colours.components);
    }
    if (kind.normals)
        data.point_arrays.push_back(std::move(normals));
    if (kind.colours)
        data.point_arrays.push_back(std::move(colours));
}

void read_faces(WordLines& lines, std::size_t count, MeshData& data) {
    const std::size_t vertices = data.mesh.positions.size();
    std::vector<int> face;
    bool coloured = false;
    for (std::size_t f = 0; f < count; ++f) {
        lines.next("a face");
        const std::size_t corners = lines.count("the number of corners");
        face.clear();
        for (std::size_t k = 0; k < corners; ++k) {
            const long long v = lines.integer("a vertex index");
            if (v < 0 || v >= static_cast<long long>(vertices))
                lines.fail("vertex index " + std::to_string(v) + " is out of range",
                           vertices == 0 ? "no faces, since there are no vertices"
                                         : "0 to " + std::to_string(vertices - 1));
            face.push_back(static_cast<int>(v));
        }
        coloured = coloured || !lines.at_end();
        if (face.size() == 2)
            data.lines.lines.push_back(face);
        if (data.mesh.triangles.size() + face.size() > max_elements)
            lines.fail("too many triangles", "at most " + std::to_string(max_elements));
        for (std::size_t i = 2; i < face.size(); ++i)
            data.mesh.triangles.push_back({face[0], face[i - 1], face[i]});
    }
    if (coloured)
        data.notes.push_back("colours of faces were passed over");
}

} // namespace

MeshData read_off(std::string_view bytes, const std::string& file) {
    TextScanner scanner(bytes, file);
    WordLines lines(scanner);
    OffKind kind;
    for (;;) { // to the first word that is no comment
        scanner.skip_space();
        if (scanner.at_end() || bytes[scanner.position()] != '#')
            break;
        scanner.next_line();
    }
    const std::string_view rest = bytes.substr(scanner.position());
    if (off_kind(rest, kind)) {
        scanner.move_to(scanner.position() + kind.length);
        const std::size_t start = scanner.position();
        if (equal_ignoring_case(scanner.peek_word(), "BINARY"))
            scanner.fail_at(start, "a binary OFF file", "OFF as text; MeshLab and Geomview save it so");
        if (kind.other_dimension)
            scanner.fail_at(start, "points that have not three dimensions", "OFF, COFF, NOFF or CNOFF");
    } else {
        kind = {};
    }
    lines.next("the numbers of vertices, faces and edges");
    const std::size_t vertices = lines.count("the number of vertices"),
                      faces = lines.count("the number of faces");
    // Before anything is made: a vertex has three numbers with a separator after each.
    if (vertices > (scanner.remaining() + 1) / 6 || faces > (scanner.remaining() + 1) / 2)
        lines.fail(std::to_string(vertices) + " vertices and " + std::to_string(faces) +
                       " faces do not fit what is left of the file",
                   "counts of what follows");
    MeshData data;
    read_vertices(lines, kind, vertices, data);
    read_faces(lines, faces, data);
    if (!data.lines.lines.empty()) {
        data.lines.points = data.mesh.positions;
        if (data.mesh.triangles.empty())
            data.mesh.positions.clear();
    }
    return data;
}

void write_off(std::ostream& out, const MeshData& data) {
    const Points& points = data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
    const NamedArray* normals = array_named(data, "Normals", 3);
    const NamedArray* colours = array_named(data, "RGB", 3);
    if (colours == nullptr)
        colours = array_named(data, "RGBA", 4);
    std::string text = std::string(colours != nullptr ? "C" : "") + (normals != nullptr ? "N" : "") +
                       "OFF\n" + std::to_string(points.size()) + ' ' +
                       std::to_string(data.mesh.triangles.size()) + " 0\n";
    const auto put = [&](const NamedArray* array, std::size_t v) {
        if (array == nullptr)
            return;
        const auto n = static_cast<std::size_t>(array->components);
        for (std::size_t k = 0; k < n; ++k)
            text += ' ' + number_text(array->values[n * v + k]);
    };
    for (std::size_t v = 0; v < points.size(); ++v) {
        text +=
            number_text(points[v].x()) + ' ' + number_text(points[v].y()) + ' ' + number_text(points[v].z());
        put(normals, v);
        put(colours, v);
        text += '\n';
    }
    for (const Tri& t : data.mesh.triangles)
        text += "3 " + std::to_string(t[0]) + ' ' + std::to_string(t[1]) + ' ' + std::to_string(t[2]) + '\n';
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

bool looks_like_off(std::string_view bytes) {
    TextScanner scanner(bytes, {});
    for (int lines = 0; lines < 1000; ++lines) {
        scanner.skip_space();
        if (scanner.at_end() || bytes[scanner.position()] != '#')
            break;
        scanner.next_line();
    }
    OffKind kind;
    return off_kind(bytes.substr(scanner.position()), kind);
}

} // namespace fascicle::io
