#pragma once
// The plots of a report and what they say, from the rows of metrics.

#include "output/html_report.hpp"
#include "view/chart.hpp"

namespace fascicle::output {

struct ReportChart {
    view::Chart light, dark; ///< the same in the colours of a light and of a dark page
    std::string sentence;    ///< plain text, not escaped
};

/// Those that have data.
std::vector<ReportChart> report_charts(const ReportInput& input);

/// Values of a metric over the frames of one muscle; empty for an unknown key.
std::vector<double> metric_series(const ReportInput& input, std::size_t muscle, const char* key);

/// Places of the least and the greatest finite value; -1 when there is none.
struct Extremes {
    int least = -1, greatest = -1;
};
Extremes extremes(const std::vector<double>& values);

/// A few significant digits, a dot in every locale.
std::string short_number(double value, int digits = 3);

} // namespace fascicle::output
