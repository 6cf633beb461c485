#pragma once
// The as-rigid-as-possible energy of a surface, its best rotations and its linear system's right side.
// Source: Sorkine & Alexa 2007, "As-rigid-as-possible surface modeling", SGP: eqs. 3 to 8.
//   E(x, R) = sum_i sum_{j in N(i)} w_ij |(x_i - x_j) - R_i (p_i - p_j)|^2
// p: rest points; x: points now; R_i: a rotation per vertex; w_ij = w_ji > 0, plain numbers, so E is in squared scene units. Each
// edge counts twice, once with the rotation of either end.

#include "fascicle/geometry/mesh_topology.hpp"

namespace fascicle::solver {

class ArapCells {
public:
    ArapCells() = default;
    /// rest: V points; weights: per edge of the topology, > 0.
    ArapCells(const Points& rest, const MeshTopology& topology, const std::vector<double>& weights);

    std::size_t size() const { return starts_.size() - 1; }
    /// Sum of the weights at a vertex: the diagonal of the system.
    double weight_at(std::size_t vertex) const { return diagonal_[vertex]; }

    double energy(const Points& x, const std::vector<Mat3>& rotations) const;
    /// V: dE/dx_i = 4 sum_j w_ij ((x_i - x_j) - (R_i + R_j) (p_i - p_j) / 2), eq. 7 before it is set to zero.
    Points gradient(const Points& x, const std::vector<Mat3>& rotations) const;
    /// The rotations that make E least for given x (eq. 6): best_rotation() of S_i = sum_j w_ij (p_i - p_j)
    /// (x_i - x_j)^T. The same bits for any number of threads.
    void fit(const Points& x, std::vector<Mat3>& rotations, int threads) const;
    /// V: b_i = sum_j w_ij (R_i + R_j) (p_i - p_j) / 2, the right side of eq. 8.
    void right_side(const std::vector<Mat3>& rotations, Points& b, int threads) const;

    struct Link {
        int other;
        double weight;
        Vec3 rest; ///< p_i - p_j
    };
    std::span<const Link> links(std::size_t vertex) const {
        return {links_.data() + starts_[vertex], starts_[vertex + 1] - starts_[vertex]};
    }
    std::size_t bytes() const { return bytes_of(starts_, links_, diagonal_); }

private:
    std::vector<std::size_t> starts_{0};
    std::vector<Link> links_;
    std::vector<double> diagonal_;
};

} // namespace fascicle::solver
