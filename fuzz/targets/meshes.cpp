// Mesh files, and what is read from them.

#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/io/load_scene.hpp"
#include "fascicle/io/mesh_convert.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/mesh_hints.hpp"
#include "fascicle/io/unit_guess.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"
#include "io/formats/xml_reader.hpp"

#include <cmath>
#include <cstring>
#include <sstream>

namespace fascicle::fuzz {
namespace {

/// What repair, checks and the editor count on.
void check_mending(const TriMesh& mesh) {
    const MendedMesh mended = mend(mesh);
    FUZZ_CHECK(mended.report.usable());
    FUZZ_CHECK(mended.mesh.vertex_count() == mesh.vertex_count());
    FUZZ_CHECK(mended.mesh.triangle_count() <= mesh.triangle_count());
    for (const Tri& t : mended.mesh.triangles)
        for (const int v : t)
            FUZZ_CHECK(v >= 0 && v < mesh.vertex_count());
    for (const std::string& line : mended.report.lines())
        FUZZ_CHECK(!line.empty() && line.find('\n') == std::string::npos);
    const MeshReport again = check_mesh(mended.mesh);
    FUZZ_CHECK(again.degenerate_triangles == 0 && again.duplicate_triangles == 0);
}

const Points& points_of(const MeshData& data) {
    return data.mesh.positions.empty() ? data.lines.points : data.mesh.positions;
}

/// False when the format refuses what it cannot hold.
bool writes(const MeshFormat& format, const MeshData& data, std::string& text) {
    std::ostringstream out;
    const bool done = reads({}, [&] { format.write(out, data); });
    text = std::move(out).str();
    return done;
}

bool same_bits(const Points& a, const Points& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0);
}

/// What we write we can read, and it is the same then: written once more, it gives the same bytes.
void check_round_trip(const MeshFormat& format, MeshData data) {
    if (!format.write || points_of(data).empty())
        return;
    fit_to_format(data, format);
    std::string first, second;
    if (!writes(format, data, first)) {
        FUZZ_CHECK(!format.holds.doubles); // no triangle, or none that fits into floats
        return;
    }
    const MeshData back = format.read(first, "written");
    check_mesh_data(back);
    if (format.holds.doubles && format.holds.vertex_order)
        FUZZ_CHECK(same_bits(points_of(back), points_of(data)) && back.mesh.triangles == data.mesh.triangles);
    if (format.holds.lines && format.holds.long_lines && format.holds.doubles)
        FUZZ_CHECK(back.lines.lines == data.lines.lines);
    if (!writes(format, back, second) || first != second)
        failed("a mesh that is written and read is the same", __FILE__, __LINE__, format.name);
}

void fuzz_mesh_format(const MeshFormat& format, std::string_view bytes) {
    const std::string name = "fuzz" + format.extensions.at(0);
    MeshData data;
    if (!reads(name, [&] { data = format.read(bytes, name); }))
        return;
    check_mesh_data(data);
    check_mending(data.mesh);
    if (!data.lines.lines.empty()) {
        const Polylines joined = joined_lines(data.lines);
        FUZZ_CHECK(joined.points.size() == data.lines.points.size());
        for (const std::vector<int>& line : joined.lines)
            for (const int v : line)
                FUZZ_CHECK(v >= 0 && static_cast<std::size_t>(v) < joined.points.size());
    }
    check_round_trip(format, std::move(data));
}

void fuzz_mesh_any(std::string_view bytes) {
    const MeshHints hints = find_mesh_hints(bytes);
    FUZZ_CHECK(!hints.millimetres || (*hints.millimetres > 0 && std::isfinite(*hints.millimetres)));
    reads("fuzz.xyz", [&] {
        const MeshFile file = read_mesh_bytes(bytes, "fuzz.xyz");
        FUZZ_CHECK(file.report.usable() && !file.format.empty());
        guess_length_unit(bounding_box(file.mesh.positions).diagonal());
    });
}

void fuzz_xml(std::string_view bytes) {
    reads("fuzz.xml", [&] {
        io::XmlReader xml(bytes, "fuzz.xml");
        int depth = 0;
        for (auto event = xml.next(); event != io::XmlReader::Event::finished; event = xml.next()) {
            if (event == io::XmlReader::Event::start) {
                FUZZ_CHECK(!xml.name().empty() && ++depth <= 101);
                if (xml.name() == "skip") {
                    xml.skip_element();
                    --depth;
                }
            } else if (event == io::XmlReader::Event::end) {
                FUZZ_CHECK(--depth >= 0);
            }
            FUZZ_CHECK(xml.position() <= bytes.size());
        }
        FUZZ_CHECK(depth == 0);
    });
}

} // namespace

std::vector<Target> mesh_targets() {
    // Packed data of VTP and what glTF says with little: a file of any size is trusted with 4 million numbers.
    constexpr std::size_t packed = 400 * MB;
    std::vector<Target> rows;
    for (const MeshFormat& format : mesh_formats()) {
        const std::string name = "mesh_" + format.extensions.at(0).substr(1);
        const auto run = [&format](std::string_view bytes) { fuzz_mesh_format(format, bytes); };
        const std::size_t base = name == "mesh_vtp" || name == "mesh_glb" ? packed : MB;
        rows.push_back({name, run, 4 * kB, name, name, 400, base});
    }
    rows.push_back({"mesh_any", fuzz_mesh_any, 4 * kB, "", "mesh_any", 400, packed});
    rows.push_back({"xml", fuzz_xml, 2 * kB, "xml", "xml", 100, MB});
    return rows;
}

} // namespace fascicle::fuzz
