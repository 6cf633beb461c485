#include "fascicle/geometry/remesh.hpp"

#include "fascicle/base/assert.hpp"
#include "remesh_topology.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>

namespace fascicle {

namespace {

/// Quality (see Remesher::quality) below which no step may push a triangle; 0.4 is a smallest angle of about
/// 17 degrees.
constexpr double fair_quality = 0.4;

class Remesher {
public:
    Remesher(const TriMesh& mesh, const RemeshOptions& options) : mesh_(mesh), options_(options) {}

    TriMesh run() {
        for (int round = 0; round < options_.rounds; ++round) {
            const double target = wanted_length();
            split_long(4.0 / 3.0 * target);
            collapse_short(4.0 / 5.0 * target, 4.0 / 3.0 * target);
            flip_to_even_valence();
            relax();
        }
        reach_count();
        flip_to_even_valence();
        relax();
        relax();
        return mesh_.compact();
    }

private:
    Vec3 normal_if(int h, int moved,
                   const Vec3& p) const { // twice the area vector, with one vertex elsewhere
        const auto at = [&](int v) -> const Vec3& { return v == moved ? p : mesh_.position(v); };
        const Vec3& a = at(mesh_.start(h));
        return (at(mesh_.end(h)) - a).cross(at(mesh_.opposite(h)) - a);
    }
    Vec3 normal(int h) const { return normal_if(h, -1, Vec3::Zero()); }

    /// Side of the equilateral triangles that would cover the area in the wanted number.
    double wanted_length() const {
        double area = 0.0;
        for (int h = 0; h < mesh_.half_edges(); h += 3)
            if (mesh_.is_alive(h))
                area += 0.5 * normal(h).norm();
        return std::sqrt(4.0 / std::sqrt(3.0) * area / options_.triangles);
    }

    Vec3 on_surface(const Vec3& p) const { return options_.project ? options_.project(p) : p; }

    /// Halves long edges in passes: edges made in a pass wait for the next one, so that no long edge is left
    /// beside ever smaller triangles.
    void split_long(double limit) {
        for (int pass = 0; pass < 12; ++pass) {
            const int count = mesh_.half_edges();
            for (int h = 0; h < count; ++h)
                if (mesh_.is_alive(h) && h < mesh_.twin(h) && mesh_.length(h) > limit)
                    mesh_.split(h, 0.5 * (mesh_.position(mesh_.start(h)) + mesh_.position(mesh_.end(h))));
            if (mesh_.half_edges() == count)
                return;
        }
    }

    /// 2 sqrt(3) (area vector x 2).direction / sum of squared sides: 1 for an equilateral triangle facing
    /// `direction`, 0 for one without area, negative for one facing away.
    static double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& direction) {
        const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
        return squares > 0.0 ? 2.0 * std::sqrt(3.0) * (b - a).cross(c - a).dot(direction) / squares : 0.0;
    }

    /// Whether v may go to p: its triangles, except the two beside the half-edge `without` (-1: none), turn
    /// by less than about 78 degrees (cosine 0.2; those with hardly any area have no direction to keep), and
    /// the worst of them gets no worse or stays fair.
    bool may_move(int v, const Vec3& p, int without) const {
        const int skip = without >= 0 ? without / 3 : -1;
        const int skip_too = without >= 0 ? mesh_.twin(without) / 3 : -1;
        Vec3 up = Vec3::Zero();
        mesh_.for_edges_from(v, [&](int h) { up += normal(h); });
        up.normalize();
        double worst_before = 1.0, worst_after = 1.0;
        bool keeps = true;
        mesh_.for_edges_from(v, [&](int h) {
            const Vec3 &b = mesh_.position(mesh_.end(h)), &c = mesh_.position(mesh_.opposite(h));
            const double q = quality(mesh_.position(v), b, c, up);
            worst_before = std::min(worst_before, q);
            if (h / 3 == skip || h / 3 == skip_too)
                return;
            worst_after = std::min(worst_after, quality(p, b, c, up));
            const Vec3 before = normal(h), after = (b - p).cross(c - p);
            keeps &= std::abs(q) < 1e-3 || before.dot(after) > 0.2 * before.norm() * after.norm();
        });
        return keeps && worst_after >= std::min(fair_quality, worst_before);
    }

    bool try_collapse(int h, double longest) {
        if (!mesh_.may_collapse(h))
            return false;
        const int a = mesh_.start(h), b = mesh_.end(h);
        const Vec3 middle = 0.5 * (mesh_.position(a) + mesh_.position(b));
        // The middle is best; among tiny triangles only an end may be free of folds.
        for (const Vec3& p : {on_surface(middle), mesh_.position(b), mesh_.position(a)}) {
            bool fits = may_move(a, p, h) && may_move(b, p, h);
            for (const int v : {a, b})
                mesh_.for_edges_from(
                    v, [&](int e) { fits &= (mesh_.position(mesh_.end(e)) - p).norm() <= longest; });
            if (fits) {
                mesh_.collapse(h, p);
                return true;
            }
        }
        return false;
    }

    void collapse_short(double limit, double longest) {
        for (int h = 0; h < mesh_.half_edges(); ++h)
            if (mesh_.is_alive(h) && h < mesh_.twin(h) && mesh_.length(h) < limit)
                try_collapse(h, longest);
    }

