#include "io/formats/obj_bodies.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/io/mesh_hints.hpp"
#include "io/formats/obj.hpp"
#include "io/formats/text_scanner.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::io {

namespace {

/// A name ends at white space in OBJ, and a line at a backslash goes on.
std::vector<std::string> object_names(const Animation& animation) {
    std::vector<std::string> names;
    for (const AnimatedBody& body : animation.bodies) {
        names.push_back(body.name);
        for (char& c : names.back())
            if (static_cast<unsigned char>(c) <= ' ' || c == '\\' || c == '#')
                c = '_';
    }
    names = unique_names(names);
    for (std::string& name : names)
        std::replace(name.begin(), name.end(), ' ', '_');
    return names;
}

/// The number that follows `before` in the text; `otherwise` when there is none.
double number_after(std::string_view text, std::string_view before, double otherwise) {
    const std::size_t at = text.find(before);
    if (at == std::string_view::npos)
        return otherwise;
    std::string_view rest = text.substr(at + before.size());
    rest = rest.substr(0, rest.find_first_of(" \t\r\n,"));
    double value = 0;
    return to_double(rest, value) == NumberCheck::ok && std::isfinite(value) ? value : otherwise;
}

struct Range {
    std::string name;
    std::size_t begin = 0, end = 0;
};

/// Which points belong to which object.
std::vector<Range> objects_of(std::string_view bytes, const std::string& file) {
    std::vector<Range> out;
    std::size_t points = 0;
    TextScanner scanner(bytes, file);
    while (!scanner.at_end()) {
        const std::string_view line = trimmed(scanner.next_line());
        if (line.substr(0, 2) == "v " || line.substr(0, 2) == "v\t") {
            if (out.empty())
                out.push_back({});
            out.back().end = ++points;
        } else if (line.substr(0, 2) == "o " || line.substr(0, 2) == "o\t") {
            out.push_back({std::string(trimmed(line.substr(2))), points, points});
        }
    }
    std::erase_if(out, [](const Range& range) { return range.begin == range.end; });
    return out;
}

} // namespace

void write_obj_bodies(std::ostream& out, const Animation& animation, std::size_t k) {
    if (animation.millimetres_per_unit > 0)
        out << "# 1 unit = " << number_text(animation.millimetres_per_unit) << " mm\n";
    out << "# up " << animation.up << "\n# frame " << animation.frames[k] << " at "
        << number_text(animation.seconds[k]) << " s\n";
    if (animation.frame_count() > 1)
        out << "# frame step " << animation.frames[1] - animation.frames[0] << " of "
            << number_text(animation.seconds[1] - animation.seconds[0]) << " s\n";
    const std::vector<std::string> names = object_names(animation);
    int offset = 1;
    Points points;
    for (std::size_t b = 0; b < animation.bodies.size(); ++b) {
        const AnimatedBody& body = animation.bodies[b];
        points_in_frame(body, k, points);
        out << "o " << names[b] << "\n";
        for (const Vec3& p : points)
            out << "v " << number_text(p.x()) << ' ' << number_text(p.y()) << ' ' << number_text(p.z())
                << "\n";
        for (const Tri& t : body.triangles)
            out << "f " << t[0] + offset << ' ' << t[1] + offset << ' ' << t[2] + offset << "\n";
        for (const std::vector<int>& line : body.lines) {
            if (line.size() < 2)
                continue;
            out << 'l';
            for (const int v : line)
                out << ' ' << v + offset;
            out << "\n";
        }
        offset += static_cast<int>(points.size());
    }
}

Animation read_obj_bodies(std::string_view bytes, const std::string& file) {
    MeshData data = read_obj(bytes, file);
    const Points& points = data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
    const std::string_view head = bytes.substr(0, 4096);
    Animation out;
    const MeshHints hints = find_mesh_hints(head);
    out.millimetres_per_unit = hints.millimetres.value_or(0);
    out.up = head.find("# up y") != std::string_view::npos ? 'y' : 'z';
    const double frame = number_after(head, "# frame ", 0);
    out.frames = {static_cast<int>(std::clamp(frame, 0.0, 1e9))};
    out.seconds = {number_after(head.substr(std::min(head.find("# frame "), head.size())), " at ", frame)};
    const std::vector<Range> objects = objects_of(bytes, file);
    if (points.empty() || objects.empty() || objects.back().end != points.size())
        throw_error(file, "the file holds no points", "an OBJ with v lines");
    for (const Range& object : objects) {
        AnimatedBody body;
        body.name = object.name.empty() ? std::filesystem::path(file).stem().string() : object.name;
        body.rest.assign(points.begin() + static_cast<std::ptrdiff_t>(object.begin),
                         points.begin() + static_cast<std::ptrdiff_t>(object.end));
        body.poses = {Pose{}};
        out.bodies.push_back(std::move(body));
    }
    const auto object_of = [&](int vertex) {
        const auto v = static_cast<std::size_t>(vertex);
        const auto after =
            std::upper_bound(objects.begin(), objects.end(), v,
                             [](std::size_t at, const Range& range) { return at < range.begin; });
        return static_cast<std::size_t>(after - objects.begin()) - 1;
    };
    const auto local = [&](std::size_t object, int vertex) {
        if (object_of(vertex) != object)
            throw_error(file,
                        "a face or line of " + shown(objects[object].name) + " uses points of another object",
                        "objects with points of their own");
        return vertex - static_cast<int>(objects[object].begin);
    };
    for (const Tri& t : data.mesh.triangles) {
        const std::size_t object = object_of(t[0]);
        out.bodies[object].triangles.push_back(
            {local(object, t[0]), local(object, t[1]), local(object, t[2])});
    }
    for (const std::vector<int>& line : data.lines.lines) {
        if (line.empty())
            continue;
        const std::size_t object = object_of(line[0]);
        std::vector<int> own;
        for (const int v : line)
            own.push_back(local(object, v));
        out.bodies[object].lines.push_back(std::move(own));
    }
    for (AnimatedBody& body : out.bodies)
        body.kind = body.triangles.empty() ? BodyKind::fibres : BodyKind::muscle;
    return out;
}

} // namespace fascicle::io
