#include "io/mesh_codec.hpp"

#include "fascicle/geometry/float_rounding.hpp"
#include "io/base64.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace fascicle::io {
namespace {

constexpr int most_elements = 100000000;

template <class Word>
void put(std::string& out, Word word) {
    for (std::size_t i = 0; i < sizeof word; ++i) // least significant byte first
        out += static_cast<char>((word >> (8 * i)) & 0xff);
}

template <class Word>
Word take(const std::string& bytes, std::size_t at) {
    Word word = 0;
    for (std::size_t i = 0; i < sizeof word; ++i)
        word = static_cast<Word>(word | (Word{static_cast<unsigned char>(bytes[at + i])} << (8 * i)));
    return word;
}

/// Also the sign of zero is kept.
bool fits_float(const Points& points) {
    for (const Vec3& p : points)
        for (int k = 0; k < 3; ++k)
            if (std::bit_cast<std::uint64_t>(rounded_to_float(p[k])) != std::bit_cast<std::uint64_t>(p[k]))
                return false;
    return true;
}

int bits_of(const JsonFields& entry, const char* key, int small, int large) {
    const int bits = entry.integer(key, 0);
    if (bits != small && bits != large)
        entry.fail(key, "got " + std::to_string(bits),
                   std::to_string(small) + " or " + std::to_string(large));
    return bits;
}

int count_of(const JsonFields& entry, const char* key) {
    const int count = entry.integer(key, -1);
    if (count < 0 || count > most_elements)
        entry.fail(key, "missing or out of range", "0 to " + std::to_string(most_elements));
    return count;
}

} // namespace

Json carried_mesh_json(const TriMesh& mesh) {
    const bool single = fits_float(mesh.positions), narrow = mesh.positions.size() <= 65536;
    std::string bytes;
    bytes.reserve(mesh.positions.size() * (single ? 12 : 24) + mesh.triangles.size() * (narrow ? 6 : 12));
    for (const Vec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k)
            if (single)
                put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(p[k])));
            else
                put(bytes, std::bit_cast<std::uint64_t>(p[k]));
    for (const Tri& t : mesh.triangles)
        for (const int v : t)
            if (narrow)
                put(bytes, static_cast<std::uint16_t>(v));
            else
                put(bytes, static_cast<std::uint32_t>(v));
    return {{"vertices", mesh.positions.size()},
            {"triangles", mesh.triangles.size()},
            {"coordinate_bits", single ? 32 : 64},
            {"index_bits", narrow ? 16 : 32},
            {"data", encode_base64(bytes)}};
}

TriMesh read_carried_mesh(const JsonFields& entry) {
    const auto vertices = static_cast<std::size_t>(count_of(entry, "vertices")),
               triangles = static_cast<std::size_t>(count_of(entry, "triangles"));
    const auto coordinate = static_cast<std::size_t>(bits_of(entry, "coordinate_bits", 32, 64)) / 8,
               index = static_cast<std::size_t>(bits_of(entry, "index_bits", 16, 32)) / 8;
    const std::size_t size = 3 * (vertices * coordinate + triangles * index);
    const auto data = entry.json().find("data");
    if (data == entry.json().end() || !data->is_string())
        entry.fail("data", "missing", "base64 text");
    const auto& text = data->get_ref<const std::string&>();
    std::string bytes;
    const std::string expected = "base64 of " + std::to_string(size) + " bytes";
    if (text.size() != (size + 2) / 3 * 4)
        entry.fail("data", "has " + std::to_string(text.size()) + " characters", expected);
    if (!decode_base64(text, bytes) || bytes.size() != size)
        entry.fail("data", "is no such text", expected);

    TriMesh mesh;
    mesh.positions.resize(vertices);
    std::size_t at = 0;
    for (Vec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k, at += coordinate) {
            p[k] = coordinate == 4 ? double(std::bit_cast<float>(take<std::uint32_t>(bytes, at)))
                                   : std::bit_cast<double>(take<std::uint64_t>(bytes, at));
            if (!std::isfinite(p[k]))
                entry.fail("data", "has a coordinate that is no number", "finite coordinates");
        }
    mesh.triangles.resize(triangles);
    for (Tri& t : mesh.triangles)
        for (int& v : t) {
            const std::uint32_t number =
                index == 2 ? take<std::uint16_t>(bytes, at) : take<std::uint32_t>(bytes, at);
            at += index;
            if (number >= vertices)
                entry.fail("data", "has a triangle with a vertex that is not there",
                           "indices below " + std::to_string(vertices));
            v = static_cast<int>(number);
        }
    return mesh;
}

} // namespace fascicle::io
