// The words for what mesh_check found, and what counts as too much.
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/mesh_check.hpp"

namespace fascicle {
namespace {

std::string count(int n, const std::string& one, const std::string& many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string between(const Edge& e) {
    return "between vertices " + std::to_string(e.a) + " and " + std::to_string(e.b);
}

void require_usable(const MeshReport& report, const std::string& where) {
    if (report.non_finite_points > 0)
        throw_error(where,
                    "vertex " + std::to_string(report.first_non_finite_point) +
                        " has a coordinate that is not finite" +
                        (report.non_finite_points > 1
                             ? " (as have " + std::to_string(report.non_finite_points - 1) + " more)"
                             : std::string()),
                    "finite coordinates");
    if (report.bad_triangles > 0)
        throw_error(where,
                    "triangle " + std::to_string(report.first_bad_triangle) +
                        " has a vertex index out of range",
                    "indices from 0 to " + std::to_string(report.vertices - 1));
}

} // namespace

std::vector<std::string> MeshReport::lines() const {
    std::vector<std::string> out;
    const auto say = [&](int n, const char* one, const char* many, const std::string& rest = {}) {
        if (n > 0)
            out.push_back(count(n, one, many) + rest);
    };
    say(non_finite_points, "vertex with a coordinate that is not finite",
        "vertices with coordinates that are not finite",
        ", the first is vertex " + std::to_string(first_non_finite_point));
    say(bad_triangles, "triangle with an index out of range", "triangles with an index out of range",
        ", the first is triangle " + std::to_string(first_bad_triangle));
    if (boundary_edges > 0)
        out.push_back(count(holes, "hole", "holes") + " (" +
                      count(boundary_edges, "boundary edge", "boundary edges") + "), the first " +
                      between(first_boundary_edge));
    say(nonmanifold_edges, "non-manifold edge", "non-manifold edges",
        ", the first " + between(first_nonmanifold_edge));
    say(nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices",
        ", the first is vertex " + std::to_string(first_nonmanifold_vertex));
    say(non_orientable_patches, "part that cannot be oriented consistently",
        "parts that cannot be oriented consistently");
    say(opposite_duplicates, "triangle lies back to back on another with the same vertices",
        "triangles lie back to back on others with the same vertices");
    say(zero_area_triangles, "triangle of no area", "triangles of no area");
    say(cavities, "closed part turned inwards inside another (a cavity)",
        "closed parts turned inwards inside others (cavities)");
    say(duplicate_vertices, "vertex at the position of another", "vertices at the positions of others");
    say(unused_vertices, "unused vertex", "unused vertices");
    say(degenerate_triangles, "triangle with a repeated vertex", "triangles with a repeated vertex",
        " (dropped)");
    say(duplicate_triangles, "duplicate triangle", "duplicate triangles", " (dropped)");
    say(inconsistent_triangles, "triangle with inconsistent orientation",
        "triangles with inconsistent orientation", " (flipped)");
    say(inverted_components, "part was inside out", "parts were inside out", " (flipped)");
    return out;
}

void require_muscle_surface(const MeshReport& report, const std::string& where) {
    require_usable(report, where);
    if (report.triangles == 0)
        throw_error(where, "has no triangles", "the closed surface of a muscle");
    if (report.boundary_edges > 0)
        throw_error(where,
                    "the surface has " + count(report.holes, "hole", "holes") +
                        "; the first boundary edge lies " + between(report.first_boundary_edge),
                    "a closed surface");
    if (!report.closed())
        throw_error(where,
                    "the surface does not close at " + count(report.unbalanced_edges, "edge", "edges") +
                        ", the first lies " + between(report.first_unbalanced_edge),
                    "a closed surface");
}

void require_bone_surface(const MeshReport& report, const std::string& where) {
    require_usable(report, where);
    if (report.triangles - report.zero_area_triangles < 4)
        throw_error(where,
                    "has " + count(report.triangles - report.zero_area_triangles, "triangle", "triangles") +
                        " with an area",
                    "a bone surface of at least 4");
}

} // namespace fascicle
