#pragma once
// Which plots there are.

#include "editor/metric_values.hpp"
#include "fascicle/metrics/line_series.hpp"

#include <optional>

namespace fascicle::editor {

/// A plot: a metric and what makes its band; or the stages of a frame's time.
struct PlotRow {
    const char* id;  ///< "plot/..."
    const char* key; ///< in metric_table()
    const char* title;
    const char* low_key; ///< null: no band
    const char* high_key;
    const char* extreme_key; ///< null: none; shown on demand
    const char* band;        ///< what the band is, in words
    std::optional<double> reference;
    double least_span;
    std::vector<double> FibreValues::*of_fibres =
        nullptr; ///< a line for each; such plots need fibres or line muscles
    std::vector<double> LineSeries::*of_lines = nullptr; ///< what line muscles have of it
    bool stages = false; ///< areas of stage times, one on the other, of all muscles together
};

const std::vector<PlotRow>& plot_rows();
/// Null when there is none of that id.
const PlotRow* find_plot_row(std::string_view id);
/// Unit and meaning of its metric.
const MetricRow& metric_of(const PlotRow& row);

} // namespace fascicle::editor
