#include "fascicle/io/mesh_convert.hpp"

#include "fascicle/geometry/float_rounding.hpp"

#include <algorithm>

namespace fascicle {
namespace {

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
    return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

/// Drops the arrays that `keeps` is false for and says so.
template <typename Keeps>
void drop_arrays(std::vector<NamedArray>& arrays, const char* whose, const MeshFormat& format, Keeps keeps,
                 std::vector<std::string>& notes) {
    std::string names;
    for (const NamedArray& array : arrays)
        if (!keeps(array))
            names += (names.empty() ? "" : ", ") + array.name;
    if (names.empty())
        return;
    arrays.erase(std::remove_if(arrays.begin(), arrays.end(), [&](const NamedArray& a) { return !keeps(a); }),
                 arrays.end());
    notes.push_back(std::string("dropped: arrays of ") + whose + ", which " + format.name +
                    " cannot hold here: " + names);
}

bool is_colour(const NamedArray& a) {
    return (a.components == 3 && (a.name == "Normals" || a.name == "RGB")) ||
           (a.components == 4 && a.name == "RGBA");
}

/// Vertices that change their number or are left out where only corners are written; 0 when all stay.
std::size_t renumbered(const TriMesh& mesh) {
    std::vector<bool> seen(mesh.positions.size(), false);
    int next = 0;
    bool moved = false;
    for (const Tri& t : mesh.triangles)
        for (const int v : t)
            if (!seen[static_cast<std::size_t>(v)]) {
                seen[static_cast<std::size_t>(v)] = true;
                moved = moved || v != next;
                ++next;
            }
    return moved || next != mesh.vertex_count() ? mesh.positions.size() : 0;
}

} // namespace

std::vector<std::string> fit_to_format(MeshData& data, const MeshFormat& format) {
    const MeshFormatHolds& holds = format.holds;
    std::vector<std::string> notes;
    if (!holds.lines && !data.lines.lines.empty()) {
        notes.push_back("dropped: " + counted(data.lines.lines.size(), "line", "lines") + ", which " +
                        format.name + " cannot hold");
        data.lines.lines.clear();
    } else if (!holds.long_lines &&
               std::any_of(data.lines.lines.begin(), data.lines.lines.end(),
                           [](const std::vector<int>& line) { return line.size() > 2; })) {
        notes.push_back("changed: lines are written as edges of two points");
    }
    drop_arrays(
        data.point_arrays, "points", format,
        [&](const NamedArray& a) { return holds.point_arrays || (holds.colours && is_colour(a)); }, notes);
    const bool line_arrays = holds.line_arrays && data.mesh.triangles.empty() && !data.lines.lines.empty();
    drop_arrays(
        data.line_arrays, "lines", format, [&](const NamedArray&) { return line_arrays; }, notes);
    if (!holds.vertex_order)
        if (const std::size_t n = renumbered(data.mesh); n > 0)
            notes.push_back(
                "changed: the " + std::to_string(n) +
                " vertices come back in the order in which triangles use them, unused ones not at all");
    if (!holds.doubles) {
        const auto rounds = [](const Vec3& p) {
            return rounded_to_float(p.x()) != p.x() || rounded_to_float(p.y()) != p.y() ||
                   rounded_to_float(p.z()) != p.z();
        };
        if (std::any_of(data.mesh.positions.begin(), data.mesh.positions.end(), rounds))
            notes.push_back("changed: coordinates are rounded to float, about 7 digits");
    }
    return notes;
}

} // namespace fascicle
