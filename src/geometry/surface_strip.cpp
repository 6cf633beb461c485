#include "geometry/surface_strip.hpp"

#include "fascicle/geometry/closest_point.hpp"
#include "geometry/funnel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {
namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

double angle_between(const Vec3& u, const Vec3& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// The place at distances `da` and `db` from a and b, on the left of a -> b (side 1) or on the right (side -1).
Vec2 place_at(const Vec2& a, const Vec2& b, double da, double db, double side) {
    const Vec2 ab = b - a;
    const double length = ab.norm();
    if (!(length > 0.0))
        return a + Vec2(da, 0.0);
    const double along = (da * da - db * db + length * length) / (2.0 * length);
    const double height = std::sqrt(std::max(0.0, da * da - along * along));
    const Vec2 unit = ab / length;
    return a + along * unit + side * height * Vec2(-unit.y(), unit.x());
}

bool has_corner(const Tri& tri, int v) {
    return tri[0] == v || tri[1] == v || tri[2] == v;
}

constexpr double straight = std::numbers::pi - 1e-7; ///< a bend of less than this is worth passing

} // namespace

SurfaceStrip::SurfaceStrip(const SurfaceGraph& graph, const SurfacePoint& from, const SurfacePoint& to,
                           const std::vector<int>& vertices)
    : graph_(graph), from_(from), to_(to) {
    for (const int v : vertices)
        steps_.push_back({v, -1, 0.0});
}

Vec3 SurfaceStrip::place(std::size_t i) const {
    const Step& step = steps_[i];
    if (step.vertex >= 0)
        return graph_.position(step.vertex);
    const Edge& edge = graph_.topology().edges()[z(step.edge)];
    return graph_.position(edge.a) + step.share * (graph_.position(edge.b) - graph_.position(edge.a));
}

Vec3 SurfaceStrip::before(std::size_t i) const {
    return i == 0 ? from_.point : place(i - 1);
}

Vec3 SurfaceStrip::after(std::size_t i) const {
    return i + 1 == steps_.size() ? to_.point : place(i + 1);
}

int SurfaceStrip::shared_triangle(std::size_t gap) const {
    if (gap == 0)
        return from_.triangle;
    if (gap == steps_.size())
        return to_.triangle;
    const auto holds = [&](int t, const Step& step) {
        if (step.vertex >= 0)
            return has_corner(graph_.triangle(t), step.vertex);
        const Edge& edge = graph_.topology().edges()[z(step.edge)];
        return has_corner(graph_.triangle(t), edge.a) && has_corner(graph_.triangle(t), edge.b);
    };
    const Step &a = steps_[gap - 1], &b = steps_[gap];
    const int v = a.vertex >= 0 ? a.vertex : graph_.topology().edges()[z(a.edge)].a;
    for (const int t : graph_.topology().vertex_triangles(v))
        if (holds(t, a) && holds(t, b))
            return t;
    return -1;
}

bool SurfaceStrip::find_fan(int vertex, Fan& fan) const {
    const MeshTopology& topology = graph_.topology();
    const auto triangles = topology.vertex_triangles(vertex);
    // Start at an open border if there is one.
    int first = -1;
    const auto neighbours = topology.vertex_neighbours(vertex);
    const auto edges = graph_.vertex_edges(vertex);
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const std::size_t sides = topology.edge_half_edges(edges[k]).size();
        if (sides > 2)
            return false;
        if (sides == 1 && first < 0)
            first = neighbours[k];
    }
    fan.closed = first < 0;
    if (first < 0)
        first = neighbours[0];
    fan.neighbours.assign(1, first);
    fan.triangles.clear();
    fan.angles.assign(1, 0.0);
    int last_triangle = -1;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const int at = fan.neighbours.back();
        int next_triangle = -1;
        for (const int half_edge : topology.edge_half_edges(graph_.edge_between(vertex, at)))
            if (half_edge / 3 != last_triangle && next_triangle < 0)
                next_triangle = half_edge / 3;
        if (next_triangle < 0)
            return false; // a second fan
        const Tri& tri = graph_.triangle(next_triangle);
        int next = -1;
        for (const int v : tri)
            if (v != vertex && v != at)
                next = v;
        fan.triangles.push_back(next_triangle);
        fan.angles.push_back(fan.angles.back() +
                             angle_between(graph_.position(at) - graph_.position(vertex),
                                           graph_.position(next) - graph_.position(vertex)));
        fan.neighbours.push_back(next);
        last_triangle = next_triangle;
        if (fan.closed && next == first)
            break;
    }
    return fan.triangles.size() == triangles.size() && (!fan.closed || fan.neighbours.back() == first);
}

