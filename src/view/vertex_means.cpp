#include "view/vertex_means.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/dihedral_angle.hpp"

#include <cmath>
#include <numbers>

namespace fascicle::view {

namespace {

std::optional<double> angle(const Dihedral& d, const Points& points) {
    const auto at = [&](int v) -> const Vec3& { return points[static_cast<std::size_t>(v)]; };
    return signed_dihedral_angle(at(d.p0), at(d.p1), at(d.p2), at(d.p3));
}

/// Sums and counts per vertex to means.
class Means {
public:
    explicit Means(std::size_t vertices) : sums_(vertices, 0.0), counts_(vertices, 0) {}
    void add(int a, int b, double value) {
        for (const int v : {a, b}) {
            sums_[static_cast<std::size_t>(v)] += value;
            ++counts_[static_cast<std::size_t>(v)];
        }
    }
    std::vector<double> result(double without) && {
        for (std::size_t i = 0; i < sums_.size(); ++i)
            sums_[i] = counts_[i] > 0 ? sums_[i] / counts_[i] : without;
        return std::move(sums_);
    }

private:
    std::vector<double> sums_;
    std::vector<int> counts_;
};

} // namespace

std::vector<double> vertex_means(const MeshTopology& topology, const std::vector<double>& edge_values,
                                 double without) {
    FASCICLE_ASSERT(edge_values.size() == topology.edges().size());
    Means means(static_cast<std::size_t>(topology.vertex_count()));
    for (std::size_t e = 0; e < edge_values.size(); ++e)
        means.add(topology.edges()[e].a, topology.edges()[e].b, edge_values[e]);
    return std::move(means).result(without);
}

VertexDihedralChange::VertexDihedralChange(const MeshTopology& topology, const Points& rest)
    : vertices_(rest.size()) {
    FASCICLE_ASSERT(rest.size() == static_cast<std::size_t>(topology.vertex_count()));
    for (const Dihedral& d : topology.dihedrals())
        if (const std::optional<double> theta = angle(d, rest)) {
            dihedrals_.push_back(d);
            rest_angles_.push_back(*theta);
        }
}

std::vector<double> VertexDihedralChange::measure(const Points& points) const {
    FASCICLE_ASSERT(points.size() == vertices_);
    Means means(vertices_);
    for (std::size_t i = 0; i < dihedrals_.size(); ++i) {
        const std::optional<double> theta = angle(dihedrals_[i], points);
        if (theta && std::isfinite(*theta))
            means.add(dihedrals_[i].p2, dihedrals_[i].p3,
                      std::abs(wrap_angle(*theta - rest_angles_[i])) * 180.0 / std::numbers::pi);
    }
    return std::move(means).result(0.0);
}

} // namespace fascicle::view
