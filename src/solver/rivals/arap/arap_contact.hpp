#pragma once
// Contact inside the alternations of arap, so that shape and contact agree: vertices near solids are held by a penalty whose
// target is found in every local step, as a constraint's projection is in projective dynamics (Bouaziz et al. 2014), with a
// multiplier that makes it exact in the limit (ADMM, Overby et al. 2017). For a vertex with distance phi to the nearest solid,
// wanted at least d, unit normal n, and multiplier m >= 0 (a length):
//   m' = max(0, d - phi + m),   target = x + (2 m' - m) n,   penalty c w_i, w_i the weight of its cell.
// A vertex that pulls away has m' = 0 and is let go in the next pass. It slides: the target never holds it along the solid.

#include "solver/contact/solid_contact.hpp"
#include "solver/rivals/arap/arap_cells.hpp"

namespace fascicle::solver {

class ArapContact {
public:
    ArapContact() = default;
    /// strength: c above; limit: the largest multiplier, scene units.
    ArapContact(std::size_t vertices, double strength, double limit, int threads);

    /// Who is held from now on: whoever was and is still pressed, and all free vertices nearer to a solid than the offset.
    /// Whether that has changed.
    bool choose(const Points& x, const std::vector<double>& inverse_mass,
                std::span<const ContactSolid> solids, const ContactSettings& settings, bool release);
    /// Finds the targets for x and adds their part to the right side b.
    void add_targets(const Points& x, const ArapCells& cells, std::span<const ContactSolid> solids,
                     const ContactSettings& settings, Points& b);
    /// V: adds the penalties of who is held.
    void add_penalties(const ArapCells& cells, std::vector<double>& penalties) const;

    std::size_t held() const;
    /// V: m above, 0 for who is not held.
    const std::vector<double>& multipliers() const { return multiplier_; }
    std::size_t bytes() const { return bytes_of(held_, next_, multiplier_); }

private:
    std::vector<std::uint8_t> held_, next_;
    std::vector<double> multiplier_;
    double strength_ = 1, limit_ = 0;
    int threads_ = 1;
};

} // namespace fascicle::solver
