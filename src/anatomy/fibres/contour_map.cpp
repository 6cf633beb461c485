#include "anatomy/fibres/contour_map.hpp"

#include "anatomy/fibres/mean_value.hpp"
#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fascicle {

struct ContourMap::Loop {
    Points points; ///< loop_points at equal steps, in the order of the rectangle
    Vec3 centre = Vec3::Zero();
    Vec3 area = Vec3::Zero(); ///< enclosed, as a vector along the field's gradient
};

namespace {

constexpr std::size_t n = ContourMap::loop_points;
constexpr std::size_t most_heads = 6;

/// Corner k = 0..4 of a width x depth rectangle as the number of the loop point nearest by share of the perimeter.
std::array<std::size_t, 5> corners_of(const Vec2& size) {
    const double perimeter = 2.0 * (size.x() + size.y());
    const auto side = std::clamp<std::size_t>(
        static_cast<std::size_t>(std::lround(double(n) * size.x() / perimeter)), 1, n / 2 - 1);
    return {0, side, n / 2, n / 2 + side, n};
}

/// Points 0..n-1 on the border of the rectangle, evenly on each side.
std::vector<Vec2> rectangle_of(const Vec2& size) {
    const auto corner = corners_of(size);
    const std::array<Vec2, 5> at{Vec2(0, 0), Vec2(size.x(), 0), size, Vec2(0, size.y()), Vec2(0, 0)};
    std::vector<Vec2> points;
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = corner[k]; i < corner[k + 1]; ++i) {
            const double share = double(i - corner[k]) / double(corner[k + 1] - corner[k]);
            points.emplace_back((1.0 - share) * at[k] + share * at[k + 1]);
        }
    return points;
}

} // namespace

ContourMap::ContourMap(const TriMesh& mesh, const MeshTopology& topology, const std::vector<double>& field,
                       int levels, const TemplateFrame& frame)
    : mirrored_(frame.z.cross(frame.x).dot(frame.y) < 0) {
    FASCICLE_ASSERT(levels >= 1);
    IsolineFinder finder(mesh, topology, field);
    std::vector<std::vector<Loop>> loops(static_cast<std::size_t>(levels) + 1);
    const double edge = 1e-6; // the ends lie just off the attachments, where the field is flat
    for (std::size_t c = 0; c < loops.size(); ++c) {
        const double value = edge + (1.0 - 2.0 * edge) * double(c) / double(levels);
        const std::vector<Isoline> found = finder.at(value);
        for (const Isoline& line : found) {
            if (loops[c].size() == most_heads || line.length < 0.1 * found.front().length)
                break;
            Loop loop{resampled_loop(line, n), Vec3::Zero(), Vec3::Zero()};
            // Isolines run clockwise about the gradient, as (0,0), (1,0), (1,1), (0,1) of (x, z) does about y.
            if (mirrored_)
                std::reverse(loop.points.begin(), loop.points.end());
            for (const Vec3& p : loop.points)
                loop.centre += p / double(n);
            for (std::size_t i = 0; i < n; ++i)
                loop.area -=
                    0.5 * (loop.points[i] - loop.centre).cross(loop.points[(i + 1) % n] - loop.centre);
            if (mirrored_)
                loop.area = -loop.area;
            loops[c].push_back(std::move(loop));
        }
        if (loops[c].empty()) { // one point for a loop: the vertex that comes nearest to the value
            ++empty_levels_;
            std::size_t best = 0;
            for (std::size_t v = 0; v < field.size(); ++v)
                if (std::abs(field[v] - value) < std::abs(field[best] - value))
                    best = v;
            loops[c].push_back({Points(n, mesh.positions[best]), mesh.positions[best], Vec3::Zero()});
        }
        most_loops_ = std::max(most_loops_, static_cast<int>(loops[c].size()));
    }
    // Start where the muscle is in one piece and thickest, and go both ways from there.
    std::size_t start = loops.size() / 2;
    const auto better = [&](std::size_t a, std::size_t b) {
        if (loops[a].size() != loops[b].size())
            return loops[a].size() < loops[b].size();
        return loops[a][0].area.norm() > loops[b][0].area.norm();
    };
    for (std::size_t c = 0; c < loops.size(); ++c)
        if (better(c, start))
            start = c;
    levels_.resize(loops.size());
    levels_[start] = make_level(loops[start], nullptr, frame);
    for (std::size_t c = start; c-- > 0;)
        levels_[c] = make_level(loops[c], &levels_[c + 1], frame);
    for (std::size_t c = start + 1; c < loops.size(); ++c)
        levels_[c] = make_level(loops[c], &levels_[c - 1], frame);
}

