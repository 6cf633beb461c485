#include "solver/rivals/mass_spring/springs.hpp"

#include "solver/rivals/mass_spring/point_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace fascicle::mass_spring {

namespace {

using Pair = std::pair<int, int>;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// Directions of a cubic lattice's neighbours, not normalised.
std::vector<Vec3> lattice_directions(const Mat3& axes, bool diagonals) {
    std::vector<Vec3> directions;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const int moved = std::abs(x) + std::abs(y) + std::abs(z);
                if (moved == 1 || (diagonals && moved > 1))
                    directions.push_back(axes * Vec3(x, y, z));
            }
    return directions;
}

class Joiner {
public:
    Joiner(const ParticleSet& particles, const SolidQuery& solid) : particles_(particles), solid_(solid) {}

    /// Whether the spring between two particles stays in the solid, near enough.
    bool inside(int a, int b) {
        constexpr double beyond = 0.15;
        if (particles_.vertex[at(a)] < 0 && particles_.vertex[at(b)] < 0)
            return true; // deeper than half the spacing, both
        const Vec3 &p = particles_.rest[at(a)], &q = particles_.rest[at(b)];
        const double length = (q - p).norm();
        return solid_.signed_distance(0.5 * (p + q), length, hint_) <= beyond * length;
    }

    void join(int a, int b) { pairs_.emplace_back(std::min(a, b), std::max(a, b)); }
    const std::vector<Pair>& pairs() {
        std::sort(pairs_.begin(), pairs_.end());
        pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
        return pairs_;
    }

private:
    const ParticleSet& particles_;
    const SolidQuery& solid_;
    int hint_ = -1;
    std::vector<Pair> pairs_;
};

/// Springs of one particle; near: the others, nearest first, distances in spacings.
void join_by_direction(int i, const ParticleSet& particles, const std::vector<NearPoint>& near,
                       const std::vector<Vec3>& directions, Joiner& joiner, std::vector<int>& joined) {
    constexpr double reach = 1.5;
    std::vector<char> taken(directions.size(), 0);
    for (const NearPoint& other : near) {
        const Vec3 d = particles.rest[at(other.point)] - particles.rest[at(i)];
        const double noise = 1e-12 * d.norm();
        std::size_t best = 0;
        double best_along = -std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < directions.size(); ++k) {
            const double along = d.dot(directions[k]) / directions[k].norm();
            if (along > best_along + noise) {
                best_along = along;
                best = k;
            }
        }
        const double length = reach * directions[best].norm();
        if (taken[best] != 0 || other.squared_distance > length * length || !joiner.inside(i, other.point))
            continue;
        taken[best] = 1;
        joined.push_back(other.point);
    }
}

/// Many in a lattice are equally near but for rounding: those by number, or the unit of length would choose.
void settle_ties(std::vector<NearPoint>& near, double spacing) {
    for (NearPoint& n : near)
        n.squared_distance = std::round(1e6 * n.squared_distance / (spacing * spacing)) * 1e-6;
    std::sort(near.begin(), near.end());
}

/// The nearest ones in the solid, and all that are as near as the last of them.
void join_nearest(int i, std::size_t count, const std::vector<NearPoint>& near, Joiner& joiner,
                  std::vector<int>& joined) {
    double last = std::numeric_limits<double>::infinity();
    for (const NearPoint& other : near) {
        if (other.squared_distance > last)
            break;
        if (!joiner.inside(i, other.point))
            continue;
        joined.push_back(other.point);
        if (joined.size() == count)
            last = other.squared_distance;
    }
}

/// Numbers of connected parts, by particle.
std::vector<int> parts_of(std::size_t count, const std::vector<Pair>& pairs) {
    std::vector<int> root(count);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int i) {
        while (root[at(i)] != i)
            i = root[at(i)] = root[at(root[at(i)])];
        return i;
    };
    for (const Pair& pair : pairs) {
        const int a = find(pair.first), b = find(pair.second);
        root[at(std::max(a, b))] = std::min(a, b);
    }
    for (std::size_t i = 0; i < count; ++i)
        root[i] = find(static_cast<int>(i));
    return root;
}

/// The shortest pair of boundary particles of one surface component that are in different parts; first < 0 when there is none.
Pair missing_link(const ParticleSet& particles, const MeshTopology& topology, const std::vector<int>& part) {
    std::map<int, int> first_part; // by component
    std::map<int, bool> torn;
    for (std::size_t i = 0; i < particles.size() && particles.vertex[i] >= 0; ++i) {
        const int component = topology.vertex_component(particles.vertex[i]);
        const int known = first_part.try_emplace(component, part[i]).first->second;
        if (known != part[i])
            torn[component] = true;
    }
    Pair best(-1, -1);
    double best_length = std::numeric_limits<double>::infinity();
    for (const auto& [component, yes] : torn)
        for (std::size_t i = 0; i < particles.size() && particles.vertex[i] >= 0; ++i) {
            if (topology.vertex_component(particles.vertex[i]) != component ||
                part[i] != first_part[component])
                continue;
            for (std::size_t j = 0; j < particles.size() && particles.vertex[j] >= 0; ++j) {
                if (part[j] == part[i] || topology.vertex_component(particles.vertex[j]) != component)
                    continue;
                const double length = (particles.rest[i] - particles.rest[j]).squaredNorm();
                if (length < best_length) {
                    best_length = length;
                    best = {static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j))};
                }
            }
        }
    return best;
}

} // namespace

std::vector<Spring> make_springs(const ParticleSet& particles, SpringLayout layout, const SolidQuery& solid,
                                 const MeshTopology& topology) {
    constexpr std::size_t nearest = 15, least = 6;
    constexpr std::size_t looked_at = 80; // of the nearest; the 26 sectors lie within them
    std::vector<Spring> springs;
    if (!(particles.spacing > 0.0) || particles.size() < 2)
        return springs;
    const auto directions = lattice_directions(particles.axes, layout == SpringLayout::lattice26);
    PointCells cells(1.5 * particles.spacing);
    for (const Vec3& p : particles.rest)
        cells.add(p);
    Joiner joiner(particles, solid);
    std::vector<NearPoint> near;
    std::vector<int> joined;
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const int i = static_cast<int>(k);
        cells.nearest(particles.rest[k], looked_at + 1, near);
        near.erase(std::remove_if(near.begin(), near.end(), [&](const NearPoint& n) { return n.point == i; }),
                   near.end());
        settle_ties(near, particles.spacing);
        joined.clear();
        if (layout == SpringLayout::nearest15)
            join_nearest(i, nearest, near, joiner, joined);
        else
            join_by_direction(i, particles, near, directions, joiner, joined);
        for (const bool anywhere : {false, true}) // what leaves the solid only when nothing else is there
            for (std::size_t n = 0; n < near.size() && joined.size() < (anywhere ? 3 : least); ++n)
                if (std::find(joined.begin(), joined.end(), near[n].point) == joined.end() &&
                    (anywhere || joiner.inside(i, near[n].point)))
                    joined.push_back(near[n].point);
        for (const int j : joined)
            joiner.join(i, j);
    }
    for (;;) {
        const Pair link = missing_link(particles, topology, parts_of(particles.size(), joiner.pairs()));
        if (link.first < 0)
            break;
        joiner.join(link.first, link.second);
    }
    for (const Pair& pair : joiner.pairs()) {
        const double length = (particles.rest[at(pair.first)] - particles.rest[at(pair.second)]).norm();
        if (length > 0.0)
            springs.push_back({pair.first, pair.second, length});
    }
    return springs;
}

} // namespace fascicle::mass_spring
