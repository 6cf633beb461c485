#pragma once
// Points sorted into cubic cells, for those near a place. Answers do not depend on the cells' size.

#include "fascicle/base/types.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace fascicle::mass_spring {

/// A point by its number, and its squared distance from where one asked.
struct NearPoint {
    double squared_distance = 0;
    int point = -1;
    bool operator<(const NearPoint& other) const {
        return squared_distance != other.squared_distance ? squared_distance < other.squared_distance
                                                          : point < other.point;
    }
};

class PointCells {
public:
    /// cell > 0: edge of a cell, scene units. Coordinates must be finite.
    explicit PointCells(double cell) : cell_(cell) {}
    /// The next number.
    void add(const Vec3& point);
    std::size_t size() const { return points_.size(); }

    /// Points within `reach` (border included) of p, nearest first, equally near ones by number.
    void within(const Vec3& p, double reach, std::vector<NearPoint>& found) const;
    /// The `count` nearest (fewer when there are no more), nearest first.
    void nearest(const Vec3& p, std::size_t count, std::vector<NearPoint>& found) const;
    /// Whether some point is nearer than `reach`.
    bool any_nearer(const Vec3& p, double reach) const;

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& c) const;
    };
    Cell cell_of(const Vec3& p) const;

    double cell_;
    std::vector<Vec3> points_;
    std::unordered_map<Cell, std::vector<int>, Hash> cells_;
};

} // namespace fascicle::mass_spring
