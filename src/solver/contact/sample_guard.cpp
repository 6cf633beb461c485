#include "solver/contact/sample_guard.hpp"

#include <algorithm>

namespace fascicle::solver {

namespace {

Vec3 place_of(const ContactSample& sample, const GuardedPoints& points) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        if (sample.weight[k] != 0.0F)
            sum += static_cast<double>(sample.weight[k]) * points.now(sample.corner[k]);
    return sum;
}

} // namespace

bool guard_point(GuardedPoints& points, int point, std::span<const ContactSolid> solids, bool whole_frame,
                 const ContactSettings& settings, GuardCounts& counts) {
    Vec3 x = points.now(point);
    const Vec3 before = whole_frame ? points.at_frame_start(point) : points.before(point);
    switch (clamp_motion(x, before, solids, settings)) {
    case ClampResult::clear:
        return false;
    case ClampResult::slid:
        ++counts.slid;
        break;
    case ClampResult::ejected:
        ++counts.ejected;
        break;
    case ClampResult::impossible:
        ++counts.impossible;
        break;
    }
    points.put(point, x, Vec3::Zero(), true);
    return true;
}

SampleViolation find_violation(const ContactSample& sample, const Vec3& place,
                               std::span<const ContactSolid> solids, const ContactSettings& settings) {
    SampleViolation worst;
    for (std::size_t b = 0; b < solids.size(); ++b) {
        const double limit =
            static_cast<int>(b) == sample.near_solid ? static_cast<double>(sample.limit) : settings.least;
        const double value = solids[b].grid->value(solids[b].now.apply_inverse(place));
        if (value < limit && (worst.solid < 0 || value - limit < worst.value - worst.limit))
            worst = {value, limit, static_cast<int>(b)};
    }
    return worst;
}

void set_guard_counts(StepReport& report, const GuardCounts& vertices, const GuardCounts& samples) {
    report.slid = vertices.slid + samples.slid;
    report.ejected = vertices.ejected + samples.ejected;
    report.impossible = vertices.impossible + samples.impossible;
    report.samples_pushed = samples.pushed;
    report.samples_held = samples.held;
}

void SampleGuard::begin(std::span<const ContactSolid> from_frame_start) {
    frame_ = from_frame_start;
    for (const int point : riders_)
        rides_[static_cast<std::size_t>(point)] = -1;
    riders_.clear();
}

bool SampleGuard::resolve(const ContactSample& sample, int round, GuardedPoints& points,
                          std::span<const ContactSolid> solids, const ContactSettings& settings,
                          GuardCounts& counts) {
    const SampleViolation found = find_violation(sample, place_of(sample, points), solids, settings);
    if (found.solid < 0)
        return false;
    const auto solid = static_cast<std::size_t>(found.solid);
    if (round < push_rounds) {
        // Where it may be nearer than others, not further than it was.
        const double target =
            found.limit < settings.least ? found.limit + 0.1 * settings.offset : settings.offset;
        return push(sample, solid, target - found.value, points, solids, settings, counts);
    }
    return ride(sample, solid, points, settings, counts);
}

bool SampleGuard::push(const ContactSample& sample, std::size_t solid, double depth, GuardedPoints& points,
                       std::span<const ContactSolid> solids, const ContactSettings& settings,
                       GuardCounts& counts) {
    const ContactSolid& by = solids[solid];
    const Vec3 gradient = by.grid->sample(by.now.apply_inverse(place_of(sample, points))).gradient;
    const double norm = gradient.norm();
    double weight = 0;
    for (std::size_t k = 0; k < 3; ++k)
        if (sample.weight[k] != 0.0F && points.is_free(sample.corner[k]))
            weight += static_cast<double>(sample.weight[k]) * static_cast<double>(sample.weight[k]);
    if (norm < 0.3 || weight == 0.0)
        return false; // left to riding
    const Vec3 normal = by.now.rotation * gradient / norm;
    ++counts.pushed;
    for (std::size_t k = 0; k < 3; ++k) {
        const int point = sample.corner[k];
        if (sample.weight[k] == 0.0F || !points.is_free(point))
            continue;
        // A lone free corner of small weight would be thrown far: then several rounds, or riding.
        const double step = std::min(depth / norm * static_cast<double>(sample.weight[k]) / weight,
                                     10.0 * settings.offset + depth / norm);
        points.put(point, points.now(point) + step * normal, normal, false);
        guard_point(points, point, solids, false, settings, counts);
    }
    return true;
}

bool SampleGuard::ride(const ContactSample& sample, std::size_t solid, GuardedPoints& points,
                       const ContactSettings& settings, GuardCounts& counts) {
    bool moved = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const int point = sample.corner[k];
        if (sample.weight[k] == 0.0F || !points.is_free(point))
            continue;
        auto& rides = rides_[static_cast<std::size_t>(point)];
        if (rides >= 0)
            continue; // with this solid already, or held by another
        rides = static_cast<std::int16_t>(solid);
        riders_.push_back(point);
        ++counts.rode;
        const ContactSolid& by = frame_[solid];
        points.put(point, by.now.apply(by.before.apply_inverse(points.at_frame_start(point))), Vec3::Zero(),
                   true);
        guard_point(points, point, frame_, true, settings, counts);
        moved = true;
    }
    counts.held += moved ? 0 : 1;
    return moved;
}

} // namespace fascicle::solver
