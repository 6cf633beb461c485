#include "fascicle/geometry/geodesic_search.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int most_visits = 8; ///< of one vertex: ends the mending of distances on any surface

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

/// Corner c seen from the edge ab: a at 0, b at (length, 0), c at (along, height), height >= 0.
struct EdgeFrame {
    EdgeFrame(const Vec3& a, const Vec3& b, const Vec3& c, double l) : length(l) {
        const Vec3 to_c = c - a;
        along = to_c.dot(b - a) / length;
        height = std::sqrt(std::max(0.0, to_c.squaredNorm() - along * along));
    }
    double length, along, height;
};

/// WaveFront::round; infinity when no source fits or the line to it misses the edge.
double round_update(const EdgeFrame& f, double da, double db) {
    const double x = (da * da - db * db + f.length * f.length) / (2.0 * f.length);
    const double depth2 = da * da - x * x;
    if (depth2 < -1e-9 * f.length * f.length)
        return infinity;
    const double depth = std::sqrt(std::max(0.0, depth2));
    const double span = depth + f.height;
    const double crossing = span > 0.0 ? x + (f.along - x) * depth / span : x;
    if (!(crossing >= 0.0 && crossing <= f.length))
        return infinity;
    return std::hypot(f.along - x, span);
}

/// WaveFront::plane; infinity when the least is at an end of the edge.
double plane_update(const EdgeFrame& f, double da, double db) {
    const double slope = (db - da) / f.length;
    if (!(std::abs(slope) < 1.0))
        return infinity;
    const double rise = std::sqrt(1.0 - slope * slope);
    const double x = f.along - f.height * slope / rise;
    if (!(x >= 0.0 && x <= f.length))
        return infinity;
    return da + slope * f.along + f.height * rise;
}

} // namespace

GeodesicSearch::GeodesicSearch(const SurfaceGraph& graph)
    : graph_(&graph), distance_(z(graph.vertex_count()), 0.0), parent_(z(graph.vertex_count()), -1),
      source_(z(graph.vertex_count()), -1), labelled_(z(graph.vertex_count()), 0),
      settled_(z(graph.vertex_count()), 0), visits_(z(graph.vertex_count()), 0) {}

void GeodesicSearch::begin() {
    heap_.clear();
    reached_.clear();
    if (++run_ == 0) { // numbers used up: start again
        std::fill(labelled_.begin(), labelled_.end(), 0u);
        std::fill(settled_.begin(), settled_.end(), 0u);
        run_ = 1;
    }
    least_gain_ = 1e-4 * graph_->mean_edge_length();
}

void GeodesicSearch::offer(int v, double distance, int from, int source) {
    const std::size_t i = z(v);
    if (labelled_[i] != run_) {
        labelled_[i] = run_;
        visits_[i] = 0;
    } else if (!(distance < distance_[i])) {
        return;
    } else if (settled_[i] == run_ && (distance_[i] - distance < least_gain_ || visits_[i] >= most_visits)) {
        return;
    }
    distance_[i] = distance;
    parent_[i] = from;
    source_[i] = source;
    heap_.push_back({distance, v});
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

void GeodesicSearch::run(std::span<const SurfacePoint> from, const GeodesicLimits& limits, WaveFront front) {
    begin();
    for (std::size_t i = 0; i < from.size(); ++i)
        if (from[i].triangle >= 0 && !has_repeated_index(graph_->triangle(from[i].triangle)))
            for (const int v : graph_->triangle(from[i].triangle))
                offer(v, (graph_->position(v) - from[i].point).norm(), -1, static_cast<int>(i));
    spread(limits, front);
}

void GeodesicSearch::run(std::span<const Seed> from, const GeodesicLimits& limits, WaveFront front) {
    begin();
    for (std::size_t i = 0; i < from.size(); ++i) {
        FASCICLE_ASSERT(from[i].vertex >= 0 && from[i].vertex < graph_->vertex_count());
        FASCICLE_ASSERT(from[i].distance >= 0.0);
        offer(from[i].vertex, from[i].distance, -1, static_cast<int>(i));
    }
    spread(limits, front);
}

void GeodesicSearch::spread(const GeodesicLimits& limits, WaveFront front) {
    Tri goal{-1, -1, -1};
    int missing = 0;
    if (limits.until_triangle >= 0) {
        goal = graph_->triangle(limits.until_triangle);
        missing = 3;
    }
    while (!heap_.empty()) {
        std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
        const Waiting top = heap_.back();
        heap_.pop_back();
        const std::size_t i = z(top.vertex);
        if (top.distance > limits.distance)
            break; // the nearest one: all others are further
        if (top.distance != distance_[i])
            continue; // a shorter way was found meanwhile
        if (settled_[i] != run_) {
            settled_[i] = run_;
            reached_.push_back(top.vertex);
            if (missing > 0 && std::find(goal.begin(), goal.end(), top.vertex) != goal.end() &&
                --missing == 0)
                break;
        }
        ++visits_[i];
        pass_on(top.vertex, limits, front);
    }
}

void GeodesicSearch::pass_on(int v, const GeodesicLimits& limits, WaveFront front) {
    const double dv = distance_[z(v)];
    const int source = source_[z(v)];
    if (front == WaveFront::edges && !limits.passes) {
        const auto neighbours = graph_->topology().vertex_neighbours(v);
        const auto edges = graph_->vertex_edges(v);
        for (std::size_t k = 0; k < neighbours.size(); ++k)
            offer(neighbours[k], dv + graph_->edge_length(edges[k]), v, source);
        return;
    }
    for (const int t : graph_->topology().vertex_triangles(v)) {
        if (limits.passes && !limits.passes(t))
            continue;
        const Tri& tri = graph_->triangle(t);
        const TriEdges& edges = graph_->triangle_edges(t);
        const std::size_t k = tri[0] == v ? 0 : tri[1] == v ? 1 : 2;
        const int b = tri[(k + 1) % 3], c = tri[(k + 2) % 3];
        const double vb = graph_->edge_length(edges[k]), vc = graph_->edge_length(edges[(k + 2) % 3]);
        offer(b, dv + vb, v, source);
        offer(c, dv + vc, v, source);
        if (front == WaveFront::edges)
            continue;
        const auto across = [&](int from, int to, double length) {
            if (settled_[z(from)] != run_ || !(length > 0.0))
                return;
            const EdgeFrame frame(graph_->position(v), graph_->position(from), graph_->position(to), length);
            const bool round = front == WaveFront::round && source_[z(from)] == source;
            const double d = round ? round_update(frame, dv, distance_[z(from)])
                                   : plane_update(frame, dv, distance_[z(from)]);
            if (d < infinity)
                offer(to, d, v, source);
        };
        across(b, c, vb);
        across(c, b, vc);
    }
}

} // namespace fascicle
