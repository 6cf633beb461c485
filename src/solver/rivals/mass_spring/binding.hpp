#pragma once
// The surface from the particles: each vertex is a fixed blend of particles near it.

#include "fascicle/base/bytes_of.hpp"
#include "fascicle/base/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace fascicle::mass_spring {

/// A sparse matrix of weights; rows sum to 1. A point that was not asked for has an empty row.
class Binding {
public:
    std::size_t rows() const { return starts_.size() - 1; }
    std::span<const std::int32_t> particles(std::size_t row) const {
        return {particles_.data() + starts_[row], starts_[row + 1] - starts_[row]};
    }
    std::span<const double> weights(std::size_t row) const {
        return {weights_.data() + starts_[row], starts_[row + 1] - starts_[row]};
    }
    /// points[i] = sum_k w_ik particles[k]; points of empty rows stay.
    void apply(const Points& particles, Points& points, int threads = 1) const;
    /// out = W^T in: out, one per particle, is set. The chain rule for anything that is a function of the points.
    void transpose(const Points& in, Points& out) const;
    std::size_t bytes() const { return bytes_of(starts_, particles_, weights_); }

private:
    friend Binding bind_to_particles(const Points&, std::span<const int>, const Points&,
                                     std::span<const char>, double, std::vector<int>&);
    std::vector<std::size_t> starts_{0};
    std::vector<std::int32_t> particles_;
    std::vector<double> weights_;
};

/// Moving least squares (Lancaster & Salkauskas 1981), a generalised barycentric coordinate: with r_j = (p_j - x) / R over the
/// particles p_j nearest to x, R just beyond the last of them, t_j = (1 - |r_j|)^2 / (|r_j|^2 + 1e-4) and q_j = (1, r_j),
///   w_j = t_j q_j . a,   (sum_j t_j q_j q_j^T) a = (1, 0, 0, 0):
/// sum w = 1 and sum w p = x, so every affine map of the particles is followed exactly. The least number of particles from 12 on is
/// taken that does so with sum |w| <= 2.5 (particles all but in a plane have none); flat ones hold a point of their plane.
/// particle_of: per point, the particle that it is (weight 1), -1. wanted: per point, 0 leaves its row empty.
/// failed: receives points that cannot be held like that; they have empty rows. cell: about the particles' spacing, > 0.
Binding bind_to_particles(const Points& particles, std::span<const int> particle_of, const Points& points,
                          std::span<const char> wanted, double cell, std::vector<int>& failed);

} // namespace fascicle::mass_spring
