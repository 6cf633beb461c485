#include "io/formats/stl.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/float_rounding.hpp"
#include "io/formats/binary_numbers.hpp"
#include "io/formats/text_scanner.hpp"
#include "io/formats/vertex_weld.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::io {
namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::uint64_t announced(std::string_view bytes) {
    return take_bits(bytes, 80, 4, false);
}

bool begins_with_solid(std::string_view bytes) {
    TextScanner scanner(bytes, {});
    return equal_ignoring_case(scanner.next_word(), "solid");
}

/// Begins with "solid", and nothing near the beginning that text does not have.
bool is_ascii(std::string_view bytes) {
    if (!begins_with_solid(bytes))
        return false;
    const std::string_view head = bytes.substr(0, 1024);
    return std::none_of(head.begin(), head.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 && !(byte >= '\t' && byte <= '\r');
    });
}

MeshData welded(VertexWeld& weld, std::vector<Tri> triangles) {
    MeshData data;
    data.mesh.triangles = std::move(triangles);
    data.mesh.positions = weld.take();
    if (!data.mesh.triangles.empty())
        data.notes.push_back(std::to_string(3 * data.mesh.triangles.size()) + " corners of triangles made " +
                             std::to_string(data.mesh.positions.size()) +
                             " vertices: those at equal coordinates are one");
    return data;
}

MeshData read_binary(TextScanner& scanner) {
    scanner.name_bytes();
    const std::string_view bytes = scanner.bytes();
    if (bytes.size() < header_bytes)
        scanner.fail_at(bytes.size(), "the file ends too early",
                        "a header of 80 bytes and the number of triangles");
    const std::uint64_t count = announced(bytes);
    const std::size_t held = (bytes.size() - header_bytes) / triangle_bytes;
    if (count > held)
        scanner.fail_at(80, "the file has room for " + std::to_string(held) + " triangles",
                        std::to_string(count) + ", as its header says");
    if (3 * count > max_elements)
        scanner.fail_at(80, "too many triangles", "at most " + std::to_string(max_elements / 3));
    VertexWeld weld;
    std::vector<Tri> triangles(static_cast<std::size_t>(count));
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t start = header_bytes + t * triangle_bytes + 12 * (c + 1);
            Vec3 p;
            for (int k = 0; k < 3; ++k)
                p[k] =
                    to_number(take_bits(bytes, start + 4 * static_cast<std::size_t>(k), 4, false), {'f', 4});
            if (!p.allFinite())
                scanner.fail_at(start,
                                "triangle " + std::to_string(t) + " has a coordinate that is not finite",
                                "finite coordinates");
            triangles[t][c] = weld.add(p);
        }
    MeshData data = welded(weld, std::move(triangles));
    if (const std::size_t end = header_bytes + static_cast<std::size_t>(count) * triangle_bytes;
        bytes.size() > end)
        data.notes.push_back(std::to_string(bytes.size() - end) +
                             " bytes after the last triangle were passed over");
    return data;
}

MeshData read_ascii(TextScanner& scanner) {
    VertexWeld weld;
    std::vector<Tri> triangles;
    Tri corners{};
    int count = 0; ///< corners of the triangle so far
    bool in_solid = false, in_triangle = false;
    for (;;) {
        const std::string word = lower_case(scanner.next_word());
        if (word.empty())
            break;
        if (word == "vertex") {
            Vec3 p;
            for (int k = 0; k < 3; ++k) {
                p[k] = scanner.next_double("three numbers after vertex");
                if (!std::isfinite(p[k]))
                    scanner.fail("a coordinate that is not finite", "finite coordinates");
            }
            if (!in_triangle || count == 3)
                scanner.fail(in_triangle ? "a triangle of more than three corners"
                                         : "vertex outside of a facet",
                             "facet, outer loop, three times vertex, endloop, endfacet");
            corners[static_cast<std::size_t>(count++)] = weld.add(p);
        } else if (word == "facet") {
            if (!in_solid || in_triangle)
                scanner.fail(in_triangle ? "facet inside of a facet" : "facet outside of a solid",
                             in_triangle ? "endfacet" : "solid");
            in_triangle = true;
            count = 0;
            scanner.next_line(); // its normal: the corners tell it
        } else if (word == "endfacet") {
            if (!in_triangle || count != 3)
                scanner.fail("a triangle of " + std::to_string(in_triangle ? count : 0) + " corners",
                             "three");
            if (3 * triangles.size() >= max_elements)
                scanner.fail("too many triangles", "at most " + std::to_string(max_elements / 3));
            triangles.push_back(corners);
            in_triangle = false;
        } else if (word == "solid" || word == "endsolid") {
            if (in_triangle || in_solid == (word == "solid"))
                scanner.fail("got '" + word + "'", in_triangle ? "endfacet"
                                                   : in_solid  ? "endsolid"
                                                               : "solid");
            in_solid = word == "solid";
            scanner.next_line(); // its name, anything
        } else if (word == "outer" || word == "endloop" || word == "color") {
            scanner.next_line();
        } else {
            scanner.fail("got " + shown(word), "solid, facet, outer loop, vertex or their ends");
        }
    }
    if (in_solid)
        scanner.fail_at(scanner.position(), "the file ends too early", in_triangle ? "endfacet" : "endsolid");
    return welded(weld, std::move(triangles));
}

} // namespace

MeshData read_stl(std::string_view bytes, const std::string& file) {
    TextScanner scanner(bytes, file);
    const bool ascii = !has_size_of_binary_stl(bytes, bytes.size()) && is_ascii(bytes);
    return ascii ? read_ascii(scanner) : read_binary(scanner);
}

void write_stl(std::ostream& out, const MeshData& data) {
    if (data.mesh.triangles.empty())
        throw_error("STL", "there is no triangle to write", "a surface");
    std::string text = "written by fascicle"; // never "solid" in front
    text.resize(80, ' ');
    put_little_endian(text, data.mesh.triangles.size(), 4);
    const auto put = [&](const Vec3& p) {
        for (int k = 0; k < 3; ++k)
            put_little_endian(text, std::bit_cast<std::uint32_t>(static_cast<float>(p[k]) + 0.0f),
                              4); // no -0
    };
    const Points& points = data.mesh.positions;
    for (const Vec3& p : points)
        if (!((p.array().abs() <= static_cast<double>(std::numeric_limits<float>::max())).all()))
            throw_error("STL", "a coordinate is beyond " + std::to_string(std::numeric_limits<float>::max()),
                        "coordinates that a float can hold");
    Points stored = points; // normals are of what is read back
    round_to_floats(stored);
    const auto rounded = [&](int v) -> const Vec3& { return stored[static_cast<std::size_t>(v)]; };
    for (const Tri& t : data.mesh.triangles) {
        const Vec3 &a = rounded(t[0]), &b = rounded(t[1]), &c = rounded(t[2]);
        const Vec3 normal = (b - a).cross(c - a);
        const double length = normal.norm();
        put(length > 0 && std::isfinite(length) ? Vec3(normal / length) : Vec3::Zero());
        put(a);
        put(b);
        put(c);
        text.append(2, '\0');
    }
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

bool has_size_of_binary_stl(std::string_view head, std::uintmax_t size) {
    return head.size() >= header_bytes && size == header_bytes + announced(head) * triangle_bytes;
}

bool looks_like_stl(std::string_view bytes) {
    return has_size_of_binary_stl(bytes, bytes.size()) || begins_with_solid(bytes);
}

} // namespace fascicle::io
