#include "fascicle/metrics/dihedral_change.hpp"

#include "fascicle/geometry/dihedral_angle.hpp"
#include "fascicle/metrics/percentile.hpp"

#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

std::optional<double> angle(const Dihedral& d, const Points& points) {
    const auto at = [&](int v) -> const Vec3& { return points[static_cast<std::size_t>(v)]; };
    return signed_dihedral_angle(at(d.p0), at(d.p1), at(d.p2), at(d.p3));
}

} // namespace

DihedralChangeMeasure::DihedralChangeMeasure(const std::vector<Dihedral>& dihedrals, const Points& rest) {
    for (const Dihedral& d : dihedrals)
        if (const std::optional<double> theta = angle(d, rest)) {
            dihedrals_.push_back(d);
            rest_angles_.push_back(*theta);
        }
    changes_.reserve(dihedrals_.size());
}

DihedralChange DihedralChangeMeasure::measure(const Points& points) {
    constexpr std::array<double, 5> percents{10, 25, 50, 75, 90};
    changes_.clear();
    double sum = 0.0, unsigned_sum = 0.0;
    std::size_t sharp = 0;
    for (std::size_t i = 0; i < dihedrals_.size(); ++i) {
        const std::optional<double> theta = angle(dihedrals_[i], points);
        if (!theta || !std::isfinite(*theta))
            continue;
        changes_.push_back(std::abs(wrap_angle(*theta - rest_angles_[i])));
        sum += changes_.back();
        unsigned_sum += std::abs(std::abs(*theta) - std::abs(rest_angles_[i]));
        sharp += std::abs(*theta) > 0.5 * std::numbers::pi;
    }
    const auto count = static_cast<double>(changes_.size()); // 0 / 0 is the NaN that is promised
    percentiles(changes_, percents, percentiles_);
    const auto& p = percentiles_;
    return {sum / count,
            p[0],
            p[1],
            p[2],
            p[3],
            p[4],
            unsigned_sum / count * 180.0 / std::numbers::pi,
            static_cast<double>(sharp) / count};
}

} // namespace fascicle
