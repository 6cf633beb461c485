#include "solver/rivals/lines/muscle_line.hpp"

#include "fascicle/geometry/solid_query.hpp"
#include "solver/rivals/lines/attachment_pairs.hpp"
#include "solver/rivals/lines/line_ends.hpp"
#include "solver/rivals/lines/middle_line.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

Vec3 mean_of(const Points& points, const std::vector<int>& vertices) {
    Vec3 sum = Vec3::Zero();
    for (const int v : vertices)
        sum += points[at(v)] / double(vertices.size());
    return sum;
}

std::vector<double> vertex_areas(const TriMesh& surface) {
    std::vector<double> areas(surface.positions.size(), 0.0);
    for (const Tri& t : surface.triangles) {
        const Vec3& a = surface.positions[at(t[0])];
        const double area =
            0.5 * (surface.positions[at(t[1])] - a).cross(surface.positions[at(t[2])] - a).norm();
        for (const int v : t)
            areas[at(v)] += area / 3.0;
    }
    return areas;
}

/// By solid, of one part of the surface.
std::vector<AttachedArea> attached_areas(const SoftBodyProblem& problem, const MeshTopology& topology,
                                         int part) {
    const std::size_t solids = problem.solids.size();
    std::vector<AttachedArea> areas(solids);
    for (std::size_t v = 0; v < problem.body_of_vertex.size(); ++v)
        if (const int solid = problem.body_of_vertex[v];
            solid >= 0 && topology.vertex_component(static_cast<int>(v)) == part)
            areas[at(solid)].vertices.push_back(static_cast<int>(v));
    for (std::size_t s = 0; s < solids; ++s) {
        areas[s].solid = static_cast<int>(s);
        areas[s].middle = mean_of(problem.surface->positions, areas[s].vertices);
        for (std::size_t k = s; k < problem.carry_weights.size() && !areas[s].moves; k += solids)
            areas[s].moves = problem.carry_weights[k] != 0.0; // no vertex follows a solid that stays
    }
    std::erase_if(areas, [](const AttachedArea& area) { return area.vertices.empty(); });
    return areas;
}

double share_of(int solid, std::size_t vertex, const EndShares& shares) {
    const auto it = std::lower_bound(shares.solids.begin(), shares.solids.end(), solid);
    return shares.of(vertex, static_cast<std::size_t>(it - shares.solids.begin()));
}

/// By vertex: how much of it is of the attachments where lines end, against those where they begin.
std::vector<double> end_side(const std::vector<AttachedArea>& areas, const std::vector<AttachmentPair>& pairs,
                             const EndShares& shares) {
    std::vector<double> u(shares.values.size() / shares.solids.size(), 0.0);
    for (std::size_t a = 0; a < areas.size(); ++a)
        if (std::any_of(pairs.begin(), pairs.end(), [&](const AttachmentPair& p) { return p.to == a; }))
            for (std::size_t v = 0; v < u.size(); ++v)
                u[v] = std::min(1.0, u[v] + share_of(areas[a].solid, v, shares));
    return u;
}

/// By vertex: how much of it is of the pair of attachments, among all pairs.
std::vector<double> pair_weights(int from, int to, const std::vector<double>& u, const EndShares& shares) {
    std::vector<double> weights(u.size(), 0.0);
    for (std::size_t v = 0; v < u.size(); ++v) {
        const double begin = u[v] < 1.0 ? share_of(from, v, shares) / (1.0 - u[v]) : 1.0;
        const double end = u[v] > 0.0 ? share_of(to, v, shares) / u[v] : 1.0;
        weights[v] = std::min(1.0, begin) * std::min(1.0, end);
    }
    return weights;
}

/// The first of the shares 1, 3/4, 1/2, 1/4 of the way from the middle at which the place is inside the muscle; else 0.
Vec3 inside_place(const SolidQuery& inside, const Vec3& middle, const Vec3& offset) {
    for (const double share : {1.0, 0.75, 0.5, 0.25})
        if (inside.inside(middle + share * offset))
            return middle + share * offset;
    return middle;
}

void add_lines(const SoftBodyProblem& problem, const MeshTopology& topology, const EndShares& shares,
               int part, int count, int via, std::vector<MuscleLine>& lines) {
    const Points& rest = problem.surface->positions;
    const std::vector<AttachedArea> areas = attached_areas(problem, topology, part);
    const std::vector<AttachmentPair> pairs = pair_attachments(areas, count);
    if (pairs.empty())
        return;
    TriMesh piece{rest, {}};
    for (const Tri& t : problem.surface->triangles)
        if (topology.vertex_component(t[0]) == part && !has_repeated_index(t))
            piece.triangles.push_back(t);
    const SolidQuery inside(piece);
    const std::vector<double> sizes = vertex_areas(piece);
    const std::vector<double> u = end_side(areas, pairs, shares);
    for (const AttachmentPair& pair : pairs) {
        const AttachedArea &begin = areas[pair.from], &end = areas[pair.to];
        std::vector<int> from = even_vertices(rest, sizes, begin.vertices, pair.lines);
        std::vector<int> to = even_vertices(rest, sizes, end.vertices, static_cast<int>(from.size()));
        if (to.size() < from.size())
            from = even_vertices(rest, sizes, begin.vertices, static_cast<int>(to.size()));
        pair_ends(rest, from, to);
        const Vec3 first = mean_of(rest, from), last = mean_of(rest, to);
        const MiddleLine middle = middle_line(rest, piece.triangles, u,
                                              pair_weights(begin.solid, end.solid, u, shares), first, last);
        for (std::size_t n = 0; n < from.size(); ++n) {
            MuscleLine line;
            line.part = part;
            line.from = begin.solid;
            line.to = end.solid;
            const Vec3 a = rest[at(from[n])] - first, b = rest[at(to[n])] - last;
            for (std::size_t k = 0; k < line_nodes; ++k) {
                const double share = double(k) / double(line_nodes - 1);
                line.nodes.push_back(inside_place(inside, middle.at(share), (1.0 - share) * a + share * b));
            }
            line.nodes.front() = rest[at(from[n])];
            line.nodes.back() = rest[at(to[n])];
            line.solid.assign(line_nodes, -1);
            line.solid.front() = line.from;
            line.solid.back() = line.to;
            for (int j = 1; j <= via; ++j) {
                const double share = double(j) / double(via + 1);
                const auto k = static_cast<std::size_t>(std::lround(share * double(line_nodes - 1)));
                const Tri& t = piece.triangles[at(inside.bvh().closest(line.nodes[k]).triangle)];
                const double mean = (u[at(t[0])] + u[at(t[1])] + u[at(t[2])]) / 3.0;
                line.solid[k] = mean < 0.5 ? line.from : line.to;
            }
            for (const int solid : line.solid)
                line.held.push_back(solid >= 0 ? 1 : 0);
            line.rest = line.nodes;
            lines.push_back(std::move(line));
        }
    }
}

} // namespace

std::vector<MuscleLine> make_lines(const SoftBodyProblem& problem, const MeshTopology& topology,
                                   const EndShares& shares, int count, int via) {
    std::vector<MuscleLine> lines;
    for (int part = 0; part < topology.component_count(); ++part)
        add_lines(problem, topology, shares, part, count, via, lines);
    return lines;
}

} // namespace fascicle::solver
