#include "anatomy/fibres/volume_field.hpp"

#include "anatomy/fibres/fibre_field.hpp"
#include "anatomy/fibres/line_crossings.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/volume.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t npos = std::numeric_limits<std::size_t>::max();
constexpr std::size_t most_cells = 8'000'000; ///< of the box, inside or not

} // namespace

VolumeField::VolumeField(const FibreProblem& checked, int cells) {
    const BoundingBox box = bounding_box(checked.surface->positions, checked.surface->triangles);
    const double volume = signed_volume(checked.surface->positions, checked.surface->triangles);
    if (!(volume > 0))
        throw_error(fibre_error_place(checked), "the surface encloses no volume",
                    "a closed surface with its triangles outwards");
    step_ = std::cbrt(volume / cells);
    // A grid over a thin bent muscle is mostly empty: it may be coarser than asked, never larger than memory allows.
    const Vec3 extent = box.size();
    step_ = std::max({step_, std::cbrt(extent.x() * extent.y() * extent.z() / double(most_cells)),
                      extent.maxCoeff() / 2000.0});
    low_ = box.min - Vec3::Constant(3.0 * step_);
    for (std::size_t k = 0; k < 3; ++k)
        size_[k] = static_cast<int>(extent[static_cast<int>(k)] / step_) + 7;
    neighbours_ = {1,
                   -1,
                   size_[0],
                   -size_[0],
                   std::ptrdiff_t{size_[0]} * size_[1],
                   -std::ptrdiff_t{size_[0]} * size_[1]};
    cells_.assign(index(size_[0] - 1, size_[1] - 1, size_[2] - 1) + 1, Cell::outside);
    u_.assign(cells_.size(), no_value);
    fill(checked);
    area_.assign(cells_.size(), 0.0);
    mark(checked, AttachmentKind::origin);
    mark(checked, AttachmentKind::insertion);
    if (!keep_connected())
        throw_error(fibre_error_place(checked),
                    "the inside does not reach from origin to insertion in cells of " +
                        std::to_string(step_ * checked.unit_mm) + " mm",
                    "a muscle in one piece and thicker than that");
    solve();
    extend();
}

void VolumeField::fill(const FibreProblem& problem) {
    const LineCrossings lines(*problem.surface, Vec3::UnitZ());
    std::vector<std::pair<double, int>> found;
    for (int y = 0; y < size_[1]; ++y)
        for (int x = 0; x < size_[0]; ++x) {
            const Vec3 start = centre(x, y, 0);
            lines.all(start, found);
            int winding = 0;
            std::size_t k = 0;
            for (int z = 0; z < size_[2]; ++z) {
                for (; k < found.size() && found[k].first <= z * step_; ++k)
                    winding -= found[k].second;
                if (winding > 0)
                    cells_[index(x, y, z)] = Cell::free;
            }
        }
}

/// The cell that p lies in when it is inside, else the nearest inside one of the 26 around; npos when there is none.
std::size_t VolumeField::inside_cell_near(const Vec3& p) const {
    const Vec3 cell = (p - low_) / step_;
    const int x = static_cast<int>(cell.x()), y = static_cast<int>(cell.y()), z = static_cast<int>(cell.z());
    if (cells_[index(x, y, z)] != Cell::outside)
        return index(x, y, z);
    std::size_t nearest = npos;
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 27; ++k) {
        const int u = x + k % 3 - 1, v = y + k / 3 % 3 - 1, w = z + k / 9 - 1;
        if (cells_[index(u, v, w)] == Cell::outside)
            continue;
        if (const double d = (centre(u, v, w) - p).squaredNorm(); d < best) {
            best = d;
            nearest = index(u, v, w);
        }
    }
    return nearest;
}

/// Shares out the areas of the attached triangles to cells; edges and single vertices count as a little area.
void VolumeField::mark(const FibreProblem& problem, AttachmentKind kind) {
    const Points& points = problem.surface->positions;
    const Cell mark = kind == AttachmentKind::origin ? Cell::origin : Cell::insertion;
    for (const Tri& t : attached_triangles(problem, kind)) {
        const Vec3 &a = points[static_cast<std::size_t>(t[0])], &b = points[static_cast<std::size_t>(t[1])],
                   &c = points[static_cast<std::size_t>(t[2])];
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const int pieces = std::clamp(static_cast<int>(std::ceil(2.0 * longest / step_)), 1, 200);
        const double area =
            (0.5 * (b - a).cross(c - a).norm() + 1e-3 * step_ * step_) / (0.5 * pieces * pieces);
        for (int i = 0; i < pieces; ++i)
            for (int j = 0; i + j < pieces; ++j) {
                const Vec3 p = a + (i + 1.0 / 3) / pieces * (b - a) + (j + 1.0 / 3) / pieces * (c - a);
                const std::size_t cell = inside_cell_near(p);
                if (cell == npos || (cells_[cell] != Cell::free && cells_[cell] != mark))
                    continue; // between the two kinds a cell stays with the first
                cells_[cell] = mark;
                area_[cell] += area;
            }
    }
}

