#include "fascicle/metrics/fibre_measure.hpp"

#include <limits>
#include <numbers>

namespace fascicle {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

} // namespace

FibreMeasure::FibreMeasure(const Scene& scene, int muscle, FibreModelPtr model, const Frame& rest)
    : muscle_(muscle), model_(std::move(model)), fibres_(model_->rest),
      series_(scene.muscles.at(static_cast<std::size_t>(muscle)).name, millimetres_per_unit(scene.unit),
              flexion_sign(scene.timeline)) {
    model_->carrier.carry(*rest.muscle_positions.at(static_cast<std::size_t>(muscle)), fibres_.points);
    rest_ = fibres_;
}

void FibreMeasure::measure(const Frame& frame, double volume) {
    model_->carrier.carry(*frame.muscle_positions.at(static_cast<std::size_t>(muscle_)), fibres_.points);
    const int count = series_.frame_count();
    const int last = count > 0 ? series_.frame(count - 1) : -1;
    if (frame.index > last) {
        if (count == 0 && frame.index > 0)
            series_.append(0, 0.0, rest_);
        series_.append(frame.index, frame.angle_rad, fibres_);
    }
    const double unit_mm = series_.unit_mm();
    const std::vector<double> lengths = fibre_lengths(fibres_);
    std::vector<double> lengths_mm = lengths;
    for (double& l : lengths_mm)
        l *= unit_mm;
    length_ = band_of(lengths_mm);
    strain_ = band_of(fibre_strains(lengths, fibre_lengths(rest_)));
    const double pennation = mean_pennation_rad(fibre_pennation(fibres_));
    pennation_deg_ = degrees * pennation;
    pcsa_cm2_ = fascicle::pcsa_cm2(volume, pennation, length_.mean / unit_mm, unit_mm);
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    for (int f = 0; f < fibres_.count; ++f) {
        from += fibres_.fibre(f).front();
        to += fibres_.fibre(f).back();
    }
    line_length_mm_ = fibres_.count > 0 ? unit_mm * (to - from).norm() / fibres_.count
                                        : std::numeric_limits<double>::quiet_NaN();
}

} // namespace fascicle
