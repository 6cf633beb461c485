#include "solver/fast/plan_order.hpp"

#include "solver/fast/vertex_order.hpp"

#include <algorithm>
#include <limits>

namespace fascicle::solver::fast {

namespace {

constexpr std::size_t sort_window =
    128; ///< vertices that may change places so that groups have rings of one length
constexpr std::size_t reach = std::numeric_limits<std::uint16_t>::max();

/// Largest distance in the order between two vertices of one dihedral or edge.
std::size_t span_of(const MeshTopology& topology, const std::vector<int>& place) {
    const auto at = [&](int v) { return place[static_cast<std::size_t>(v)]; };
    int span = 0;
    for (const Edge& e : topology.edges())
        span = std::max(span, std::abs(at(e.a) - at(e.b)));
    for (const Dihedral& d : topology.dihedrals()) {
        const auto [low, high] = std::minmax({at(d.p0), at(d.p1), at(d.p2), at(d.p3)});
        span = std::max(span, high - low);
    }
    return static_cast<std::size_t>(span);
}

/// Cuts the order into an even number of blocks (or one) of equal work, each at least `least` long; returns their ends.
std::vector<std::size_t> cut(const std::vector<int>& order, const std::vector<bool>& held,
                             std::size_t least) {
    constexpr double held_work = 0.2; // of a free vertex
    std::vector<double> work{0.0};
    for (const int v : order)
        work.push_back(work.back() + (held[static_cast<std::size_t>(v)] ? held_work : 1.0));
    const std::size_t count = order.size();
    for (std::size_t blocks = 2 * (count / (2 * largest_block) + 1); blocks >= 2; blocks -= 2) {
        std::vector<std::size_t> ends;
        std::size_t begin = 0;
        for (std::size_t b = 1; b <= blocks; ++b) {
            const double wanted = work.back() * static_cast<double>(b) / static_cast<double>(blocks);
            auto end =
                static_cast<std::size_t>(std::lower_bound(work.begin(), work.end(), wanted) - work.begin());
            end = b == blocks ? count : std::clamp(end, std::min(count, begin + least), count);
            ends.push_back(end);
            if (end - begin < least)
                break;
            begin = end;
        }
        if (ends.size() == blocks && begin == count)
            return ends;
    }
    return {count};
}

/// The vertices round v, in order, chain by chain. A closed chain ends with its first vertex.
std::vector<std::vector<int>> chains_round(int v, const std::vector<Tri>& triangles,
                                           const MeshTopology& topology) {
    std::vector<std::array<int, 2>> steps;
    for (const int t : topology.vertex_triangles(v)) {
        const Tri& tri = triangles[static_cast<std::size_t>(t)];
        const std::size_t corner = tri[0] == v ? 0 : tri[1] == v ? 1 : 2;
        steps.push_back({tri[(corner + 1) % 3], tri[(corner + 2) % 3]});
    }
    std::vector<std::vector<int>> chains;
    while (!steps.empty()) {
        // An open chain has to begin at its end: at a vertex that no step leads to.
        std::size_t first = 0;
        for (std::size_t s = 0; s < steps.size(); ++s)
            if (std::none_of(steps.begin(), steps.end(),
                             [&](const auto& o) { return o[1] == steps[s][0]; })) {
                first = s;
                break;
            }
        std::vector<int> chain{steps[first][0]};
        for (auto next = steps.begin() + static_cast<std::ptrdiff_t>(first); next != steps.end();
             next = std::find_if(steps.begin(), steps.end(),
                                 [&](const auto& s) { return s[0] == chain.back(); })) {
            chain.push_back((*next)[1]);
            steps.erase(next);
            if (chain.back() == chain.front())
                break;
        }
        chains.push_back(std::move(chain));
    }
    std::stable_sort(chains.begin(), chains.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return chains;
}

} // namespace

std::optional<BlockLayout> lay_out_blocks(const MeshTopology& topology, const std::vector<bool>& held,
                                          Plan& plan) {
    const std::vector<int> order = vertex_order(topology);
    const std::size_t count = order.size();
    std::vector<int> place(count);
    for (std::size_t i = 0; i < count; ++i)
        place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);