/// Drops parts that do not hold both kinds. Whether one does.
bool VolumeField::keep_connected() {
    std::vector<char> seen(cells_.size(), 0);
    std::vector<std::size_t> part;
    bool any = false;
    for (std::size_t start = 0; start < cells_.size(); ++start) {
        if (seen[start] != 0 || cells_[start] == Cell::outside)
            continue;
        part.assign(1, start);
        seen[start] = 1;
        bool has[2] = {false, false};
        for (std::size_t k = 0; k < part.size(); ++k) {
            has[0] = has[0] || cells_[part[k]] == Cell::origin;
            has[1] = has[1] || cells_[part[k]] == Cell::insertion;
            for (const std::ptrdiff_t step : neighbours_) {
                const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(part[k]) + step);
                if (seen[next] == 0 && cells_[next] != Cell::outside) {
                    seen[next] = 1;
                    part.push_back(next);
                }
            }
        }
        if (has[0] && has[1])
            any = true;
        else
            for (const std::size_t i : part)
                cells_[i] = Cell::outside;
    }
    return any;
}

/// Conjugate gradients, preconditioned by the diagonal, to 1e-5 of the first residual. The matrix leaves a constant
/// open; what enters and leaves is balanced in each part, so that there is a solution.
void VolumeField::solve() {
    std::vector<std::size_t> cell_of;
    std::vector<int> unknown(cells_.size(), -1);
    std::array<double, 2> total{0, 0};
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (cells_[i] != Cell::outside) {
            unknown[i] = static_cast<int>(cell_of.size());
            cell_of.push_back(i);
            total[cells_[i] == Cell::insertion ? 1 : 0] += area_[i];
        }
    const std::size_t n = cell_of.size();
    std::vector<std::array<int, 6>> rows(n);
    std::vector<double> diagonal(n, 0.0), x(n, 0.0), r(n, 0.0), z(n), d(n), q(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < 6; ++k) {
            rows[i][k] =
                unknown[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell_of[i]) + neighbours_[k])];
            diagonal[i] += rows[i][k] >= 0 ? 1.0 : 0.0;
        }
        const bool leaves = cells_[cell_of[i]] == Cell::insertion;
        r[i] = (leaves ? 1.0 : -1.0) * area_[cell_of[i]] / total[leaves ? 1 : 0];
    }
    double first = 0, rz = 0;
    for (std::size_t i = 0; i < n; ++i) {
        z[i] = diagonal[i] > 0 ? r[i] / diagonal[i] : 0.0;
        rz += r[i] * z[i];
    }
    first = rz;
    d = z;
    for (int iteration = 0; iteration < 3000 && rz > 1e-10 * first && rz > 0; ++iteration) {
        double dq = 0;
        for (std::size_t i = 0; i < n; ++i) {
            double sum = diagonal[i] * d[i];
            for (const int j : rows[i])
                if (j >= 0)
                    sum -= d[static_cast<std::size_t>(j)];
            q[i] = sum;
            dq += d[i] * sum;
        }
        const double alpha = rz / dq;
        double next = 0;
        for (std::size_t i = 0; i < n; ++i) {
            x[i] += alpha * d[i];
            r[i] -= alpha * q[i];
            z[i] = diagonal[i] > 0 ? r[i] / diagonal[i] : 0.0;
            next += r[i] * z[i];
        }
        const double beta = next / rz;
        rz = next;
        for (std::size_t i = 0; i < n; ++i)
            d[i] = z[i] + beta * d[i];
    }
    for (std::size_t i = 0; i < n; ++i)
        u_[cell_of[i]] = x[i];
}

void VolumeField::extend() {
    for (int layer = 0; layer < 2; ++layer) {
        std::vector<std::pair<std::size_t, double>> added;
        for (int z = 1; z + 1 < size_[2]; ++z)
            for (int y = 1; y + 1 < size_[1]; ++y)
                for (int x = 1; x + 1 < size_[0]; ++x) {
                    const std::size_t i = index(x, y, z);
                    if (cells_[i] != Cell::outside)
                        continue;
                    double sum = 0, count = 0;
                    for (int k = 0; k < 27; ++k)
                        if (const std::size_t j = index(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1);
                            cells_[j] != Cell::outside) {
                            sum += u_[j];
                            count += 1;
                        }
                    if (count > 0)
                        added.emplace_back(i, sum / count);
                }
        for (const auto& [i, value] : added) {
            cells_[i] = Cell::around;
            u_[i] = value;
        }
    }
}

double VolumeField::value(const Vec3& p) const {
    const Vec3 q = (p - low_) / step_ - Vec3::Constant(0.5);
    if (!((q.array() >= 0).all()))
        return no_value;
    const int x = static_cast<int>(q.x()), y = static_cast<int>(q.y()), z = static_cast<int>(q.z());
    if (x + 1 >= size_[0] || y + 1 >= size_[1] || z + 1 >= size_[2])
        return no_value;
    const Vec3 f = q - Vec3(x, y, z);
    double sum = 0;
    for (int k = 0; k < 8; ++k) {
        const double w =
            (k & 1 ? f.x() : 1 - f.x()) * (k & 2 ? f.y() : 1 - f.y()) * (k & 4 ? f.z() : 1 - f.z());
        sum += w * u_[index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2))];
    }
    return sum;
}

Vec3 VolumeField::gradient(const Vec3& p) const {
    Vec3 slope;
    for (int k = 0; k < 3; ++k) {
        const Vec3 half = 0.5 * step_ * Vec3::Unit(k);
        slope[k] = (value(p + half) - value(p - half)) / step_;
    }
    return slope.allFinite() ? slope : Vec3::Zero();
}

bool VolumeField::at_insertion(const Vec3& p) const {
    const Vec3 q = (p - low_) / step_;
    if (!((q.array() >= 0).all()) || q.x() >= size_[0] || q.y() >= size_[1] || q.z() >= size_[2])
        return false;
    return cells_[index(static_cast<int>(q.x()), static_cast<int>(q.y()), static_cast<int>(q.z()))] ==
           Cell::insertion;
}

} // namespace fascicle
