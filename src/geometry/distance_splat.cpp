#include "distance_splat.hpp"

#include "boundary_cap.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/closest_point.hpp"
#include "fascicle/geometry/mesh_topology.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numbers>

namespace fascicle {

namespace {

// All lengths here are in units of the grid spacing, positions relative to node (0, 0, 0).
constexpr double slack = 1e-4; // by which every piece is grown: far more than rounding
constexpr double thin = 1e-4;  // height / longest side below which a triangle is taken as its edges
constexpr double barycentric_slack = 1e-7;
constexpr double longest_piece = 4.0;   // of an edge
constexpr std::size_t most_spokes = 16; // edges at a corner whose cone is looked for

std::size_t z(int i) {
    return static_cast<std::size_t>(i);
}

void lower_to(float& place, double d2) {
    std::atomic_ref<float> cell(place);
    float old = cell.load(std::memory_order_relaxed);
    if (!(d2 < static_cast<double>(old)))
        return;
    auto value = static_cast<float>(d2);
    if (static_cast<double>(value) > d2)
        value = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) - 1);
    while (value < old && !cell.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
    }
}

struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// Where two half-planes that stand on an edge end: unit directions square to the edge, at most pi / 4 apart.
struct Sector {
    Vec3 first, second;
};

class Splat {
public:
    Splat(const GridShape& shape, const Points& points, const std::vector<Tri>& triangles, double reach,
          float* squared)
        : nodes_(shape.nodes), reach_(reach / shape.h), squared_(squared) {
        step_y_ = z(nodes_[0]);
        step_z_ = step_y_ * z(nodes_[1]);
        points_.reserve(points.size());
        for (const Vec3& p : points)
            points_.push_back((p - shape.low) / shape.h);
        const std::vector<int> same = coincident_vertices(points);
        triangles_.reserve(triangles.size());
        for (const Tri& t : triangles)
            triangles_.push_back({same[z(t[0])], same[z(t[1])], same[z(t[2])]});
        topology_ = MeshTopology(static_cast<int>(points.size()), triangles_);
        normals_.resize(triangles_.size());
        all_round_.assign(points.size(), 0);
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const Vec3 &a = at(triangles_[t][0]), &b = at(triangles_[t][1]), &c = at(triangles_[t][2]);
            const Vec3 normal = (b - a).cross(c - a);
            const double longest =
                std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
            const double size = normal.norm();
            if (size > thin * longest) {
                normals_[t] = normal / size;
                continue;
            }
            normals_[t] = Vec3::Zero();
            for (const int v : triangles_[t])
                all_round_[z(v)] = 1;
        }
    }

    std::size_t triangle_count() const { return triangles_.size(); }
    std::size_t edge_count() const { return topology_.edges().size(); }
    std::size_t vertex_count() const { return points_.size(); }

    void triangle(std::size_t t) const {
        const Tri& tri = triangles_[t];
        if (!is_thin(t)) {
            prism(at(tri[0]), at(tri[1]), at(tri[2]), normals_[t]);
            return;
        }
        const auto distance = [&](const Vec3& p) {
            return closest_point_on_triangle(p, at(tri[0]), at(tri[1]), at(tri[2])).squared_distance;
        };
        for (std::size_t k = 0; k < 3; ++k)
            around_edge(at(tri[k]), at(tri[(k + 1) % 3]), distance);
    }

    void edge(std::size_t e) const {
        const auto row = topology_.edge_half_edges(static_cast<int>(e));
        for (const int h : row)
            if (is_thin(z(h / 3)))
                return; // that triangle goes all round its edges
        const Vec3 &a = at(topology_.edges()[e].a), &b = at(topology_.edges()[e].b);
        const Vec3 side = b - a;
        const auto distance = [&, per_length = 1.0 / side.squaredNorm()](const Vec3& p) {
            const Vec3 q = p - a;
            return (q - std::clamp(q.dot(side) * per_length, 0.0, 1.0) * side).squaredNorm();
        };
        if (row.size() > 2) {
            around_edge(a, b, distance);
            return;
        }
        // Directions in the triangles, square to the edge; the wedge is where none of them makes an acute angle.
        const Vec3 along = side.normalized();
        const auto inward = [&](int h) {
            const Tri& tri = triangles_[z(h / 3)];
            const Vec3 q = at(tri[z((h % 3 + 2) % 3)]) - a;
            return Vec3((q - q.dot(along) * along).normalized());
        };
        const Vec3 u = inward(row[0]);
        const Vec3 u_turned = along.cross(u);
        if (row.size() == 1) {
            wedge(a, b, u_turned, -u, -u_turned, distance);
            return;
        }
        const Vec3 w = inward(row[1]);
        // First end: square to u, away from w; second: square to w, away from u.
        const double sine = u_turned.dot(w), cosine = u.dot(w);
        const double opening = std::abs(std::atan2(-sine, -cosine)); // 0: flat, pi: folded back onto itself
        if (opening * 2.0 * reach_ < slack)
            return; // within the slack of the prisms
        const Vec3 first = sine > 0.0 ? Vec3(-u_turned) : u_turned;
        const Vec3 w_turned = along.cross(w);
        const Vec3 second = sine > 0.0 ? w_turned : Vec3(-w_turned);
        const Vec3 middle = -(u + w);
        wedge(a, b, first,
              middle.squaredNorm() > 1e-12 ? Vec3(middle.normalized()) : Vec3(first + second).normalized(),
              second, distance);
    }

    void vertex(std::size_t v) const {
        const auto around = topology_.vertex_neighbours(static_cast<int>(v));
        if (around.size() == 0 && all_round_[v] == 0)
            return; // used by no triangle
        if (all_round_[v] != 0 || around.size() < 3 || around.size() > most_spokes) {
            ball(points_[v]);
            return;
        }
        std::array<Vec3, most_spokes> spokes;
        for (std::size_t i = 0; i < around.size(); ++i)
            spokes[i] = (at(around[i]) - points_[v]).normalized();
        Vec3 axis = Vec3::Zero();
        std::array<Vec3, 2 * most_spokes> rays;
        std::size_t count = 0;
        for (std::size_t i = 0; i < around.size(); ++i)
            for (std::size_t j = i + 1; j < around.size(); ++j) {
                const Vec3 product = spokes[i].cross(spokes[j]);
                const double size = product.norm();
                if (size < 1e-6)
                    continue;
                for (const double sign : {1.0, -1.0}) {
                    const Vec3 ray = sign / size * product;
                    const bool in_cone =
                        std::all_of(spokes.begin(), spokes.begin() + std::ptrdiff_t(around.size()),
                                    [&](const Vec3& s) { return s.dot(ray) <= 1e-9; });
                    if (!in_cone)
                        continue;
                    if (count == rays.size()) { // many edges in one plane
                        ball_unless_flat(v);
                        return;
                    }
                    rays[count++] = ray;
                    axis += ray;
                }
            }
        if (count == 0)
            return; // a saddle: nothing is nearest to its middle alone
        double narrowest = axis.norm() > 1e-3 ? 1.0 : -1.0;
        axis.normalize();
        for (std::size_t i = 0; i < count && narrowest > 0.0; ++i)
            narrowest = std::min(narrowest, axis.dot(rays[i]));
        if (narrowest < 0.9)
            ball_unless_flat(v);
        else
            cone(points_[v], axis, {rays.data(), count});
    }

