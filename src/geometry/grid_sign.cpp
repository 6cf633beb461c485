#include "grid_sign.hpp"

#include "boundary_cap.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/volume.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

// Two unrelated irrational shares: rays do not run through vertices or along axis-parallel faces.
constexpr double shift_y = 0.7320508075688772e-5;
constexpr double shift_z = 0.4142135623730951e-5;

/// Twice the area of (a, b, p) in the y-z plane, computed from the lower of a and b to the higher, so that
/// both triangles at an edge get the same number, with opposite signs. positive: whether p counts as being on
/// the positive side of the directed edge a -> b; zero counts as a fixed side of the undirected edge (p
/// shifted by (-e^2, e) for a vanishing e).
struct EdgeSide {
    double value;
    bool positive;
};

EdgeSide edge_side(const Vec3& a, const Vec3& b, double y, double z) {
    const bool forward = a.y() < b.y() || (a.y() == b.y() && a.z() < b.z());
    const Vec3& from = forward ? a : b;
    const Vec3& to = forward ? b : a;
    const double value = (to.y() - from.y()) * (z - from.z()) - (to.z() - from.z()) * (y - from.y());
    return forward ? EdgeSide{value, value >= 0.0} : EdgeSide{-value, value < 0.0};
}

int clamped(double x, int count) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(count - 1)));
}

} // namespace

template <typename Visit>
void GridSign::cut(const Points& points, const Tri& t, const Visit& visit) const {
    const double y0 = shape_.low.y() + shift_y * shape_.h, z0 = shape_.low.z() + shift_z * shape_.h;
    const Vec3& a = points[static_cast<std::size_t>(t[0])];
    const Vec3& b = points[static_cast<std::size_t>(t[1])];
    const Vec3& c = points[static_cast<std::size_t>(t[2])];
    const auto [y_min, y_max] = std::minmax({a.y(), b.y(), c.y()});
    const auto [z_min, z_max] = std::minmax({a.z(), b.z(), c.z()});
    const auto [x_min, x_max] = std::minmax({a.x(), b.x(), c.x()});
    // One column more on each side than the box needs: rounding must not lose one, the sides decide.
    const int j_first = clamped(std::floor((y_min - y0) / shape_.h), shape_.nodes[1]);
    const int j_last = clamped(std::ceil((y_max - y0) / shape_.h), shape_.nodes[1]);
    const int k_first = clamped(std::floor((z_min - z0) / shape_.h), shape_.nodes[2]);
    const int k_last = clamped(std::ceil((z_max - z0) / shape_.h), shape_.nodes[2]);
    for (int k = k_first; k <= k_last; ++k)
        for (int j = j_first; j <= j_last; ++j) {
            const double y = y0 + shape_.h * j, z = z0 + shape_.h * k;
            const EdgeSide ab = edge_side(a, b, y, z);
            const EdgeSide bc = edge_side(b, c, y, z);
            const EdgeSide ca = edge_side(c, a, y, z);
            if (ab.positive != bc.positive || bc.positive != ca.positive)
                continue;
            const double sum = ab.value + bc.value + ca.value;
            const double x = sum == 0.0
                                 ? 0.5 * (x_min + x_max)
                                 : std::clamp((bc.value * a.x() + ca.value * b.x() + ab.value * c.x()) / sum,
                                              x_min, x_max);
            visit(static_cast<std::size_t>(j) +
                      static_cast<std::size_t>(shape_.nodes[1]) * static_cast<std::size_t>(k),
                  Crossing{x, ab.positive ? 1 : -1});
        }
}

