#include "solver/rivals/mass_spring/spring_net.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fascicle::mass_spring {

namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

} // namespace

Vec3 spring_force(const Vec3& p, const Vec3& q, double rest, double unit) {
    const Vec3 d = q - p;
    const double length = d.norm();
    if (length == 0.0)
        return Vec3::Zero(); // what is not finite goes on to step(), which refuses it
    return (unit / rest) * ((length - rest) / (std::max(length, 0.5 * rest) * length)) * d;
}

SpringNet::SpringNet(const Points& rest, std::vector<char> fixed, std::vector<Spring> springs)
    : x_(rest), before_(rest), force_(rest.size(), Vec3::Zero()), fixed_(std::move(fixed)),
      springs_(std::move(springs)) {
    for (const Spring& spring : springs_)
        mean_ += spring.rest / static_cast<double>(springs_.size());
    if (mean_ > 0.0)
        unit_ = mean_;
    // The stiffness of a spring at rest is u^2 / rest^2.
    const double largest = largest_eigenvalue();
    if (largest > stiffest)
        unit_ *= std::sqrt(stiffest / largest);
}

/// By power iteration, with a tenth on top for what it has not reached yet.
double SpringNet::largest_eigenvalue() const {
    constexpr int rounds = 60;
    Points v(x_.size(), Vec3::Zero()), next(x_.size());
    // No symmetry of a net has these numbers.
    for (std::size_t i = 0; i < v.size(); ++i)
        if (fixed_[i] == 0)
            v[i] = Vec3(std::sin(1.0 + 12.9898 * double(i)), std::sin(2.0 + 78.233 * double(i)),
                        std::sin(3.0 + 37.719 * double(i)));
    double largest = 0;
    for (int round = 0; round < rounds; ++round) {
        double size = 0;
        for (const Vec3& p : v)
            size += p.squaredNorm();
        if (!(size > 0.0))
            return 0.0;
        std::fill(next.begin(), next.end(), Vec3::Zero());
        for (const Spring& s : springs_) {
            const Vec3 n = (x_[at(s.b)] - x_[at(s.a)]) / s.rest;
            const Vec3 f = (unit_ * unit_ / (s.rest * s.rest)) * n.dot(v[at(s.b)] - v[at(s.a)]) * n;
            next[at(s.a)] -= f;
            next[at(s.b)] += f;
        }
        double along = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (fixed_[i] != 0)
                next[i].setZero();
            along += next[i].dot(v[i]);
        }
        largest = std::max(largest, along / size);
        const double scale = 1.0 / std::sqrt(size);
        for (std::size_t i = 0; i < v.size(); ++i)
            v[i] = scale * next[i];
    }
    return 1.1 * largest;
}

std::size_t SpringNet::step(double dt, double damping) {
    std::fill(force_.begin(), force_.end(), Vec3::Zero());
    for (const Spring& s : springs_) {
        const Vec3 f = spring_force(x_[at(s.a)], x_[at(s.b)], s.rest, unit_);
        force_[at(s.a)] += f;
        force_[at(s.b)] -= f;
    }
    std::size_t refused = 0;
    const double longest = longest_step * mean_;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (fixed_[i] != 0)
            continue;
        Vec3 move = (1.0 - damping * dt) * (x_[i] - before_[i]) + (dt * dt * unit_) * force_[i];
        if (!move.allFinite() || !x_[i].allFinite()) {
            ++refused;
            before_[i] = x_[i];
            continue;
        }
        const double size = move.norm();
        if (size > longest)
            move *= longest / size;
        before_[i] = x_[i];
        x_[i] += move;
    }
    return refused;
}

void SpringNet::carry_to(std::size_t i, const Vec3& p) {
    before_[i] += p - x_[i];
    x_[i] = p;
}

void SpringNet::stop_at(std::size_t i, const Vec3& p) {
    x_[i] = before_[i] = p;
}

} // namespace fascicle::mass_spring