private:
    const Vec3& at(int v) const { return points_[z(v)]; }
    bool is_thin(std::size_t t) const { return normals_[t].isZero(0.0); }

    /// Nodes of an interval of coordinate k, cut to the grid.
    bool range(const Interval& x, std::size_t k, int& first, int& last) const {
        const double end = nodes_[k];
        first = static_cast<int>(std::ceil(std::clamp(x.low - slack, 0.0, end)));
        last = static_cast<int>(std::floor(std::clamp(x.high + slack, -1.0, end - 1.0)));
        return first <= last;
    }

    /// visit(node position, place) for the nodes of slice `c` of coordinate `k` within a box of the two other
    /// coordinates k + 1 and k + 2 (modulo 3).
    template <typename Visit>
    void slice(std::size_t k, int c, const Interval& s, const Interval& t, const Visit& visit) const {
        const std::size_t ks = (k + 1) % 3, kt = (k + 2) % 3;
        int s_first = 0, s_last = 0, t_first = 0, t_last = 0;
        if (!range(s, ks, s_first, s_last) || !range(t, kt, t_first, t_last))
            return;
        const std::array<std::size_t, 3> steps{1, step_y_, step_z_};
        Vec3 p;
        p[Eigen::Index(k)] = c;
        for (int j = t_first; j <= t_last; ++j) {
            p[Eigen::Index(kt)] = j;
            float* place = squared_ + z(c) * steps[k] + z(j) * steps[kt] + z(s_first) * steps[ks];
            for (int i = s_first; i <= s_last; ++i, place += steps[ks]) {
                p[Eigen::Index(ks)] = i;
                visit(p, *place);
            }
        }
    }

    static std::size_t steepest(const Vec3& direction) {
        Eigen::Index k = 0;
        direction.cwiseAbs().maxCoeff(&k);
        return static_cast<std::size_t>(k);
    }

    /// Largest cosine between a fixed direction and those within an angle (given by its cosine) of an axis that makes
    /// the angle acos(axis) with it.
    static double steepest_within(double axis, double cosine) {
        if (axis >= cosine)
            return 1.0;
        return axis * cosine + std::sqrt(std::max(0.0, (1.0 - axis * axis) * (1.0 - cosine * cosine)));
    }

    /// Nodes over and under a triangle: those whose foot lies in it get the distance to its plane.
    void prism(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& n) const {
        const std::size_t k = steepest(n), ks = (k + 1) % 3, kt = (k + 2) % 3;
        const auto ek = Eigen::Index(k), es = Eigen::Index(ks), et = Eigen::Index(kt);
        const double slope_s = n[es] / n[ek], slope_t = n[et] / n[ek];
        Interval height, s0, t0; // where the corners' normals cut the slice 0
        for (const Vec3* p : {&a, &b, &c}) {
            height.add((*p)[ek]);
            s0.add((*p)[es] - slope_s * (*p)[ek]);
            t0.add((*p)[et] - slope_t * (*p)[ek]);
        }
        const double up = reach_ * std::abs(n[ek]);
        int first = 0, last = 0;
        if (!range({height.low - up, height.high + up}, k, first, last))
            return;
        // Barycentric weights of b and c, and the height above the plane, are linear in the position.
        const Vec3 ab = b - a, ac = c - a;
        const double area = ab.cross(ac).dot(n);
        const Vec3 to_b = ac.cross(n) / area, to_c = n.cross(ab) / area;
        const double limit = reach_ * reach_;
        for (int at_k = first; at_k <= last; ++at_k)
            slice(k, at_k, {s0.low + slope_s * at_k, s0.high + slope_s * at_k},
                  {t0.low + slope_t * at_k, t0.high + slope_t * at_k}, [&](const Vec3& p, float& place) {
                      const Vec3 q = p - a;
                      const double weight_b = to_b.dot(q), weight_c = to_c.dot(q);
                      const double d = n.dot(q), d2 = d * d;
                      if (std::min({weight_b, weight_c, 1.0 - weight_b - weight_c}) >= -barycentric_slack &&
                          d2 < limit)
                          lower_to(place, d2);
                  });
    }

    /// The part of the wedge from `first` over `middle` to `second` (each less than pi apart from the next) that
    /// stands on the edge ab, by sectors of at most pi / 4.
    template <typename Distance>
    void wedge(const Vec3& a, const Vec3& b, const Vec3& first, const Vec3& middle, const Vec3& second,
               const Distance& distance) const {
        for (const auto& [from, to] : {std::pair{first, middle}, std::pair{middle, second}}) {
            const double angle = std::acos(std::clamp(from.dot(to), -1.0, 1.0));
            // The two halves of a narrow wedge in one.
            if (from.dot(middle) > 0.93 && middle.dot(second) > 0.93) {
                sector(a, b, {first, second}, distance);
                return;
            }
            const int parts = std::max(1, static_cast<int>(std::ceil(angle / (0.25 * std::numbers::pi))));
            const Vec3 side = (to - from.dot(to) * from).normalized();
            Vec3 previous = from;
            for (int i = 1; i <= parts; ++i) {
                const double turn = angle * i / parts;
                const Vec3 next = std::cos(turn) * from + std::sin(turn) * side;
                sector(a, b, {previous, next}, distance);
                previous = next;
            }
        }
    }

    template <typename Distance>
    void around_edge(const Vec3& a, const Vec3& b, const Distance& distance) const {
        Vec3 along = b - a;
        if (along.squaredNorm() == 0.0)
            return; // its corners go all round
        along.normalize();
        const Vec3 u = along.unitOrthogonal(), w = along.cross(u);
        wedge(a, b, u, w, -u, distance);
        wedge(a, b, -u, -w, u, distance);
    }

    /// Nodes within reach of the edge ab in directions between those of the sector.
    template <typename Distance>
    void sector(const Vec3& a, const Vec3& b, const Sector& between, const Distance& distance) const {
        const int pieces = std::max(1, static_cast<int>(std::ceil((b - a).norm() / longest_piece)));
        Vec3 from = a;
        for (int i = 1; i <= pieces; ++i) {
            const Vec3 to = a + double(i) / pieces * (b - a);
            sector_piece(from, to, between, distance);
            from = to;
        }
    }

    template <typename Distance>
    void sector_piece(const Vec3& a, const Vec3& b, const Sector& between, const Distance& distance) const {
        const Vec3 middle = (between.first + between.second).normalized();
        const std::size_t k = steepest(middle), ks = (k + 1) % 3, kt = (k + 2) % 3;
        const auto ek = Eigen::Index(k), es = Eigen::Index(ks), et = Eigen::Index(kt);
        const double up = middle[ek] > 0.0 ? 1.0 : -1.0;
        // middle[k] >= 1 / sqrt 3, so both ends rise by at least cos(54.8 + 22.5 degrees) = 0.22.
        const double steep = steepest_within(std::abs(middle[ek]), middle.dot(between.first));
        const double low = std::min(a[ek] * up, b[ek] * up), high = std::max(a[ek] * up, b[ek] * up);
        Interval height;
        height.add(up * (low - slack));
        height.add(up * (high + reach_ * steep + slack));
        int first = 0, last = 0;
        if (!range(height, k, first, last))
            return;
        struct Line {
            double k, s, t, slope_s, slope_t;
        };
        std::array<Line, 4> lines;
        std::size_t count = 0;
        for (const Vec3* p : {&a, &b})
            for (const Vec3* r : {&between.first, &between.second})
                lines[count++] = {(*p)[ek], (*p)[es], (*p)[et], (*r)[es] / (*r)[ek], (*r)[et] / (*r)[ek]};
        const double rise = b[ek] - a[ek];
        const double limit = reach_ * reach_;
        for (int c = first; c <= last; ++c) {
            Interval s, t;
            for (const Line& line : lines) {
                const double above = c - line.k;
                if (above * up < -2.0 * slack)
                    continue;
                s.add(line.s + above * line.slope_s);
                t.add(line.t + above * line.slope_t);
            }
            if ((c - a[ek]) * (c - b[ek]) <= 0.0) { // the edge itself passes the slice
                const double share = rise != 0.0 ? (c - a[ek]) / rise : 0.5;
                s.add(a[es] + share * (b[es] - a[es]));
                t.add(a[et] + share * (b[et] - a[et]));
            }
            // Near the slice of a corner the lines start up to 2 slack beside it.
            s = {s.low - 20.0 * slack, s.high + 20.0 * slack};
            t = {t.low - 20.0 * slack, t.high + 20.0 * slack};
            slice(k, c, s, t, [&](const Vec3& p, float& place) {
                if (const double d2 = distance(p); d2 < limit)
                    lower_to(place, d2);
            });
        }
    }

    /// Nodes within reach of a point in the directions of a narrow cone, spanned by rays at most 26 degrees
    /// from its axis.
    void cone(const Vec3& v, const Vec3& axis, std::span<const Vec3> rays) const {
        const std::size_t k = steepest(axis), ks = (k + 1) % 3, kt = (k + 2) % 3;
        const auto ek = Eigen::Index(k), es = Eigen::Index(ks), et = Eigen::Index(kt);
        const double up = axis[ek] > 0.0 ? 1.0 : -1.0;
        Interval slope_s, slope_t;
        double cosine = 1.0;
        for (const Vec3& r : rays) {
            slope_s.add(r[es] / r[ek]);
            slope_t.add(r[et] / r[ek]);
            cosine = std::min(cosine, axis.dot(r));
        }
        Interval height;
        height.add(v[ek] - up * slack);
        height.add(v[ek] + up * (reach_ * steepest_within(std::abs(axis[ek]), cosine) + slack));
        int first = 0, last = 0;
        if (!range(height, k, first, last))
            return;
        for (int c = first; c <= last; ++c) {
            const double above = c - v[ek];
            Interval s, t;
            for (const double slope : {slope_s.low, slope_s.high})
                s.add(v[es] + above * slope);
            for (const double slope : {slope_t.low, slope_t.high})
                t.add(v[et] + above * slope);
            slice(k, c, s, t, [&](const Vec3& p, float& place) { lower_from(v, p, place); });
        }
    }

    void ball_unless_flat(std::size_t v) const {
        // Straight on in all directions: the prisms around it are enough.
        const auto triangles = topology_.vertex_triangles(static_cast<int>(v));
        const bool flat = std::all_of(triangles.begin(), triangles.end(), [&](int t) {
            return normals_[z(t)].cross(normals_[z(triangles[0])]).norm() * 2.0 * reach_ < slack;
        });
        double angle = 0.0;
        for (const int t : triangles) {
            const Tri& tri = triangles_[z(t)];
            const std::size_t corner = tri[0] == int(v) ? 0 : tri[1] == int(v) ? 1 : 2;
            const Vec3 x = at(tri[(corner + 1) % 3]) - points_[v], y = at(tri[(corner + 2) % 3]) - points_[v];
            angle += std::atan2(x.cross(y).norm(), x.dot(y));
        }
        if (!flat || std::abs(angle - 2.0 * std::numbers::pi) > 1e-6 ||
            triangles.size() != topology_.vertex_neighbours(static_cast<int>(v)).size())
            ball(points_[v]);
    }

    void ball(const Vec3& v) const {
        int first = 0, last = 0;
        if (!range({v.z() - reach_, v.z() + reach_}, 2, first, last))
            return;
        for (int c = first; c <= last; ++c) {
            const double r = std::sqrt(std::max(0.0, reach_ * reach_ - (c - v.z()) * (c - v.z())));
            slice(2, c, {v.x() - r, v.x() + r}, {v.y() - r, v.y() + r},
                  [&](const Vec3& p, float& place) { lower_from(v, p, place); });
        }
    }

    void lower_from(const Vec3& v, const Vec3& p, float& place) const {
        if (const double d2 = (p - v).squaredNorm(); d2 < reach_ * reach_)
            lower_to(place, d2);
    }

    std::array<int, 3> nodes_;
    std::size_t step_y_ = 0, step_z_ = 0;
    double reach_;
    float* squared_;
    Points points_;
    std::vector<Tri> triangles_; ///< of coincident vertices the lowest
    MeshTopology topology_;
    Points normals_;              ///< zero for thin triangles
    std::vector<char> all_round_; ///< by vertex: whether a thin triangle uses it
};

} // namespace

