#include "solver/contact/contact_samples.hpp"

#include "fascicle/geometry/distance_grid.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::solver {

namespace {

constexpr int most_parts = 8;

int parts(double length, double spacing) {
    int n = 1;
    while (n < most_parts && length > spacing * n)
        n *= 2;
    return n;
}

/// Barycentric weights of the centroids of a face cut into n^2.
std::vector<std::array<float, 3>> face_weights(int n) {
    std::vector<std::array<float, 3>> weights;
    const auto add = [&](int i, int j) { // in thirds of a part
        const double u = i / (3.0 * n), v = j / (3.0 * n);
        weights.push_back({static_cast<float>(1.0 - u - v), static_cast<float>(u), static_cast<float>(v)});
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j) {
            add(3 * i + 1, 3 * j + 1);
            if (i + j + 1 < n)
                add(3 * i + 2, 3 * j + 2);
        }
    return weights;
}

} // namespace

std::vector<ContactSample> make_contact_samples(const Points& rest, const std::vector<Tri>& triangles,
                                                const MeshTopology& topology,
                                                const std::vector<double>& inverse_mass, double face_spacing,
                                                double edge_spacing) {
    const auto at = [&](int v) -> const Vec3& { return rest[static_cast<std::size_t>(v)]; };
    const auto free = [&](int v) { return inverse_mass[static_cast<std::size_t>(v)] > 0.0; };
    std::vector<ContactSample> samples;
    for (int n = 1; n <= most_parts; n *= 2)
        for (const auto& weight : face_weights(n))
            for (const Tri& t : triangles) {
                if (!free(t[0]) && !free(t[1]) && !free(t[2]))
                    continue;
                const double longest = std::max({(at(t[1]) - at(t[0])).norm(), (at(t[2]) - at(t[1])).norm(),
                                                 (at(t[0]) - at(t[2])).norm()});
                if (parts(longest, face_spacing) == n)
                    samples.push_back({{t[0], t[1], t[2]}, weight, 0, -1});
            }
    for (int n = 2; n <= most_parts; n *= 2)
        for (int i = 1; i < n; ++i)
            for (const Edge& e : topology.edges())
                if ((free(e.a) || free(e.b)) && parts((at(e.b) - at(e.a)).norm(), edge_spacing) == n) {
                    const auto w = static_cast<float>(double(i) / n);
                    samples.push_back({{e.a, e.b, e.b}, {1.0F - w, w, 0.0F}, 0, -1});
                }
    return samples;
}

void set_sample_limits(std::vector<ContactSample>& samples, const Points& rest,
                       std::span<const DistanceGrid* const> solids, double least) {
    for (ContactSample& sample : samples) {
        sample.limit = static_cast<float>(least);
        const Vec3 p = sample.at(rest);
        for (std::size_t b = 0; b < solids.size(); ++b)
            // A little less than at rest: rounding must not count as a violation.
            if (const double phi = solids[b]->value(p) - 0.1 * least;
                phi < static_cast<double>(sample.limit)) {
                sample.limit = static_cast<float>(phi);
                sample.near_solid = static_cast<int>(b);
            }
    }
}

} // namespace fascicle::solver
