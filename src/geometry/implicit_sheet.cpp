#include "fascicle/geometry/implicit_sheet.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/implicit_tube.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace fascicle {

namespace {

/// What is looked up at a place of the plane; slopes along u and v.
struct Sample {
    double height, slope_u, slope_v, half_thickness, outline;
};

struct Table {
    Mat3 to_local; // rows u, v, n
    Vec3 origin;
    Vec2 lower;
    double step;
    int nu, nv;
    std::vector<Sample> samples; // nu x nv, u fastest
};

double kernel(double squared_r) {
    return squared_r > 0.0 ? 0.5 * squared_r * std::log(squared_r) : 0.0; // r^2 log r
}

/// Spline weights: n kernel weights, then constant, u, v; one column for heights and one for half
/// thicknesses.
Eigen::MatrixXd solve_splines(const std::vector<Vec3>& local, const std::vector<double>& thickness) {
    const Eigen::Index n = static_cast<Eigen::Index>(local.size());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 3, n + 3);
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(n + 3, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Vec3& p = local[static_cast<std::size_t>(i)];
        for (Eigen::Index j = 0; j < n; ++j)
            a(i, j) = kernel((p - local[static_cast<std::size_t>(j)]).head<2>().squaredNorm());
        a.row(i).tail<3>() << 1.0, p.x(), p.y();
        a.col(i).tail<3>() << 1.0, p.x(), p.y();
        b.row(i) << p.z(), thickness[static_cast<std::size_t>(i)];
    }
    return a.fullPivLu().solve(b);
}

/// Signed distance to a closed polygon, negative inside (crossing count along +u).
double polygon_distance(const std::vector<Vec2>& polygon, const Vec2& p) {
    double squared = std::numeric_limits<double>::max();
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Vec2 &a = polygon[j], &b = polygon[i];
        const Vec2 edge = b - a;
        const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
        squared = std::min(squared, (p - a - t * edge).squaredNorm());
        if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / edge.y() * edge.x())
            inside = !inside;
    }
    return inside ? -std::sqrt(squared) : std::sqrt(squared);
}

std::vector<Vec2> smooth_polygon(const std::vector<Vec2>& corners, int pieces) {
    std::vector<Vec2> polygon;
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i)
        for (int k = 0; k < pieces; ++k)
            polygon.push_back(catmull_rom(corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n],
                                          corners[(i + 2) % n], static_cast<double>(k) / pieces));
    return polygon;
}

void fill_table(Table& table, const std::vector<Vec3>& local, const Eigen::MatrixXd& weights,
                const std::vector<Vec2>& polygon, const Vec2& thickness_range) {
    const std::size_t n = local.size();
    table.samples.resize(static_cast<std::size_t>(table.nu) * static_cast<std::size_t>(table.nv));
    std::size_t at = 0;
    for (int j = 0; j < table.nv; ++j)
        for (int i = 0; i < table.nu; ++i) {
            const Vec2 p = table.lower + table.step * Vec2(i, j);
            const Eigen::Index m = static_cast<Eigen::Index>(n);
            Sample s{weights(m, 0) + weights(m + 1, 0) * p.x() + weights(m + 2, 0) * p.y(), weights(m + 1, 0),
                     weights(m + 2, 0), weights(m, 1) + weights(m + 1, 1) * p.x() + weights(m + 2, 1) * p.y(),
                     0.0};
            for (std::size_t k = 0; k < n; ++k) {
                const Vec2 d = p - local[k].head<2>();
                const double squared = d.squaredNorm();
                const double w = weights(static_cast<Eigen::Index>(k), 0);
                const double phi = kernel(squared);
                s.height += w * phi;
                s.half_thickness += weights(static_cast<Eigen::Index>(k), 1) * phi;
                const double slope = squared > 0.0 ? std::log(squared) + 1.0 : 0.0; // (d phi / d r) / r
                s.slope_u += w * slope * d.x();
                s.slope_v += w * slope * d.y();
            }
            // The spline may overshoot between stations: keep the thickness within what was asked for.
            s.half_thickness = std::clamp(s.half_thickness, thickness_range.x(), thickness_range.y());
            s.outline = polygon_distance(polygon, p);
            table.samples[at++] = s;
        }
}

