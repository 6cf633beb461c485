#include "solver/coarse/cluster_seeds.hpp"

#include "solver/coarse/cluster_basis.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace fascicle::solver {

namespace {

constexpr double far_away = std::numeric_limits<double>::max();

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

template <class Item>
using MinQueue = std::priority_queue<Item, std::vector<Item>, std::greater<>>;

/// Lowers `distance` to the distance along edges from the sources, where that is less. What is near enough to an
/// older source is not visited: a run of these costs little more than one search.
void lower_distances(const Points& rest, const MeshTopology& topology, const std::vector<int>& sources,
                     std::vector<double>& distance) {
    MinQueue<std::pair<double, int>> queue;
    for (const int s : sources) {
        distance[at(s)] = 0;
        queue.push({0.0, s});
    }
    while (!queue.empty()) {
        const auto [d, i] = queue.top();
        queue.pop();
        if (d > distance[at(i)])
            continue;
        for (const int j : topology.vertex_neighbours(i))
            if (const double next = d + (rest[at(i)] - rest[at(j)]).norm(); next < distance[at(j)]) {
                distance[at(j)] = next;
                queue.push({next, j});
            }
    }
}

/// The five nearest seeds of every vertex: a search from all seeds at once that lets five of them through a vertex.
void find_nearest(const Points& rest, const MeshTopology& topology, ClusterSeeds& seeds) {
    MinQueue<std::tuple<double, int, int>> queue; // distance, seed, vertex
    for (std::size_t s = 0; s < seeds.vertices.size(); ++s)
        queue.push({0.0, static_cast<int>(s), seeds.vertices[s]});
    while (!queue.empty()) {
        const auto [d, seed, i] = queue.top();
        queue.pop();
        auto& near = seeds.nearest[at(i)];
        const auto end = near.seed.begin() + near.count;
        if (near.count == 5 || std::find(near.seed.begin(), end, seed) != end)
            continue;
        near.seed[at(near.count)] = seed;
        near.distance[at(near.count)] = d;
        ++near.count;
        for (const int j : topology.vertex_neighbours(i))
            if (seeds.nearest[at(j)].count < 5)
                queue.push({d + (rest[at(i)] - rest[at(j)]).norm(), seed, j});
    }
}

using Neighbours = std::vector<std::vector<int>>;

/// Breadth-first order from `start`; neighbours by degree, then number.
std::vector<int> breadth_first(const Neighbours& neighbours, int start, std::vector<bool>& seen) {
    std::vector<int> order{start};
    seen[at(start)] = true;
    for (std::size_t k = 0; k < order.size(); ++k) {
        std::vector<int> next;
        for (const int j : neighbours[at(order[k])])
            if (!seen[at(j)]) {
                seen[at(j)] = true;
                next.push_back(j);
            }
        std::stable_sort(next.begin(), next.end(),
                         [&](int a, int b) { return neighbours[at(a)].size() < neighbours[at(b)].size(); });
        order.insert(order.end(), next.begin(), next.end());
    }
    return order;
}

Neighbours couple_clusters(const MeshTopology& topology, const std::vector<ClusterWeights>& weights,
                           int clusters) {
    Neighbours neighbours(at(clusters));
    const auto couple = [&](int a, int b) {
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t l = 0; l < 4; ++l)
                if (weights[at(a)].weight[k] != 0.0 && weights[at(b)].weight[l] != 0.0) {
                    auto& list = neighbours[at(weights[at(a)].cluster[k])];
                    const int other = weights[at(b)].cluster[l];
                    if (std::find(list.begin(), list.end(), other) == list.end())
                        list.push_back(other);
                }
    };
    for (int i = 0; i < topology.vertex_count(); ++i)
        couple(i, i);
    for (const Edge& e : topology.edges()) {
        couple(e.a, e.b);
        couple(e.b, e.a);
    }
    for (const Dihedral& d :
         topology.dihedrals()) { // the edges of a hinge are edges; only its wings are left
        couple(d.p0, d.p1);
        couple(d.p1, d.p0);
    }
    for (auto& list : neighbours)
        std::sort(list.begin(), list.end());
    return neighbours;
}

} // namespace

ClusterSeeds find_cluster_seeds(const Points& rest, const MeshTopology& topology,
                                const std::vector<double>& inverse_mass, int wanted) {
    ClusterSeeds seeds;
    const std::size_t count = rest.size();
    seeds.nearest.resize(count);
    seeds.from_fixed.assign(count, far_away);
    std::vector<int> fixed, free;
    for (std::size_t i = 0; i < count; ++i)
        (inverse_mass[i] == 0.0 ? fixed : free).push_back(static_cast<int>(i));
    lower_distances(rest, topology, fixed, seeds.from_fixed);
    std::vector<double> distance = seeds.from_fixed;
    const std::size_t limit = std::min(at(std::max(wanted, 0)), free.size() / 20);
    const auto farthest = [&] {
        return *std::max_element(free.begin(), free.end(),
                                 [&](int a, int b) { return distance[at(a)] < distance[at(b)]; });
    };
    while (seeds.vertices.size() < limit) {
        const int seed = farthest();
        if (!(distance[at(seed)] > 0.0))
            break;
        seeds.vertices.push_back(seed);
        lower_distances(rest, topology, {seed}, distance);
    }
    if (seeds.vertices.empty())
        return seeds;
    for (const int i : free)
        if (distance[at(i)] < far_away)
            seeds.radius = std::max(seeds.radius, distance[at(i)]);
    find_nearest(rest, topology, seeds);
    return seeds;
}

int order_clusters(const MeshTopology& topology, std::vector<ClusterWeights>& weights, int clusters) {
    const Neighbours neighbours = couple_clusters(topology, weights, clusters);
    std::vector<bool> done(at(clusters), false);
    std::vector<int> order;
    for (int m = 0; m < clusters; ++m) {
        if (done[at(m)])
            continue;
        int start = m; // walked to an end of its part first
        for (int pass = 0; pass < 3; ++pass) {
            std::vector<bool> seen = done;
            start = breadth_first(neighbours, start, seen).back();
        }
        const std::vector<int> part = breadth_first(neighbours, start, done);
        order.insert(order.end(), part.begin(), part.end());
    }
    std::reverse(order.begin(), order.end());
    std::vector<int> place(at(clusters));
    for (std::size_t k = 0; k < order.size(); ++k)
        place[at(order[k])] = static_cast<int>(k);
    int width = 0;
    for (int m = 0; m < clusters; ++m)
        for (const int other : neighbours[at(m)])
            width = std::max(width, std::abs(place[at(m)] - place[at(other)]));
    for (ClusterWeights& w : weights)
        for (std::size_t k = 0; k < 4; ++k)
            if (w.weight[k] != 0.0)
                w.cluster[k] = static_cast<std::uint16_t>(place[at(w.cluster[k])]);
    return 6 * width + 5;
}

} // namespace fascicle::solver
