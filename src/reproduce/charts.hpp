#pragma once
// The plots of the report.

#include "reproduce/results.hpp"
#include "view/chart.hpp"

namespace fascicle::reproduce {

struct Plot {
    std::string figures; ///< of the paper, empty: not in it
    std::string about;   ///< Finding::about of its sentence; empty: none
    view::Chart chart;
    std::string caption; ///< what is plotted, plain text
};

/// Of one experiment: those that have data.
std::vector<Plot> experiment_plots(const ExperimentResult& result);
/// Frames a second against triangles.
std::vector<Plot> speed_plots(const SpeedResult& speed);

/// Colour of a method, the same in every plot; `known`: names in the order of the registry.
render::Rgba method_colour(const std::string& method);

} // namespace fascicle::reproduce
