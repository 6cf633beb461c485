#include "anatomy/fibres/outline_cut.hpp"

#include "fascicle/anatomy/attach.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace fascicle {

namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

/// A closed curve on the surface with its outward normals.
struct SurfaceCurve {
    Points points, normals;
    double mean_distance = 0;
};

double mean_edge(const TriMesh& mesh) {
    double sum = 0;
    for (const Tri& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            sum += (mesh.positions[static_cast<std::size_t>(t[(k + 1) % 3])] -
                    mesh.positions[static_cast<std::size_t>(t[k])])
                       .norm();
    return sum / (3.0 * double(mesh.triangles.size()));
}

SurfaceCurve projected(const TriMesh& mesh, const Points& outline, double spacing, const Points& normals) {
    BoundingBox box = bounding_box(outline);
    const double reach = 0.5 * box.diagonal() + 8.0 * spacing;
    box.add(Vec3(box.min.array() - reach));
    box.add(Vec3(box.max.array() + reach));
    std::vector<Tri> near;
    for (const Tri& t : mesh.triangles)
        if (std::any_of(t.begin(), t.end(), [&](int v) {
                const Vec3& p = mesh.positions[static_cast<std::size_t>(v)];
                return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
            }))
            near.push_back(t);
    SurfaceCurve curve;
    if (near.empty())
        return curve;
    const TriangleBvh tree(mesh.positions, near);
    double sum = 0;
    int hint = -1;
    const std::size_t n = outline.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 &a = outline[i], &b = outline[(i + 1) % n];
        const auto steps = static_cast<int>(std::clamp(std::ceil((b - a).norm() / spacing), 1.0, 200.0));
        for (int k = 0; k < steps; ++k) {
            const SurfacePoint q =
                tree.closest(a + double(k) / steps * (b - a), std::numeric_limits<double>::infinity(), hint);
            hint = q.triangle;
            sum += std::sqrt(q.squared_distance);
            if (!curve.points.empty() && (q.point - curve.points.back()).norm() < 1e-3 * spacing)
                continue;
            curve.points.push_back(q.point);
            Vec3 normal = Vec3::Zero();
            for (int c = 0; c < 3; ++c)
                normal += q.weights[c] * normals[static_cast<std::size_t>(
                                             near[static_cast<std::size_t>(q.triangle)][std::size_t(c)])];
            curve.normals.push_back(normal.normalized());
        }
    }
    curve.mean_distance = sum / double(curve.points.size());
    return curve;
}

/// Signed distance of p to the curve, positive on its left seen from outside; NaN when it is farther than `reach` or on
/// another sheet of the surface.
double signed_offset(const SurfaceCurve& curve, const Vec3& p, const Vec3& normal, double reach) {
    const std::size_t n = curve.points.size();
    double best = reach;
    std::size_t piece = n;
    double share = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = curve.points[k], &b = curve.points[(k + 1) % n];
        if ((a - p).norm() > best + (b - a).norm() || curve.normals[k].dot(normal) <= 0)
            continue;
        const double s = closest_share_on_segment(p, a, b);
        if (const double d = (a + s * (b - a) - p).norm(); d < best) {
            best = d;
            piece = k;
            share = s;
        }
    }
    if (piece == n)
        return nowhere;
    const auto direction = [&](std::size_t k) {
        return Vec3((curve.points[(k + 1) % n] - curve.points[k]).normalized());
    };
    Vec3 tangent = direction(piece);
    if (share <= 0) // at a corner: the side of both pieces together
        tangent += direction((piece + n - 1) % n);
    else if (share >= 1)
        tangent += direction((piece + 1) % n);
    const Vec3& a = curve.points[piece];
    const Vec3 foot = a + share * (curve.points[(piece + 1) % n] - a);
    const double side = curve.normals[piece].cross(tangent).dot(p - foot);
    return side >= 0 ? best : -best;
}

