#include "fascicle/geometry/repair/self_intersection.hpp"

#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "geometry/triangle_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;
constexpr double wide_rounding = 1e-32;
#else
typedef long double Wide;
constexpr double wide_rounding = 1e-17;
#endif

int sign_of(Wide value, Wide size) {
    const Wide bound = wide_rounding * size;
    return value > bound ? 1 : value < -bound ? -1 : 0;
}

Wide absolute(Wide x) {
    return x < 0 ? -x : x;
}

int wide_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<std::array<Wide, 3>, 3> r;
    const std::array<const Vec3*, 3> rows{&a, &b, &c};
    for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            r[i][static_cast<std::size_t>(k)] = static_cast<Wide>((*rows[i])[k]) - static_cast<Wide>(d[k]);
    Wide sum = 0, size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto &p = r[(i + 1) % 3], &q = r[(i + 2) % 3];
        sum += r[i][2] * (p[0] * q[1] - p[1] * q[0]);
        size += absolute(r[i][2]) * (absolute(p[0] * q[1]) + absolute(p[1] * q[0]));
    }
    return sign_of(sum, size);
}

/// Whether the segment goes from one side of the triangle's plane to the other through the triangle or its border.
bool pierces(const Vec3& p, const Vec3& q, int side_p, int side_q, const std::array<const Vec3*, 3>& t) {
    if (side_p * side_q >= 0)
        return false;
    int low = 0, high = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const int s = orientation_sign(p, q, *t[k], *t[(k + 1) % 3]);
        low = std::min(low, s);
        high = std::max(high, s);
    }
    return low == 0 || high == 0;
}

/// Of two triangles in a plane: whether no side of either has all of the other on its outer side or on its line.
bool overlap_in_plane(const std::array<const Vec3*, 3>& s, const std::array<const Vec3*, 3>& t) {
    const Vec3 normal = (*s[1] - *s[0]).cross(*s[2] - *s[0]);
    int drop = 0;
    normal.cwiseAbs().maxCoeff(&drop);
    const int i = (drop + 1) % 3, j = (drop + 2) % 3;
    const auto side = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const Wide ux = static_cast<Wide>(b[i]) - a[i], uy = static_cast<Wide>(b[j]) - a[j];
        const Wide vx = static_cast<Wide>(c[i]) - a[i], vy = static_cast<Wide>(c[j]) - a[j];
        return sign_of(ux * vy - uy * vx, absolute(ux * vy) + absolute(uy * vx));
    };
    for (const auto& [one, other] : {std::pair{&s, &t}, std::pair{&t, &s}}) {
        const int turn = side(*(*one)[0], *(*one)[1], *(*one)[2]);
        if (turn == 0)
            return false;
        for (std::size_t k = 0; k < 3; ++k) {
            bool apart = true;
            for (const Vec3* p : *other)
                apart = apart && turn * side(*(*one)[k], *(*one)[(k + 1) % 3], *p) <= 0;
            if (apart)
                return false;
        }
    }
    return true;
}

struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

    void add(const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    bool meets(const Box& o) const {
        return (low.array() <= o.high.array()).all() && (o.low.array() <= high.array()).all();
    }
};

/// The triangles in the order of a tree, with their boxes.
class BoxTree {
public:
    BoxTree(const TriMesh& mesh, int leaf_size)
        : tree_(build_triangle_tree(mesh.positions, mesh.triangles, leaf_size)) {
        for (const int t : tree_.order) {
            Box box;
            for (const int v : mesh.triangles[static_cast<std::size_t>(t)])
                box.add(mesh.positions[static_cast<std::size_t>(v)]);
            boxes_.push_back(box);
        }
        for (const TriangleTree::Node& node : tree_.nodes) {
            node_boxes_.emplace_back();
            for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i)
                for (int slot = node.children[i].begin; slot < node.children[i].end; ++slot) {
                    node_boxes_.back()[i].add(boxes_[static_cast<std::size_t>(slot)].low);
                    node_boxes_.back()[i].add(boxes_[static_cast<std::size_t>(slot)].high);
                }
        }
    }
    int triangle(std::size_t slot) const { return tree_.order[slot]; }
    std::size_t size() const { return boxes_.size(); }

    /// visit(other slot) for every later slot whose box meets that of `slot`.
    template <typename Visit>
    void later_neighbours(std::size_t slot, const Visit& visit) const {
        const Box& box = boxes_[slot];
        std::array<int, 256> stack{}; // depth <= log4(2^31) + 2, three waiting a level
        std::size_t waiting = 0;
        stack[waiting++] = 0;
        while (waiting > 0) {
            const auto n = static_cast<std::size_t>(stack[--waiting]);
            const TriangleTree::Node& node = tree_.nodes[n];
            for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i) {
                const TriangleTree::Child& child = node.children[i];
                if (static_cast<std::size_t>(child.end) <= slot + 1 || !node_boxes_[n][i].meets(box))
                    continue;
                if (child.node >= 0) {
                    stack[waiting++] = child.node;
                    continue;
                }
                for (auto other = std::max(static_cast<std::size_t>(child.begin), slot + 1);
                     other < static_cast<std::size_t>(child.end); ++other)
                    if (boxes_[other].meets(box))
                        visit(other);
            }
        }
    }

