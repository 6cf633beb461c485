#include "fascicle/geometry/line_hits.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

constexpr std::size_t lanes = 4;

/// The line seen along itself: a point's place beside the line (x, y) and along it (z, in units of the direction).
struct LineFrame {
    Vec3 origin;
    Eigen::Index major, first, second; ///< axes; `major` is where the direction is longest
    double shear_x, shear_y, scale;

    LineFrame(const Vec3& from, const Vec3& direction) : origin(from) {
        direction.cwiseAbs().maxCoeff(&major);
        first = (major + 1) % 3;
        second = (major + 2) % 3;
        if (direction[major] < 0.0)
            std::swap(first, second); // keeps the sense of rotation
        scale = 1.0 / direction[major];
        shear_x = direction[first] * scale;
        shear_y = direction[second] * scale;
    }
    Vec3 place(const Vec3& p) const {
        const Vec3 q = p - origin;
        return {q[first] - shear_x * q[major], q[second] - shear_y * q[major], scale * q[major]};
    }
};

/// Whether the line through `origin` may meet the box; a line beside an axis divides by zero, and infinities decide.
bool meets_box(const Vec3& origin, const Vec3& inverse, const Vec3& low, const Vec3& high) {
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < 3; ++k) {
        if (!std::isfinite(inverse[k])) {
            if (origin[k] < low[k] || origin[k] > high[k])
                return false;
            continue;
        }
        const double a = (low[k] - origin[k]) * inverse[k], b = (high[k] - origin[k]) * inverse[k];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    // Rounding of the six quotients must not lose a box that is touched.
    return enter <= leave + 1e-12 * (std::abs(enter) + std::abs(leave));
}

} // namespace

void TriangleBvh::line_hits(const Vec3& origin, const Vec3& direction, std::vector<LineHit>& hits) const {
    FASCICLE_ASSERT(direction.squaredNorm() > 0.0);
    if (nodes_.empty() || !origin.allFinite() || !direction.allFinite())
        return;
    const LineFrame frame(origin, direction);
    const Vec3 inverse = direction.cwiseInverse();
    const auto try_leaf_lanes = [&](std::size_t number) {
        const Leaf& leaf = leaves_[number];
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const std::size_t slot = lanes * number + lane;
            const int triangle = triangle_of_[slot];
            if (slot_of_[static_cast<std::size_t>(triangle)] != static_cast<int>(slot))
                continue; // a spare lane
            const auto corner = [&](std::size_t i) {
                const auto& c = leaf.corners[i];
                return frame.place(Vec3(c[0][lane], c[1][lane], c[2][lane]));
            };
            const Vec3 a = corner(0), b = corner(1), c = corner(2);
            // Twice the signed areas against the line; exactly opposite for the two triangles of an edge.
            const double u = c.x() * b.y() - c.y() * b.x();
            const double v = a.x() * c.y() - a.y() * c.x();
            const double w = b.x() * a.y() - b.y() * a.x();
            if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0))
                continue;
            const double area = u + v + w;
            if (area == 0.0)
                continue;
            // A counter-clockwise triangle seen from where the line comes has its outward normal against the line.
            hits.push_back({(u * a.z() + v * b.z() + w * c.z()) / area, triangle, area > 0.0});
        }
    };
    std::array<int, 64> stack{}; // depth < 18 levels, each leaves at most 3 siblings behind
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const int child = stack[--depth];
        if (child < 0) {
            try_leaf_lanes(static_cast<std::size_t>(~child));
            continue;
        }
        const Node& node = nodes_[static_cast<std::size_t>(child)];
        for (std::size_t i = 0; i < lanes; ++i) {
            const Vec3 low(node.low[0][i], node.low[1][i], node.low[2][i]);
            const Vec3 high(node.high[0][i], node.high[1][i], node.high[2][i]);
            if (!(low.x() <= high.x()) || !meets_box(origin, inverse, low, high))
                continue; // absent, or missed
            FASCICLE_ASSERT(depth < stack.size());
            stack[depth++] = node.child[i];
        }
    }
}

void inside_intervals(std::vector<LineHit>& hits, double same, std::vector<LineInterval>& intervals) {
    std::sort(hits.begin(), hits.end(), [](const LineHit& a, const LineHit& b) {
        return a.position != b.position ? a.position < b.position : a.triangle < b.triangle;
    });
    int depth = 0;
    double begin = 0;
    double last_in = -std::numeric_limits<double>::infinity(), last_out = last_in;
    for (const LineHit& hit : hits) {
        double& last = hit.entering ? last_in : last_out;
        if (hit.position - last <= same)
            continue;
        last = hit.position;
        if (hit.entering && depth++ == 0)
            begin = hit.position;
        if (!hit.entering && depth-- == 1 && hit.position > begin)
            intervals.push_back({begin, hit.position});
    }
}

} // namespace fascicle
