#include "fascicle/anatomy/fibre_architecture.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fascicle {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const Vec3& end_point(const FibreSet& fibres, int f, FibreEnd end) {
    const std::span<const Vec3> fibre = fibres.fibre(f);
    return end == FibreEnd::origin ? fibre.front() : fibre.back();
}

Vec3 mean_end(const FibreSet& fibres, FibreEnd end) {
    Vec3 sum = Vec3::Zero();
    for (int f = 0; f < fibres.count; ++f)
        sum += end_point(fibres, f, end);
    return fibres.count > 0 ? Vec3(sum / fibres.count) : sum;
}

/// Mean of those that are defined.
double mean_of(std::span<const double> values) {
    double sum = 0.0;
    std::size_t n = 0;
    for (const double v : values)
        if (std::isfinite(v)) {
            sum += v;
            ++n;
        }
    return n > 0 ? sum / static_cast<double>(n) : nan;
}

/// Angle in [0, pi] of two unit vectors, exact near 0 and pi too; NaN when one is zero.
double angle_between(const Vec3& a, const Vec3& b) {
    if (a.isZero(0.0) || b.isZero(0.0))
        return nan;
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The mean of the tangents; where they cancel, what leads from origin to insertion on the whole.
Vec3 mean_direction(const FibreSet& fibres, const Points& tangents) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& t : tangents)
        sum += t;
    if (sum.norm() <= 1e-9 * fibres.count)
        sum = mean_end(fibres, FibreEnd::insertion) - mean_end(fibres, FibreEnd::origin);
    return sum.stableNormalized();
}

LineOfAction line_from(const FibreSet& fibres, FibreEnd end, const Points& tangents,
                       const PennationOptions& options) {
    LineOfAction line;
    line.point = mean_end(fibres, end);
    line.direction = mean_direction(fibres, tangents);
    line.axis_r2 = nan;
    Mat3 scatter = Mat3::Zero();
    for (int f = 0; f < fibres.count; ++f) {
        const Vec3 d = end_point(fibres, f, end) - line.point;
        scatter += d * d.transpose();
    }
    if (!(scatter.trace() > 0.0) || !scatter.allFinite())
        return line;
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(scatter / scatter.trace());
    line.axis_r2 = std::min(1.0, axes.eigenvalues()[2]); // what the axis leaves over is the other two
    // Two ends are always on a line: they say nothing.
    if (fibres.count < 3 || !(line.axis_r2 > options.axis_r2))
        return line;
    Vec3 axis = axes.eigenvectors().col(2).normalized();
    if (axis.dot(line.direction) < 0.0)
        axis = -axis;
    if (angle_between(axis, line.direction) <= options.axis_within_rad) { // false for NaN
        line.direction = axis;
        line.along_ends = true;
    }
    return line;
}

} // namespace

Points end_tangents(const FibreSet& fibres, FibreEnd end, double share) {
    FASCICLE_ASSERT(share > 0.0 && share <= 1.0);
    Points tangents(static_cast<std::size_t>(fibres.count), Vec3::Zero());
    const std::vector<double> lengths = fibre_lengths(fibres);
    for (std::size_t f = 0; f < tangents.size(); ++f) {
        const std::span<const Vec3> fibre = fibres.fibre(static_cast<int>(f));
        const std::size_t last = fibre.size() - 1;
        const auto at = [&](std::size_t j) { return end == FibreEnd::origin ? fibre[j] : fibre[last - j]; };
        double left = share * lengths[f];
        Vec3 reached = at(0);
        for (std::size_t j = 0; j < last && left > 0.0; ++j) {
            const Vec3 step = at(j + 1) - at(j);
            const double l = step.norm();
            reached = l <= left ? at(j + 1) : Vec3(at(j) + step * (left / l));
            left -= l;
        }
        const Vec3 chord = end == FibreEnd::origin ? Vec3(reached - at(0)) : Vec3(at(0) - reached);
        if (chord.norm() > 1e-12 * lengths[f])
            tangents[f] = chord.stableNormalized();
    }
    return tangents;
}

