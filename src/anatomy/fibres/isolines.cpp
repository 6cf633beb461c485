#include "anatomy/fibres/isolines.hpp"

#include <algorithm>

namespace fascicle {

IsolineFinder::IsolineFinder(const TriMesh& mesh, const MeshTopology& topology,
                             const std::vector<double>& field)
    : mesh_(mesh), topology_(topology), field_(field), edge_of_(3 * mesh.triangles.size(), -1),
      next_(topology.edges().size(), -1), seen_(topology.edges().size(), 0) {
    for (std::size_t e = 0; e < topology.edges().size(); ++e)
        for (const int half_edge : topology.edge_half_edges(static_cast<int>(e)))
            edge_of_[static_cast<std::size_t>(half_edge)] = static_cast<int>(e);
    range_.reserve(mesh.triangles.size());
    for (const Tri& t : mesh.triangles) {
        const double a = field[static_cast<std::size_t>(t[0])], b = field[static_cast<std::size_t>(t[1])],
                     c = field[static_cast<std::size_t>(t[2])];
        range_.push_back({std::min({a, b, c}), std::max({a, b, c})});
    }
}

std::vector<Isoline> IsolineFinder::at(double level) {
    std::vector<int> crossed; // edges where a piece begins, in the order of the triangles
    std::vector<int> entered; // edges where one ends
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
        if (!(range_[t][0] < level && range_[t][1] >= level) || edge_of_[3 * t] < 0)
            continue;
        // The triangle walks its border: up across the level at one edge, down at another. With the low corner on the
        // left the piece runs from the edge walked up to the edge walked down.
        int up = -1, down = -1;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool from = field_[static_cast<std::size_t>(mesh_.triangles[t][k])] >= level;
            const bool to = field_[static_cast<std::size_t>(mesh_.triangles[t][(k + 1) % 3])] >= level;
            if (!from && to)
                up = edge_of_[3 * t + k];
            else if (from && !to)
                down = edge_of_[3 * t + k];
        }
        next_[static_cast<std::size_t>(up)] = down;
        crossed.push_back(up);
        entered.push_back(down);
    }
    // Curves that begin at a border first, so that they are walked from their beginning.
    for (const int e : entered)
        ++seen_[static_cast<std::size_t>(e)];
    std::stable_partition(crossed.begin(), crossed.end(),
                          [&](int e) { return seen_[static_cast<std::size_t>(e)] == 0; });
    for (const int e : entered)
        seen_[static_cast<std::size_t>(e)] = 0;
    std::vector<Isoline> loops;
    for (const int start : crossed) {
        Isoline loop;
        for (int e = start; e >= 0 && seen_[static_cast<std::size_t>(e)] == 0;
             e = next_[static_cast<std::size_t>(e)]) {
            seen_[static_cast<std::size_t>(e)] = 1;
            const Edge& edge = topology_.edges()[static_cast<std::size_t>(e)];
            const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
            const double share = (level - field_[a]) / (field_[b] - field_[a]);
            const Vec3 p = mesh_.positions[a] + share * (mesh_.positions[b] - mesh_.positions[a]);
            if (loop.points.empty() || p != loop.points.back())
                loop.points.push_back(p);
        }
        while (loop.points.size() > 1 && loop.points.back() == loop.points.front())
            loop.points.pop_back();
        for (std::size_t i = 0; i < loop.points.size(); ++i)
            loop.length += (loop.points[(i + 1) % loop.points.size()] - loop.points[i]).norm();
        if (!loop.points.empty())
            loops.push_back(std::move(loop));
    }
    for (const int e : crossed)
        seen_[static_cast<std::size_t>(e)] = 0;
    for (const auto* edges : {&crossed, &entered})
        for (const int e : *edges) {
            seen_[static_cast<std::size_t>(e)] = 0;
            next_[static_cast<std::size_t>(e)] = -1;
        }
    std::stable_sort(loops.begin(), loops.end(),
                     [](const Isoline& a, const Isoline& b) { return a.length > b.length; });
    return loops;
}

Points resampled_loop(const Isoline& loop, std::size_t count) {
    Points points;
    points.reserve(count);
    std::size_t k = 0;
    double walked = 0; // length up to point k
    for (std::size_t i = 0; i < count; ++i) {
        const double target = loop.length * double(i) / double(count);
        for (;;) {
            const Vec3 &a = loop.points[k], &b = loop.points[(k + 1) % loop.points.size()];
            const double step = (b - a).norm();
            if (walked + step >= target || k + 1 == loop.points.size()) {
                points.push_back(step > 0 ? Vec3(a + std::clamp((target - walked) / step, 0.0, 1.0) * (b - a))
                                          : a);
                break;
            }
            walked += step;
            ++k;
        }
    }
    return points;
}

} // namespace fascicle
