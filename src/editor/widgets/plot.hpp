#pragma once
// A curve plot over frames with a playhead. All plots share one range of x, one playhead and one hover line.

#include "editor/widgets/paint.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fascicle::editor {

/// y[k]: value at frame k; not finite: a gap. low, high: a band around it, of the same length or empty.
struct PlotCurve {
    std::string name;
    ImU32 colour = 0;
    std::vector<double> y, low, high;
    bool ghost = false;  ///< of an earlier run: thin, pale, not in the legend
    bool hidden = false; ///< stays in the legend
    bool dashed = false; ///< thin, in pieces; named at its end instead of in the legend
};

/// Visible frames, shared.
struct PlotRange {
    double low = 0, high = 300;
};

struct PlotInput {
    std::string title, unit, tooltip;
    std::string x_label;                       ///< with unit: "frame", "time [s]"
    std::function<std::string(double)> x_text; ///< a frame as the axis shows it
    std::vector<PlotCurve> curves;
    double playhead = 0;
    std::optional<double> hover; ///< frame under the pointer in any plot or the ruler
    double last_frame = 1;
    std::optional<double> reference; ///< a dashed line at this value, e.g. 1 for a ratio
    double least_span = 1e-6;        ///< noise below this is not blown up to full height
    std::string empty_text;          ///< shown without curves
};

struct PlotResult {
    std::optional<double> moved_to; ///< the playhead was put here
    std::optional<double> hovered;
    int toggled = -1;  ///< index of the curve whose legend entry was clicked
    int isolated = -1; ///< or double-clicked
};

/// id: also the widget's name for tests ("plot/..."), with "/area" for the part inside the axes.
PlotResult draw_plot(const char* id, const Rect& rect, const PlotInput& input, PlotRange& range,
                     const Theme& theme, float scale);

} // namespace fascicle::editor
