#include "editor/commands/command_groups.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/panels/plot_controls.hpp"

namespace fascicle::editor {

using C = Command;

std::vector<KeyBinding> plot_commands() {
    const char* const plots = "Plots";
    return {
        {C::toggle_plots_over_view,
         plots,
         "Plots over the view",
         "One or two plots in the lower right corner of the view.",
         {},
         false,
         [](const EditorContext& c) { return checked(c.state.plots.over_view); },
         [](EditorContext& c) { c.state.plots.over_view = !c.state.plots.over_view; }},
        {C::export_plots,
         plots,
         "Export plots...",
         "Writes the shown plots as CSV, SVG or PNG.",
         {},
         false,
         nullptr,
         [](EditorContext& c) { c.dialogs.plot_export.open(c, shown_plots(c), PlotFile::csv, false); }},
    };
}

} // namespace fascicle::editor
