#include "solver/rivals/lines/middle_line.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

constexpr int levels = 32; ///< levels between are this less one
constexpr int smoothings = 3;

struct Section {
    double weight = 0;
    Vec3 sum = Vec3::Zero();
};

} // namespace

Vec3 MiddleLine::at(double share) const {
    const double wanted = std::clamp(share, 0.0, 1.0) * length();
    std::size_t k = 1;
    while (k + 1 < points.size() && lengths[k] < wanted)
        ++k;
    const double part = lengths[k] - lengths[k - 1];
    const double f = part > 0.0 ? std::clamp((wanted - lengths[k - 1]) / part, 0.0, 1.0) : 0.0;
    return points[k - 1] + f * (points[k] - points[k - 1]);
}

MiddleLine with_lengths(Points points) {
    MiddleLine line;
    line.points = std::move(points);
    line.lengths.assign(line.points.size(), 0.0);
    for (std::size_t k = 1; k < line.points.size(); ++k)
        line.lengths[k] = line.lengths[k - 1] + (line.points[k] - line.points[k - 1]).norm();
    return line;
}

MiddleLine middle_line(const Points& rest, std::span<const Tri> triangles, const std::vector<double>& u,
                       const std::vector<double>& weights, const Vec3& first, const Vec3& last) {
    std::vector<Section> sections(levels + 1);
    for (const Tri& t : triangles) {
        double low = 1, high = 0, weight = 0;
        for (const int v : t) {
            low = std::min(low, u[static_cast<std::size_t>(v)]);
            high = std::max(high, u[static_cast<std::size_t>(v)]);
            weight += weights[static_cast<std::size_t>(v)] / 3.0;
        }
        const int from = std::max(1, static_cast<int>(std::ceil(low * levels)));
        const int to = std::min(levels - 1, static_cast<int>(std::floor(high * levels)));
        for (int k = from; k <= to; ++k) {
            const double level = double(k) / levels;
            Vec3 ends[2];
            int found = 0;
            for (std::size_t c = 0; c < 3 && found < 2; ++c) {
                const auto a = static_cast<std::size_t>(t[c]), b = static_cast<std::size_t>(t[(c + 1) % 3]);
                if ((u[a] < level) != (u[b] < level))
                    ends[found++] = rest[a] + (level - u[a]) / (u[b] - u[a]) * (rest[b] - rest[a]);
            }
            if (found < 2)
                continue;
            const double w = weight * (ends[1] - ends[0]).norm();
            sections[static_cast<std::size_t>(k)].weight += w;
            sections[static_cast<std::size_t>(k)].sum += 0.5 * w * (ends[0] + ends[1]);
        }
    }
    Points points{first};
    for (const Section& section : sections)
        if (section.weight > 0.0)
            points.push_back(section.sum / section.weight);
    points.push_back(last);
    for (int round = 0; round < smoothings; ++round) {
        Points smooth = points;
        for (std::size_t k = 1; k + 1 < points.size(); ++k)
            smooth[k] = 0.25 * points[k - 1] + 0.5 * points[k] + 0.25 * points[k + 1];
        points = std::move(smooth);
    }
    return with_lengths(std::move(points));
}

} // namespace fascicle::solver
