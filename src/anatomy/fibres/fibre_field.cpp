#include "anatomy/fibres/fibre_field.hpp"

#include "anatomy/fibres/stopwatch.hpp"
#include "fascicle/anatomy/harmonic_field.hpp"
#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/mesh_check.hpp"
#include "fascicle/geometry/vertex_normals.hpp"

#include <algorithm>

namespace fascicle {

namespace {

std::string patch_name(const AttachmentPatch& patch) {
    return patch.name.empty() ? std::string(to_text(patch.kind)) : patch.name;
}

void check_numbers(const FibreProblem& problem) {
    const std::string where = fibre_error_place(problem);
    if (problem.count < 1 || problem.count > 2000)
        throw_error(where, std::to_string(problem.count) + " fibres", "1 to 2000");
    if (problem.segments < 1 || problem.segments > 200)
        throw_error(where, std::to_string(problem.segments) + " segments", "1 to 200");
    if (!(problem.unit_mm > 0))
        throw_error(where, "a length unit of " + std::to_string(problem.unit_mm) + " mm", "above 0");
}

void check_surface(const FibreProblem& problem) {
    const TriMesh& mesh = *problem.surface;
    const std::string where = fibre_error_place(problem);
    if (mesh.triangles.empty())
        throw_error(where, "the surface has no triangles", "a closed surface");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        if (!mesh.positions[i].allFinite())
            throw_error(where, "vertex " + std::to_string(i) + " is not finite", "numbers");
    if (const auto& open = problem.topology->boundary_edges(); !open.empty()) {
        const Edge& edge = problem.topology->edges()[static_cast<std::size_t>(open.front())];
        throw_error(where,
                    "the surface is open at " + std::to_string(open.size()) +
                        " edges, first between vertices " + std::to_string(edge.a) + " and " +
                        std::to_string(edge.b),
                    "a closed surface");
    }
}

} // namespace

std::string fibre_error_place(const FibreProblem& problem) {
    return (problem.muscle.empty() ? std::string("muscle") : problem.muscle) + ": fibres";
}

std::string fibre_error_place(const FibreProblem& problem, const AttachmentPatch& patch) {
    return fibre_error_place(problem) + ": " + patch_name(patch);
}

FibreProblem checked_problem(const FibreProblem& problem, std::vector<std::string>& notes) {
    FASCICLE_ASSERT(problem.surface != nullptr && problem.topology != nullptr);
    FASCICLE_ASSERT(problem.topology->vertex_count() == problem.surface->vertex_count());
    check_numbers(problem);
    check_surface(problem);
    const std::string where = fibre_error_place(problem);
    FibreProblem checked = problem;
    const auto vertices = static_cast<int>(problem.surface->positions.size());
    std::array<std::vector<char>, 2> claimed;
    claimed.fill(std::vector<char>(problem.surface->positions.size(), 0));
    for (const AttachmentPatch& patch : problem.patches) {
        if (patch.kind == AttachmentKind::unknown)
            throw_error(fibre_error_place(problem, patch), "neither origin nor insertion", "one of them");
        if (patch.vertices.empty())
            throw_error(fibre_error_place(problem, patch), "no vertex of the muscle is attached",
                        "at least one");
        for (const int v : patch.vertices) {
            if (v < 0 || v >= vertices)
                throw_error(fibre_error_place(problem, patch), "vertex " + std::to_string(v),
                            "0 to " + std::to_string(vertices - 1));
            claimed[patch.kind == AttachmentKind::origin ? 0 : 1][static_cast<std::size_t>(v)] = 1;
        }
        for (const Vec3& p : patch.outline)
            if (!p.allFinite())
                throw_error(fibre_error_place(problem, patch), "a point of the outline is not finite",
                            "numbers");
    }
    std::size_t shared = 0;
    for (AttachmentPatch& patch : checked.patches) {
        const std::size_t before = patch.vertices.size();
        std::erase_if(patch.vertices, [&](int v) {
            return problem.topology->vertex_component(v) < 0 ||
                   (claimed[0][static_cast<std::size_t>(v)] != 0 &&
                    claimed[1][static_cast<std::size_t>(v)] != 0);
        });
        shared += before - patch.vertices.size();
        // Its outline overlaps the other kind's as well.
        if (patch.vertices.size() < before)
            patch.outline.clear();
    }
    std::erase_if(checked.patches, [](const AttachmentPatch& patch) { return patch.vertices.empty(); });
    for (const AttachmentKind kind : {AttachmentKind::origin, AttachmentKind::insertion}) {
        const auto of_kind = [&](const AttachmentPatch& patch) { return patch.kind == kind; };
        if (std::none_of(problem.patches.begin(), problem.patches.end(), of_kind))
            throw_error(where, std::string("no ") + to_text(kind), "an origin and an insertion");
        if (std::none_of(checked.patches.begin(), checked.patches.end(), of_kind))
            throw_error(where,
                        std::string("every vertex of the ") + to_text(kind) +
                            " is attached at the other end too",
                        "an origin and an insertion in different places");
    }
    if (shared > 0)
        notes.push_back(std::to_string(shared) +
                        " vertices are attached at both ends; fibres take them for neither");
    return checked;
}

std::vector<double> FibreField::at_original(std::size_t vertices) const {
    std::vector<double> field(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(vertices));
    for (double& u : field)
        u = std::clamp(u, 0.0, 1.0);
    return field;
}

FibreField solve_fibre_field(const FibreProblem& checked) {
    FibreField field;
    Stopwatch watch;
    const std::string where = fibre_error_place(checked);
    const Points normals = vertex_normals(checked.surface->positions, checked.surface->triangles);
    std::vector<OutlineSide> sides;
    for (const AttachmentPatch& patch : checked.patches) {
        sides.emplace_back();
        sides.back().failure = "there is none";
        if (patch.outline.empty())
            continue;
        sides.back() = side_of_outline(checked, patch, normals);
        if (!sides.back().failure.empty() && sides.back().failure != "it is an open line")
            field.notes.push_back(patch_name(patch) + ": the muscle is not cut along its outline, " +
                                  sides.back().failure + "; the attached vertices count instead");
    }
    field.surface = cut_surface(checked, sides);
    const TriMesh& mesh = field.surface.mesh;
    const std::size_t n = mesh.positions.size();
    field.topology = MeshTopology(mesh.vertex_count(), mesh.triangles);
    std::vector<bool> fixed(n, false);
    field.values.assign(n, -1.0);
    const auto components = static_cast<std::size_t>(field.topology.component_count());
    std::vector<std::array<bool, 3>> has(components, {false, false, false}); // origin, insertion, free
    for (std::size_t v = 0; v < n; ++v) {
        const int component = field.topology.vertex_component(static_cast<int>(v));
        if (component < 0)
            continue;
        const int patch = field.surface.patch[v];
        const bool origin =
            patch >= 0 && checked.patches[static_cast<std::size_t>(patch)].kind == AttachmentKind::origin;
        has[static_cast<std::size_t>(component)][patch < 0 ? 2 : origin ? 0 : 1] = true;
        if (patch >= 0) {
            fixed[v] = true;
            field.values[v] = origin ? 0.0 : 1.0;
        }
    }
    std::size_t useful = 0;
    for (const auto& h : has)
        useful += h[0] && h[1] && h[2] ? 1u : 0u;
    if (useful == 0)
        throw_error(where,
                    std::any_of(has.begin(), has.end(), [](const auto& h) { return h[0] && h[1]; })
                        ? "origin and insertion leave no free vertex between them"
                        : "origin and insertion are on parts of the surface that do not hang together",
                    "a muscle that reaches from one to the other");
    if (useful < components)
        field.notes.push_back(
            std::to_string(components - useful) + " of " + std::to_string(components) +
            " separate parts of the surface do not reach from origin to insertion and get no "
            "fibres");
    field.cut_seconds = watch.lap();
    field.values = solve_harmonic(mesh, field.topology, fixed, field.values, 1);
    for (std::size_t v = 0; v < n; ++v) {
        const int component = field.topology.vertex_component(static_cast<int>(v));
        const bool used = component >= 0 && has[static_cast<std::size_t>(component)][0] &&
                          has[static_cast<std::size_t>(component)][1];
        if (!used)
            field.values[v] = -1.0;
        else if (!std::isfinite(field.values[v]))
            throw_error(where,
                        "the field between the attachments is not finite at vertex " + std::to_string(v),
                        "a surface without degenerate triangles between them");
    }
    field.field_seconds = watch.lap();
    return field;
}

std::vector<Tri> attached_triangles(const FibreProblem& problem, AttachmentKind kind) {
    std::vector<char> attached(problem.surface->positions.size(), 0);
    for (const AttachmentPatch& patch : problem.patches)
        if (patch.kind == kind)
            for (const int v : patch.vertices)
                attached[static_cast<std::size_t>(v)] = 1;
    const auto is = [&](int v) { return attached[static_cast<std::size_t>(v)] != 0; };
    std::vector<Tri> found;
    for (const Tri& t : problem.surface->triangles) {
        const int held = int(is(t[0])) + int(is(t[1])) + int(is(t[2]));
        if (held == 3)
            found.push_back(t);
        else if (held == 2) {
            const std::size_t k = !is(t[0]) ? 1 : !is(t[1]) ? 2 : 0;
            found.push_back({t[k], t[(k + 1) % 3], t[(k + 1) % 3]});
        } else if (held == 1) {
            const int v = is(t[0]) ? t[0] : is(t[1]) ? t[1] : t[2];
            found.push_back({v, v, v});
        }
    }
    return found;
}

} // namespace fascicle
