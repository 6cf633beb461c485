#pragma once
// Where values are on the screen: what painting and pointer of a plot share.

#include "editor/widgets/plot.hpp"

namespace fascicle::editor {

struct PlotAxes {
    Rect area;
    double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
    float x(double value) const {
        return area.min.x + static_cast<float>((value - x0) / (x1 - x0)) * area.width();
    }
    float y(double value) const {
        return area.max.y - static_cast<float>((value - y0) / (y1 - y0)) * area.height();
    }
    double value_x(float px) const { return x0 + double(px - area.min.x) / double(area.width()) * (x1 - x0); }
    double value_y(float px) const {
        return y0 + double(area.max.y - px) / double(area.height()) * (y1 - y0);
    }
};

/// x of a frame of the timeline.
double frame_position(const PlotInput& input, double frame);
/// Range of y of what is visible, with some air.
PlotRange fitted_y(const PlotInput& input, const PlotRange& x);

/// Grid, curves, lines, playhead; all inside axes.area but the labels.
void paint_plot(ImDrawList& list, const char* id, const PlotAxes& axes, const PlotInput& input, PlotInk& ink,
                const Theme& theme, float scale);
/// Pointer inside the axes: scrub, pan, zoom, fit, menu; what is under it.
void handle_plot_pointer(const char* id, const PlotAxes& axes, const PlotInput& input, PlotGesture& gesture,
                         const Theme& theme, float scale, PlotResult& result);

} // namespace fascicle::editor
