#include "fascicle/geometry/bvh.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/closest_point.hpp"
#include "triangle_tree.hpp"

#include <cmath>

namespace fascicle {

namespace {

constexpr int lanes = 4;
constexpr int absent = std::numeric_limits<int>::min(); // no child here
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Pending {
    double squared_distance;
    int child; // >= 0: a node, else leaf ~child
};

// Depth of the tree is at most log4(2^31) + 2 < 18, each level leaves at most 3 siblings behind.
constexpr std::size_t stack_size = 64;

// Two doubles at once (SSE2, which every x86-64 has; elsewhere the compiler finds its own way).
using Pair = double __attribute__((vector_size(16)));

Pair load(const double* from) {
    return Pair{from[0], from[1]};
}
Pair both(double x) {
    return Pair{x, x};
}
Pair larger(Pair a, Pair b) {
    return a > b ? a : b;
}
Pair smaller(Pair a, Pair b) {
    return a < b ? a : b;
}

struct Pair3 {
    Pair x, y, z;
    Pair3 operator-(const Pair3& o) const { return {x - o.x, y - o.y, z - o.z}; }
    Pair dot(const Pair3& o) const { return x * o.x + y * o.y + z * o.z; }
    Pair3 cross(const Pair3& o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
};

/// Squared distance of the segment from 0 to d and the point q; d may be zero.
Pair segment_squared_distance(const Pair3& q, const Pair3& d, Pair dd) {
    const Pair t = smaller(larger(q.dot(d), both(0.0)) / larger(dd, both(1e-300)), both(1.0));
    const Pair3 rest{q.x - t * d.x, q.y - t * d.y, q.z - t * d.z};
    return rest.dot(rest);
}

/// Squared distances of two triangles, by the rules of closest_point_on_triangle, without branches.
Pair triangle_squared_distance(const Pair3& p, const Pair3& a, const Pair3& b, const Pair3& c) {
    const Pair3 ab = b - a, ac = c - a, bc = c - b, ap = p - a, bp = p - b;
    const Pair3 normal = ab.cross(ac);
    const Pair nn = normal.dot(normal);
    const Pair ab2 = ab.dot(ab), ac2 = ac.dot(ac), bc2 = bc.dot(bc);
    const Pair longest = larger(ab2, larger(ac2, bc2));
    const Pair part_a = bc.cross(bp).dot(normal);
    const Pair part_b = ap.cross(ac).dot(normal);
    const Pair part_c = ab.cross(ap).dot(normal);
    const Pair height = ap.dot(normal);
    const auto flat = nn > 1e-24 * longest * longest;
    const auto above = flat & (smaller(part_a, smaller(part_b, part_c)) >= both(0.0));
    const Pair edges =
        smaller(segment_squared_distance(ap, ab, ab2),
                smaller(segment_squared_distance(ap, ac, ac2), segment_squared_distance(bp, bc, bc2)));
    return above ? height * height / larger(nn, both(1e-300)) : edges;
}

} // namespace

TriangleBvh::TriangleBvh(const Points& points, const std::vector<Tri>& triangles) {
    const TriangleTree tree = build_triangle_tree(points, triangles, lanes);
    slot_of_.resize(tree.order.size());
    nodes_.resize(tree.nodes.size());
    const std::size_t leaf_count = tree.order.size() / lanes + 1; // all are full but one
    leaves_.reserve(leaf_count);
    triangle_of_.reserve(leaf_count * lanes);
    slot_vertices_.reserve(leaf_count * lanes);
    for (std::size_t n = 0; n < nodes_.size(); ++n)
        for (std::size_t i = 0; i < 4; ++i) {
            const TriangleTree::Child& child = tree.nodes[n].children[i];
            nodes_[n].child[i] = child.begin == child.end ? absent : child.node;
            if (nodes_[n].child[i] != -1)
                continue;
            nodes_[n].child[i] = ~static_cast<int>(leaves_.size());
            leaves_.emplace_back();
            for (int lane = 0; lane < lanes; ++lane) {
                const int triangle =
                    tree.order[static_cast<std::size_t>(std::min(child.begin + lane, child.end - 1))];
                if (child.begin + lane < child.end)
                    slot_of_[static_cast<std::size_t>(triangle)] = static_cast<int>(triangle_of_.size());
                triangle_of_.push_back(triangle);
                slot_vertices_.push_back(triangles[static_cast<std::size_t>(triangle)]);
            }
        }
    refit(points);
}

void TriangleBvh::refit(const Points& points) {
    for (std::size_t slot = 0; slot < slot_vertices_.size(); ++slot)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const Vec3& p = points[static_cast<std::size_t>(slot_vertices_[slot][corner])];
            for (std::size_t k = 0; k < 3; ++k)
                leaves_[slot / lanes].corners[corner][k][slot % lanes] = p[static_cast<Eigen::Index>(k)];
        }
    fit_boxes();
}

void TriangleBvh::fit_boxes() {
    for (std::size_t n = nodes_.size(); n-- > 0;) { // children come after their parents
        Node& node = nodes_[n];
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                double low = infinity, high = -infinity;
                if (node.child[i] >= 0) {
                    const Node& below = nodes_[static_cast<std::size_t>(node.child[i])];
                    for (std::size_t j = 0; j < 4; ++j) {
                        low = std::min(low, below.low[k][j]);
                        high = std::max(high, below.high[k][j]);
                    }
                } else if (node.child[i] != absent) {
                    for (const auto& corner : leaves_[static_cast<std::size_t>(~node.child[i])].corners)
                        for (const double x : corner[k]) {
                            low = std::min(low, x);
                            high = std::max(high, x);
                        }
                }
                node.low[k][i] = low;
                node.high[k][i] = high;
            }
    }
}

