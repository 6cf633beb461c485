#include "fascicle/geometry/fill_holes.hpp"

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/volume.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>

namespace fascicle {

namespace {

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

constexpr double never = std::numeric_limits<double>::infinity();

/// Rings of border edges, each walked so that triangles inside of it go the same way round. Vertices with more than one
/// way on are in no ring; `broken` counts the chains that end there.
std::vector<std::vector<int>> border_rings(const TriMesh& mesh, const MeshTopology& topology, int& broken) {
    std::vector<int> next(mesh.positions.size(), -1), entering(mesh.positions.size(), 0);
    std::vector<char> bad(mesh.positions.size(), 0);
    for (const int e : topology.boundary_edges()) {
        const int h = topology.edge_half_edges(e)[0];
        const Tri& t = mesh.triangles[z(h / 3)];
        const int to = t[z(h % 3)], from = t[z((h + 1) % 3)]; // against the triangle that is there
        if (next[z(from)] >= 0)
            bad[z(from)] = 1;
        if (entering[z(to)]++ > 0)
            bad[z(to)] = 1;
        next[z(from)] = to;
    }
    std::vector<std::vector<int>> rings;
    std::vector<char> seen(mesh.positions.size(), 0);
    for (int start = 0; start < mesh.vertex_count(); ++start) {
        if (next[z(start)] < 0 || seen[z(start)])
            continue;
        std::vector<int> ring;
        bool whole = true;
        int v = start;
        while (v >= 0 && !seen[z(v)]) {
            seen[z(v)] = 1;
            whole = whole && !bad[z(v)];
            ring.push_back(v);
            v = next[z(v)];
        }
        if (whole && v == start)
            rings.push_back(std::move(ring));
        else
            ++broken;
    }
    return rings;
}

class RingFiller {
public:
    RingFiller(const TriMesh& mesh, const std::vector<int>& ring, const std::set<std::pair<int, int>>& edges)
        : ring_(ring), n_(static_cast<int>(ring.size())), cost_(z(n_ * n_), 0), split_(z(n_ * n_), -1) {
        for (int length = 2; length < n_; ++length)
            for (int i = 0; i + length < n_; ++i)
                find(mesh, edges, i, i + length);
    }
    bool possible() const { return n_ >= 3 && cost_[z(n_ - 1)] < never; }
    void triangles(std::vector<Tri>& out) const { collect(0, n_ - 1, out); }

private:
    std::size_t at(int i, int j) const { return z(i * n_ + j); }

    void find(const TriMesh& mesh, const std::set<std::pair<int, int>>& edges, int i, int j) {
        double best = never;
        const bool border = i == 0 && j == n_ - 1;
        if (border || edges.count(std::minmax(ring_[z(i)], ring_[z(j)])) == 0)
            for (int k = i + 1; k < j; ++k) {
                const double c = cost_[at(i, k)] + cost_[at(k, j)] + weight(mesh, i, k, j);
                if (c < best) {
                    best = c;
                    split_[at(i, j)] = k;
                }
            }
        cost_[at(i, j)] = best;
    }

    double weight(const TriMesh& mesh, int i, int k, int j) const {
        const Vec3 &a = mesh.positions[z(ring_[z(i)])], &b = mesh.positions[z(ring_[z(k)])],
                   &c = mesh.positions[z(ring_[z(j)])];
        return 0.5 * (b - a).cross(c - a).norm() +
               0.001 * ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
    }

    void collect(int i, int j, std::vector<Tri>& out) const {
        if (j - i < 2)
            return;
        const int k = split_[at(i, j)];
        out.push_back({ring_[z(i)], ring_[z(k)], ring_[z(j)]});
        collect(i, k, out);
        collect(k, j, out);
    }

    const std::vector<int>& ring_;
    int n_;
    std::vector<double> cost_; ///< of the part of the ring from i to j, closed by the edge between them
    std::vector<int> split_;
};

} // namespace

HoleFilling fill_holes(const TriMesh& mesh, int max_edges,
                       const std::function<bool(const std::vector<int>& ring)>& wanted) {
    HoleFilling result{mesh};
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::set<std::pair<int, int>> edges;
    for (const Edge& edge : topology.edges())
        edges.insert({edge.a, edge.b});
    std::vector<Tri> added;
    for (const std::vector<int>& ring : border_rings(mesh, topology, result.left)) {
        const bool short_enough =
            ring.size() >= 3 && static_cast<int>(ring.size()) <= max_edges && (!wanted || wanted(ring));
        const std::size_t before = added.size();
        if (short_enough)
            if (const RingFiller filler(mesh, ring, edges); filler.possible())
                filler.triangles(added);
        if (added.size() == before) {
            ++result.left;
            continue;
        }
        ++result.filled;
        for (std::size_t t = before; t < added.size(); ++t) // the next ring must not use them again
            for (int c = 0; c < 3; ++c)
                edges.insert(std::minmax(added[t][z(c)], added[t][z((c + 1) % 3)]));
    }
    result.triangles = static_cast<int>(added.size());
    result.added_area = surface_area(mesh.positions, added);
    result.mesh.triangles.insert(result.mesh.triangles.end(), added.begin(), added.end());
    result.surface_area = surface_area(result.mesh.positions, result.mesh.triangles);
    return result;
}

} // namespace fascicle
