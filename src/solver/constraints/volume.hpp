#pragma once
// Volume constraint of a closed surface, C = V - p V0, projected exactly to first order (compliance 0).
// V and its gradient: geometry/volume.hpp.
// Source: Mueller et al. 2007, with the factor 1/6 that eq. 3 of Cervenka & Kohout 2020 leaves out.

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/types.hpp"

namespace fascicle::solver {

class VolumeConstraint {
public:
    /// rest: V points of the closed surface; pressure p (1 preserves). kept: false lets any volume be: project() does nothing.
    VolumeConstraint(const Points& rest, std::vector<Tri> triangles, double pressure, bool kept = true);

    bool kept() const { return kept_; }
    double rest_volume() const { return rest_volume_; }
    double wanted_volume() const { return wanted_; }
    /// Signed volume of x, scene units cubed; fills gradient() as a side product.
    double evaluate(const Points& x);
    const Points& gradient() const { return gradient_; }
    std::size_t bytes() const { return bytes_of(triangles_, gradient_); }

    /// x += -w g C / sum w |g|^2, g = grad C. Does nothing when no free point has a gradient.
    /// blocked: V unit normals of contacts that were active, zero elsewhere, or empty. Where the correction would push a
    /// point against its normal, g loses that component: the plate would only undo it, and the points that are free to
    /// move must make up for it. One call changes the volume by at most max_step of the rest volume.
    void project(Points& x, const std::vector<double>& inverse_mass, const Points& blocked = {});

    static constexpr double max_step = 0.1;

private:
    std::vector<Tri> triangles_;
    Points gradient_;
    double rest_volume_ = 0;
    double wanted_ = 0;
    bool kept_ = true;
};

} // namespace fascicle::solver
