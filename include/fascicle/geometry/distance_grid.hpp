#pragma once
// Signed distance to a solid on a regular grid in the solid's rest frame.

#include "fascicle/base/job_control.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

namespace fascicle {

/// Value and gradient of the trilinear interpolant. gradient is that of the interpolant, not normalised; zero
/// where the value is saturated.
struct DistanceSample {
    double value = 0;
    Vec3 gradient = Vec3::Zero();
};

struct DistanceGridOptions {
    double spacing = 1.0; ///< wanted h, scene units; made coarser when the grid would exceed max_nodes
    double saturation =
        8.0; ///< values are clamped to +-saturation: a valid lower bound of the distance's size
    std::size_t max_nodes = std::size_t{64} << 20;
    int threads = 1;
};

/// Negative inside, by generalised winding number > 0.5. Conservative: the interpolant is <= 0 on the whole
/// surface (each node is lowered by what its cells' surface samples need), so that the set value >= 0 holds
/// no surface point.
class DistanceGrid {
public:
    DistanceGrid(const TriMesh& mesh, const DistanceGridOptions& options, const JobControl& control = {});

    /// Any point. Outside of the grid's box the value is the saturation distance, gradient zero.
    DistanceSample sample(const Vec3& p) const;
    double value(const Vec3& p) const;

    double spacing() const { return spacing_; }
    double saturation() const { return saturation_; }
    const std::array<int, 3>& nodes() const { return nodes_; }
    /// Largest and mean lowering of nodes near the surface, scene units: how far the zero set stands off the
    /// surface.
    double correction_max() const { return correction_max_; }
    double correction_mean() const { return correction_mean_; }
    std::size_t bytes() const { return values_.size() * sizeof(float); }

private:
    double spacing_ = 1;
    double saturation_ = 8;
    std::array<int, 3> nodes_{};
    Vec3 low_ = Vec3::Zero();
    std::vector<float> values_; ///< x fastest
    double correction_max_ = 0;
    double correction_mean_ = 0;
};

} // namespace fascicle
