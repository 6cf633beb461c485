#include "fascicle/geometry/region_border.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle {
namespace {

/// A piece of border through one triangle, or along an open border. Nodes: edge number, or edge count + vertex.
struct Piece {
    int from, to;
    friend bool operator<(const Piece& x, const Piece& y) {
        return x.from != y.from ? x.from < y.from : x.to < y.to;
    }
};

class BorderWalk {
public:
    BorderWalk(const SurfaceGraph& graph, const SurfaceRegion& region) : graph_(graph), region_(region) {
        std::vector<int> triangles;
        region.for_each([&](int v) {
            if (!at_border(v))
                return;
            for (const int t : graph.topology().vertex_triangles(v))
                triangles.push_back(t);
        });
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        for (const int t : triangles)
            add_triangle(t);
        std::sort(pieces_.begin(), pieces_.end());
        used_.assign(pieces_.size(), 0);
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            by_end_.push_back({pieces_[i].to, static_cast<int>(i)});
        std::sort(by_end_.begin(), by_end_.end());
    }

    std::vector<BorderLoop> loops() {
        std::vector<BorderLoop> result;
        for (std::size_t i = 0; i < pieces_.size(); ++i) {
            if (used_[i] != 0)
                continue;
            BorderLoop loop;
            const int start = pieces_[i].from;
            loop.points.push_back(point(start));
            used_[i] = 1;
            int at = pieces_[i].to;
            while (at != start) {
                loop.points.push_back(point(at));
                const int next = take_from(at);
                if (next < 0)
                    break;
                at = next;
            }
            loop.closed = at == start;
            result.push_back(std::move(loop));
        }
        return result;
    }

private:
    /// Whether a piece may run beside a vertex of the region.
    bool at_border(int v) const {
        for (const int n : graph_.topology().vertex_neighbours(v))
            if (!region_.contains(n))
                return true;
        for (const int e : graph_.vertex_edges(v))
            if (graph_.topology().edge_half_edges(e).size() == 1)
                return true;
        return false;
    }

    int edge_count() const { return static_cast<int>(graph_.topology().edges().size()); }

    void add_triangle(int t) {
        const Tri& tri = graph_.triangle(t);
        const TriEdges& edges = graph_.triangle_edges(t);
        int inside = 0;
        for (const int v : tri)
            inside += region_.contains(v) ? 1 : 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = tri[k], b = tri[(k + 1) % 3];
            const bool a_in = region_.contains(a), b_in = region_.contains(b);
            // The corner that is alone: round it, so that what is inside lies on the left.
            if (inside == 1 && a_in)
                pieces_.push_back({edges[k], edges[(k + 2) % 3]});
            if (inside == 2 && !a_in)
                pieces_.push_back({edges[(k + 2) % 3], edges[k]});
            if ((a_in || b_in) && graph_.topology().edge_half_edges(edges[k]).size() == 1)
                pieces_.push_back({a_in ? edge_count() + a : edges[k], b_in ? edge_count() + b : edges[k]});
        }
    }

    BorderPoint point(int node) const {
        if (node >= edge_count())
            return {node - edge_count(), -1};
        const Edge& edge = graph_.topology().edges()[static_cast<std::size_t>(node)];
        return region_.contains(edge.a) ? BorderPoint{edge.a, edge.b} : BorderPoint{edge.b, edge.a};
    }

    /// Takes an unused piece at the node and returns its other end: one that begins there, else (where the surface is not
    /// oriented) one that ends there, else -1.
    int take_from(int node) {
        for (auto it = std::lower_bound(pieces_.begin(), pieces_.end(), Piece{node, -1});
             it != pieces_.end() && it->from == node; ++it)
            if (char& used = used_[static_cast<std::size_t>(it - pieces_.begin())]; used == 0) {
                used = 1;
                return it->to;
            }
        for (auto it = std::lower_bound(by_end_.begin(), by_end_.end(), std::pair{node, -1});
             it != by_end_.end() && it->first == node; ++it)
            if (char& used = used_[static_cast<std::size_t>(it->second)]; used == 0) {
                used = 1;
                return pieces_[static_cast<std::size_t>(it->second)].from;
            }
        return -1;
    }

    const SurfaceGraph& graph_;
    const SurfaceRegion& region_;
    std::vector<Piece> pieces_;
    std::vector<char> used_;
    std::vector<std::pair<int, int>> by_end_; ///< end node, piece
};

} // namespace

std::vector<BorderLoop> region_border(const SurfaceGraph& graph, const SurfaceRegion& region) {
    FASCICLE_ASSERT(region.vertex_count() == graph.vertex_count());
    return BorderWalk(graph, region).loops();
}

Points border_positions(const SurfaceGraph& graph, const BorderLoop& loop) {
    Points points;
    points.reserve(loop.points.size());
    for (const BorderPoint& p : loop.points)
        points.push_back(p.outside < 0 ? graph.position(p.inside)
                                       : Vec3(0.5 * (graph.position(p.inside) + graph.position(p.outside))));
    return points;
}

double border_length(const SurfaceGraph& graph, const BorderLoop& loop) {
    const Points points = border_positions(graph, loop);
    double length = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        length += (points[i + 1] - points[i]).norm();
    if (loop.closed && !points.empty())
        length += (points.front() - points.back()).norm();
    return length;
}

} // namespace fascicle
