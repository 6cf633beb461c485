#pragma once
// Statistics of the report: ranks, rank correlation, shares inside a band.

#include <span>
#include <vector>

namespace fascicle::reproduce {

/// Ranks from 1 of n values; equal values share the mean of the ranks they take (fractional ranks). A value that is not finite has
/// NaN and takes no rank.
std::vector<double> ranks(std::span<const double> values);

/// Spearman's rank correlation: Pearson's correlation of the fractional ranks, so right with ties (C. Spearman 1904; M. G. Kendall,
/// "Rank Correlation Methods", 1948). In [-1, 1]; pairs in which either is not finite are left out. NaN with fewer than two
/// pairs, or when either list is constant.
double spearman(std::span<const double> x, std::span<const double> y);

/// A value in (x, y), linear between points of ascending x; NaN outside of their range, or without points.
double interpolated(std::span<const double> x, std::span<const double> y, double at);

/// Least, mean and greatest of the finite values; NaN when there is none.
struct Span3 {
    double least = 0, mean = 0, greatest = 0;
};
Span3 span_of(std::span<const double> values);

/// Largest |value - from| of the finite values; NaN when there is none.
double farthest(std::span<const double> values, double from);

/// An interval at a place: what a value there is held against.
struct BandPoint {
    double x = 0, low = 0, high = 0;
};

/// Percent of places x at which low <= y <= high, the band linear between its points (ascending x). Places outside of the band's range,
/// or where y is not finite, do not count; NaN when none counts.
double percent_inside(std::span<const double> x, std::span<const double> y, std::span<const BandPoint> band);
/// Percent of the finite values with low <= value <= high; NaN when none is finite.
double percent_between(std::span<const double> values, double low, double high);

} // namespace fascicle::reproduce
