#include "fascicle/geometry/winding_number.hpp"

#include "fascicle/base/assert.hpp"
#include "triangle_tree.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

constexpr int leaf_size = 4;
constexpr double four_pi = 4.0 * std::numbers::pi;
constexpr std::size_t stack_size = 64; // depth < 18, at most 3 siblings stay behind on each level

double solid_angle_from(const Vec3& p, const std::array<Vec3, 3>& t) {
    return solid_angle(t[0] - p, t[1] - p, t[2] - p);
}

} // namespace

double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double det = a.dot(b.cross(c));
    const double base = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    // In the triangle's plane the angle is 0 or +-2 pi, undecided on the triangle itself: taken as 0.
    return det == 0.0 ? 0.0 : 2.0 * std::atan2(det, base);
}

WindingNumber::WindingNumber(const Points& points, const std::vector<Tri>& triangles) {
    const TriangleTree tree = build_triangle_tree(points, triangles, leaf_size);
    slot_of_.resize(tree.order.size());
    corners_.resize(tree.order.size());
    for (std::size_t slot = 0; slot < corners_.size(); ++slot) {
        const auto triangle = static_cast<std::size_t>(tree.order[slot]);
        slot_of_[triangle] = static_cast<int>(slot);
        for (std::size_t k = 0; k < 3; ++k)
            corners_[slot][k] = points[static_cast<std::size_t>(triangles[triangle][k])];
    }
    nodes_.resize(tree.nodes.size());
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        nodes_[n].count = tree.nodes[n].count;
        for (std::size_t i = 0; i < static_cast<std::size_t>(nodes_[n].count); ++i) {
            Group& group = nodes_[n].groups[i];
            const TriangleTree::Child& child = tree.nodes[n].children[i];
            group.begin = child.begin;
            group.end = child.end;
            group.node = child.node;
            fit_group(group);
        }
    }
}

void WindingNumber::fit_group(Group& group) const {
    // From the triangles themselves on every level: T log T in all, and the radii are as small as they can
    // be.
    double weight = 0.0;
    Vec3 plain = Vec3::Zero();
    for (int slot = group.begin; slot < group.end; ++slot) {
        const auto& t = corners_[static_cast<std::size_t>(slot)];
        const Vec3 area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
        group.area += area;
        group.centre += area.norm() * middle;
        weight += area.norm();
        plain += middle;
    }
    group.centre = weight > 0.0 ? Vec3(group.centre / weight) : Vec3(plain / (group.end - group.begin));
    double r2 = 0.0;
    for (int slot = group.begin; slot < group.end; ++slot) {
        const auto& t = corners_[static_cast<std::size_t>(slot)];
        const Vec3 area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
        group.moment += area * ((t[0] + t[1] + t[2]) / 3.0 - group.centre).transpose();
        for (const Vec3& corner : t)
            r2 = std::max(r2, (corner - group.centre).squaredNorm());
    }
    group.radius = std::sqrt(r2);
}

double WindingNumber::exact(const Vec3& p) const {
    double sum = 0.0;
    for (int slot : slot_of_)
        sum += solid_angle_from(p, corners_[static_cast<std::size_t>(slot)]);
    return sum / four_pi;
}

double WindingNumber::fast(const Vec3& p, double beta) const {
    FASCICLE_ASSERT(beta >= 2.0);
    if (nodes_.empty())
        return 0.0;
    double sum = 0.0;
    std::array<int, stack_size> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const Node& node = nodes_[static_cast<std::size_t>(stack[--depth])];
        for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i) {
            const Group& group = node.groups[i];
            const Vec3 d = group.centre - p;
            const double d2 = d.squaredNorm(), reach = beta * group.radius;
            if (d2 > reach * reach) {
                sum += (group.area.dot(d) + group.moment.trace() - 3.0 * d.dot(group.moment * d) / d2) /
                       (d2 * std::sqrt(d2));
            } else if (group.node >= 0) {
                FASCICLE_ASSERT(depth < stack_size);
                stack[depth++] = group.node;
            } else {
                for (int slot = group.begin; slot < group.end; ++slot)
                    sum += solid_angle_from(p, corners_[static_cast<std::size_t>(slot)]);
            }
        }
    }
    return sum / four_pi;
}

bool WindingNumber::inside(const Vec3& p) const {
    const double w = fast(p, 2.0);
    return std::abs(w - 0.5) < 0.1 ? exact(p) > 0.5 : w > 0.5;
}

} // namespace fascicle
