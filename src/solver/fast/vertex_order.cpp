#include "solver/fast/vertex_order.hpp"

#include <algorithm>

namespace fascicle::solver::fast {

namespace {

class Walk {
public:
    explicit Walk(const MeshTopology& topology)
        : topology_(topology), seen_(static_cast<std::size_t>(topology.vertex_count()), 0) {}

    /// Vertices of start's component by breadth, those of few neighbours first; the last one is far from start.
    std::vector<int> from(int start) {
        ++round_;
        std::vector<int> found{start};
        mark(start);
        std::vector<int> next;
        for (std::size_t head = 0; head < found.size(); ++head) {
            next.clear();
            for (const int n : topology_.vertex_neighbours(found[head]))
                if (seen_[static_cast<std::size_t>(n)] != round_) {
                    mark(n);
                    next.push_back(n);
                }
            std::stable_sort(next.begin(), next.end(), [&](int a, int b) { return degree(a) < degree(b); });
            found.insert(found.end(), next.begin(), next.end());
        }
        return found;
    }

private:
    std::size_t degree(int v) const { return topology_.vertex_neighbours(v).size(); }
    void mark(int v) { seen_[static_cast<std::size_t>(v)] = round_; }

    const MeshTopology& topology_;
    std::vector<int> seen_; ///< round in which a vertex was last met
    int round_ = 0;
};

} // namespace

std::vector<int> vertex_order(const MeshTopology& topology) {
    Walk walk(topology);
    std::vector<int> order, lone;
    std::vector<bool> done(static_cast<std::size_t>(topology.vertex_count()), false);
    for (int v = 0; v < topology.vertex_count(); ++v) {
        if (done[static_cast<std::size_t>(v)])
            continue;
        if (topology.vertex_component(v) < 0) {
            lone.push_back(v);
            continue;
        }
        int start = v;
        for (int turn = 0; turn < 3; ++turn)
            start = walk.from(start).back();
        const std::vector<int> found = walk.from(start);
        for (const int f : found)
            done[static_cast<std::size_t>(f)] = true;
        order.insert(order.end(), found.rbegin(), found.rend());
    }
    order.insert(order.end(), lone.begin(), lone.end());
    return order;
}

} // namespace fascicle::solver::fast
