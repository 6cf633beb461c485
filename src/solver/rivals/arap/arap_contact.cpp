#include "solver/rivals/arap/arap_contact.hpp"

#include "fascicle/base/parallel.hpp"

#include <algorithm>

namespace fascicle::solver {

namespace {

constexpr std::size_t chunk = 1024;

struct Nearest {
    double value = 0;
    Vec3 normal = Vec3::Zero(); ///< unit, or zero where the grid has no slope
};

Nearest look(const Vec3& x, std::span<const ContactSolid> solids) {
    std::size_t nearest = 0;
    double least = solids[0].grid->value(solids[0].now.apply_inverse(x));
    for (std::size_t b = 1; b < solids.size(); ++b)
        if (const double value = solids[b].grid->value(solids[b].now.apply_inverse(x)); value < least) {
            least = value;
            nearest = b;
        }
    const ContactSolid& solid = solids[nearest];
    const Vec3 slope = solid.now.rotation * solid.grid->sample(solid.now.apply_inverse(x)).gradient;
    const double size = slope.norm();
    return {least, size > 0.0 ? Vec3(slope / size) : Vec3::Zero()};
}

} // namespace

ArapContact::ArapContact(std::size_t vertices, double strength, double limit, int threads)
    : held_(vertices, 0), next_(vertices, 0), multiplier_(vertices, 0.0), strength_(strength), limit_(limit),
      threads_(threads) {}

bool ArapContact::choose(const Points& x, const std::vector<double>& inverse_mass,
                         std::span<const ContactSolid> solids, const ContactSettings& settings,
                         bool release) {
    if (solids.empty())
        return false;
    parallel_for(threads_, x.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            next_[i] = held_[i];
            if (inverse_mass[i] == 0.0 || (held_[i] != 0 && (!release || multiplier_[i] > 0.0)))
                continue;
            next_[i] = 0;
            for (const ContactSolid& solid : solids)
                if (solid.grid->value(solid.now.apply_inverse(x[i])) < settings.offset)
                    next_[i] = 1;
        }
    });
    if (next_ == held_)
        return false;
    held_.swap(next_);
    return true;
}

void ArapContact::add_targets(const Points& x, const ArapCells& cells, std::span<const ContactSolid> solids,
                              const ContactSettings& settings, Points& b) {
    parallel_for(threads_, x.size(), chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (held_[i] == 0)
                continue;
            const Nearest nearest = look(x[i], solids);
            const double old = multiplier_[i];
            if (nearest.normal.isZero(0.0)) { // deep inside: no way out to be pushed along
                b[i] += strength_ * cells.weight_at(i) * x[i];
                continue;
            }
            multiplier_[i] = std::clamp(settings.offset - nearest.value + old, 0.0, limit_);
            b[i] += strength_ * cells.weight_at(i) * (x[i] + (2.0 * multiplier_[i] - old) * nearest.normal);
        }
    });
}

void ArapContact::add_penalties(const ArapCells& cells, std::vector<double>& penalties) const {
    for (std::size_t i = 0; i < held_.size(); ++i)
        if (held_[i] != 0)
            penalties[i] += strength_ * cells.weight_at(i);
}

std::size_t ArapContact::held() const {
    return static_cast<std::size_t>(std::count(held_.begin(), held_.end(), 1));
}

} // namespace fascicle::solver