double value_at(const Table& table, const Vec3& p) {
    const Vec3 q = table.to_local * (p - table.origin);
    const Vec2 grid = (q.head<2>() - table.lower) / table.step;
    const Vec2 held(std::clamp(grid.x(), 0.0, table.nu - 1.001), std::clamp(grid.y(), 0.0, table.nv - 1.001));
    const double beyond = (grid - held).norm() * table.step; // outside the table: further away by this much
    const int i = static_cast<int>(held.x()), j = static_cast<int>(held.y());
    const double fu = held.x() - i, fv = held.y() - j;
    const Sample* s = &table.samples[static_cast<std::size_t>(j) * static_cast<std::size_t>(table.nu) +
                                     static_cast<std::size_t>(i)];
    const Sample &a = s[0], &b = s[1], &c = s[table.nu], &d = s[table.nu + 1];
    const auto mix = [&](double Sample::*m) {
        return (1.0 - fv) * ((1.0 - fu) * a.*m + fu * b.*m) + fv * ((1.0 - fu) * c.*m + fu * d.*m);
    };
    const double su = mix(&Sample::slope_u), sv = mix(&Sample::slope_v);
    const double height = std::abs(q.z() - mix(&Sample::height)) / std::sqrt(1.0 + su * su + sv * sv);
    const double t = mix(&Sample::half_thickness);
    return std::hypot(std::max(mix(&Sample::outline) + beyond + t, 0.0), height) - t;
}

} // namespace

ImplicitShape sheet_shape(const SheetPlane& plane, const std::vector<SheetStation>& outline,
                          const std::vector<SheetStation>& inside, double table_step) {
    FASCICLE_ASSERT(outline.size() >= 3 && table_step > 0.0);
    auto table = std::make_shared<Table>();
    table->to_local << plane.u.transpose(), plane.v.transpose(), plane.u.cross(plane.v).transpose();
    table->origin = plane.origin;
    table->step = table_step;
    std::vector<Vec3> local;
    std::vector<double> thickness;
    std::vector<Vec2> corners;
    Vec2 range(std::numeric_limits<double>::max(), 0.0);
    for (const auto* list : {&outline, &inside})
        for (const SheetStation& s : *list) {
            FASCICLE_ASSERT(s.half_thickness > 0.0);
            local.push_back(table->to_local * (s.point - plane.origin));
            thickness.push_back(s.half_thickness);
            range = Vec2(std::min(range.x(), s.half_thickness), std::max(range.y(), s.half_thickness));
            if (list == &outline)
                corners.push_back(local.back().head<2>());
        }
    const std::vector<Vec2> polygon = smooth_polygon(corners, 8);
    Eigen::AlignedBox2d box;
    for (const Vec2& p : polygon)
        box.extend(p);
    const double margin = range.y() + 4.0 * table_step;
    table->lower = box.min() - Vec2::Constant(margin);
    table->nu = static_cast<int>(std::ceil((box.sizes().x() + 2.0 * margin) / table_step)) + 1;
    table->nv = static_cast<int>(std::ceil((box.sizes().y() + 2.0 * margin) / table_step)) + 1;
    fill_table(*table, local, solve_splines(local, thickness), polygon, range);

    Eigen::AlignedBox3d hull; // of the middle surface inside the outline, in local axes
    for (int j = 0, k = 0; j < table->nv; ++j)
        for (int i = 0; i < table->nu; ++i, ++k)
            if (const Sample& s = table->samples[static_cast<std::size_t>(k)]; s.outline < table_step)
                hull.extend(
                    Vec3(table->lower.x() + table_step * i, table->lower.y() + table_step * j, s.height));
    const Vec3 centre = plane.origin + table->to_local.transpose() * hull.center();
    return {[table](const Vec3& p) { return value_at(*table, p); }, centre,
            0.5 * hull.sizes().norm() + range.y()};
}

} // namespace fascicle