ContourMap::Level ContourMap::make_level(const std::vector<Loop>& loops, const Level* beside,
                                         const TemplateFrame& frame) const {
    Level level;
    level.x = beside != nullptr ? beside->x : frame.x;
    level.z = beside != nullptr ? beside->z : frame.z;
    Vec3 area = Vec3::Zero();
    for (const Loop& loop : loops)
        area += loop.area;
    // Turn the axes into the level's plane by the smallest rotation, so that they follow a bent muscle.
    if (const Vec3 normal = (mirrored_ ? -1.0 : 1.0) * level.z.cross(level.x);
        area.norm() > 0 && normal.norm() > 0) {
        const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(normal, area);
        if (normal.dot(area) > -0.5 * normal.norm() * area.norm()) {
            level.x = turn * level.x;
            level.z = turn * level.z;
        }
    }
    if (loops.size() == 1) {
        level.strips.push_back(make_strip(loops[0], 0, 1, 0, level, beside));
        return level;
    }
    // Shares of the loops, then the axis and the order that leave the fibres nearest to where they are beside.
    std::vector<double> share;
    double sum = 0;
    for (const Loop& loop : loops)
        sum += loop.area.norm();
    for (const Loop& loop : loops)
        share.push_back(std::max(0.02, sum > 0 ? loop.area.norm() / sum : 1.0));
    const double shares = std::accumulate(share.begin(), share.end(), 0.0);
    const auto target = [&](double x, double z) {
        if (beside != nullptr)
            return at(*beside, x, z);
        Vec3 centre = Vec3::Zero();
        for (const Loop& loop : loops)
            centre += loop.centre / double(loops.size());
        double spread = 0;
        for (const Loop& loop : loops)
            spread = std::max(spread, (loop.centre - centre).norm());
        return Vec3(centre + 2.0 * spread * ((x - 0.5) * level.x + (z - 0.5) * level.z));
    };
    std::array<std::array<Vec3, 5>, 5> targets;
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j)
            targets[i][j] = target((double(i) + 0.5) / 5, (double(j) + 0.5) / 5);
    std::vector<std::size_t> order(loops.size()), best_order;
    std::iota(order.begin(), order.end(), std::size_t{0});
    double best = std::numeric_limits<double>::infinity();
    do
        for (const int axis : {0, 1}) {
            double cost = 0;
            for (std::size_t i = 0; i < 5; ++i) {
                std::size_t k = 0;
                for (double end = share[order[0]] / shares;
                     end < (double(i) + 0.5) / 5 && k + 1 < order.size();)
                    end += share[order[++k]] / shares;
                for (std::size_t j = 0; j < 5; ++j)
                    cost +=
                        (loops[order[k]].centre - (axis == 0 ? targets[i][j] : targets[j][i])).squaredNorm();
            }
            if (cost < best) {
                best = cost;
                best_order = order;
                level.axis = axis;
            }
        }
    while (std::next_permutation(order.begin(), order.end()));
    double low = 0;
    for (std::size_t k = 0; k < best_order.size(); ++k) {
        const double high = k + 1 == best_order.size() ? 1.0 : low + share[best_order[k]] / shares;
        level.strips.push_back(make_strip(loops[best_order[k]], low, high, level.axis, level, beside));
        low = high;
    }
    return level;
}

ContourMap::Strip ContourMap::make_strip(const Loop& loop, double low, double high, int axis,
                                         const Level& level, const Level* beside) const {
    Strip strip;
    strip.low = low;
    strip.high = high;
    Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity()), most = -least;
    for (const Vec3& p : loop.points) {
        const Vec2 q((p - loop.centre).dot(level.x), (p - loop.centre).dot(level.z));
        least = least.cwiseMin(q);
        most = most.cwiseMax(q);
    }
    strip.size = most - least;
    strip.size = strip.size.cwiseMax(0.02 * strip.size.maxCoeff());
    if (!(strip.size.maxCoeff() > 0))
        strip.size = Vec2::Ones();
    strip.rectangle = rectangle_of(strip.size);
    // The start that brings points on the border nearest to where they are in the level beside, or, in the first level,
    // to the rectangle itself. Both sets less their means: a shift is no twist.
    constexpr std::size_t step = 4;
    Points targets;
    Vec3 mean_target = Vec3::Zero(), mean_loop = Vec3::Zero();
    for (std::size_t i = 0; i < n; i += step) {
        Vec2 q = strip.rectangle[i].cwiseQuotient(strip.size);
        if (beside != nullptr) {
            double& shared = axis == 0 ? q.x() : q.y();
            shared = low + shared * (high - low);
            targets.push_back(at(*beside, q.x(), q.y()));
        } else
            targets.push_back(strip.rectangle[i].x() * level.x + strip.rectangle[i].y() * level.z);
        mean_target += targets.back() * double(step) / double(n);
    }
    for (const Vec3& p : loop.points)
        mean_loop += p / double(n);
    std::size_t best_start = 0;
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t start = 0; start < n; ++start) {
        double agreement = 0;
        for (std::size_t i = 0; i < n; i += step)
            agreement += (loop.points[(start + i) % n] - mean_loop).dot(targets[i / step] - mean_target);
        if (agreement > best) {
            best = agreement;
            best_start = start;
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        strip.contour.push_back(loop.points[(best_start + i) % n]);
    return strip;
}

Vec3 ContourMap::at(const Level& level, double x, double z) const {
    double shared = level.axis == 0 ? x : z;
    std::size_t k = 0;
    while (k + 1 < level.strips.size() && shared >= level.strips[k].high)
        ++k;
    const Strip& strip = level.strips[k];
    shared = std::clamp((shared - strip.low) / (strip.high - strip.low), 0.0, 1.0);
    const Vec2 q = (level.axis == 0 ? Vec2(shared, z) : Vec2(x, shared)).cwiseProduct(strip.size);
    std::array<double, n> weights;
    mean_value_weights(strip.rectangle, q, weights);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < n; ++i)
        sum += weights[i] * strip.contour[i];
    return sum;
}

Vec3 ContourMap::operator()(const Vec3& cube) const {
    const double last = double(levels_.size() - 1);
    double height = std::clamp(cube.y(), 0.0, 1.0) * last;
    if (const double whole = std::round(height); std::abs(height - whole) < 1e-9)
        height = whole;
    const auto below = std::min(static_cast<std::size_t>(height), levels_.size() - 1);
    const double share = height - double(below);
    const Vec3 lower = at(levels_[below], cube.x(), cube.z());
    if (share == 0.0)
        return lower;
    return (1.0 - share) * lower + share * at(levels_[below + 1], cube.x(), cube.z());
}

} // namespace fascicle