GridSign::GridSign(const GridShape& shape, const Points& points, const std::vector<Tri>& triangles,
                   int threads)
    : shape_(shape) {
    const TriMesh cap = boundary_cap(points, triangles);
    struct RowCrossing {
        std::size_t row;
        Crossing crossing;
    };
    constexpr std::size_t chunk = 4096;
    const std::size_t count = triangles.size() + cap.triangles.size();
    std::vector<std::vector<RowCrossing>> found((count + chunk - 1) / chunk);
    parallel_for(threads, count, chunk, [&](std::size_t begin, std::size_t end) {
        std::vector<RowCrossing>& list = found[begin / chunk];
        const auto keep = [&](std::size_t row, const Crossing& crossing) { list.push_back({row, crossing}); };
        for (std::size_t t = begin; t < end; ++t)
            if (t < triangles.size())
                cut(points, triangles[t], keep);
            else
                cut(cap.positions, cap.triangles[t - triangles.size()], keep);
    });
    const std::size_t rows =
        static_cast<std::size_t>(shape.nodes[1]) * static_cast<std::size_t>(shape.nodes[2]);
    first_.assign(rows + 1, 0);
    for (const auto& list : found)
        for (const RowCrossing& c : list)
            ++first_[c.row + 1];
    for (std::size_t r = 0; r < rows; ++r)
        first_[r + 1] += first_[r];
    crossings_.resize(first_[rows]);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const auto& list : found)
        for (const RowCrossing& c : list)
            crossings_[next[c.row]++] = c.crossing;
    parallel_for(threads, rows, chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r)
            std::sort(crossings_.begin() + static_cast<std::ptrdiff_t>(first_[r]),
                      crossings_.begin() + static_cast<std::ptrdiff_t>(first_[r + 1]),
                      [](const Crossing& u, const Crossing& v) {
                          return u.x < v.x || (u.x == v.x && u.direction < v.direction);
                      });
    });
    if (!cap.triangles.empty()) {
        cap_ = WindingNumber(cap);
        const BoundingBox box = bounding_box(cap.positions);
        cap_low_ = box.min;
        cap_high_ = box.max;
        // |w| <= area / (4 pi d^2) at distance d.
        cap_reach_ = std::sqrt(surface_area(cap.positions, cap.triangles) / (4.0 * std::numbers::pi * 0.49));
    }
}

bool GridSign::cap_decides_inside(const Vec3& p, int crossings) const {
    const Vec3 gap = (cap_low_ - p).cwiseMax(p - cap_high_).cwiseMax(0.0);
    if (gap.squaredNorm() >= cap_reach_ * cap_reach_)
        return crossings >= 1;
    double w = crossings - cap_.fast(p, 2.0);
    if (std::abs(w - 0.5) < 0.1)
        w = crossings - cap_.fast(p, 8.0); // error below 3e-4: enough for a sign that hangs in a hole
    return w > 0.5;
}

void GridSign::mark_row(int j, int k, std::vector<unsigned char>& inside) const {
    const std::size_t row =
        static_cast<std::size_t>(j) + static_cast<std::size_t>(shape_.nodes[1]) * static_cast<std::size_t>(k);
    std::size_t next = first_[row];
    const std::size_t end = first_[row + 1];
    int ahead = 0; // signed crossings between the node and +infinity
    for (std::size_t c = next; c < end; ++c)
        ahead += crossings_[c].direction;
    if (cap_.triangle_count() == 0) { // closed: nothing changes from one crossing to the next
        int i = 0;
        const auto mark_to = [&](int end_of_run) {
            std::fill(inside.begin() + i, inside.begin() + end_of_run,
                      static_cast<unsigned char>(ahead >= 1));
            i = end_of_run;
        };
        for (; next < end; ++next) {
            const double x = crossings_[next].x;
            // First node at or behind the crossing, by the same comparison as below.
            int behind = clamped(std::floor((x - shape_.low.x()) / shape_.h), shape_.nodes[0] + 1);
            while (behind < shape_.nodes[0] && x > shape_.node(behind, j, k).x())
                ++behind;
            while (behind > 0 && x <= shape_.node(behind - 1, j, k).x())
                --behind;
            mark_to(std::max(i, behind));
            ahead -= crossings_[next].direction;
        }
        mark_to(shape_.nodes[0]);
        return;
    }
    for (int i = 0; i < shape_.nodes[0]; ++i) {
        const Vec3 p = shape_.node(i, j, k) + shape_.h * Vec3(0.0, shift_y, shift_z);
        for (; next < end && crossings_[next].x <= p.x(); ++next)
            ahead -= crossings_[next].direction;
        inside[static_cast<std::size_t>(i)] = cap_decides_inside(p, ahead);
    }
}

} // namespace fascicle
