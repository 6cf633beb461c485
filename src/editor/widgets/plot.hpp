#pragma once
// A curve plot with a playhead. All plots share one range of x, one playhead and one hover line.

#include "editor/plot_state.hpp"
#include "editor/widgets/paint.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace fascicle::editor {

enum class LineStyle { solid, dashed, dotted };

/// y[k]: value at x[k], or at frame k when x is empty; not finite: a gap. low, high: a band around it, of the same length or
/// empty. Views: whoever makes the input keeps the numbers until the plot is drawn.
struct PlotCurve {
    std::string name;
    ImU32 colour = 0;
    std::span<const double> x, y, low, high;
    std::span<const std::size_t> turns; ///< samples where another branch begins; those are dotted
    LineStyle style = LineStyle::solid;
    bool ghost = false;  ///< of an earlier run: thin, pale, not in the legend
    bool hidden = false; ///< stays in the legend
    bool in_legend = true;
    bool end_name = false; ///< named at its end instead
    float width = 1.8f;    ///< pixels at scale 1; 0: only the band
    float band = 0.16f;    ///< opacity
    std::uint64_t run = 0; ///< that a ghost is of
    bool by_frame = true;  ///< sample k belongs to frame k
};

/// Many thin lines of one colour, frame-major: value of line i at frame k is values[k * count + i].
struct PlotBundle {
    std::string name;
    ImU32 colour = 0;
    std::span<const double> x; ///< per frame; empty: the frame
    const double* values = nullptr;
    std::size_t count = 0, frames = 0;
    std::span<const double> least, most; ///< per frame
    int highlighted = -1;
    std::uint64_t version = 0; ///< of the values: differs when they do
};

/// Lines of bundles as they were laid out last, so that an unchanged plot is not laid out again.
struct BundleInk {
    std::uint64_t version = 0;
    std::array<double, 8> place{};
    std::vector<std::vector<ImVec2>> lines;
};
/// By name of plot and bundle.
using PlotInk = std::map<std::string, BundleInk>;

struct PlotInput {
    std::string title, unit, tooltip;
    std::string x_label; ///< with unit: "frame", "time [s]"
    double x_unit = 1;   ///< what the axis writes for x = 1: seconds of a frame, else 1
    PlotRange x_limits;  ///< all there is
    double least_x_span = 5;
    std::span<const double> frame_x; ///< x of each frame of the timeline; empty: the frame itself
    std::span<const std::size_t> frame_turns;
    std::vector<PlotCurve> curves;
    std::vector<PlotBundle> bundles;
    double playhead = 0;         ///< frame
    std::optional<double> hover; ///< frame under the pointer in any plot or the ruler
    double last_frame = 1;
    std::optional<double> reference; ///< a dashed line at this value, e.g. 1 for a ratio
    double least_span = 1e-6;        ///< noise below this is not blown up to full height
    std::string empty_text;          ///< shown without curves
    bool maximisable = true;         ///< it has a button that shows it alone
    bool maximised = false;          ///< it is shown alone
    bool compact = false;            ///< over the view: translucent, takes no pointer
};

struct PlotResult {
    std::optional<double> moved_to; ///< the playhead was put here
    std::optional<double> hovered;
    int toggled = -1;       ///< index of the curve whose legend entry was clicked
    int isolated = -1;      ///< or double-clicked
    int hovered_curve = -1; ///< the ghost under the pointer
    int hovered_bundle = -1, hovered_line = -1;
    bool maximise = false;         ///< the button that shows it alone, or all again
    bool menu = false;             ///< right click
    bool fit = false;              ///< double-click: shows all of x and y
    std::optional<PlotRange> x, y; ///< the visible part is to be this
};

/// id: also the widget's name for tests ("plot/..."), with "/area" for the part inside the axes. x: visible part; y: the chosen
/// one, null where it fits.
PlotResult draw_plot(const char* id, const Rect& rect, const PlotInput& input, const PlotRange& x,
                     const PlotRange* y, PlotGesture& gesture, PlotInk& ink, const Theme& theme, float scale);

} // namespace fascicle::editor
