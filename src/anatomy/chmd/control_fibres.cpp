#include "control_fibres.hpp"

#include "curve_tools.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/geometry/bounding_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace fascicle::chmd {

namespace {

constexpr int most_fibres = 500;

std::string millimetres(double length, const FibreProblem& problem) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f mm", length * problem.unit_mm);
    return text;
}

/// Points of one line, repeated ones left out.
Points line_points(const FibreProblem& problem, std::size_t number) {
    const Polylines& given = *problem.surface_fibres;
    const std::string who = "surface fibre " + std::to_string(number + 1);
    Points line;
    for (const int i : given.lines[number]) {
        if (i < 0 || static_cast<std::size_t>(i) >= given.points.size())
            throw_error(problem.muscle, who + " uses point " + std::to_string(i) + ", which does not exist",
                        "a point number below " + std::to_string(given.points.size()));
        const Vec3& p = given.points[static_cast<std::size_t>(i)];
        if (!p.allFinite())
            throw_error(problem.muscle, who + " has a point that is not finite", "finite coordinates");
        if (line.empty() || (p - line.back()).norm() > 1e-9 * (1.0 + p.norm()))
            line.push_back(p);
    }
    if (line.size() < 2)
        throw_error(problem.muscle, who + " has fewer than 2 different points",
                    "a polyline from origin to insertion");
    return line;
}

/// Returns the greatest distance of a point to the surface.
double require_near(const FibreProblem& problem, const SolidQuery& solid, const Points& line,
                    std::size_t number) {
    BoundingBox box;
    for (const Vec3& p : problem.surface->positions)
        box.add(p);
    const double limit = std::max(10.0 / problem.unit_mm, 0.05 * box.diagonal());
    double sum = 0, farthest = 0;
    for (const Vec3& p : line) {
        const double distance = std::sqrt(solid.bvh().closest(p).squared_distance);
        sum += distance;
        farthest = std::max(farthest, distance);
    }
    const double mean = sum / static_cast<double>(line.size());
    if (mean > limit)
        throw_error(problem.muscle,
                    "surface fibre " + std::to_string(number + 1) + " lies " + millimetres(mean, problem) +
                        " from the muscle's surface on average",
                    "superficial fibres of this muscle, within " + millimetres(limit, problem) +
                        ", in its unit");
    return farthest;
}

double mean_gap(const Points& a, const Points& b) {
    double sum = 0;
    for (std::size_t j = 0; j < a.size(); ++j)
        sum += (a[j] - b[j]).norm();
    return sum / static_cast<double>(a.size());
}

/// Turns every fibre from origin to insertion.
void orient(std::vector<Points>& fibres, const PatchSurface& origin, const PatchSurface& insertion) {
    const auto far = [](const PatchSurface& patch, const Vec3& p) {
        return std::sqrt(patch.bvh.closest(p).squared_distance);
    };
    std::vector<char> sure(fibres.size());
    for (std::size_t i = 0; i < fibres.size(); ++i) {
        Points& line = fibres[i];
        const double forwards = far(origin, line.front()) + far(insertion, line.back());
        const double backwards = far(origin, line.back()) + far(insertion, line.front());
        sure[i] = std::abs(forwards - backwards) > 0.1 * polyline_length(line);
        if (backwards < forwards)
            std::reverse(line.begin(), line.end());
    }
    for (std::size_t i = 0; i < fibres.size(); ++i) {
        if (sure[i])
            continue;
        std::size_t nearest = i;
        double least = 0;
        bool turned = false;
        const Points line = equal_arcs(fibres[i], 16), back(line.rbegin(), line.rend());
        for (std::size_t k = 0; k < fibres.size(); ++k) {
            if (!sure[k])
                continue;
            const Points other = equal_arcs(fibres[k], 16);
            const double as_is = mean_gap(line, other), reversed = mean_gap(back, other);
            if (nearest == i || std::min(as_is, reversed) < least) {
                nearest = k;
                least = std::min(as_is, reversed);
                turned = reversed < as_is;
            }
        }
        if (turned)
            std::reverse(fibres[i].begin(), fibres[i].end());
    }
}