private:
    TriangleTree tree_;
    std::vector<Box> boxes_; ///< by slot
    std::vector<std::array<Box, 4>> node_boxes_;
};

} // namespace

int orientation_sign(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = a - d, v = b - d, w = c - d;
    const double vw = v.x() * w.y(), wv = w.x() * v.y();
    const double wu = w.x() * u.y(), uw = u.x() * w.y();
    const double uv = u.x() * v.y(), vu = v.x() * u.y();
    const double det = u.z() * (vw - wv) + v.z() * (wu - uw) + w.z() * (uv - vu);
    const double permanent = (std::abs(vw) + std::abs(wv)) * std::abs(u.z()) +
                             (std::abs(wu) + std::abs(uw)) * std::abs(v.z()) +
                             (std::abs(uv) + std::abs(vu)) * std::abs(w.z());
    constexpr double epsilon = 0x1p-53;
    const double bound = (7 + 56 * epsilon) * epsilon * permanent;
    if (det > bound)
        return 1;
    if (det < -bound)
        return -1;
    return permanent == 0 ? 0 : wide_orientation(a, b, c, d);
}

bool triangles_cross(const Points& points, const Tri& s, const Tri& t) {
    std::array<const Vec3*, 3> ps, pt;
    for (std::size_t k = 0; k < 3; ++k) {
        ps[k] = &points[static_cast<std::size_t>(s[k])];
        pt[k] = &points[static_cast<std::size_t>(t[k])];
    }
    // A shared corner lies in both planes, whatever rounding says.
    std::array<int, 3> side_s{}, side_t{};
    std::array<char, 3> shared_s{}, shared_t{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (s[i] == t[j])
                shared_s[i] = shared_t[j] = 1;
    const auto sides = [](const std::array<const Vec3*, 3>& corners, const std::array<char, 3>& shared,
                          const std::array<const Vec3*, 3>& plane, std::array<int, 3>& side) {
        bool positive = false, negative = false;
        for (std::size_t k = 0; k < 3; ++k) {
            side[k] = shared[k] ? 0 : orientation_sign(*plane[0], *plane[1], *plane[2], *corners[k]);
            positive = positive || side[k] > 0;
            negative = negative || side[k] < 0;
        }
        return positive == negative; // both: on both sides; none: in the plane
    };
    if (!sides(pt, shared_t, ps, side_t) || !sides(ps, shared_s, pt, side_s))
        return false;
    if (side_s == std::array{0, 0, 0} && side_t == std::array{0, 0, 0})
        return overlap_in_plane(ps, pt);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        if (pierces(*ps[k], *ps[l], side_s[k], side_s[l], pt) ||
            pierces(*pt[k], *pt[l], side_t[k], side_t[l], ps))
            return true;
    }
    return false;
}

CrossingReport find_crossings(const TriMesh& mesh, int threads, const JobControl& control, std::size_t keep) {
    CrossingReport report;
    const BoxTree tree(mesh, 4);
    constexpr std::size_t chunk = 1024;
    constexpr std::size_t most_pairs = 20000, most_visits = 4000000; // in a chunk
    std::vector<std::vector<std::array<int, 2>>> found((tree.size() + chunk - 1) / chunk);
    std::vector<char> cut(found.size(), 0);
    parallel_for(threads, tree.size(), chunk, [&](std::size_t begin, std::size_t end) {
        if (control.cancelled())
            throw Cancelled();
        std::vector<std::array<int, 2>>& pairs = found[begin / chunk];
        std::size_t visits = 0;
        for (std::size_t slot = begin; slot < end; ++slot) {
            if (pairs.size() >= most_pairs || visits >= most_visits) {
                cut[begin / chunk] = 1;
                return;
            }
            const int a = tree.triangle(slot);
            const Tri& s = mesh.triangles[static_cast<std::size_t>(a)];
            if (has_repeated_index(s))
                continue;
            tree.later_neighbours(slot, [&](std::size_t other) {
                ++visits;
                const int b = tree.triangle(other);
                const Tri& t = mesh.triangles[static_cast<std::size_t>(b)];
                if (!has_repeated_index(t) && triangles_cross(mesh.positions, s, t))
                    pairs.push_back({std::min(a, b), std::max(a, b)});
            });
        }
    });
    std::vector<std::array<int, 2>> all;
    for (const auto& pairs : found)
        all.insert(all.end(), pairs.begin(), pairs.end());
    report.complete = std::find(cut.begin(), cut.end(), 1) == cut.end();
    std::sort(all.begin(), all.end());
    report.pairs = static_cast<int>(all.size());
    for (const auto& pair : all)
        report.triangles.insert(report.triangles.end(), pair.begin(), pair.end());
    std::sort(report.triangles.begin(), report.triangles.end());
    report.triangles.erase(std::unique(report.triangles.begin(), report.triangles.end()),
                           report.triangles.end());
    all.resize(std::min(all.size(), keep));
    report.first = std::move(all);
    return report;
}

} // namespace fascicle