SurfaceStrip::Bearing SurfaceStrip::bearing(const Fan& fan, std::size_t step, bool forward) const {
    const int vertex = steps_[step].vertex;
    const std::size_t other = forward ? step + 1 : step - 1;
    const bool is_end = forward ? step + 1 == steps_.size() : step == 0;
    if (!is_end && steps_[other].vertex >= 0) {
        for (std::size_t k = 0; k < fan.triangles.size() + (fan.closed ? 0 : 1); ++k)
            if (fan.neighbours[k] == steps_[other].vertex)
                return {static_cast<int>(2 * k), fan.angles[k]};
        return {};
    }
    const Vec3 to = (forward ? after(step) : before(step)) - graph_.position(vertex);
    for (std::size_t k = 0; k < fan.triangles.size(); ++k) {
        if (is_end) {
            if (fan.triangles[k] != (forward ? to_ : from_).triangle)
                continue;
        } else {
            const Edge& edge = graph_.topology().edges()[z(steps_[other].edge)];
            const int a = fan.neighbours[k], b = fan.neighbours[k + 1];
            if (std::min(a, b) != edge.a || std::max(a, b) != edge.b)
                continue;
        }
        return {static_cast<int>(2 * k + 1),
                fan.angles[k] +
                    angle_between(graph_.position(fan.neighbours[k]) - graph_.position(vertex), to)};
    }
    return {};
}

bool SurfaceStrip::pass_vertex(std::size_t step) {
    Fan fan;
    const int vertex = steps_[step].vertex;
    // An end that lies on the vertex: there is no direction to it, and nothing to gain.
    const double nothing = 1e-9 * graph_.mean_edge_length();
    if ((before(step) - place(step)).norm() <= nothing || (after(step) - place(step)).norm() <= nothing)
        return false;
    if (!find_fan(vertex, fan))
        return false;
    const Bearing in = bearing(fan, step, false), out = bearing(fan, step, true);
    if (in.slot < 0 || out.slot < 0)
        return false;
    // Upwards in the fan from `in` to `out`, or downwards; in an open fan only one of them stays inside. Slots decide what
    // is above: angles of points on an edge are equal but for rounding.
    double gap = out.angle - in.angle;
    if (in.slot != out.slot)
        gap = out.slot > in.slot ? std::max(gap, 0.0) : std::min(gap, 0.0);
    const bool above = in.slot != out.slot ? out.slot > in.slot : gap >= 0.0;
    const double outwards = fan.closed ? fan.angles.back() - std::abs(gap) : 1e9;
    const double up = above ? std::abs(gap) : outwards, down = above ? outwards : std::abs(gap);
    if (std::min(up, down) >= straight)
        return false;
    std::vector<Step> around;
    const int slots = static_cast<int>(2 * fan.triangles.size()) + (fan.closed ? 0 : 1);
    const int turn = up <= down ? 1 : slots - 1;
    if (in.slot != out.slot)
        for (int s = (in.slot + turn) % slots; s != out.slot; s = (s + turn) % slots)
            if (s % 2 == 0) {
                const int edge = graph_.edge_between(vertex, fan.neighbours[z(s / 2)]);
                around.push_back({-1, edge, graph_.topology().edges()[z(edge)].a == vertex ? 0.0 : 1.0});
            }
    const auto at = steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(step));
    steps_.insert(at, around.begin(), around.end());
    return true;
}

void SurfaceStrip::clean_up() {
    const auto is_end_of = [&](int vertex, int edge) {
        const Edge& e = graph_.topology().edges()[z(edge)];
        return e.a == vertex || e.b == vertex;
    };
    std::vector<Step> kept;
    for (const Step& step : steps_) {
        // A crossing at a vertex that the way goes through is that vertex.
        if (step.vertex >= 0)
            while (!kept.empty() && kept.back().vertex < 0 && is_end_of(step.vertex, kept.back().edge))
                kept.pop_back();
        const bool repeated =
            !kept.empty() && kept.back().vertex >= 0 &&
            (step.vertex >= 0 ? step.vertex == kept.back().vertex : is_end_of(kept.back().vertex, step.edge));
        if (repeated)
            continue;
        if (!kept.empty() && step.vertex < 0 && kept.back().edge == step.edge)
            kept.pop_back(); // there and back
        else
            kept.push_back(step);
    }
    steps_.swap(kept);
}

