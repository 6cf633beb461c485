#pragma once
// A chart as plain data: what is plotted, without where on the screen. Drawn by chart_svg() and by the editor's plots.

#include "render/draw_list.hpp"

#include <optional>
#include <string>
#include <vector>

namespace fascicle::view {

/// x, y: one per sample, in the axes' units; y not finite: a gap. low, high: a band around it, of the same length or
/// empty.
struct ChartCurve {
    std::string name; ///< in the legend, once for neighbours of the same name; empty: not there
    render::Rgba colour{0, 0, 0, 1};
    std::vector<double> x, y, low, high;
    bool ghost = false;  ///< of an earlier run: thin, pale
    bool dashed = false; ///< for comparison: measured, a model, the way back
    double width = 1.5;  ///< of the line, in pixels at scale 1; 0: only the band
    double band_opacity = 0.16;
};

struct ChartSpan {
    double low = 0, high = 1;
};

struct Chart {
    std::string title, unit; ///< unit "1" is not written
    std::string x_label;     ///< with its unit
    std::vector<ChartCurve> curves;
    std::optional<double> reference;           ///< a dashed line at this value, e.g. 1 for a ratio
    std::optional<double> playhead;            ///< in the unit of x
    double least_span = 1e-6;                  ///< noise below this is not blown up to full height
    std::optional<ChartSpan> x_range, y_range; ///< nothing: all there is
};

/// "Volume ratio", "Fibre length [mm]".
std::string chart_heading(const Chart& chart);
/// What the axes show: the given range, or that of all samples; of y with some air. Never empty, always finite.
ChartSpan chart_x(const Chart& chart);
ChartSpan chart_y(const Chart& chart);

} // namespace fascicle::view
