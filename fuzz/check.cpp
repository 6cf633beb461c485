#include "fuzz/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace fascicle::fuzz {

void failed(const char* condition, const char* file, int line, const std::string& more) {
    std::fprintf(stderr, "fuzz: %s does not hold (%s:%d) %s\n", condition, file, line, more.c_str());
    std::abort();
}

void check_message(const Error& error, std::string_view name) {
    const std::string_view message = error.what();
    bool printable = !message.empty();
    for (const char c : message)
        printable = printable && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
    if (!printable || message.find(name) == std::string_view::npos)
        failed("one line that names the file", __FILE__, __LINE__, std::string(message));
}

namespace {

void check_points(const Points& points) {
    for (const Vec3& p : points)
        FUZZ_CHECK(p.allFinite());
}

void check_arrays(const std::vector<NamedArray>& arrays, std::size_t count) {
    for (const NamedArray& array : arrays)
        FUZZ_CHECK(array.components > 0 &&
                   array.values.size() == count * static_cast<std::size_t>(array.components));
}

} // namespace

void check_mesh_data(const MeshData& data) {
    check_points(data.mesh.positions);
    check_points(data.lines.points);
    for (const Tri& t : data.mesh.triangles)
        for (const int v : t)
            FUZZ_CHECK(v >= 0 && v < data.mesh.vertex_count());
    for (const std::vector<int>& line : data.lines.lines) {
        FUZZ_CHECK(line.size() >= 2);
        for (const int v : line)
            FUZZ_CHECK(v >= 0 && static_cast<std::size_t>(v) < data.lines.points.size());
    }
    FUZZ_CHECK(data.mesh.positions.empty() || data.lines.points.empty() ||
               data.mesh.positions.size() == data.lines.points.size());
    check_arrays(data.point_arrays,
                 data.mesh.positions.empty() ? data.lines.points.size() : data.mesh.positions.size());
    check_arrays(data.line_arrays, data.lines.lines.size());
}

} // namespace fascicle::fuzz
