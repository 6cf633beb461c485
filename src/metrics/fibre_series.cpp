#include "fascicle/metrics/fibre_series.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/metrics/percentile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace fascicle {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void append_degrees(std::vector<double>& to, const std::vector<double>& radians) {
    for (const double angle : radians)
        to.push_back(angle * 180.0 / std::numbers::pi);
}

} // namespace

Band band_of(std::span<const double> values) {
    static constexpr std::array<double, 7> percents{0, 5, 25, 50, 75, 95, 100};
    std::vector<double> finite, p;
    double sum = 0.0;
    for (const double v : values)
        if (std::isfinite(v)) {
            finite.push_back(v);
            sum += v;
        }
    percentiles(finite, percents, p);
    const double mean = finite.empty() ? nan : sum / static_cast<double>(finite.size());
    return {finite.size(), mean, p[0], p[1], p[2], p[3], p[4], p[5], p[6]};
}

std::span<const FibreQuantityRow> fibre_quantities() {
    static constexpr std::array<FibreQuantityRow, 5> rows{{
        {FibreQuantity::length, "length_mm", "Fibre length", "mm", "Length of the fibre along its points."},
        {FibreQuantity::strain, "strain", "Fibre strain", "1",
         "Change of length against the length at rest."},
        {FibreQuantity::moment_arm, "moment_arm_mm", "Moment arm", "mm",
         "Shortening per radian of flexion: positive for what bends the joint the way the motion does."},
        {FibreQuantity::pennation_origin, "pennation_origin_deg", "Pennation at the origin", "deg",
         "Angle of the first fifth of the fibre to the line of action there."},
        {FibreQuantity::pennation_insertion, "pennation_insertion_deg", "Pennation at the insertion", "deg",
         "Angle of the last fifth of the fibre to the line of action there."},
    }};
    return rows;
}

FibreSeries::FibreSeries(std::string muscle, double unit_mm, double sign, ArmOptions arms,
                         PennationOptions pennation)
    : muscle_(std::move(muscle)), unit_mm_(unit_mm), sign_(sign), arm_options_(arms),
      pennation_options_(pennation) {
    FASCICLE_ASSERT(unit_mm > 0.0 && (sign == 1.0 || sign == -1.0));
}

void FibreSeries::append(int frame, double angle_rad, const FibreSet& fibres) {
    const std::string where = "fibres of " + muscle_ + ", frame " + std::to_string(frame);
    check_fibres(fibres, where);
    if (!std::isfinite(angle_rad))
        throw_error(where, "the joint angle is not finite", "an angle in radians");
    if (!frames_.empty() && (fibres.count != rest_.count || fibres.segments != rest_.segments))
        throw_error(where,
                    std::to_string(fibres.count) + " fibres of " + std::to_string(fibres.segments) +
                        " segments",
                    std::to_string(rest_.count) + " of " + std::to_string(rest_.segments) + " as at rest");
    FASCICLE_ASSERT(frames_.empty() || frame > frames_.back());
    if (frames_.empty())
        rest_ = fibres;
    fibre_lengths(fibres, row_);
    for (const double length : row_)
        lengths_mm_.push_back(unit_mm_ * length);
    const Pennation pennation = fibre_pennation(fibres, pennation_options_);
    append_degrees(pennation_origin_, pennation.origin_rad);
    append_degrees(pennation_insertion_, pennation.insertion_rad);
    angles_.push_back(angle_rad);
    frames_.push_back(frame);
}

int FibreSeries::index_of(int frame) const {
    const auto found = std::lower_bound(frames_.begin(), frames_.end(), frame);
    return found != frames_.end() && *found == frame ? static_cast<int>(found - frames_.begin()) : -1;
}

const std::vector<double>& FibreSeries::arms() const {
    if (arms_frames_ == frames_.size())
        return arms_mm_;
    arms_mm_.resize(lengths_mm_.size(), nan);
    std::vector<MotionSpan> spans = motion_spans(angles_);
    // Spans that are as they were keep their arms, but the last, whose frames that stand still may have grown.
    std::size_t from = 0;
    while (from + 1 < spans.size() && from < arms_spans_.size() && spans[from] == arms_spans_[from])
        ++from;
    update_arms(spans, from, angles_, lengths_mm_, rest_.count, sign_, arm_options_, arms_mm_);
    arms_spans_ = std::move(spans);
    arms_frames_ = frames_.size();
    return arms_mm_;
}

double FibreSeries::value(FibreQuantity quantity, int k, int f) const {
    const std::size_t i = at(k, f);
    switch (quantity) {
    case FibreQuantity::length:
        return lengths_mm_[i];
    case FibreQuantity::strain: {
        const double rest = lengths_mm_[static_cast<std::size_t>(f)];
        return rest > 0.0 ? (lengths_mm_[i] - rest) / rest : nan;
    }
    case FibreQuantity::moment_arm:
        return arms()[i];
    case FibreQuantity::pennation_origin:
        return pennation_origin_[i];
    case FibreQuantity::pennation_insertion:
        return pennation_insertion_[i];
    }
    return nan;
}

std::vector<double> FibreSeries::values(FibreQuantity quantity, int k) const {
    std::vector<double> result;
    for (int f = 0; f < rest_.count; ++f)
        result.push_back(value(quantity, k, f));
    return result;
}

std::vector<double> FibreSeries::course(FibreQuantity quantity, int f) const {
    std::vector<double> result;
    for (int k = 0; k < frame_count(); ++k)
        result.push_back(value(quantity, k, f));
    return result;
}

Band FibreSeries::band(FibreQuantity quantity, int k) const {
    return band_of(values(quantity, k));
}

} // namespace fascicle