/// Sides of the vertices far from the curve, by flooding; false when one side is reached from both.
bool flood(const MeshTopology& topology, const std::vector<double>& offset, std::vector<char>& left) {
    const std::size_t n = offset.size();
    std::vector<char> known(n, 0);
    for (std::size_t v = 0; v < n; ++v)
        if (!std::isnan(offset[v])) {
            known[v] = 1;
            left[v] = offset[v] > 0 ? 1 : 0;
        }
    std::vector<int> stack;
    for (std::size_t start = 0; start < n; ++start) {
        if (known[start] != 0)
            continue;
        stack.assign(1, static_cast<int>(start));
        std::vector<int> part;
        bool touches[2] = {false, false};
        known[start] = 1;
        while (!stack.empty()) {
            const int v = stack.back();
            stack.pop_back();
            part.push_back(v);
            for (const int w : topology.vertex_neighbours(v)) {
                const auto u = static_cast<std::size_t>(w);
                if (!std::isnan(offset[u]))
                    touches[offset[u] > 0 ? 1 : 0] = true;
                else if (known[u] == 0) {
                    known[u] = 1;
                    stack.push_back(w);
                }
            }
        }
        if (touches[0] && touches[1])
            return false;
        for (const int v : part)
            left[static_cast<std::size_t>(v)] = touches[1] ? 1 : 0;
    }
    return true;
}

class EdgeCuts {
public:
    EdgeCuts(CutSurface& surface, std::vector<OutlineSide>& sides, std::size_t side)
        : surface_(surface), sides_(sides), side_(side) {}
    void snap();
    void cut();

private:
    bool crosses(int a, int b) const {
        const double u = offset(a), v = offset(b);
        return (u < 0 && v > 0) || (u > 0 && v < 0);
    }
    double offset(int v) const { return sides_[side_].offset[static_cast<std::size_t>(v)]; }
    int vertex_on(int a, int b);

    CutSurface& surface_;
    std::vector<OutlineSide>& sides_;
    std::size_t side_;
    std::map<std::pair<int, int>, int> new_vertices_;
};

void EdgeCuts::snap() {
    std::vector<double>& offsets = sides_[side_].offset;
    for (const Tri& t : surface_.mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            if (!crosses(a, b))
                continue;
            const double share = offset(a) / (offset(a) - offset(b));
            if (share < 0.1)
                offsets[static_cast<std::size_t>(a)] = 0.0;
            else if (share > 0.9)
                offsets[static_cast<std::size_t>(b)] = 0.0;
        }
}

int EdgeCuts::vertex_on(int a, int b) {
    if (a > b)
        std::swap(a, b);
    const auto [it, fresh] = new_vertices_.try_emplace({a, b}, surface_.mesh.vertex_count());
    if (!fresh)
        return it->second;
    const double share = offset(a) / (offset(a) - offset(b));
    const auto blend = [&](double u, double v) { return (1.0 - share) * u + share * v; };
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    surface_.mesh.positions.push_back((1.0 - share) * surface_.mesh.positions[i] +
                                      share * surface_.mesh.positions[j]);
    const int patch = surface_.patch[i] == surface_.patch[j] ? surface_.patch[i] : -1;
    surface_.patch.push_back(patch);
    for (OutlineSide& other : sides_) {
        if (other.offset.empty())
            continue;
        other.offset.push_back(blend(other.offset[i], other.offset[j]));
        other.inside.push_back(other.inside[i] != 0 && other.inside[j] != 0 ? 1 : 0);
    }
    sides_[side_].offset.back() = 0.0;
    return it->second;
}

void EdgeCuts::cut() {
    std::vector<Tri> triangles;
    triangles.reserve(surface_.mesh.triangles.size() + 256);
    const std::vector<Tri> before = std::move(surface_.mesh.triangles);
    for (const Tri& t : before) {
        if (!crosses(t[0], t[1]) && !crosses(t[1], t[2]) && !crosses(t[2], t[0])) {
            triangles.push_back(t);
            continue;
        }
        std::array<std::vector<int>, 2> parts; // the polygons inside and outside, the cut in both
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = t[k], b = t[(k + 1) % 3];
            if (offset(a) <= 0)
                parts[0].push_back(a);
            if (offset(a) >= 0)
                parts[1].push_back(a);
            if (crosses(a, b))
                for (auto& part : parts)
                    part.push_back(vertex_on(a, b));
        }
        for (const auto& part : parts)
            for (std::size_t k = 1; k + 1 < part.size(); ++k)
                triangles.push_back({part[0], part[k], part[k + 1]});
    }
    surface_.mesh.triangles = std::move(triangles);
}

} // namespace