LineOfAction line_of_action(const FibreSet& fibres, FibreEnd end, const PennationOptions& options) {
    return line_from(fibres, end, end_tangents(fibres, end, options.end_share), options);
}

LineOfAction muscle_line(const FibreSet& fibres) {
    const Vec3 origin = mean_end(fibres, FibreEnd::origin);
    const Vec3 direction = mean_end(fibres, FibreEnd::insertion) - origin;
    return {origin, direction.isZero(0.0) ? direction : direction.stableNormalized().eval(), nan, false};
}

Pennation fibre_pennation(const FibreSet& fibres, const PennationOptions& options) {
    Pennation result;
    for (const FibreEnd end : {FibreEnd::origin, FibreEnd::insertion}) {
        const Points tangents = end_tangents(fibres, end, options.end_share);
        LineOfAction& line = end == FibreEnd::origin ? result.origin_line : result.insertion_line;
        std::vector<double>& angles = end == FibreEnd::origin ? result.origin_rad : result.insertion_rad;
        line = line_from(fibres, end, tangents, options);
        for (const Vec3& t : tangents)
            angles.push_back(angle_between(t, line.direction));
    }
    return result;
}

double mean_pennation_rad(const Pennation& pennation) {
    std::vector<double> all = pennation.origin_rad;
    all.insert(all.end(), pennation.insertion_rad.begin(), pennation.insertion_rad.end());
    return mean_of(all);
}

double pcsa_cm2(double volume, double mean_pennation_rad, double mean_length, double unit_mm) {
    if (!(mean_length > 0.0))
        return nan;
    return volume * std::cos(mean_pennation_rad) / mean_length * unit_mm * unit_mm / 100.0; // mm2 to cm2
}

double fibre_cover_percent(const FibreSet& fibres, double volume, int threads) {
    if (!(volume > 0.0) || fibres.count < 2)
        return nan;
    const std::vector<double> lengths = fibre_lengths(fibres), radii = fibre_radii(fibres, threads);
    double sum = 0.0;
    for (std::size_t f = 0; f < lengths.size(); ++f)
        sum += std::numbers::pi * radii[f] * radii[f] * lengths[f];
    return 100.0 * sum / volume;
}

namespace {

/// The same fibres with at most about 20 segments, of the points they have: distances between neighbours need no more.
FibreSet thinned(const FibreSet& fibres) {
    constexpr int enough = 20;
    if (fibres.segments <= enough)
        return fibres;
    FibreSet thin{fibres.count, enough, {}};
    for (int f = 0; f < fibres.count; ++f)
        for (int j = 0; j <= enough; ++j)
            thin.points.push_back(fibres.fibre(
                f)[static_cast<std::size_t>(j) * static_cast<std::size_t>(fibres.segments) / enough]);
    return thin;
}

} // namespace

MuscleArchitecture muscle_architecture(const FibreSet& fibres, double volume, double unit_mm,
                                       const std::string& muscle, int threads,
                                       const PennationOptions& options) {
    check_fibres(fibres, muscle);
    const double degrees = 180.0 / std::numbers::pi;
    const std::vector<double> lengths = fibre_lengths(fibres);
    const Pennation pennation = fibre_pennation(fibres, options);
    MuscleArchitecture result;
    const double mean = mean_of(lengths), angle = mean_pennation_rad(pennation);
    result.length_mean_mm = unit_mm * mean;
    const auto [least, most] = std::minmax_element(lengths.begin(), lengths.end());
    result.length_min_mm = lengths.empty() ? nan : unit_mm * *least;
    result.length_max_mm = lengths.empty() ? nan : unit_mm * *most;
    result.pennation_origin_deg = degrees * mean_of(pennation.origin_rad);
    result.pennation_insertion_deg = degrees * mean_of(pennation.insertion_rad);
    result.pennation_mean_deg = degrees * angle;
    result.pcsa_cm2 = fascicle::pcsa_cm2(volume, angle, mean, unit_mm);
    result.cover_percent = fibre_cover_percent(thinned(fibres), volume, threads);
    result.line = muscle_line(fibres);
    return result;
}

} // namespace fascicle
