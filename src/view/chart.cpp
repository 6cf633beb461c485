#include "view/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::view {

namespace {

class Extent {
public:
    void add(double value) {
        if (std::isfinite(value)) {
            low_ = std::min(low_, value);
            high_ = std::max(high_, value);
        }
    }
    ChartSpan span() const { return low_ <= high_ ? ChartSpan{low_, high_} : ChartSpan{}; }

private:
    double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

bool usable(const std::optional<ChartSpan>& span) {
    return span && std::isfinite(span->low) && std::isfinite(span->high) && span->low < span->high;
}

/// At least `least` wide, about the same middle.
ChartSpan widened(ChartSpan span, double least) {
    // Also where doubles of this size cannot be told apart otherwise.
    const double size = std::max(std::abs(span.low), std::abs(span.high));
    const double lack = std::max(least, size * 1e-9) - (span.high - span.low);
    return lack > 0 ? ChartSpan{span.low - lack / 2, span.high + lack / 2} : span;
}

} // namespace

std::string chart_heading(const Chart& chart) {
    return chart.unit.empty() || chart.unit == "1" ? chart.title : chart.title + " [" + chart.unit + "]";
}

ChartSpan chart_x(const Chart& chart) {
    if (usable(chart.x_range))
        return *chart.x_range;
    Extent extent;
    for (const ChartCurve& curve : chart.curves)
        for (std::size_t k = 0; k < std::min(curve.x.size(), curve.y.size()); ++k)
            extent.add(curve.x[k]);
    return widened(extent.span(), 1e-9);
}

ChartSpan chart_y(const Chart& chart) {
    if (usable(chart.y_range))
        return *chart.y_range;
    const ChartSpan x = chart_x(chart);
    Extent extent;
    for (const ChartCurve& curve : chart.curves)
        for (const std::vector<double>* values : {&curve.y, &curve.low, &curve.high})
            for (std::size_t k = 0; k < std::min(curve.x.size(), values->size()); ++k)
                if (curve.x[k] >= x.low && curve.x[k] <= x.high)
                    extent.add((*values)[k]);
    if (chart.reference)
        extent.add(*chart.reference);
    const ChartSpan span = widened(extent.span(), std::max(0.0, chart.least_span));
    const double air = (span.high - span.low) * 0.08;
    return {span.low - air, span.high + air};
}

} // namespace fascicle::view