    // Interfaces on both sides of a block must not meet in it.
    const std::size_t least = std::max(2 * (span_of(topology, place) + sort_window), smallest_block);
    const std::vector<std::size_t> ends = cut(order, held, least);
    BlockLayout layout{{0}};
    plan.record_of_vertex.assign(count, -1);
    std::size_t begin = 0, first = 0;
    for (const std::size_t end : ends) {
        std::vector<int> mine(order.begin() + static_cast<std::ptrdiff_t>(begin),
                              order.begin() + static_cast<std::ptrdiff_t>(end));
        for (std::size_t w = 0; w < mine.size(); w += sort_window)
            std::stable_sort(
                mine.begin() + static_cast<std::ptrdiff_t>(w),
                mine.begin() + static_cast<std::ptrdiff_t>(std::min(mine.size(), w + sort_window)),
                [&](int a, int c) {
                    return topology.vertex_triangles(a).size() < topology.vertex_triangles(c).size();
                });
        for (std::size_t i = 0; i < mine.size(); ++i)
            plan.record_of_vertex[static_cast<std::size_t>(mine[i])] = static_cast<int>(first + i);
        const std::size_t records = (mine.size() + packet - 1) / packet * packet + block_dummies;
        for (std::size_t g = first / packet; g < (first + records) / packet; g += chunk_groups)
            plan.chunks.push_back({g, std::min((first + records) / packet, g + chunk_groups)});
        begin = end;
        first += records;
        layout.first_record.push_back(first);
    }
    plan.groups = first / packet;
    for (std::size_t b = 0; b < layout.blocks(); ++b)
        if (layout.first_record[std::min(b + 2, layout.blocks())] - layout.first_record[b] > reach)
            return std::nullopt;
    return layout;
}

bool lay_out_rings(const std::vector<Tri>& triangles, const MeshTopology& topology, Plan& plan) {
    std::vector<std::vector<int>> rings(plan.records());
    for (int v = 0; v < topology.vertex_count(); ++v) {
        const auto chains = chains_round(v, triangles, topology);
        const auto record = static_cast<std::size_t>(plan.record_of_vertex[static_cast<std::size_t>(v)]);
        const auto at = [&](int other) { return plan.record_of_vertex[static_cast<std::size_t>(other)]; };
        for (const std::vector<int>& chain : chains) {
            if (chains.size() > 1 && chain.front() != chain.back())
                return false;
            for (const int other : chain)
                rings[record].push_back(at(other));
        }
        // Closed fans one after the other: the step from one to the next is taken back by the step home.
        for (std::size_t c = chains.size(); c-- > 1;)
            rings[record].push_back(at(chains[c - 1].front()));
    }
    for (std::size_t g = 0; g < plan.groups; ++g) {
        std::size_t length = 0;
        int low = std::numeric_limits<int>::max(), high = 0;
        for (std::size_t i = 0; i < packet; ++i)
            for (const int r : rings[packet * g + i]) {
                low = std::min(low, r);
                high = std::max(high, r);
            }
        for (std::size_t i = 0; i < packet; ++i)
            length = std::max(length, rings[packet * g + i].size());
        if (length > 0 && static_cast<std::size_t>(high - low) > reach)
            return false;
        plan.ring_base.push_back(length > 0 ? static_cast<std::uint32_t>(low) : 0u);
        plan.ring_first.push_back(static_cast<std::uint32_t>(plan.rings.size() / packet));
        plan.ring_length.push_back(static_cast<std::uint32_t>(length));
        for (std::size_t k = 0; k < length; ++k)
            for (std::size_t i = 0; i < packet; ++i) {
                // A short ring stays where it ends: p x p = 0.
                const auto& ring = rings[packet * g + i];
                const int r = ring.empty() ? low : ring[std::min(k, ring.size() - 1)];
                plan.rings.push_back(static_cast<std::uint16_t>(r - low));
            }
    }
    return true;
}

} // namespace fascicle::solver::fast
