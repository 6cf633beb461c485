#pragma once
// The fibres of one muscle in a run: carried along with the surface, and measured.

#include "fascicle/metrics/fibre_series.hpp"
#include "fascicle/scene/recording.hpp"

namespace fascicle {

class FibreMeasure {
public:
    /// rest: frame 0 of the recording; muscle: its index in the scene. The model is not null.
    FibreMeasure(const Scene& scene, int muscle, FibreModelPtr model, const Frame& rest);

    /// Measures a frame; what follows is about it. Frames that come in ascending order are kept in the series. volume: that of the
    /// muscle in this frame, cubed scene units.
    void measure(const Frame& frame, double volume);

    const FibreModel& model() const { return *model_; }
    const FibreSet& fibres() const { return fibres_; }
    /// Millimetres, a ratio, degrees (mean of both ends), over the fibres.
    const Band& length_mm() const { return length_; }
    const Band& strain() const { return strain_; }
    double pennation_deg() const { return pennation_deg_; }
    double pcsa_cm2() const { return pcsa_cm2_; }
    double line_length_mm() const { return line_length_mm_; } ///< between the means of origins and insertions
    /// Of the frames so far, rest first. Moment arms are known there.
    const FibreSeries& series() const { return series_; }

private:
    /// What frame k of a series tells.
    void read(const FibreSeries& series, int k, double volume);

    int muscle_;
    FibreModelPtr model_;
    FibreSet fibres_;
    FibreSet rest_;
    FibreSeries series_;
    Band length_, strain_;
    double pennation_deg_ = 0, pcsa_cm2_ = 0, line_length_mm_ = 0;
};

} // namespace fascicle
