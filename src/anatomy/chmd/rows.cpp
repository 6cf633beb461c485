#include "rows.hpp"

#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/line_hits.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::chmd {

namespace {

constexpr int probes = 8; ///< parts of a span at whose borders gaps are looked for

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

} // namespace

Rows::Rows(const FibreProblem& problem, const SolidQuery& solid, const ControlFibres& control)
    : mesh_(*problem.surface), solid_(solid) {
    double spacing = 0;
    for (int j = 0; j < control.rows(); ++j) {
        Points row;
        for (const Points& fibre : control.fibres)
            row.push_back(fibre[z(j)]);
        for (std::size_t i = 1; i < row.size(); ++i)
            spacing = std::max(spacing, (row[i] - row[i - 1]).norm());
        across_.emplace_back(std::move(row));
    }
    reach_ = std::max(10.0 / problem.unit_mm, 0.25 * spacing);
    thin_ = 1.0 / problem.unit_mm;
    find_normals(control);
    find_gaps(problem.threads);
}

Vec3 Rows::surface_normal(int triangle) const {
    const Tri& t = mesh_.triangles[z(triangle)];
    const Vec3 &a = mesh_.positions[z(t[0])], &b = mesh_.positions[z(t[1])], &c = mesh_.positions[z(t[2])];
    return (b - a).cross(c - a).normalized();
}

void Rows::find_normals(const ControlFibres& control) {
    const int m = rows(), n = control.count();
    // The surface's normals, the nearer the surface the more they count, without their part along the fibres: at the
    // muscle's ends the surface turns, the layers do not.
    Points local(z(m * n), Vec3::Zero()), mean(z(m), Vec3::Zero());
    for (int j = 0; j < m; ++j) {
        Vec3 along = Vec3::Zero();
        for (const Points& fibre : control.fibres)
            along += (fibre[z(std::min(j + 1, m - 1))] - fibre[z(std::max(j - 1, 0))]).normalized();
        along = along.squaredNorm() > 0.0 ? along.normalized() : along;
        for (int i = 0; i <= 4 * spans(); ++i) {
            const Vec3 p =
                i < 4 * spans() ? across_[z(j)].at(i / 4, 0.25 * (i % 4)) : across_[z(j)].points().back();
            const SurfacePoint near = solid_.bvh().closest(p);
            Vec3 normal =
                surface_normal(near.triangle) / (1.0 + near.squared_distance / (0.01 * reach_ * reach_));
            normal -= normal.dot(along) * along;
            mean[z(j)] += normal;
            local[z(j * n + (i + 2) / 4)] += normal;
        }
    }
    const auto unit = [](const Vec3& v) {
        return v.norm() > 1e-9 ? Vec3(v.normalized()) : Vec3(Vec3::Zero());
    };
    normals_.assign(z(m * n), Vec3::Zero());
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            Vec3 row = Vec3::Zero(), here = Vec3::Zero();
            for (int k = std::max(j - 2, 0); k <= std::min(j + 2, m - 1); ++k) {
                row += mean[z(k)];
                here += local[z(k * n + i)];
            }
            Vec3& normal = normals_[z(j * n + i)];
            // At the muscle's rim the surface turns away from the row: there the row decides.
            row = unit(row);
            here = unit(here);
            normal = unit(row + std::pow(std::max(0.0, row.dot(here)), 4) * here);
            if (normal.isZero()) // normals that cancel: all round a muscle; any direction across does
                normal = j > 0 ? normals_[z((j - 1) * n + i)]
                               : surface_normal(solid_.bvh().closest(control.fibres[z(i)].front()).triangle);
        }
}

Vec3 Rows::normal(int row, int span, double share) const {
    const auto at = z(row * (spans() + 1) + span);
    const Vec3 mean = (1.0 - share) * normals_[at] + share * normals_[at + 1];
    return mean.norm() > 1e-9 ? Vec3(mean.normalized()) : normals_[at];
}

Thickness Rows::probe(const Vec3& p, const Vec3& outward, double reach) const {
    std::vector<LineHit> hits;
    std::vector<LineInterval> intervals;
    solid_.bvh().line_hits(p, -outward, hits);
    inside_intervals(hits, 1e-9 * reach, intervals);
    Thickness found;
    double nearest = reach;
    for (const LineInterval& interval : intervals) {
        const double distance = std::max({interval.begin, -interval.end, 0.0});
        if (distance < nearest || (!found.hit && distance <= nearest)) {
            nearest = distance;
            found = {p - interval.begin * outward, p - interval.end * outward, true};
        }
    }
    return found;
}

void Rows::find_gaps(int threads) {
    gaps_.assign(z(rows() * spans()), Gap());
    parallel_for(threads, gaps_.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t at = begin; at < end; ++at) {
            const int j = static_cast<int>(at) / spans(), i = static_cast<int>(at) % spans();
            const auto thick = [&](double share) {
                return probe(across_[z(j)].at(i, share), normal(j, i, share), reach_).length();
            };
            const double left = thick(0.0), right = thick(1.0);
            if (left < 2.0 * thin_ || right < 2.0 * thin_)
                continue; // at the muscle's rim nothing can be said
            double first = 2, last = -1;
            for (int k = 1; k < probes; ++k)
                if (const double share = static_cast<double>(k) / probes; thick(share) < thin_) {
                    first = std::min(first, share);
                    last = share;
                }
            if (last < 0)
                continue;
            const auto edge = [&](double in, double out, double anchor) {
                for (int step = 0; step < 20; ++step) {
                    const double middle = 0.5 * (in + out);
                    (thick(middle) > 0.8 * anchor ? in : out) = middle;
                }
                return in;
            };
            gaps_[at] = {true, edge(0.0, first, left), edge(1.0, last, right)};
        }
    });
}

bool Rows::splits(int span, bool at_origin) const {
    int open = 0;
    while (open < rows() && gap(at_origin ? open : rows() - 1 - open, span).open)
        ++open;
    return open >= 2 && 8 * open >= rows();
}

int Rows::head(int fibre, bool at_origin) const {
    int count = 0;
    for (int span = 0; span < fibre; ++span)
        count += splits(span, at_origin) ? 1 : 0;
    return count;
}

Vec3 Rows::place(int row, int span, double share) const {
    const Gap& g = gap(row, span);
    if (g.open)
        share = share <= 0.5 ? g.left * 2.0 * share : 1.0 - (1.0 - g.right) * 2.0 * (1.0 - share);
    return across_[z(row)].at(span, share);
}

Thickness Rows::thickness(int row, int span, double share) const {
    const Vec3 p = place(row, span, share), outward = normal(row, span, share);
    const double graze = 3.0 * thin_;
    const Thickness found = probe(p, outward, reach_);
    if (found.length() > graze)
        return found;
    const SurfacePoint near = solid_.bvh().closest(p);
    const Thickness inner = probe(near.point - graze * surface_normal(near.triangle), outward, reach_);
    if (inner.length() > found.length())
        return inner;
    return found.hit ? found : Thickness{near.point, near.point, true};
}

} // namespace fascicle::chmd
