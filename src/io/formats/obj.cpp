#include "io/formats/obj.hpp"

#include "fascicle/base/param_table.hpp"
#include "io/formats/text_scanner.hpp"

#include <cmath>
#include <istream>
#include <limits>
#include <streambuf>
#include <tiny_obj_loader.h>

namespace fascicle::io {
namespace {

/// A read-only stream over memory, without a copy.
class ViewBuffer : public std::streambuf {
public:
    explicit ViewBuffer(std::string_view bytes) {
        char* begin = const_cast<char*>(bytes.data());
        setg(begin, begin, begin + bytes.size());
    }
};

/// The first pass: checks every line that matters, keeps coordinates and polylines, and copies faces (with a
/// short vertex line for each vertex, since negative indices count back from where they stand) to `checked`.
class LineCheck {
public:
    explicit LineCheck(TextScanner& scanner) : scanner_(scanner) {}

    void run();

    Points points;
    std::vector<std::vector<int>> lines;
    std::string checked;

private:
    bool next_logical_line();
    void vertex();
    void face();
    void polyline();
    /// Checks "v", "v/vt", "v//vn" or "v/vt/vn" and returns the 0-based vertex.
    int index(std::string_view word);
    [[noreturn]] void fail(const std::string& what, const std::string& expected = {}) const {
        scanner_.fail_at(line_start_, what, expected);
    }

    TextScanner& scanner_;
    std::size_t line_start_ = 0;
    std::string joined_; ///< a line with continuations
    std::string_view line_;
    long long highest_index_ = -1;
    std::size_t highest_index_at_ = 0;
};

std::string_view take_word(std::string_view& text) {
    // Loops, because std::string_view's searches for one of several characters are slow for words this short.
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    std::size_t begin = 0;
    while (begin < text.size() && is_blank(text[begin]))
        ++begin;
    std::size_t end = begin;
    while (end < text.size() && !is_blank(text[end]))
        ++end;
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

/// One line, or several joined by a backslash at the end.
bool LineCheck::next_logical_line() {
    if (scanner_.at_end())
        return false;
    line_start_ = scanner_.position();
    line_ = scanner_.next_line();
    if (line_.empty() || line_.back() != '\\')
        return true;
    joined_.assign(line_);
    while (!joined_.empty() && joined_.back() == '\\') {
        joined_.back() = ' ';
        joined_ += scanner_.next_line(); // empty at the end of the file
    }
    line_ = joined_;
    return true;
}

void LineCheck::run() {
    while (next_logical_line()) {
        line_ = line_.substr(0, line_.find('#'));
        const std::string_view keyword = take_word(line_);
        if (keyword == "v")
            vertex();
        else if (keyword == "f" || keyword == "fo")
            face();
        else if (keyword == "l")
            polyline();
    }
    if (highest_index_ >= static_cast<long long>(points.size()))
        scanner_.fail_at(highest_index_at_,
                         "vertex index " + std::to_string(highest_index_ + 1) + " is out of range",
                         "1 to " + std::to_string(points.size()) + ", the number of vertices");
}

void LineCheck::vertex() {
    Vec3 p;
    for (int k = 0; k < 3; ++k) {
        const std::string_view word = take_word(line_);
        if (to_double(word, p[k]) != NumberCheck::ok)
            fail(word.empty() ? "vertex with " + std::to_string(k) + " coordinates" : "got " + shown(word),
                 "three numbers after v");
        if (!std::isfinite(p[k]))
            fail("vertex " + std::to_string(points.size() + 1) +
                     " has a coordinate that is not finite: " + shown(word),
                 "finite coordinates");
    }
    if (points.size() >= max_elements)
        fail("too many vertices", "at most " + std::to_string(max_elements));
    points.push_back(p);
    checked += "v 0\n";
}

int LineCheck::index(std::string_view word) {
    std::string_view rest = word;
    long long vertex = 0;
    int part = 0;
    for (bool more = true; more; ++part) {
        const std::size_t slash = rest.find('/');
        const std::string_view number = rest.substr(0, slash);
        more = slash != std::string_view::npos;
        rest.remove_prefix(more ? slash + 1 : rest.size());
        long long value = 0;
        const bool left_out = number.empty() && part == 1 && more; // v//vn
        // Also "v/" and "v//", which some programs write.
        const bool trailing = number.empty() && part > 0 && !more;
        if (!left_out && !trailing &&
            (to_integer(number, value) != NumberCheck::ok || value == 0 ||
             std::abs(value) > std::numeric_limits<int>::max()))
            fail("bad index " + shown(word), "v, v/vt, v//vn or v/vt/vn with whole numbers other than 0");
        if (part == 0)
            vertex = value;
        if (part > 2)
            fail("bad index " + shown(word), "at most three numbers: v/vt/vn");
    }
    const auto count = static_cast<long long>(points.size());
    if (vertex < -count)
        fail("vertex index " + std::to_string(vertex) + " is out of range",
             "no further back than -" + std::to_string(count) + ", the number of vertices so far");
    const long long i = vertex < 0 ? count + vertex : vertex - 1;
    if (i > highest_index_) {
        highest_index_ = i;
        highest_index_at_ = line_start_;
    }
    return static_cast<int>(i);
}

void LineCheck::face() {
    checked += "f";
    int corners = 0;
    for (std::string_view word = take_word(line_); !word.empty(); word = take_word(line_), ++corners) {
        index(word);
        checked += ' ';
        checked += word;
    }
    if (corners < 3)
        fail("face of " + std::to_string(corners) + (corners == 1 ? " vertex" : " vertices"), "at least 3");
    checked += '\n';
}

void LineCheck::polyline() {
    std::vector<int> line;
    for (std::string_view word = take_word(line_); !word.empty(); word = take_word(line_))
        line.push_back(index(word));
    if (line.size() < 2)
        fail("line of " + std::to_string(line.size()) + (line.size() == 1 ? " vertex" : " vertices"),
             "at least 2");
    lines.push_back(std::move(line));
}

/// The second pass, through tinyobjloader's callbacks.
struct FaceCollector {
    std::vector<Tri> triangles;
    int vertices_so_far = 0;
    bool too_many = false;

    static void on_vertex(void* self, tinyobj::real_t, tinyobj::real_t, tinyobj::real_t, tinyobj::real_t) {
        ++static_cast<FaceCollector*>(self)->vertices_so_far;
    }
    static void on_face(void* self, tinyobj::index_t* corners, int count) {
        auto& me = *static_cast<FaceCollector*>(self);
        const auto vertex = [&](int i) {
            const int raw = corners[i].vertex_index;
            return raw < 0 ? me.vertices_so_far + raw : raw - 1;
        };
        me.too_many = me.too_many || me.triangles.size() + static_cast<std::size_t>(count) > max_elements;
        for (int i = 2; i < count && !me.too_many; ++i)
            me.triangles.push_back({vertex(0), vertex(i - 1), vertex(i)});
    }
};

} // namespace

MeshData read_obj(std::string_view bytes, const std::string& file) {
    TextScanner scanner(bytes, file);
    LineCheck check(scanner);
    check.run();

    FaceCollector faces;
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = &FaceCollector::on_vertex;
    callbacks.index_cb = &FaceCollector::on_face;
    ViewBuffer buffer(check.checked);
    std::istream stream(&buffer);
    std::string warning, error;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks, &faces, nullptr, &warning, &error))
        scanner.fail_at(0, "cannot read: " + error, "Wavefront OBJ");
    if (faces.too_many)
        scanner.fail_at(0, "too many triangles", "at most " + std::to_string(max_elements));

