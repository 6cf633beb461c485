#include "fascicle/geometry/segment_query.hpp"

#include "triangle_tree.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle {
namespace {

constexpr int leaf_size = 4;

/// Segment a + t d, t in [0, 1], against a box widened by `slack`: the shares in which it lies between each pair of planes.
bool meets_box(const Vec3& a, const Vec3& d, const Vec3& low, const Vec3& high, double slack) {
    double enter = 0, leave = 1;
    for (int k = 0; k < 3; ++k) {
        const double below = low[k] - slack - a[k], above = high[k] + slack - a[k];
        if (d[k] == 0.0) {
            if (below > 0 || above < 0)
                return false;
            continue;
        }
        const double first = below / d[k], second = above / d[k];
        enter = std::max(enter, std::min(first, second));
        leave = std::min(leave, std::max(first, second));
    }
    return enter <= leave * (1 + 1e-15) + 1e-15;
}

/// Signs of the six tetrahedra: the ends on two sides of the plane, and the line passes the three edges on one side. A volume
/// that may be rounding counts as either sign.
bool meets_triangle(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& c, double slack) {
    const Vec3 u = c[0] - a, v = c[1] - a, w = c[2] - a, d = b - a;
    const double size = std::max(
        {u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff(), d.cwiseAbs().maxCoeff()});
    const Vec3 normal = (v - u).cross(w - u);
    const double from = normal.dot(u),
                 to = from - normal.dot(d); // heights of a and b below the plane, times |normal|
    const double height_slack = (slack + 1e-14 * size) * normal.norm() + 1e-14 * size * size * size;
    if ((from > height_slack && to > height_slack) || (from < -height_slack && to < -height_slack))
        return false;
    const double volume_slack = (slack + 1e-14 * size) * size * d.norm();
    const double s0 = d.dot(u.cross(v)), s1 = d.dot(v.cross(w)), s2 = d.dot(w.cross(u));
    const bool left = s0 >= -volume_slack && s1 >= -volume_slack && s2 >= -volume_slack;
    const bool right = s0 <= volume_slack && s1 <= volume_slack && s2 <= volume_slack;
    return left || right;
}

} // namespace

SegmentQuery::SegmentQuery(const TriMesh& mesh) {
    const TriangleTree tree = build_triangle_tree(mesh.positions, mesh.triangles, leaf_size);
    double largest = 0;
    for (const int t : tree.order) {
        const Tri& triangle = mesh.triangles[static_cast<std::size_t>(t)];
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = mesh.positions[static_cast<std::size_t>(triangle[k])];
            largest = std::max(largest, corners[k].cwiseAbs().maxCoeff());
        }
        corners_.push_back(corners);
    }
    slack_ = 1e-12 * largest;
    for (const TriangleTree::Node& from : tree.nodes) {
        Node node;
        node.count = from.count;
        for (std::size_t i = 0; i < static_cast<std::size_t>(from.count); ++i) {
            const TriangleTree::Child& child = from.children[i];
            Box box{Vec3::Constant(std::numeric_limits<double>::infinity()),
                    Vec3::Constant(-std::numeric_limits<double>::infinity())};
            for (int t = child.begin; t < child.end; ++t)
                for (const Vec3& corner : corners_[static_cast<std::size_t>(t)]) {
                    box.low = box.low.cwiseMin(corner);
                    box.high = box.high.cwiseMax(corner);
                }
            node.children[i] = {box, child.begin, child.end, child.node};
        }
        nodes_.push_back(node);
    }
}

bool SegmentQuery::meets(const Vec3& a, const Vec3& b) const {
    if (!a.allFinite() || !b.allFinite())
        return true;
    if (nodes_.empty())
        return false;
    const Vec3 d = b - a;
    const double slack = slack_ + 1e-12 * std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff());
    std::array<int, 256> stack{}; // depth <= log4(2^31) + 2, three waiting a level
    int waiting = 0;
    stack[static_cast<std::size_t>(waiting++)] = 0;
    while (waiting > 0) {
        const Node& node = nodes_[static_cast<std::size_t>(stack[static_cast<std::size_t>(--waiting)])];
        for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i) {
            const Child& child = node.children[i];
            if (!meets_box(a, d, child.box.low, child.box.high, slack))
                continue;
            if (child.node >= 0) {
                stack[static_cast<std::size_t>(waiting++)] = child.node;
                continue;
            }
            for (int t = child.begin; t < child.end; ++t)
                if (meets_triangle(a, b, corners_[static_cast<std::size_t>(t)], slack))
                    return true;
        }
    }
    return false;
}

} // namespace fascicle
