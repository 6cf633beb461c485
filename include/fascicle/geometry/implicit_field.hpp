#pragma once
// An implicit solid sampled on a regular grid near its surface, for meshing and for cheap repeated look-ups.

#include "fascicle/geometry/implicit.hpp"

#include <array>
#include <vector>

namespace fascicle {

/// Where and how finely to sample. upper is rounded up to whole cells. lipschitz: bound on |gradient f| that
/// decides which blocks are far from the surface and need no samples; 1 for true distances, more for
/// estimates.
struct FieldBox {
    Vec3 lower, upper;
    double spacing;
    double lipschitz = 1.5;
};

/// Samples of f at the nodes. Exact (f itself) at every node within 2 spacings of the surface; further away a
/// node may hold any value of the right sign and at least 2 spacings. Nodes on the border of the box are made
/// positive, so that the solid is closed even if the box cuts it. The same for every thread count.
class ImplicitField {
public:
    /// Throws Error when the box would need more than 2^27 nodes.
    ImplicitField(const Implicit& f, const FieldBox& box, int threads);

    const std::array<int, 3>& nodes() const { return nodes_; }
    double spacing() const { return spacing_; }
    Vec3 position(int i, int j, int k) const { return lower_ + spacing_ * Vec3(i, j, k); }
    double at(int i, int j, int k) const { return values_[index(i, j, k)]; }

    /// Trilinear value; outside the box the value at the nearest point of the box plus the distance to it.
    double operator()(const Vec3& p) const;
    /// Gradient of the trilinear interpolant, smoothed over one cell (central differences of half a spacing).
    Vec3 gradient(const Vec3& p) const;

private:
    std::size_t index(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(nodes_[1]) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(nodes_[0]) +
               static_cast<std::size_t>(i);
    }
    void fill(const Implicit& f, double lipschitz, const std::array<int, 3>& from, int size);

    Vec3 lower_;
    double spacing_;
    std::array<int, 3> nodes_;
    std::vector<float> values_;
};

} // namespace fascicle
