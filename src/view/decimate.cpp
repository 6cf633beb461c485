#include "view/decimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace fascicle::view {

std::vector<ScreenPoint> decimated(const std::vector<ScreenPoint>& points, double column) {
    std::vector<ScreenPoint> kept;
    for (std::size_t first = 0; first < points.size();) {
        const double place = std::floor(points[first].x / column);
        std::size_t end = first + 1, low = first, high = first;
        for (; end < points.size() && std::floor(points[end].x / column) == place; ++end) {
            if (points[end].y < points[low].y)
                low = end;
            if (points[end].y > points[high].y)
                high = end;
        }
        std::array<std::size_t, 4> chosen{first, std::min(low, high), std::max(low, high), end - 1};
        for (std::size_t i = 0; i < chosen.size(); ++i)
            if (i == 0 || chosen[i] != chosen[i - 1])
                kept.push_back(points[chosen[i]]);
        first = end;
    }
    return kept;
}

} // namespace fascicle::view
