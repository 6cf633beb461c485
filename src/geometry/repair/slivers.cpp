// Triangles without area: needles, whose short edge collapses, and caps, whose long edge flips.
#include "geometry/remesh_topology.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fascicle::detail {

namespace {

class SliverRemover {
public:
    SliverRemover(RepairMesh& m, double shortest)
        : m_(m), topology_(m.mesh), shortest_(shortest), into_(m.mesh.positions.size()) {
        std::iota(into_.begin(), into_.end(), 0);
    }

    SliverCounts run() {
        SliverCounts counts;
        counts.found = count_bad();
        if (counts.found == 0)
            return counts;
        constexpr int most_passes = 10;
        for (int pass = 0; pass < most_passes; ++pass) {
            const int before = counts.collapsed + counts.flipped;
            for (int h = 0; h < topology_.half_edges(); ++h)
                if (topology_.is_alive(h) && h < topology_.twin(h) && topology_.length(h) <= shortest_)
                    counts.collapsed += collapse_either(h) ? 1 : 0;
            for (int t = 0; 3 * t < topology_.half_edges(); ++t) {
                if (!topology_.is_alive(3 * t) || !flat(3 * t))
                    continue;
                if (flip_longest(t))
                    ++counts.flipped;
                else
                    counts.collapsed += collapse_shortest(t) ? 1 : 0;
            }
            if (counts.collapsed + counts.flipped == before)
                break;
        }
        counts.left = count_bad();
        keep();
        return counts;
    }

private:
    Vec3 normal(int h, int moved = -1, const Vec3& to = Vec3::Zero()) const {
        const auto place = [&](int v) -> const Vec3& { return v == moved ? to : topology_.position(v); };
        const Vec3& a = place(topology_.start(h));
        return (place(topology_.end(h)) - a).cross(place(topology_.opposite(h)) - a);
    }
    static bool flat(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double l2 = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        return (b - a).cross(c - a).squaredNorm() <= 1e-12 * l2 * l2; // as mesh_check counts them
    }
    bool flat(int h) const {
        return flat(topology_.position(topology_.start(h)), topology_.position(topology_.end(h)),
                    topology_.position(topology_.opposite(h)));
    }

    int count_bad() const {
        int count = 0;
        for (int h = 0; h < topology_.half_edges(); ++h)
            if (topology_.is_alive(h))
                count +=
                    (h < topology_.twin(h) && topology_.length(h) <= shortest_) || (h % 3 == 0 && flat(h))
                        ? 1
                        : 0;
        return count;
    }

    /// Whether the start of h may go to its end: no triangle with an area turns over or loses it.
    bool folds(int h) const {
        const int v = topology_.start(h), gone = h / 3, gone_too = topology_.twin(h) / 3;
        const Vec3& to = topology_.position(topology_.end(h));
        bool bad = false;
        topology_.for_edges_from(v, [&](int e) {
            if (e / 3 == gone || e / 3 == gone_too || flat(e))
                return;
            bad = bad || !(normal(e).dot(normal(e, v, to)) > 0) ||
                  flat(to, topology_.position(topology_.end(e)), topology_.position(topology_.opposite(e)));
        });
        return bad;
    }
    bool collapse(int h) {
        // Each collapse takes as long as the fan of the vertex that goes: the hub of a large wheel stays, its rim goes into it.
        constexpr int largest_fan = 1000;
        if (topology_.has_more_edges(topology_.start(h), largest_fan) || !topology_.may_collapse(h) ||
            folds(h))
            return false;
        into_[at(topology_.start(h))] = topology_.end(h);
        topology_.collapse(h, topology_.position(topology_.end(h)));
        return true;
    }
    bool collapse_either(int h) {
        const int a = topology_.start(h), b = topology_.end(h); // the higher number goes first
        return a > b ? collapse(h) || collapse(topology_.twin(h))
                     : collapse(topology_.twin(h)) || collapse(h);
    }
    bool collapse_shortest(int t) {
        std::array<int, 3> sides{3 * t, 3 * t + 1, 3 * t + 2};
        std::sort(sides.begin(), sides.end(), [&](int a, int b) {
            const double x = topology_.length(a), y = topology_.length(b);
            return x != y ? x < y : a < b;
        });
        return collapse_either(sides[0]);
    }

    /// The apex lies on the longest side: the other diagonal leaves the shape as it is. Only when both new triangles have an
    /// area and face as the neighbour does, so that every flip leaves fewer of them.
    bool flip_longest(int t) {
        int h = 3 * t;
        for (int k = 1; k < 3; ++k)
            if (topology_.length(3 * t + k) > topology_.length(h))
                h = 3 * t + k;
        if (!topology_.may_flip(h))
            return false;
        const int o = topology_.twin(h);
        const Vec3 &a = topology_.position(topology_.start(h)), &b = topology_.position(topology_.end(h)),
                   &c = topology_.position(topology_.opposite(h)),
                   &d = topology_.position(topology_.opposite(o));
        if (flat(d, c, a) || flat(c, d, b))
            return false;
        const Vec3 before = normal(o), first = (c - d).cross(a - d), second = (d - c).cross(b - c);
        if (!flat(o) && (first.dot(before) <= 0 || second.dot(before) <= 0))
            return false;
        if (first.dot(second) <= 0)
            return false;
        topology_.flip(h);
        return true;
    }

    void keep() {
        std::vector<VertexOrigin> origins;
        std::vector<int> number(into_.size(), -1);
        for (int v = 0; v < topology_.vertices(); ++v)
            if (topology_.is_vertex_alive(v)) {
                number[at(v)] = static_cast<int>(origins.size());
                origins.push_back(m_.origins[at(v)]);
            }
        std::vector<int> became(into_.size());
        for (std::size_t v = 0; v < into_.size(); ++v) {
            int end = static_cast<int>(v);
            while (into_[at(end)] != end)
                end = into_[at(end)] = into_[at(into_[at(end)])];
            became[v] = number[at(end)];
        }
        m_.follow(became);
        m_.origins = std::move(origins);
        m_.mesh = topology_.compact();
    }

    RepairMesh& m_;
    RemeshTopology topology_;
    double shortest_;
    std::vector<int> into_; ///< by vertex: which one it collapsed into
};

} // namespace

SliverCounts remove_slivers(RepairMesh& m, double shortest) {
    drop_unused_vertices(m);
    return SliverRemover(m, shortest).run();
}

} // namespace fascicle::detail
