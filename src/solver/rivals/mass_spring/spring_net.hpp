#pragma once
// Particles of unit mass, springs between them, Verlet steps.
// Source: Janak 2012 (TR DCSE/TR-2012-5); Janak & Kohout 2014; numbers as in the methods notes 6.3.

#include "fascicle/base/bytes_of.hpp"
#include "solver/rivals/mass_spring/springs.hpp"

#include <cstddef>

namespace fascicle::mass_spring {

/// Force on p at one end of a spring to q at the other, in units of length u: L = |q - p| / u, L0 = rest / u, k = 1 / L0,
///   F = k (L - L0) / L  along (q - p) / |q - p|.
/// Guard that the source lacks: it divides by no less than L0 / 2, or a crushed spring would get without bound stiff. Zero for a spring
/// crushed to a point, which has no direction.
Vec3 spring_force(const Vec3& p, const Vec3& q, double rest, double unit);

class SpringNet {
public:
    SpringNet() = default;
    /// rest: P positions; fixed: P, not 0 for particles that step() leaves alone. springs in force-free length at rest.
    SpringNet(const Points& rest, std::vector<char> fixed, std::vector<Spring> springs);

    /// x+ = 2 x - x- + (dt^2 / m) (F - (c / dt) (x - x-)), m = 1, lengths in units u; no particle goes farther than longest_step
    /// of the mean spring in one step. A position that would not be finite is refused: the particle stays, at rest.
    /// Returns how many were refused.
    std::size_t step(double dt, double damping);

    /// Where particle i is put: without changing its velocity (carried), with none (stopped); or a way that becomes velocity (moved).
    void carry_to(std::size_t i, const Vec3& p);
    void stop_at(std::size_t i, const Vec3& p);
    void move(std::size_t i, const Vec3& way) { x_[i] += way; }

    const Points& positions() const { return x_; }
    const Points& before() const { return before_; }
    bool fixed(std::size_t i) const { return fixed_[i] != 0; }
    const std::vector<Spring>& springs() const { return springs_; }
    double mean_length() const { return mean_; }
    /// u, scene units: the mean spring length, or as much less that no eigenvalue of the stiffness matrix at rest, in u = 1,
    /// exceeds stiffest. A common factor of all forces: it changes how fast the net settles, not where.
    double unit() const { return unit_; }
    std::size_t bytes() const { return bytes_of(x_, before_, force_, fixed_, springs_); }

    /// Verlet with c dt = 0.4, dt = 0.4 is stable up to 2 (2 - c dt) / dt^2 = 20; a spring at half its length is four times as stiff.
    static constexpr double stiffest = 8.0;
    static constexpr double longest_step = 0.25;

private:
    double largest_eigenvalue() const;

    Points x_, before_, force_;
    std::vector<char> fixed_;
    std::vector<Spring> springs_;
    double mean_ = 0, unit_ = 1;
};

} // namespace fascicle::mass_spring
