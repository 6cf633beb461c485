#pragma once
// A field that is harmonic in the volume of a muscle, on a regular grid.

#include "fascicle/anatomy/fibre_problem.hpp"

namespace fascicle {

/// Potential of a flow in the cells inside a muscle: as much enters through every area of the origins, and leaves through
/// every area of the insertions, nothing passes the surface elsewhere (Choi & Blemker 2013). 7-point Laplacian, sum over
/// inside neighbours (u_j - u_i) = -what enters the cell; u rises towards the insertion, and has mean 0. Two layers of
/// cells around have the mean of their neighbours, so that u and its gradient can be read up to the surface.
class VolumeField {
public:
    /// About `cells` cells. Error naming the muscle when no connected part of them reaches from origin to insertion.
    VolumeField(const FibreProblem& checked, int cells);

    double step() const { return step_; }
    /// Trilinear between cell centres; NaN where cells have no value.
    double value(const Vec3& p) const;
    /// Of the trilinear u by central differences over one step; zero where there is none.
    Vec3 gradient(const Vec3& p) const;
    /// Whether p lies in a cell where the flow leaves.
    bool at_insertion(const Vec3& p) const;

private:
    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_[1]) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size_[0]) +
               static_cast<std::size_t>(x);
    }
    Vec3 centre(int x, int y, int z) const { return low_ + step_ * (Vec3(x, y, z) + Vec3::Constant(0.5)); }
    void fill(const FibreProblem& problem);
    void mark(const FibreProblem& problem, AttachmentKind kind);
    std::size_t inside_cell_near(const Vec3& p) const;
    bool keep_connected();
    void solve();
    void extend();

    enum class Cell : char { outside, free, origin, insertion, around };
    Vec3 low_ = Vec3::Zero();
    double step_ = 1;
    std::array<int, 3> size_{1, 1, 1};
    std::array<std::ptrdiff_t, 6> neighbours_{};
    std::vector<Cell> cells_;
    std::vector<double> u_;
    std::vector<double> area_; ///< attached area in a cell, above 0 where it is marked
};

} // namespace fascicle