OutlineSide side_of_outline(const FibreProblem& problem, const AttachmentPatch& patch,
                            const Points& normals) {
    OutlineSide side;
    const TriMesh& mesh = *problem.surface;
    const Points& outline = patch.outline;
    if (outline.size() < 3 ||
        (outline.front() - outline.back()).norm() > attach_rules(problem.unit_mm).open_gap) {
        side.failure = "it is an open line";
        return side;
    }
    const double edge = mean_edge(mesh);
    const SurfaceCurve curve = projected(mesh, outline, 0.5 * edge, normals);
    if (curve.points.size() < 3 || curve.mean_distance > 15.0 / problem.unit_mm) {
        side.failure = "it lies away from the muscle";
        return side;
    }
    const double reach = 2.5 * edge;
    BoundingBox box = bounding_box(curve.points);
    box.min.array() -= reach;
    box.max.array() += reach;
    side.offset.assign(mesh.positions.size(), nowhere);
    std::size_t near = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3& p = mesh.positions[v];
        if ((p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all()) {
            side.offset[v] = signed_offset(curve, p, normals[v], reach);
            near += std::isnan(side.offset[v]) ? 0u : 1u;
        }
    }
    std::vector<char> left(mesh.positions.size(), 0);
    if (!flood(*problem.topology, side.offset, left)) {
        side.failure = "its two sides meet";
        return side;
    }
    const auto lefts = std::count(left.begin(), left.end(), 1);
    const auto rights = static_cast<std::ptrdiff_t>(left.size()) - lefts;
    if (lefts == 0 || rights == 0 || near == 0) {
        side.failure = "it bounds no vertex";
        return side;
    }
    const char inner = lefts <= rights ? 1 : 0;
    side.inside.resize(left.size());
    for (std::size_t v = 0; v < left.size(); ++v)
        side.inside[v] = left[v] == inner ? 1 : 0;
    if (inner == 1)
        for (double& offset : side.offset)
            offset = -offset;
    std::size_t held = 0;
    for (const int v : patch.vertices)
        held += side.inside[static_cast<std::size_t>(v)] != 0 ? 1u : 0u;
    // Attaching takes a border beyond the outline too, and both faces of a thin edge, so the two never agree fully.
    const auto within = static_cast<std::size_t>(std::min(lefts, rights));
    if (4 * held < std::min(within, patch.vertices.size()))
        side.failure = "it does not lie where the muscle is attached";
    return side;
}

CutSurface cut_surface(const FibreProblem& problem, std::vector<OutlineSide>& sides) {
    CutSurface surface{*problem.surface, std::vector<int>(problem.surface->positions.size(), -1)};
    for (OutlineSide& side : sides)
        if (!side.failure.empty())
            side.offset.clear();
    for (std::size_t s = 0; s < sides.size(); ++s)
        if (sides[s].failure.empty()) {
            EdgeCuts cuts(surface, sides, s);
            cuts.snap();
            cuts.cut();
        }
    for (std::size_t s = sides.size(); s-- > 0;) {
        if (sides[s].offset.empty())
            for (const int v : problem.patches[s].vertices)
                surface.patch[static_cast<std::size_t>(v)] = static_cast<int>(s);
        else
            for (std::size_t v = 0; v < sides[s].offset.size(); ++v)
                if (sides[s].inside[v] != 0 || sides[s].offset[v] == 0.0)
                    surface.patch[v] = static_cast<int>(s);
    }
    return surface;
}

} // namespace fascicle