/// Shortest path through all fibres: the best of the nearest-neighbour paths, then pieces of it reversed while that helps.
std::vector<std::size_t> path_order(const std::vector<Points>& fibres) {
    const std::size_t n = fibres.size();
    std::vector<double> gap(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i + 1; k < n; ++k)
            gap[i * n + k] = gap[k * n + i] = mean_gap(fibres[i], fibres[k]);
    std::vector<std::size_t> best;
    double least = 0;
    for (std::size_t start = 0; start < n; ++start) {
        std::vector<std::size_t> path{start};
        std::vector<char> used(n, 0);
        used[start] = 1;
        double length = 0;
        while (path.size() < n) {
            std::size_t next = n;
            for (std::size_t k = 0; k < n; ++k)
                if (!used[k] && (next == n || gap[path.back() * n + k] < gap[path.back() * n + next]))
                    next = k;
            length += gap[path.back() * n + next];
            used[next] = 1;
            path.push_back(next);
        }
        if (best.empty() || length < least) {
            best = path;
            least = length;
        }
    }
    const auto step = [&](std::size_t a, std::size_t b) { return gap[best[a] * n + best[b]]; };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = i + 1; k < n; ++k) { // reverse i..k
                const double now = (i > 0 ? step(i - 1, i) : 0.0) + (k + 1 < n ? step(k, k + 1) : 0.0);
                const double then = (i > 0 ? step(i - 1, k) : 0.0) + (k + 1 < n ? step(i, k + 1) : 0.0);
                if (then < now * (1.0 - 1e-12)) {
                    std::reverse(best.begin() + static_cast<std::ptrdiff_t>(i),
                                 best.begin() + static_cast<std::ptrdiff_t>(k) + 1);
                    changed = true;
                }
            }
    }
    return best;
}

/// Negative when the fibres run from left to right seen from outside with the origin above.
double handedness(const FibreProblem& problem, const SolidQuery& solid, const std::vector<Points>& fibres) {
    double sum = 0;
    const std::size_t m = fibres.front().size();
    for (std::size_t i = 0; i + 1 < fibres.size(); ++i)
        for (std::size_t j = 0; j + 1 < m; ++j) {
            const int triangle = solid.bvh().closest(fibres[i][j]).triangle;
            const Tri& t = problem.surface->triangles[static_cast<std::size_t>(triangle)];
            const auto at = [&](std::size_t k) -> const Vec3& {
                return problem.surface->positions[static_cast<std::size_t>(t[k])];
            };
            const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
            const Vec3 across = fibres[i + 1][j] - fibres[i][j], along = fibres[i][j + 1] - fibres[i][j];
            sum += across.cross(along).dot(normal);
        }
    return sum;
}

bool comes_first(const Points& a, const Points& b) {
    for (std::size_t j = 0; j < a.size(); ++j)
        for (Eigen::Index k = 0; k < 3; ++k)
            if (a[j][k] != b[j][k])
                return a[j][k] < b[j][k];
    return false;
}

} // namespace

ControlFibres order_control_fibres(const FibreProblem& problem, const SolidQuery& solid,
                                   const PatchSurface& origin, const PatchSurface& insertion) {
    const std::string wanted = "2 to " + std::to_string(most_fibres) + " superficial fibres of this muscle";
    if (problem.surface_fibres == nullptr)
        throw_error(problem.muscle, "CHMD needs superficial fibres and there are none", wanted);
    const std::size_t n = problem.surface_fibres->lines.size();
    if (n < 2 || n > most_fibres)
        throw_error(problem.muscle,
                    "there " + std::string(n == 1 ? "is 1 surface fibre"
                                                  : "are " + std::to_string(n) + " surface fibres"),
                    wanted);
    std::vector<Points> lines;
    ControlFibres result;
    double longest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        lines.push_back(line_points(problem, i));
        result.farthest = std::max(result.farthest, require_near(problem, solid, lines.back(), i));
        longest = std::max(longest, polyline_length(lines.back()));
    }
    const int rows =
        static_cast<int>(std::clamp(std::ceil(longest * problem.unit_mm / 10.0) + 1.0, 8.0, 32.0));
    orient(lines, origin, insertion); // before resampling, so that a reversed line gives the same bits
    for (Points& line : lines)
        line = equal_arcs(smooth_line(line, 16), rows - 1);
    std::sort(lines.begin(), lines.end(), comes_first); // so that the order in the file does not matter
    for (const std::size_t i : path_order(lines))
        result.fibres.push_back(lines[i]);
    if (handedness(problem, solid, result.fibres) > 0.0)
        std::reverse(result.fibres.begin(), result.fibres.end());
    return result;
}

} // namespace fascicle::chmd
