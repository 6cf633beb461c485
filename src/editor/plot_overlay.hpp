#pragma once
// Measured or published curves from a csv, to be drawn over a plot.

#include "fascicle/motion/timeline.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace fascicle::editor {

/// A column beside the first. y may hold gaps (NaN).
struct OverlayCurve {
    std::string name;
    std::vector<double> x, y;                ///< x: frames, seconds or degrees
    std::vector<double> frames{}, degrees{}; ///< the same places on the axes of a scene: place_overlay()
};

struct PlotOverlay {
    enum class Axis { frame, seconds, degrees };
    std::string name; ///< of the file
    std::string plot; ///< id of the plot that it lies over
    Axis axis = Axis::frame;
    std::vector<OverlayCurve> curves;
};

/// First column: frame, time (s or ms) or angle (deg or rad), by its name; every further column a curve, in the plot's unit;
/// empty cells are passed over, "nan" is a gap. Error naming file and line when it is something else, has no curve, more than 64, or is larger than 64 MB.
PlotOverlay read_overlay(const std::filesystem::path& file, const std::string& plot);

void place_overlay(PlotOverlay& overlay, double frame_seconds, const Timeline& timeline,
                   const std::vector<double>& planned_degrees);

/// Places on an axis of frames (fractional), or of degrees. Where an angle is asked for by frame, that of the way out is
/// taken; NaN where the motion does not come there. frame_seconds > 0.
std::vector<double> overlay_frames(PlotOverlay::Axis axis, std::span<const double> x, double frame_seconds,
                                   const std::vector<double>& planned_degrees);
std::vector<double> overlay_degrees(PlotOverlay::Axis axis, std::span<const double> x, double frame_seconds,
                                    const Timeline& timeline);

} // namespace fascicle::editor
