#pragma once
// From what was measured to what a plot draws, with the state of the view: hidden curves, axis, hovered fibre.

#include "editor/plot_data.hpp"
#include "view/chart.hpp"

namespace fascicle::editor {

/// In the legend, and in EditorState::hidden_curves.
inline constexpr const char* all_lines = "line muscles";

/// The input points into data, until the next change of it. theme: of the colours, null for the interface's.
PlotInput plot_input(const EditorContext& context, PlotData& data, const PlotRow& row,
                     const Theme* theme = nullptr);
/// Whether the axis of x shows angles.
bool axis_of_angles(const EditorContext& context);
/// The visible part of x, within what there is.
PlotRange plot_x(const EditorContext& context, const PlotInput& input);
void set_plot_x(EditorContext& context, const PlotRange& range);

/// Axis of x, playhead and hover line, as in all plots. Curves of the motion as planned lie at input.frame_x.
void set_plot_axis(const EditorContext& context, const PlotData& data, PlotInput& input);
/// Draws with the shared range and the plot's own; playhead, hover line and ranges follow the pointer.
PlotResult draw_shared_plot(EditorContext& context, PlotData& data, const char* id, const Rect& rect,
                            const PlotInput& input);

/// What is on the screen as a chart for files: same curves, same part, same axis.
view::Chart plot_chart(const EditorContext& context, PlotData& data, const PlotRow& row, bool dark);

/// "Edge stiffness 0.9, now 0.5", a line each, of the parameters that differ; at most `most` lines and a last one that says how
/// many more. Empty when all are equal.
std::string differing_parameters(const ParamSet& kept, const ParamSet& now, std::size_t most = 8);

} // namespace fascicle::editor
