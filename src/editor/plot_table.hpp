#pragma once
// The numbers of plots as a table, for csv files and the clipboard.

#include "editor/plot_input.hpp"

namespace fascicle::editor {

struct PlotTable {
    struct Column {
        std::string key;            ///< with the unit as suffix
        std::vector<double> values; ///< per frame, may be shorter than the table
    };
    std::vector<Column> columns;     ///< frame, time_s, angle_deg first
    std::size_t first = 0, last = 0; ///< frames to be written, both included
};

/// Columns: frame, time_s, angle_deg (where the motion has a joint), then the curves that are visible in the plots: their
/// bands, single fibres, line muscles, and those of earlier runs with the run's name before them. Overlaid files are left out.
/// visible_only: only the frames in the visible range of x.
PlotTable plot_table(const EditorContext& context, PlotData& data, const std::vector<const PlotRow*>& rows,
                     bool visible_only);
/// Comma, dot, LF, header (interaction.md 9); empty cells where a curve has no frame.
std::string to_csv(const PlotTable& table);
/// Where the numbers come from, as JSON: program, scene, and per run its parameters.
std::string provenance_json(const EditorContext& context, const PlotTable& table, const std::string& file);

} // namespace fascicle::editor
