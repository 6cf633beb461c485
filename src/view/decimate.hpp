#pragma once
// Polylines with far more points than pixels.

#include <vector>

namespace fascicle::view {

struct ScreenPoint {
    double x = 0, y = 0;
};

/// The points that a picture can show: of neighbours in one pixel column the first, the lowest, the highest and the last, in
/// their order. x may go back and forth. The first and the last point stay.
std::vector<ScreenPoint> decimated(const std::vector<ScreenPoint>& points, double column = 1);

} // namespace fascicle::view