void TriangleBvh::try_leaf(const Leaf& leaf, int number, const Vec3& p, Nearest& best) {
    const Pair3 at{both(p.x()), both(p.y()), both(p.z())};
    for (int half = 0; half < 2; ++half) {
        const auto corner = [&](std::size_t i) {
            const auto& c = leaf.corners[i];
            const auto lane = static_cast<std::size_t>(2 * half);
            return Pair3{load(&c[0][lane]), load(&c[1][lane]), load(&c[2][lane])};
        };
        const Pair d2 = triangle_squared_distance(at, corner(0), corner(1), corner(2));
        for (int lane = 0; lane < 2; ++lane)
            if (d2[lane] < best.squared_distance)
                best = {d2[lane], lanes * number + 2 * half + lane};
    }
}

void TriangleBvh::search(const Vec3& p, double stop, Nearest& best) const {
    if (nodes_.empty())
        return;
    std::array<Pending, stack_size> stack;
    std::size_t depth = 0;
    stack[depth++] = {0.0, 0};
    while (depth > 0 && best.squared_distance > stop) {
        const Pending top = stack[--depth];
        if (top.squared_distance >= best.squared_distance)
            continue;
        if (top.child < 0) {
            try_leaf(leaves_[static_cast<std::size_t>(~top.child)], ~top.child, p, best);
            continue;
        }
        const Node& node = nodes_[static_cast<std::size_t>(top.child)];
        std::array<double, 4> d2;
        for (std::size_t i = 0; i < 4; i += 2) {
            Pair sum = both(0.0);
            for (std::size_t k = 0; k < 3; ++k) {
                const Pair x = both(p[static_cast<Eigen::Index>(k)]);
                const Pair gap =
                    larger(larger(load(&node.low[k][i]) - x, x - load(&node.high[k][i])), both(0.0));
                sum += gap * gap;
            }
            d2[i] = sum[0];
            d2[i + 1] = sum[1];
        }
        const std::size_t base = depth;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!(d2[i] < best.squared_distance))
                continue;
            std::size_t at = depth++;
            FASCICLE_ASSERT(depth <= stack_size);
            for (; at > base && stack[at - 1].squared_distance < d2[i]; --at)
                stack[at] = stack[at - 1];
            stack[at] = {d2[i], node.child[i]};
        }
    }
}

double TriangleBvh::closest_squared_distance(const Vec3& p, double max_distance, int& hint,
                                             double good_enough) const {
    Nearest best{max_distance * max_distance, -1};
    if (hint >= 0) {
        const int leaf = slot_of_[static_cast<std::size_t>(hint)] / lanes;
        try_leaf(leaves_[static_cast<std::size_t>(leaf)], leaf, p, best);
    }
    search(p, good_enough * good_enough, best);
    if (best.slot >= 0)
        hint = triangle_of_[static_cast<std::size_t>(best.slot)];
    return best.squared_distance;
}

SurfacePoint TriangleBvh::closest(const Vec3& p, double max_distance, int hint) const {
    SurfacePoint result;
    int triangle = hint;
    const double reach = max_distance * max_distance;
    result.squared_distance = closest_squared_distance(p, max_distance, triangle);
    if (!(result.squared_distance < reach))
        return result;
    const auto slot = static_cast<std::size_t>(slot_of_[static_cast<std::size_t>(triangle)]);
    const auto corner = [&](std::size_t i) {
        const auto& c = leaves_[slot / lanes].corners[i];
        return Vec3(c[0][slot % lanes], c[1][slot % lanes], c[2][slot % lanes]);
    };
    const TrianglePoint foot = closest_point_on_triangle(p, corner(0), corner(1), corner(2));
    return {triangle, foot.squared_distance, foot.point, foot.weights};
}

std::size_t TriangleBvh::bytes() const {
    return nodes_.size() * sizeof(Node) + leaves_.size() * sizeof(Leaf) +
           slot_vertices_.size() * (sizeof(Tri) + 2 * sizeof(int));
}

} // namespace fascicle
