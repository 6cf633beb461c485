// Parts a surface at edges with more than two triangles, so that every edge has two and every vertex one fan.
//
// The triangles at such an edge are sorted by their angle around it. In radial order a triangle that walks the edge from a to b
// has the solid before it and the outside behind it (its normal points to growing angles), one that walks it back the other way
// round. Reading the ones as closing and the others as opening brackets, matching brackets enclose a wedge of the solid:
// pairs made so part bodies that touch. Reading them the other way round, pairs enclose a wedge of the outside: the body stays
// in one piece with a thickness of nothing there, which is right for a pinched one. Of the two that is taken, for all edges
// that hang together, with which the vertices fall into fans by themselves (two spheres that touch: solid; a sheet of muscle
// pressed together: outside; where both do, solid). An edge that neither parts gets a vertex in its middle for each pair.
// Odd or unbalanced triangles (walls inside, fins): those of the smallest patches are left over and stay hanging.
#include "fascicle/geometry/mesh_topology.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fascicle::detail {

namespace {

class UnionFind {
public:
    explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int i) {
        while (parent_[at(i)] != i)
            i = parent_[at(i)] = parent_[at(parent_[at(i)])];
        return i;
    }
    void join(int a, int b) {
        a = root(a);
        b = root(b);
        parent_[at(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<int> parent_;
};

enum class Wedge : char { solid, outside };

class SheetParter {
public:
    explicit SheetParter(RepairMesh& m)
        : m_(m), topology_(m.mesh.vertex_count(), m.mesh.triangles), crowded_(topology_.nonmanifold_edges()),
          wedge_(crowded_.size(), Wedge::solid), across_(3 * m.mesh.triangles.size(), -1) {}

    SheetCounts run() {
        SheetCounts counts;
        counts.edges = static_cast<int>(crowded_.size());
        counts.hanging.assign(m_.mesh.triangles.size(), 0);
        for (int e = 0; e < static_cast<int>(topology_.edges().size()); ++e)
            if (const auto row = topology_.edge_half_edges(e); row.size() == 2)
                pair(row[0], row[1]);
        if (!crowded_.empty()) {
            measure_patches();
            face_alike();
            for (const int e : crowded_)
                sorted_.push_back(around(e));
            choose_wedges();
        }
        UnionFind fans = corner_fans();
        counts.vertices = copy_vertices(fans);
        if (!crowded_.empty()) {
            for (std::size_t i = 0; i < crowded_.size(); ++i)
                for (const int h : topology_.edge_half_edges(crowded_[i]))
                    if (across_[at(h)] < 0)
                        counts.hanging[at(h / 3)] = 1;
            counts.middles = split_double_edges(counts.hanging);
        }
        return counts;
    }

private:
    void pair(int a, int b) {
        across_[at(a)] = b;
        across_[at(b)] = a;
    }
    int start(int h) const { return m_.mesh.triangles[at(h / 3)][at(h % 3)]; }
    int end(int h) const { return m_.mesh.triangles[at(h / 3)][at((h + 1) % 3)]; }
    int opposite(int h) const { return m_.mesh.triangles[at(h / 3)][at((h + 2) % 3)]; }
    const Vec3& place(int v) const { return m_.mesh.positions[at(v)]; }

    /// Area of the patch of each triangle: patches end at crowded edges.
    void measure_patches() {
        const std::size_t n = m_.mesh.triangles.size();
        UnionFind patches(n);
        for (int h = 0; h < static_cast<int>(3 * n); ++h)
            if (across_[at(h)] > h)
                patches.join(h / 3, across_[at(h)] / 3);
        std::vector<double> area(n, 0);
        for (std::size_t t = 0; t < n; ++t) {
            const int h = static_cast<int>(3 * t);
            area[at(patches.root(static_cast<int>(t)))] +=
                (place(end(h)) - place(start(h))).cross(place(opposite(h)) - place(start(h))).norm() / 2;
        }
        patch_area_.resize(n);
        patch_.resize(n);
        for (std::size_t t = 0; t < n; ++t) {
            patch_[t] = patches.root(static_cast<int>(t));
            patch_area_[t] = area[at(patch_[t])];
        }
    }

    bool forward(int h, const Edge& edge) const {
        return (start(h) == edge.a) != (turned_[at(patch_[at(h / 3)])] != 0);
    }

    /// Patches that face against their neighbours count as turned: the largest first, each that leaves the crowded edges more
    /// balanced when turned, until none does.
    void face_alike() {
        const std::size_t n = m_.mesh.triangles.size();
        turned_.assign(n, 0);
        struct Share {
            int patch, edge, walks;
        };
        std::vector<Share> shares;
        std::vector<int> net(crowded_.size(), 0);
        for (std::size_t i = 0; i < crowded_.size(); ++i)
            for (const int h : topology_.edge_half_edges(crowded_[i])) {
                const int walk = forward(h, topology_.edges()[at(crowded_[i])]) ? 1 : -1;
                shares.push_back({patch_[at(h / 3)], static_cast<int>(i), walk});
                net[i] += walk;
            }
        if (std::all_of(net.begin(), net.end(), [](int w) { return w == 0; }))
            return;
        std::stable_sort(shares.begin(), shares.end(), [&](const Share& a, const Share& b) {
            const double x = patch_area_[at(a.patch)], y = patch_area_[at(b.patch)];
            return x != y ? x > y : a.patch != b.patch ? a.patch < b.patch : a.edge < b.edge;
        });
        constexpr int most_rounds = 20;
        bool changed = true;
        for (int round = 0; changed && round < most_rounds; ++round) {
            changed = false;
            for (std::size_t i = 0; i < shares.size();) {
                std::size_t j = i;
                int gain = 0;
                while (j < shares.size() && shares[j].patch == shares[i].patch) {
                    int walks = 0; // of the patch along this edge
                    const int e = shares[j].edge;
                    for (; j < shares.size() && shares[j].patch == shares[i].patch && shares[j].edge == e;
                         ++j)
                        walks += shares[j].walks;
                    gain += std::abs(net[at(e)]) - std::abs(net[at(e)] - 2 * walks);
                }
                if (gain > 0) {
                    changed = true;
                    turned_[at(shares[i].patch)] = turned_[at(shares[i].patch)] ? 0 : 1;
                    for (std::size_t k = i; k < j; ++k) {
                        net[at(shares[k].edge)] -= 2 * shares[k].walks;
                        shares[k].walks = -shares[k].walks;
                    }
                }
                i = j;
            }
        }
    }

    struct Spoke {
        double angle;
        int h;
        bool forward; ///< walks the edge from its lower vertex
    };

    /// The half-edges of an edge by angle; an odd one, and those beyond the balance, taken out: the smallest patches first.
    std::vector<Spoke> around(int e) {
        const Edge edge = topology_.edges()[at(e)];
        const Vec3 axis = (place(edge.b) - place(edge.a)).normalized();
        const Vec3 u = axis.unitOrthogonal(), w = axis.cross(u);
        std::vector<Spoke> spokes;
        int balance = 0;
        for (const int h : topology_.edge_half_edges(e)) {
            const Vec3 d = place(opposite(h)) - place(edge.a);
            spokes.push_back({std::atan2(d.dot(w), d.dot(u)), h, forward(h, edge)});
            balance += spokes.back().forward ? 1 : -1;
        }
        while (balance != 0 &&
               (spokes.size() % 2 == 1 || std::abs(balance) < static_cast<int>(spokes.size()))) {
            // With an odd number any may be the surplus; else only of those that are too many.
            const bool any = spokes.size() % 2 == 1;
            const auto surplus = [&](const Spoke& s) { return any || s.forward == (balance > 0); };
            auto least = spokes.end();
            for (auto it = spokes.begin(); it != spokes.end(); ++it)
                if (surplus(*it) && (least == spokes.end() || rank(it->h) < rank(least->h)))
                    least = it;
            balance -= least->forward ? 1 : -1;
            spokes.erase(least);
            if (any && balance != 0)
                break; // even now: patches that face against each other are paired by angle
        }
        std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
            return a.angle != b.angle ? a.angle < b.angle : a.h < b.h;
        });
        return spokes;
    }
    std::pair<double, int> rank(int h) const { return {patch_area_[at(h / 3)], -h}; }

    void pair_edge(std::size_t i) {
        const std::vector<Spoke>& spokes = sorted_[i];
        const auto n = spokes.size();
        for (const int h : topology_.edge_half_edges(crowded_[i]))
            across_[at(h)] = -1;
        int balance = 0;
        for (const Spoke& s : spokes)
            balance += s.forward ? 1 : -1;
        if (balance != 0) { // neighbours in angle, from the first or from the second on
            const std::size_t from = wedge_[i] == Wedge::solid ? 0 : 1;
            for (std::size_t k = 0; k + 1 < n; k += 2)
                pair(spokes[(k + from) % n].h, spokes[(k + 1 + from) % n].h);
            return;
        }
        const bool opens = wedge_[i] == Wedge::outside; // a forward one opens a wedge of the outside
        std::vector<std::size_t> waiting;
        std::vector<char> done(n, 0);
        for (std::size_t k = 0; k < 2 * n; ++k) {
            const Spoke& s = spokes[k % n];
            if (s.forward == opens) {
                if (k < n)
                    waiting.push_back(k);
            } else if (!done[k % n] && !waiting.empty()) {
                pair(s.h, spokes[waiting.back()].h);
                done[k % n] = 1;
                waiting.pop_back();
            }
        }
    }

    int corner(int t, int v) const {
        const Tri& tri = m_.mesh.triangles[at(t)];
        return 3 * t + (tri[0] == v ? 0 : tri[1] == v ? 1 : 2);
    }

    /// Corners of triangles that hang together across paired edges are one vertex.
    UnionFind corner_fans() const {
        UnionFind fans(across_.size());
        for (int h = 0; h < static_cast<int>(across_.size()); ++h) {
            const int o = across_[at(h)];
            if (o < h)
                continue;
            for (const int v : {start(h), end(h)})
                fans.join(corner(h / 3, v), corner(o / 3, v));
        }
        return fans;
    }

    /// By crowded edge: whether two of its pairs have the same vertices at both ends.
    std::vector<char> double_edges(UnionFind& fans) const {
        std::vector<char> twice(crowded_.size(), 0);
        for (std::size_t i = 0; i < crowded_.size(); ++i) {
            const Edge edge = topology_.edges()[at(crowded_[i])];
            std::vector<std::pair<int, int>> ends;
            for (const int h : topology_.edge_half_edges(crowded_[i]))
                if (across_[at(h)] < h) // once a pair, and those left over
                    ends.emplace_back(fans.root(corner(h / 3, edge.a)), fans.root(corner(h / 3, edge.b)));
            std::sort(ends.begin(), ends.end());
            twice[i] = std::adjacent_find(ends.begin(), ends.end()) != ends.end();
        }
        return twice;
    }

    void choose_wedges() {
        const auto pair_all = [&] {
            for (std::size_t i = 0; i < crowded_.size(); ++i)
                pair_edge(i);
        };
        UnionFind groups(m_.mesh.positions.size()); // of crowded edges, by their vertices
        for (const int e : crowded_)
            groups.join(topology_.edges()[at(e)].a, topology_.edges()[at(e)].b);
        const auto count = [&](const std::vector<char>& twice) {
            std::vector<int> of(m_.mesh.positions.size(), 0);
            for (std::size_t i = 0; i < crowded_.size(); ++i)
                of[at(groups.root(topology_.edges()[at(crowded_[i])].a))] += twice[i];
            return of;
        };
        pair_all();
        UnionFind fans = corner_fans();
        const std::vector<int> solid = count(double_edges(fans));
        if (std::all_of(solid.begin(), solid.end(), [](int n) { return n == 0; }))
            return;
        const auto group_of = [&](std::size_t i) {
            return at(groups.root(topology_.edges()[at(crowded_[i])].a));
        };
        for (std::size_t i = 0; i < crowded_.size(); ++i)
            if (solid[group_of(i)] > 0)
                wedge_[i] = Wedge::outside;
        pair_all();
        fans = corner_fans();
        const std::vector<int> outside = count(double_edges(fans));
        for (std::size_t i = 0; i < crowded_.size(); ++i)
            if (outside[group_of(i)] >= solid[group_of(i)])
                wedge_[i] = Wedge::solid;
        pair_all();
    }

    /// The first fan of a vertex keeps it, the others get copies.
    int copy_vertices(UnionFind& fans) {
        std::vector<int> vertex_of(across_.size(), -1); // by root corner
        std::vector<char> taken(m_.mesh.positions.size(), 0);
        int copies = 0;
        for (std::size_t c = 0; c < across_.size(); ++c) {
            int& v = m_.mesh.triangles[c / 3][c % 3];
            int& mine = vertex_of[at(fans.root(static_cast<int>(c)))];
            if (mine < 0) {
                mine = v;
                if (taken[at(v)]) {
                    mine = m_.copy_vertex(v);
                    ++copies;
                } else {
                    taken[at(v)] = 1;
                }
            }
            v = mine;
        }
        return copies;
    }

    /// A vertex in the middle of every side whose edge is still crowded, one per pair.
    int split_double_edges(std::vector<char>& hanging) {
        const MeshTopology now(m_.mesh.vertex_count(), m_.mesh.triangles);
        std::vector<int> middle(across_.size(), -1);
        int added = 0;
        for (const int e : now.nonmanifold_edges()) {
            const Edge edge = now.edges()[at(e)];
            for (const int h : now.edge_half_edges(e)) {
                if (middle[at(h)] >= 0)
                    continue;
                middle[at(h)] =
                    m_.add_vertex(0.5 * (place(edge.a) + place(edge.b)),
                                  mean_origin({m_.origins[at(edge.a)], m_.origins[at(edge.b)]}, {1, 1}));
                ++added;
                if (across_[at(h)] >= 0)
                    middle[at(across_[at(h)])] = middle[at(h)];
            }
        }
        if (added == 0)
            return 0;
        std::vector<Tri> triangles;
        std::vector<char> marks;
        for (std::size_t t = 0; t < m_.mesh.triangles.size(); ++t) {
            const auto before = triangles.size();
            cut(m_.mesh.triangles[t], {middle[3 * t], middle[3 * t + 1], middle[3 * t + 2]}, triangles);
            marks.insert(marks.end(), triangles.size() - before, hanging[t]);
        }
        m_.mesh.triangles = std::move(triangles);
        hanging = std::move(marks);
        return added;
    }

    /// middles: of the sides 0-1, 1-2, 2-0; -1: not cut.
    static void cut(const Tri& t, const std::array<int, 3>& middles, std::vector<Tri>& out) {
        // Corners and middles in order; ears are cut off at the corners between two middles, the rest is a fan.
        std::vector<int> ring;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool ear = middles[(k + 2) % 3] >= 0 && middles[k] >= 0;
            if (ear)
                out.push_back({middles[(k + 2) % 3], t[k], middles[k]});
            else
                ring.push_back(t[k]);
            if (middles[k] >= 0)
                ring.push_back(middles[k]);
        }
        // From a middle, so that no triangle of the fan has all corners on one side.
        const auto start = std::find_if(ring.begin(), ring.end(), [&](int v) {
            return std::find(middles.begin(), middles.end(), v) != middles.end();
        });
        if (start != ring.end())
            std::rotate(ring.begin(), start, ring.end());
        for (std::size_t k = 1; k + 1 < ring.size(); ++k)
            out.push_back({ring[0], ring[k], ring[k + 1]});
    }

    RepairMesh& m_;
    MeshTopology topology_; ///< of the triangles as they came
    const std::vector<int>& crowded_;
    std::vector<Wedge> wedge_;               ///< by crowded edge
    std::vector<std::vector<Spoke>> sorted_; ///< by crowded edge
    std::vector<int> across_;                ///< half-edge -> its partner
    std::vector<double> patch_area_;
    std::vector<int> patch_;   ///< by triangle: its first triangle
    std::vector<char> turned_; ///< by patch
};

} // namespace

SheetCounts part_sheets(RepairMesh& m) {
    return SheetParter(m).run();
}

} // namespace fascicle::detail
