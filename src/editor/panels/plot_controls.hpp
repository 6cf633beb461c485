#pragma once
// Menus of the plots: which are shown, the curves of earlier runs, what a right click offers.

#include "editor/plot_input.hpp"

namespace fascicle::editor {

/// Buttons in the tab strip, right-aligned, with what they open.
void draw_plot_strip(EditorContext& context, const Rect& strip);
/// Lines of the menu of one plot; run: the curve of an earlier run under the pointer, 0: none. In an open popup.
void draw_plot_menu(EditorContext& context, const PlotRow& row, std::uint64_t run);
/// The parameters of a kept run become the document's, as one undo step.
void restore_parameters(EditorContext& context, const MetricValues& run);
/// Ids of the plots that are not hidden.
std::vector<std::string> shown_plots(const EditorContext& context);
/// Name, what differs from the present parameters, whether it is kept for good.
std::string kept_run_text(const EditorContext& context, const MetricValues& run);

} // namespace fascicle::editor
