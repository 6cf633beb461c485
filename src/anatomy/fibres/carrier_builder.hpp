#pragma once
// Fills a FibreCarrier row by row.

#include "fascicle/anatomy/fibre_carrier.hpp"

namespace fascicle {

/// One row under construction: vertices may come several times; add() collects, merged() sums them.
class CarrierRow {
public:
    void clear() { entries_.clear(); }
    void add(int vertex, double weight) { entries_.emplace_back(vertex, weight); }
    void add(const Tri& t, const Vec3& weights, double scale) {
        for (int k = 0; k < 3; ++k)
            add(t[static_cast<std::size_t>(k)], scale * weights[k]);
    }
    /// Entries by ascending vertex, each once, divided by their sum.
    const std::vector<std::pair<int, double>>& merged();

private:
    std::vector<std::pair<int, double>> entries_;
};

using HoldEnds = std::array<std::int32_t, InsideHold::ends_per_point>;

class CarrierBuilder {
public:
    CarrierBuilder(const TriMesh& surface, const MeshTopology& topology);
    void reserve(std::size_t points, std::size_t weights);
    void add_row(const std::vector<std::pair<int, double>>& entries, const HoldEnds& ends, double margin);
    FibreCarrier take() { return std::move(carrier_); }

private:
    FibreCarrier carrier_;
};

} // namespace fascicle