std::size_t SurfaceStrip::tighten(std::size_t step) {
    if (step >= steps_.size() || steps_[step].vertex >= 0) {
        if (step == 0 || steps_[step - 1].vertex >= 0)
            return step;
        --step;
    }
    std::size_t first = step, last = step;
    while (first > 0 && steps_[first - 1].vertex < 0)
        --first;
    while (last + 1 < steps_.size() && steps_[last + 1].vertex < 0)
        ++last;
    // Unfold: the start at the origin, then every vertex from its distances to the edge before.
    const Vec3 start = before(first), end = after(last);
    const auto ends = [&](std::size_t i) { return graph_.topology().edges()[z(steps_[i].edge)]; };
    std::vector<FunnelGate> gates;
    std::vector<std::array<int, 2>> names; // vertices on the left and on the right
    const Edge e0 = ends(first);
    const auto distance = [&](int v, const Vec3& p) { return (graph_.position(v) - p).norm(); };
    int left = e0.a, right = e0.b;
    const Vec2 right_place(distance(right, start), 0.0);
    gates.push_back({place_at(Vec2::Zero(), right_place, distance(left, start),
                              (graph_.position(left) - graph_.position(right)).norm(), 1.0),
                     right_place});
    names.push_back({left, right});
    for (std::size_t i = first + 1; i <= last; ++i) {
        const Edge e = ends(i);
        const FunnelGate& g = gates.back();
        const bool keeps_left = e.a == left || e.b == left;
        const int kept = keeps_left ? left : right;
        const int fresh = e.a == kept ? e.b : e.a;
        // What lies ahead is on the right hand of right -> left.
        const Vec2 p = place_at(g.right, g.left, distance(fresh, graph_.position(right)),
                                distance(fresh, graph_.position(left)), -1.0);
        (keeps_left ? right : left) = fresh;
        gates.push_back(keeps_left ? FunnelGate{g.left, p} : FunnelGate{p, g.right});
        names.push_back({left, right});
    }
    const FunnelGate& g = gates.back();
    const Vec2 end_place = place_at(g.right, g.left, distance(right, end), distance(left, end), -1.0);
    // A start on an edge has passed it already; to the funnel such a gate is as wide as the plane.
    std::vector<double> shares;
    const double nothing = 1e-9 * graph_.mean_edge_length();
    while (shares.size() < gates.size()) {
        const auto [l, r] = names[shares.size()];
        const double share = closest_share_on_segment(start, graph_.position(l), graph_.position(r));
        if ((graph_.position(l) + share * (graph_.position(r) - graph_.position(l)) - start).norm() > nothing)
            break;
        shares.push_back(share);
    }
    const auto passed = static_cast<std::ptrdiff_t>(shares.size());
    const std::vector<double> rest =
        funnel_shares(Vec2::Zero(), {gates.begin() + passed, gates.end()}, end_place);
    shares.insert(shares.end(), rest.begin(), rest.end());

    std::vector<Step> fresh;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const int bend = shares[i] <= 1e-12 ? names[i][0] : shares[i] >= 1.0 - 1e-12 ? names[i][1] : -1;
        if (bend >= 0) {
            if (fresh.empty() || fresh.back().vertex != bend)
                fresh.push_back({bend, -1, 0.0});
            continue;
        }
        const double share = names[i][0] == ends(first + i).a ? shares[i] : 1.0 - shares[i];
        fresh.push_back({-1, steps_[first + i].edge, share});
    }
    const auto begin = steps_.begin() + static_cast<std::ptrdiff_t>(first);
    steps_.erase(begin, begin + static_cast<std::ptrdiff_t>(last - first + 1));
    steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(first), fresh.begin(), fresh.end());
    return first;
}

void SurfaceStrip::straighten() {
    // Every passing makes the line shorter, so it ends; the cap is for rounding.
    std::size_t left = 50 * (steps_.size() + 20);
    for (std::size_t i = 0; i < steps_.size() && left > 0;) {
        if (steps_[i].vertex < 0 || !pass_vertex(i)) {
            ++i;
            continue;
        }
        --left;
        clean_up();
        i = tighten(std::min(i, steps_.size()));
        clean_up();
        // Back to the vertex before what changed (clean_up takes away little, and rarely).
        i = std::min(i, steps_.size());
        i -= std::min<std::size_t>(i, 3);
        while (i > 0 && steps_[i].vertex < 0)
            --i;
    }
}

GeodesicLine SurfaceStrip::line() const {
    GeodesicLine line;
    line.points.push_back({-1, -1, from_.triangle, 0.0, from_.point});
    for (std::size_t i = 0; i < steps_.size(); ++i)
        line.points.push_back(
            {steps_[i].vertex, steps_[i].edge, shared_triangle(i + 1), steps_[i].share, place(i)});
    line.points.push_back({-1, -1, to_.triangle, 0.0, to_.point});
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
        line.length += (line.points[i + 1].point - line.points[i].point).norm();
    return line;
}

} // namespace fascicle