    void flip_to_even_valence() {
        std::vector<int> valence(static_cast<std::size_t>(mesh_.vertices()), 0);
        for (int h = 0; h < mesh_.half_edges(); ++h)
            if (mesh_.is_alive(h))
                ++valence[static_cast<std::size_t>(mesh_.start(h))];
        for (int h = 0; h < mesh_.half_edges(); ++h) {
            if (!mesh_.is_alive(h) || h > mesh_.twin(h))
                continue;
            const int o = mesh_.twin(h);
            int& a = valence[static_cast<std::size_t>(mesh_.start(h))];
            int& b = valence[static_cast<std::size_t>(mesh_.start(o))];
            int& c = valence[static_cast<std::size_t>(mesh_.opposite(h))];
            int& d = valence[static_cast<std::size_t>(mesh_.opposite(o))];
            const auto square = [](int x) { return x * x; };
            const int before = square(a - 6) + square(b - 6) + square(c - 6) + square(d - 6);
            const int after = square(a - 7) + square(b - 7) + square(c - 5) + square(d - 5);
            if (after >= before || !flip_keeps_shape(h) || !mesh_.may_flip(h))
                continue;
            --a, --b, ++c, ++d;
            mesh_.flip(h);
        }
    }

    /// The new triangles must face the way the old ones do (no fold, no cut through a crease) and be fair or
    /// no worse.
    bool flip_keeps_shape(int h) const {
        const int o = mesh_.twin(h);
        const Vec3 &a = mesh_.position(mesh_.start(h)), &b = mesh_.position(mesh_.start(o));
        const Vec3 &c = mesh_.position(mesh_.opposite(h)), &d = mesh_.position(mesh_.opposite(o));
        const Vec3 up = (normal(h) + normal(o)).normalized();
        const Vec3 left = (c - d).cross(a - d), right = (d - c).cross(b - c);
        const double before = std::min(quality(a, b, c, up), quality(b, a, d, up));
        const double after = std::min(quality(d, c, a, up), quality(c, d, b, up));
        return left.dot(up) > 0.7 * left.norm() && right.dot(up) > 0.7 * right.norm() &&
               after >= std::min(fair_quality, before);
    }

    /// Each vertex moves towards the area-weighted mean of its triangles' centroids, in its tangent plane.
    void relax() {
        for (int v = 0; v < mesh_.vertices(); ++v) {
            if (!mesh_.is_vertex_alive(v))
                continue;
            Vec3 mean = Vec3::Zero(), up = Vec3::Zero();
            double weight = 0.0;
            mesh_.for_edges_from(v, [&](int h) {
                const Vec3 n = normal(h);
                const double area = n.norm();
                mean +=
                    area / 3.0 *
                    (mesh_.position(v) + mesh_.position(mesh_.end(h)) + mesh_.position(mesh_.opposite(h)));
                up += n;
                weight += area;
            });
            if (!(weight > 0.0) || !(up.squaredNorm() > 0.0))
                continue;
            up.normalize();
            const Vec3 shift = mean / weight - mesh_.position(v);
            const Vec3 p = on_surface(mesh_.position(v) + shift - shift.dot(up) * up);
            if (may_move(v, p, -1))
                mesh_.positions[static_cast<std::size_t>(v)] = p;
        }
    }

    /// Collapses the shortest or splits the longest edges until the count is right.
    void reach_count() {
        struct Item {
            double length;
            int a, b, h; // the edge still means the same when its ends do
        };
        const bool shrink = mesh_.triangles() > options_.triangles;
        const auto later = [shrink](const Item& x, const Item& y) {
            if (x.length != y.length)
                return shrink ? x.length > y.length : x.length < y.length;
            return x.h > y.h;
        };
        std::priority_queue<Item, std::vector<Item>, decltype(later)> queue(later);
        const auto push = [&](int h) {
            const int low = std::min(h, mesh_.twin(h));
            queue.push({mesh_.length(low), mesh_.start(low), mesh_.end(low), low});
        };
        for (int h = 0; h < mesh_.half_edges(); ++h)
            if (mesh_.is_alive(h) && h < mesh_.twin(h))
                push(h);
        const double longest = 2.0 * wanted_length();
        while (!queue.empty() && (shrink ? mesh_.triangles() > options_.triangles
                                         : mesh_.triangles() + 2 <= options_.triangles)) {
            const Item item = queue.top();
            queue.pop();
            const int h = item.h;
            if (!mesh_.is_alive(h) || mesh_.start(h) != item.a || mesh_.end(h) != item.b ||
                mesh_.length(h) != item.length)
                continue;
            int changed = item.b;
            if (shrink) {
                if (!try_collapse(h, longest))
                    continue;
            } else {
                changed = mesh_.split(h, on_surface(0.5 * (mesh_.position(item.a) + mesh_.position(item.b))));
            }
            mesh_.for_edges_from(changed, push);
        }
    }

    RemeshTopology mesh_;
    const RemeshOptions& options_;
};

} // namespace

TriMesh remesh(const TriMesh& mesh, const RemeshOptions& options) {
    FASCICLE_ASSERT(options.triangles > 0 && options.rounds >= 0);
    return Remesher(mesh, options).run();
}

} // namespace fascicle
