#include "geometry/repair/steps.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace fascicle::detail {

namespace {

/// Places in space by cell, open addressing; a cell's places hang in a chain.
class CellTable {
public:
    explicit CellTable(std::size_t places)
        : heads_(std::bit_ceil(2 * places + 16), -1), cells_(heads_.size()), next_(places, -1) {}

    /// First place of the cell, -1: none.
    int& head(const Vec3& cell) {
        std::size_t slot = hash(cell) & (heads_.size() - 1);
        while (heads_[slot] >= 0 && cells_[slot] != cell)
            slot = (slot + 1) & (heads_.size() - 1);
        cells_[slot] = cell;
        return heads_[slot];
    }
    int find(const Vec3& cell) const {
        std::size_t slot = hash(cell) & (heads_.size() - 1);
        while (heads_[slot] >= 0 && cells_[slot] != cell)
            slot = (slot + 1) & (heads_.size() - 1);
        return heads_[slot];
    }
    int next(int place) const { return next_[at(place)]; }
    void add(const Vec3& cell, int place) {
        int& first = head(cell);
        next_[at(place)] = first;
        first = place;
    }

private:
    static std::size_t hash(const Vec3& cell) {
        std::uint64_t h = 0;
        for (int k = 0; k < 3; ++k) { // + 0.0: -0 and 0 are one cell
            h ^= std::bit_cast<std::uint64_t>(cell[k] + 0.0) + 0x9e3779b97f4a7c15u + (h << 6) + (h >> 2);
            h *= 0xbf58476d1ce4e5b9u;
            h ^= h >> 29;
        }
        return h;
    }

    std::vector<int> heads_;
    std::vector<Vec3> cells_;
    std::vector<int> next_;
};

/// Cells of eight tolerances: nearly always one or two are looked through.
constexpr double cell_in_tolerances = 8;

} // namespace

std::vector<int> near_vertices(const Points& points, double tolerance) {
    std::vector<int> stands(points.size());
    CellTable exact(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) {
        int& first = exact.head(points[v]);
        if (first < 0)
            first = static_cast<int>(v);
        stands[v] = first;
    }
    if (!(tolerance > 0))
        return stands;
    const double size = cell_in_tolerances * tolerance;
    CellTable cells(points.size());
    const auto cell_of = [&](const Vec3& p) { return Vec3((p / size).array().floor()); };
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (stands[v] != static_cast<int>(v)) {
            stands[v] = stands[at(stands[v])];
            continue;
        }
        const Vec3& p = points[v];
        const Vec3 low = cell_of(p - Vec3::Constant(tolerance)),
                   high = cell_of(p + Vec3::Constant(tolerance));
        int best = -1;
        double best_distance = tolerance * tolerance;
        // Corners of the range only: a cell is wider than the ball. They may be equal.
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 cell(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                            corner & 4 ? high.z() : low.z());
            if ((corner & 1 && high.x() == low.x()) || (corner & 2 && high.y() == low.y()) ||
                (corner & 4 && high.z() == low.z()))
                continue;
            for (int u = cells.find(cell); u >= 0; u = cells.next(u)) {
                const double d = (points[at(u)] - p).squaredNorm();
                if (d < best_distance || (d == best_distance && (best < 0 || u < best))) {
                    best = u;
                    best_distance = d;
                }
            }
        }
        if (best >= 0)
            stands[v] = best;
        else
            cells.add(cell_of(p), static_cast<int>(v));
    }
    return stands;
}

} // namespace fascicle::detail
