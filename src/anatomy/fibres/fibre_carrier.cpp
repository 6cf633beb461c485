#include "fascicle/anatomy/fibre_carrier.hpp"

#include "anatomy/fibres/carrier_builder.hpp"
#include "fascicle/base/assert.hpp"
#include "fascicle/base/bytes_of.hpp"

#include <algorithm>

namespace fascicle {

void FibreCarrier::carry(std::span<const Vec3> surface, std::span<Vec3> points) const {
    FASCICLE_ASSERT(surface.size() == surface_vertices_ && points.size() == point_count());
    for (std::size_t i = 0; i < points.size(); ++i) {
        double x = 0, y = 0, z = 0;
        for (std::uint32_t k = starts_[i]; k < starts_[i + 1]; ++k) {
            const double w = weights_[k];
            const double* const v = surface[static_cast<std::size_t>(vertices_[k])].data();
            x += w * v[0];
            y += w * v[1];
            z += w * v[2];
        }
        points[i] = hold_.held(i, Vec3(x, y, z), surface);
    }
}

std::size_t FibreCarrier::bytes() const {
    return bytes_of(starts_, vertices_, weights_) + hold_.bytes();
}

const std::vector<std::pair<int, double>>& CarrierRow::merged() {
    std::sort(entries_.begin(), entries_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::size_t kept = 0;
    double sum = 0;
    for (const auto& entry : entries_) {
        sum += entry.second;
        if (kept > 0 && entries_[kept - 1].first == entry.first)
            entries_[kept - 1].second += entry.second;
        else
            entries_[kept++] = entry;
    }
    entries_.resize(kept);
    for (auto& entry : entries_)
        entry.second /= sum;
    return entries_;
}

void CarrierBuilder::reserve(std::size_t points, std::size_t weights) {
    carrier_.starts_.reserve(points + 1);
    carrier_.vertices_.reserve(weights);
    carrier_.weights_.reserve(weights);
    carrier_.hold_.reserve(points);
}

CarrierBuilder::CarrierBuilder(const TriMesh& surface, const MeshTopology& topology) {
    carrier_.surface_vertices_ = surface.positions.size();
    carrier_.hold_ = InsideHold(surface, topology);
}

void CarrierBuilder::add_row(const std::vector<std::pair<int, double>>& entries, const HoldEnds& ends,
                             double margin) {
    carrier_.hold_.add(ends, margin);
    for (const auto& [vertex, weight] : entries) {
        carrier_.vertices_.push_back(vertex);
        carrier_.weights_.push_back(weight);
    }
    carrier_.starts_.push_back(static_cast<std::uint32_t>(carrier_.vertices_.size()));
}

} // namespace fascicle
