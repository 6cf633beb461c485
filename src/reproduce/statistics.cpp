#include "reproduce/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace fascicle::reproduce {

namespace {

const double none = std::numeric_limits<double>::quiet_NaN();

/// Pearson's correlation of two lists of one length without gaps; NaN when either is constant.
double pearson(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    const double mean_x = std::accumulate(x.begin(), x.end(), 0.0) / n;
    const double mean_y = std::accumulate(y.begin(), y.end(), 0.0) / n;
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - mean_x) * (x[i] - mean_x);
        yy += (y[i] - mean_y) * (y[i] - mean_y);
        xy += (x[i] - mean_x) * (y[i] - mean_y);
    }
    return xx > 0 && yy > 0 ? std::clamp(xy / std::sqrt(xx * yy), -1.0, 1.0) : none;
}

} // namespace

std::vector<double> ranks(std::span<const double> values) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i]))
            order.push_back(i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    std::vector<double> result(values.size(), none);
    for (std::size_t i = 0; i < order.size();) {
        std::size_t end = i + 1;
        while (end < order.size() && values[order[end]] == values[order[i]])
            ++end;
        // The ranks i + 1 to end, in the mean.
        const double shared = (static_cast<double>(i) + 1 + static_cast<double>(end)) / 2;
        for (; i < end; ++i)
            result[order[i]] = shared;
    }
    return result;
}

double spearman(std::span<const double> x, std::span<const double> y) {
    std::vector<double> a, b;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
        if (std::isfinite(x[i]) && std::isfinite(y[i])) {
            a.push_back(x[i]);
            b.push_back(y[i]);
        }
    return a.size() < 2 ? none : pearson(ranks(a), ranks(b));
}

double interpolated(std::span<const double> x, std::span<const double> y, double at) {
    if (x.empty() || x.size() != y.size() || !(at >= x.front()) || !(at <= x.back()))
        return none;
    const auto after = std::upper_bound(x.begin(), x.end(), at);
    if (after == x.end())
        return y.back();
    const auto i = static_cast<std::size_t>(after - x.begin());
    const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
    return y[i - 1] + share * (y[i] - y[i - 1]);
}

Span3 span_of(std::span<const double> values) {
    Span3 result{none, none, none};
    double sum = 0;
    std::size_t count = 0;
    for (const double v : values) {
        if (!std::isfinite(v))
            continue;
        result.least = count == 0 ? v : std::min(result.least, v);
        result.greatest = count == 0 ? v : std::max(result.greatest, v);
        sum += v;
        ++count;
    }
    if (count > 0)
        result.mean = sum / static_cast<double>(count);
    return result;
}

double farthest(std::span<const double> values, double from) {
    double most = none;
    for (const double v : values)
        if (std::isfinite(v) && !(std::abs(v - from) <= most))
            most = std::abs(v - from);
    return most;
}

double percent_inside(std::span<const double> x, std::span<const double> y, std::span<const BandPoint> band) {
    std::vector<double> places, low, high;
    for (const BandPoint& point : band) {
        places.push_back(point.x);
        low.push_back(point.low);
        high.push_back(point.high);
    }
    std::size_t inside = 0, all = 0;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
        const double l = interpolated(places, low, x[i]), h = interpolated(places, high, x[i]);
        if (!std::isfinite(l) || !std::isfinite(h) || !std::isfinite(y[i]))
            continue;
        ++all;
        inside += y[i] >= l && y[i] <= h ? 1 : 0;
    }
    return all == 0 ? none : 100.0 * static_cast<double>(inside) / static_cast<double>(all);
}

double percent_between(std::span<const double> values, double low, double high) {
    std::size_t inside = 0, finite = 0;
    for (const double v : values)
        if (std::isfinite(v)) {
            ++finite;
            inside += v >= low && v <= high ? 1 : 0;
        }
    return finite > 0 ? 100 * static_cast<double>(inside) / static_cast<double>(finite) : none;
}

} // namespace fascicle::reproduce