    MeshData data;
    data.mesh.triangles = std::move(faces.triangles);
    data.lines.lines = std::move(check.lines);
    if (!data.lines.lines.empty())
        data.lines.points = check.points;
    if (data.lines.lines.empty() || !data.mesh.triangles.empty())
        data.mesh.positions = std::move(check.points);
    return data;
}

void write_obj(std::ostream& out, const MeshData& data) {
    const Points& points = data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
    for (const Vec3& p : points)
        out << "v " << number_text(p.x()) << ' ' << number_text(p.y()) << ' ' << number_text(p.z()) << '\n';
    for (const Tri& t : data.mesh.triangles)
        out << "f " + std::to_string(t[0] + 1) + ' ' + std::to_string(t[1] + 1) + ' ' +
                   std::to_string(t[2] + 1) + '\n';
    for (const auto& line : data.lines.lines) {
        out << 'l';
        for (const int v : line)
            out << ' ' + std::to_string(v + 1);
        out << '\n';
    }
}

bool looks_like_obj(std::string_view bytes) {
    TextScanner scanner(bytes, {});
    for (int lines = 0; lines < 10000 && !scanner.at_end(); ++lines) {
        std::string_view line = scanner.next_line();
        line = line.substr(0, line.find('#'));
        const std::string_view keyword = take_word(line);
        if (keyword == "v") {
            double value = 0.0;
            return to_double(take_word(line), value) == NumberCheck::ok;
        }
        if (keyword.size() > 16 || keyword.find_first_of("<>{}[]=;,") != std::string_view::npos)
            return false;
    }
    return false;
}

} // namespace fascicle::io
