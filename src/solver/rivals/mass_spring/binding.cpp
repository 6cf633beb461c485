#include "solver/rivals/mass_spring/binding.hpp"

#include "fascicle/base/parallel.hpp"
#include "solver/rivals/mass_spring/point_cells.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace fascicle::mass_spring {

namespace {

using Vec4 = Eigen::Vector4d;

/// Weights of the formula for all of `near`; false when they do not reproduce affine maps or are too large.
bool moving_least_squares(const Points& particles, const Vec3& x, const std::vector<NearPoint>& near,
                          std::vector<double>& weights) {
    const double reach = 1.1 * std::sqrt(near.back().squared_distance);
    if (!(reach > 0.0))
        return false;
    Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
    std::vector<Vec4> rows;
    weights.clear();
    double total = 0;
    for (const NearPoint& n : near) {
        const Vec3 r = (particles[static_cast<std::size_t>(n.point)] - x) / reach;
        const double fall = 1.0 - r.norm(), t = fall * fall / (r.squaredNorm() + 1e-4);
        rows.emplace_back(1.0, r.x(), r.y(), r.z());
        weights.push_back(t);
        total += t;
        m += t * rows.back() * rows.back().transpose();
    }
    // Of least norm where particles are in a plane or line.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(m / total);
    Vec4 a = Vec4::Zero();
    constexpr double flat = 1e-10;
    for (int k = 0; k < 4; ++k)
        if (eigen.eigenvalues()[k] > flat * eigen.eigenvalues()[3])
            a += eigen.eigenvectors().col(k) * (eigen.eigenvectors()(0, k) / eigen.eigenvalues()[k]);
    a /= total;
    Vec4 off(-1.0, 0.0, 0.0, 0.0);
    double size = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        weights[k] *= rows[k].dot(a);
        off += weights[k] * rows[k];
        size += std::abs(weights[k]);
    }
    constexpr double most = 2.5, exact = 1e-9;
    return size <= most && off.cwiseAbs().maxCoeff() <= exact;
}

} // namespace

Binding bind_to_particles(const Points& particles, std::span<const int> particle_of, const Points& points,
                          std::span<const char> wanted, double cell, std::vector<int>& failed) {
    constexpr std::size_t fewest = 12, most = 96;
    Binding binding;
    PointCells cells(cell);
    for (const Vec3& p : particles)
        cells.add(p);
    std::vector<NearPoint> near;
    std::vector<double> weights;
    failed.clear();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (particle_of[i] >= 0) {
            binding.particles_.push_back(particle_of[i]);
            binding.weights_.push_back(1.0);
        } else if (wanted[i] != 0) {
            bool held = false;
            for (std::size_t count = fewest; !held && count <= most; count *= 2) {
                cells.nearest(points[i], count, near);
                held = !near.empty() && moving_least_squares(particles, points[i], near, weights);
                if (near.size() < count)
                    break; // there are no more
            }
            for (std::size_t k = 0; held && k < near.size(); ++k)
                if (weights[k] != 0.0) {
                    binding.particles_.push_back(near[k].point);
                    binding.weights_.push_back(weights[k]);
                }
            if (!held)
                failed.push_back(static_cast<int>(i));
        }
        binding.starts_.push_back(binding.particles_.size());
    }
    return binding;
}

void Binding::apply(const Points& particles, Points& points, int threads) const {
    parallel_for(threads, rows(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (starts_[i] == starts_[i + 1])
                continue;
            Vec3 sum = Vec3::Zero();
            for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k)
                sum += weights_[k] * particles[static_cast<std::size_t>(particles_[k])];
            points[i] = sum;
        }
    });
}

void Binding::transpose(const Points& in, Points& out) const {
    std::fill(out.begin(), out.end(), Vec3::Zero());
    for (std::size_t i = 0; i < rows(); ++i)
        for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k)
            out[static_cast<std::size_t>(particles_[k])] += weights_[k] * in[i];
}

} // namespace fascicle::mass_spring
