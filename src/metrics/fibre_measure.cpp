#include "fascicle/metrics/fibre_measure.hpp"

#include <limits>
#include <numbers>

namespace fascicle {

namespace {

constexpr double radians = std::numbers::pi / 180.0;

} // namespace

FibreMeasure::FibreMeasure(const Scene& scene, int muscle, FibreModelPtr model, const Frame& rest)
    : muscle_(muscle), model_(std::move(model)), fibres_(model_->rest),
      series_(scene.muscles.at(static_cast<std::size_t>(muscle)).name, millimetres_per_unit(scene.unit),
              flexion_sign(scene)) {
    model_->carrier.carry(*rest.muscle_positions.at(static_cast<std::size_t>(muscle)), fibres_.points);
    rest_ = fibres_;
}

void FibreMeasure::measure(const Frame& frame, double volume) {
    model_->carrier.carry(*frame.muscle_positions.at(static_cast<std::size_t>(muscle_)), fibres_.points);
    if (series_.frame_count() == 0 && frame.index > 0)
        series_.append(0, 0.0, rest_);
    if (series_.frame_count() == 0 || frame.index > series_.frame(series_.frame_count() - 1))
        series_.append(frame.index, frame.angle_rad, fibres_);
    if (const int k = series_.index_of(frame.index); k >= 0) {
        read(series_, k, volume);
    } else { // a frame that was left out on the way
        FibreSeries aside(series_.muscle(), series_.unit_mm(), series_.sign());
        aside.append(0, 0.0, rest_);
        aside.append(frame.index, frame.angle_rad, fibres_);
        read(aside, 1, volume);
    }
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    for (int f = 0; f < fibres_.count; ++f) {
        from += fibres_.fibre(f).front();
        to += fibres_.fibre(f).back();
    }
    line_length_mm_ = fibres_.count > 0 ? series_.unit_mm() * (to - from).norm() / fibres_.count
                                        : std::numeric_limits<double>::quiet_NaN();
}

void FibreMeasure::read(const FibreSeries& series, int k, double volume) {
    length_ = series.band(FibreQuantity::length, k);
    strain_ = series.band(FibreQuantity::strain, k);
    std::vector<double> angles = series.values(FibreQuantity::pennation_origin, k);
    const std::vector<double> others = series.values(FibreQuantity::pennation_insertion, k);
    angles.insert(angles.end(), others.begin(), others.end());
    pennation_deg_ = band_of(angles).mean;
    const double unit_mm = series.unit_mm();
    pcsa_cm2_ = fascicle::pcsa_cm2(volume, radians * pennation_deg_, length_.mean / unit_mm, unit_mm);
}

} // namespace fascicle
