#include "solver/rivals/mass_spring/point_cells.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::mass_spring {

std::size_t PointCells::Hash::operator()(const Cell& c) const {
    const auto mixed = static_cast<std::uint64_t>(c[0]) * 73856093u ^
                       static_cast<std::uint64_t>(c[1]) * 19349663u ^
                       static_cast<std::uint64_t>(c[2]) * 83492791u;
    return static_cast<std::size_t>(mixed);
}

PointCells::Cell PointCells::cell_of(const Vec3& p) const {
    const auto one = [&](double x) {
        // Far beyond any muscle, but within what an integer holds.
        return static_cast<std::int64_t>(std::floor(std::clamp(x / cell_, -1e15, 1e15)));
    };
    return {one(p.x()), one(p.y()), one(p.z())};
}

void PointCells::add(const Vec3& point) {
    cells_[cell_of(point)].push_back(static_cast<int>(points_.size()));
    points_.push_back(point);
}

void PointCells::within(const Vec3& p, double reach, std::vector<NearPoint>& found) const {
    found.clear();
    const auto keep = [&](int i) {
        const double d = (points_[static_cast<std::size_t>(i)] - p).squaredNorm();
        if (d <= reach * reach)
            found.push_back({d, i});
    };
    const Cell low = cell_of(p - Vec3::Constant(reach)), high = cell_of(p + Vec3::Constant(reach));
    double count = 1;
    for (std::size_t k = 0; k < 3; ++k)
        count *= static_cast<double>(high[k] - low[k] + 1);
    if (count > static_cast<double>(points_.size())) {
        for (std::size_t i = 0; i < points_.size(); ++i)
            keep(static_cast<int>(i));
    } else {
        for (auto x = low[0]; x <= high[0]; ++x)
            for (auto y = low[1]; y <= high[1]; ++y)
                for (auto z = low[2]; z <= high[2]; ++z)
                    if (const auto it = cells_.find({x, y, z}); it != cells_.end())
                        std::for_each(it->second.begin(), it->second.end(), keep);
    }
    std::sort(found.begin(), found.end());
}

void PointCells::nearest(const Vec3& p, std::size_t count, std::vector<NearPoint>& found) const {
    count = std::min(count, points_.size());
    constexpr int doublings = 8;
    double reach = cell_;
    for (int k = 0; k < doublings; ++k, reach *= 2.0) {
        within(p, reach, found);
        if (found.size() >= count)
            break;
    }
    if (found.size() < count) { // scattered widely: look at all
        found.clear();
        for (std::size_t i = 0; i < points_.size(); ++i)
            found.push_back({(points_[i] - p).squaredNorm(), static_cast<int>(i)});
        std::sort(found.begin(), found.end());
    }
    found.resize(count);
}

bool PointCells::any_nearer(const Vec3& p, double reach) const {
    const Cell low = cell_of(p - Vec3::Constant(reach)), high = cell_of(p + Vec3::Constant(reach));
    for (auto x = low[0]; x <= high[0]; ++x)
        for (auto y = low[1]; y <= high[1]; ++y)
            for (auto z = low[2]; z <= high[2]; ++z)
                if (const auto it = cells_.find({x, y, z}); it != cells_.end())
                    for (const int i : it->second)
                        if ((points_[static_cast<std::size_t>(i)] - p).squaredNorm() < reach * reach)
                            return true;
    return false;
}

} // namespace fascicle::mass_spring
