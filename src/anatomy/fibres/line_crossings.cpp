#include "anatomy/fibres/line_crossings.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

/// Twice the signed area of (a, b, p) seen along the direction, the same number for both ways of walking the edge but
/// for its sign.
double edge_side(const Points& flat, int a, int b, const Vec2& p) {
    const bool forward = a < b;
    const Vec3& from = flat[static_cast<std::size_t>(forward ? a : b)];
    const Vec3& to = flat[static_cast<std::size_t>(forward ? b : a)];
    const double side = (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
    // A line through the edge itself counts as on its left, for both triangles.
    const double decided = side == 0.0 ? std::numeric_limits<double>::denorm_min() : side;
    return forward ? decided : -decided;
}

void keep_two(LineCrossing& first, LineCrossing& second, const LineCrossing& found) {
    if (std::abs(found.distance) < std::abs(first.distance)) {
        second = first;
        first = found;
    } else if (std::abs(found.distance) < std::abs(second.distance))
        second = found;
}

} // namespace

LineCrossings::LineCrossings(const TriMesh& mesh, const Vec3& direction) : mesh_(&mesh) {
    axes_[0] = direction.unitOrthogonal();
    axes_[1] = direction.cross(axes_[0]);
    axes_[2] = direction;
    flat_.reserve(mesh.positions.size());
    for (const Vec3& p : mesh.positions)
        flat_.emplace_back(p.dot(axes_[0]), p.dot(axes_[1]), p.dot(axes_[2]));
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Tri& t : mesh.triangles)
        for (const int v : t) {
            const Vec2 p = flat_[static_cast<std::size_t>(v)].head<2>();
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
    if (mesh.triangles.empty()) {
        starts_.assign(2, 0);
        low_ = Vec2::Zero();
        return;
    }
    // About as many cells as triangles, at most 1024 a side: a long thin surface must not cost memory.
    const Vec2 size = (high - low).cwiseMax(1e-12 * (1.0 + high.cwiseAbs().maxCoeff()));
    cell_ =
        std::max(std::sqrt(size.x() * size.y() / double(mesh.triangles.size())), size.maxCoeff() / 1024.0);
    low_ = low;
    columns_ = static_cast<int>(size.x() / cell_) + 1;
    rows_ = static_cast<int>(size.y() / cell_) + 1;
    const auto cells_of = [&](const Tri& t) {
        Vec2 a = flat_[static_cast<std::size_t>(t[0])].head<2>(), b = a;
        for (const int v : t) {
            a = a.cwiseMin(flat_[static_cast<std::size_t>(v)].head<2>());
            b = b.cwiseMax(flat_[static_cast<std::size_t>(v)].head<2>());
        }
        const auto index = [&](double x, int count) {
            return std::clamp(static_cast<int>(x / cell_), 0, count - 1);
        };
        return std::array<int, 4>{index(a.x() - low_.x(), columns_), index(b.x() - low_.x(), columns_),
                                  index(a.y() - low_.y(), rows_), index(b.y() - low_.y(), rows_)};
    };
    starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    const auto for_cells = [&](const Tri& t, const auto& visit) {
        const std::array<int, 4> c = cells_of(t);
        for (int y = c[2]; y <= c[3]; ++y)
            for (int x = c[0]; x <= c[1]; ++x)
                visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(x));
    };
    for (const Tri& t : mesh.triangles)
        for_cells(t, [&](std::size_t cell) { ++starts_[cell + 1]; });
    for (std::size_t c = 1; c < starts_.size(); ++c)
        starts_[c] += starts_[c - 1];
    triangles_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for_cells(mesh.triangles[t],
                  [&](std::size_t cell) { triangles_[next[cell]++] = static_cast<std::int32_t>(t); });
}

template <typename Visit>
void LineCrossings::for_crossings(const Vec3& p, const Visit& visit) const {
    const Vec2 q(p.dot(axes_[0]), p.dot(axes_[1]));
    const double height = p.dot(axes_[2]);
    const double x = std::floor((q.x() - low_.x()) / cell_), y = std::floor((q.y() - low_.y()) / cell_);
    if (!(x >= 0 && x < columns_ && y >= 0 && y < rows_))
        return;
    const std::size_t cell =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    for (std::uint32_t k = starts_[cell]; k < starts_[cell + 1]; ++k) {
        const Tri& t = mesh_->triangles[static_cast<std::size_t>(triangles_[k])];
        const double a = edge_side(flat_, t[1], t[2], q), b = edge_side(flat_, t[2], t[0], q);
        if ((a > 0) != (b > 0))
            continue;
        const double c = edge_side(flat_, t[0], t[1], q);
        const double sum = a + b + c;
        if ((a > 0) != (c > 0) || !(std::abs(sum) > 1e-300))
            continue;
        LineCrossing found;
        found.triangle = triangles_[k];
        found.weights = Vec3(a, b, c) / sum;
        found.distance = found.weights[0] * flat_[static_cast<std::size_t>(t[0])].z() +
                         found.weights[1] * flat_[static_cast<std::size_t>(t[1])].z() +
                         found.weights[2] * flat_[static_cast<std::size_t>(t[2])].z() - height;
        visit(found, a > 0 ? 1 : -1);
    }
}

LineNeighbours LineCrossings::at(const Vec3& p) const {
    LineNeighbours result;
    for_crossings(p, [&](const LineCrossing& found, int sign) {
        if (found.distance >= 0) {
            keep_two(result.ahead, result.ahead_second, found);
            result.winding += sign;
        } else
            keep_two(result.behind, result.behind_second, found);
    });
    return result;
}

const std::array<Vec3, 13>& chord_directions() {
    static const std::array<Vec3, 13> directions = [] {
        const Mat3 turn =
            (Eigen::AngleAxisd(0.3718, Vec3::UnitZ()) * Eigen::AngleAxisd(0.5237, Vec3::UnitY()) *
             Eigen::AngleAxisd(0.2191, Vec3::UnitX()))
                .toRotationMatrix();
        std::array<Vec3, 13> all;
        std::size_t n = 0;
        for (int k = 14; k < 27; ++k) // the half of the 3 x 3 x 3 neighbours that comes after the centre
            all[n++] = turn * Vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1).normalized();
        return all;
    }();
    return directions;
}

} // namespace fascicle
