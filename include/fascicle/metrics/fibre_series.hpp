#pragma once
// What the fibres of one muscle do over a run: a number per frame and fibre, and bands over the fibres.

#include "fascicle/anatomy/fibre_architecture.hpp"
#include "fascicle/metrics/moment_arm.hpp"

namespace fascicle {

/// Order statistics over fibres, of the values that are finite; all NaN when none is. Percentiles as percentile.hpp.
struct Band {
    std::size_t count = 0;
    double mean = 0, min = 0, p5 = 0, p25 = 0, p50 = 0, p75 = 0, p95 = 0, max = 0;
};
Band band_of(std::span<const double> values);

/// What is known per frame and fibre; the order of fibre_quantities() and of the columns of fibres.csv.
enum class FibreQuantity { length, strain, moment_arm, pennation_origin, pennation_insertion };

struct FibreQuantityRow {
    FibreQuantity quantity;
    const char* key;   ///< column name in fibres.csv, unit as suffix
    const char* label; ///< shown to people
    const char* unit;
    const char* meaning;
};
std::span<const FibreQuantityRow> fibre_quantities();

/// K frames of F fibres, appended one by one; the first is rest. Keeps numbers, not points (4 doubles per frame and
/// fibre: 2,000 fibres over 300 frames are 19 MB) and the points of rest. Not thread-safe.
class FibreSeries {
public:
    /// muscle: its name, for messages and files. unit_mm: millimetres in a scene unit. sign: flexion_sign() of the
    /// run's timeline (known before the frames are; a sign taken from the frames so far could change).
    FibreSeries(std::string muscle, double unit_mm, double sign, ArmOptions arms = {},
                PennationOptions pennation = {});

    /// Frames in ascending order. Error naming muscle, frame and fibre when a point or the angle is not finite, or when
    /// the fibres are not those of rest (other number, other number of segments); the series is then as before.
    void append(int frame, double angle_rad, const FibreSet& fibres);

    const std::string& muscle() const { return muscle_; }
    double unit_mm() const { return unit_mm_; }
    double sign() const { return sign_; }
    int fibre_count() const { return rest_.count; } ///< 0 before the first frame
    int frame_count() const { return static_cast<int>(frames_.size()); }
    int frame(int k) const { return frames_[static_cast<std::size_t>(k)]; }
    double angle_rad(int k) const {
        return angles_[static_cast<std::size_t>(k)];
    } ///< as in metrics.csv, no sign
    const FibreSet& rest() const { return rest_; }
    /// Index k of a frame number, -1 when it is not there.
    int index_of(int frame) const;

    /// F values of frame k, millimetres; strain dimensionless; pennation in degrees; moment arms in millimetres per
    /// radian. Lengths and arms of the frames so far, see excursion_arms: the arms of the span that is still going
    /// on change with every frame, those of earlier ones do not. Arms are brought up to date when asked for.
    std::vector<double> values(FibreQuantity quantity, int k) const;
    double value(FibreQuantity quantity, int k, int f) const;
    /// The course of one fibre over the frames, K values.
    std::vector<double> course(FibreQuantity quantity, int f) const;
    Band band(FibreQuantity quantity, int k) const;

private:
    std::size_t at(int k, int f) const {
        return static_cast<std::size_t>(k) * static_cast<std::size_t>(rest_.count) +
               static_cast<std::size_t>(f);
    }
    const std::vector<double>& arms() const;

    std::string muscle_;
    double unit_mm_, sign_;
    ArmOptions arm_options_;
    PennationOptions pennation_options_;
    FibreSet rest_;
    std::vector<int> frames_;
    std::vector<double> angles_;                                              ///< K
    std::vector<double> lengths_mm_, pennation_origin_, pennation_insertion_; ///< K x F; angles in degrees
    std::vector<double> row_;                                                 ///< kept between calls

    mutable std::vector<double> arms_mm_; ///< K x F, of the first arms_frames_ frames
    mutable std::vector<MotionSpan> arms_spans_;
    mutable std::size_t arms_frames_ = 0;
};

} // namespace fascicle