void splat_squared_distances(const GridShape& shape, const Points& points, const std::vector<Tri>& triangles,
                             double reach, int threads, const JobControl& control,
                             const std::function<void(double)>& progress, float* squared) {
    const Splat splat(shape, points, triangles, reach, squared);
    progress(0.1);
    const std::size_t total = splat.triangle_count() + splat.edge_count() + splat.vertex_count();
    std::size_t done = 0;
    const auto run = [&](std::size_t count, const auto& one) {
        constexpr std::size_t chunk = 64;
        const std::size_t batch = std::max<std::size_t>(chunk, count / 6 + 1);
        for (std::size_t from = 0; from < count; from += batch) {
            const std::size_t size = std::min(batch, count - from);
            parallel_for(threads, size, chunk, [&](std::size_t begin, std::size_t end) {
                if (control.cancelled())
                    throw Cancelled();
                for (std::size_t i = begin; i < end; ++i)
                    one(from + i);
            });
            done += size;
            progress(0.1 + 0.9 * static_cast<double>(done) / static_cast<double>(total));
        }
    };
    run(splat.triangle_count(), [&](std::size_t t) { splat.triangle(t); });
    run(splat.edge_count(), [&](std::size_t e) { splat.edge(e); });
    run(splat.vertex_count(), [&](std::size_t v) { splat.vertex(v); });
}

} // namespace fascicle
