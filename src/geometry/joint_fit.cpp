// fit_joint_centre of sphere_fit.hpp.

#include "fascicle/base/param_table.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/sphere_fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace fascicle {

namespace {

constexpr double band = 0.065;        // of the radius: what still belongs to the ball
constexpr double least_facing = 0.95; // cosine between normal and radius
constexpr double least_coverage = 0.25;
constexpr double largest_rms = 0.03; // of the radius
constexpr int iterations = 60;

class BallFinder {
public:
    BallFinder(const TriMesh& bone, const std::vector<const TriMesh*>& others)
        : bone_(bone), topology_(bone.vertex_count(), bone.triangles), areas_(bone.positions.size(), 0.0),
          normals_(bone.positions.size(), Vec3::Zero()),
          distances_(bone.positions.size(), std::numeric_limits<double>::infinity()) {
        for (const Tri& t : bone.triangles) {
            const Vec3 area = 0.5 * (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
            for (const int v : t) {
                areas_[static_cast<std::size_t>(v)] += area.norm() / 3.0;
                normals_[static_cast<std::size_t>(v)] += area;
            }
        }
        for (Vec3& n : normals_)
            n.normalize(); // stays zero when it is zero
        for (const TriMesh* other : others) {
            const TriangleBvh bvh(*other);
            int hint = -1;
            for (std::size_t v = 0; v < distances_.size(); ++v)
                if (areas_[v] > 0.0)
                    distances_[v] = std::min(
                        distances_[v], bvh.closest_squared_distance(
                                           bone.positions[v], std::numeric_limits<double>::infinity(), hint));
        }
        for (int v = 0; v < bone.vertex_count(); ++v)
            if (std::isfinite(distances_[static_cast<std::size_t>(v)]))
                nearest_.push_back(v);
        std::sort(nearest_.begin(), nearest_.end(), [&](int v, int w) {
            const double dv = distances_[static_cast<std::size_t>(v)];
            const double dw = distances_[static_cast<std::size_t>(w)];
            return dv < dw || (dv == dw && v < w);
        });
    }

    JointFit find() const {
        JointFit best;
        best.reason = "no part of one bone that is close to the other fits a sphere";
        for (const double share : {0.005, 0.01, 0.02, 0.04, 0.08}) {
            const JointFit fit = grow(start_patch(share));
            const bool better = fit.sphere.has_value() != best.sphere.has_value()
                                    ? fit.sphere.has_value()
                                    : fit.coverage > best.coverage;
            if (better)
                best = fit;
        }
        return best;
    }

private:
    const Vec3& at(int v) const { return bone_.positions[static_cast<std::size_t>(v)]; }

    /// The vertices nearest to the other bones that make up a share of the surface.
    std::vector<int> start_patch(double share) const {
        const double total = std::accumulate(areas_.begin(), areas_.end(), 0.0);
        std::vector<int> patch;
        double sum = 0.0;
        for (std::size_t i = 0; i < nearest_.size() && sum < share * total; ++i) {
            patch.push_back(nearest_[i]);
            sum += areas_[static_cast<std::size_t>(nearest_[i])];
        }
        return patch;
    }

    std::optional<SphereFit> fit(const std::vector<int>& patch) const {
        Points points;
        std::vector<double> weights;
        for (const int v : patch) {
            points.push_back(at(v));
            weights.push_back(areas_[static_cast<std::size_t>(v)]);
        }
        return fit_sphere(points, weights);
    }

    bool belongs(int v, const Sphere& sphere, double width) const {
        const Vec3 from = at(v) - sphere.centre;
        const double length = from.norm();
        return std::abs(length - sphere.radius) < width * sphere.radius &&
               normals_[static_cast<std::size_t>(v)].dot(from) > least_facing * length;
    }

    /// The connected patch of vertices of the ball that holds most of the surface of `seeds`, ascending.
    std::vector<int> connected_patch(const Sphere& sphere, double width,
                                     const std::vector<int>& seeds) const {
        std::vector<char> seed(areas_.size(), 0), seen(areas_.size(), 0);
        for (const int v : seeds)
            seed[static_cast<std::size_t>(v)] = 1;
        std::vector<int> best, patch;
        double best_area = -1.0;
        for (const int first : seeds) {
            if (seen[static_cast<std::size_t>(first)] != 0 || !belongs(first, sphere, width))
                continue;
            double area = 0.0;
            patch.assign(1, first);
            seen[static_cast<std::size_t>(first)] = 1;
            for (std::size_t i = 0; i < patch.size(); ++i) {
                const auto v = static_cast<std::size_t>(patch[i]);
                area += seed[v] != 0 ? areas_[v] : 0.0;
                for (const int w : topology_.vertex_neighbours(patch[i]))
                    if (seen[static_cast<std::size_t>(w)] == 0 && belongs(w, sphere, width)) {
                        seen[static_cast<std::size_t>(w)] = 1;
                        patch.push_back(w);
                    }
            }
            if (area > best_area) {
                best_area = area;
                best = patch;
            }
        }
        std::sort(best.begin(), best.end());
        return best;
    }

    JointFit grow(std::vector<int> patch) const {
        JointFit result;
        std::optional<SphereFit> ball = fit(patch);
        // The first sphere is rough: begin with a wide band.
        for (int i = 0; ball && i < iterations; ++i) {
            const double width = std::max(band, 0.25 * std::pow(0.8, i));
            std::vector<int> next = connected_patch(ball->sphere, width, patch);
            const bool settled = next == patch && width == band;
            patch = std::move(next);
            if (settled)
                break;
            ball = fit(patch);
        }
        if (!ball) {
            result.reason = "the part of one bone that is close to the other fits no sphere";
            return result;
        }
        double area = 0.0;
        for (const int v : patch)
            area += areas_[static_cast<std::size_t>(v)];
        const double r = ball->sphere.radius;
        result.rms = ball->rms;
        result.vertices = static_cast<int>(patch.size());
        result.coverage = area / (4.0 * std::numbers::pi * r * r);
        const auto percent = [](double x) { return number_text(std::round(1000.0 * x) / 10.0) + " %"; };
        if (result.coverage < least_coverage)
            result.reason = "the best sphere is met by only " + percent(result.coverage) +
                            " of its surface (a ball needs " + percent(least_coverage) + ")";
        else if (result.rms > largest_rms * r)
            result.reason = "the best sphere is " + percent(result.rms / r) +
                            " of its radius off (a ball may be " + percent(largest_rms) + ")";
        else
            result.sphere = ball->sphere;
        return result;
    }

    const TriMesh& bone_;
    MeshTopology topology_;
    std::vector<double> areas_; ///< a third of the triangles around each vertex
    Points normals_;
    std::vector<double> distances_; ///< squared, to the other bones
    std::vector<int> nearest_;      ///< vertices by distance
};

} // namespace

JointFit fit_joint_centre(const TriMesh& moving, const std::vector<MeshPtr>& fixed) {
    std::vector<const TriMesh*> others;
    for (const MeshPtr& mesh : fixed)
        if (mesh != nullptr && !mesh->triangles.empty())
            others.push_back(mesh.get());
    JointFit best;
    if (moving.triangles.empty() || others.empty()) {
        best.reason = "there is no pair of bones";
        return best;
    }
    best = BallFinder(moving, others).find();
    if (best.sphere)
        return best;
    for (const TriMesh* other : others) {
        JointFit fit = BallFinder(*other, {&moving}).find();
        if (fit.sphere && (!best.sphere || fit.coverage > best.coverage)) {
            fit.ball_on_moving_bone = false;
            best = std::move(fit);
        }
    }
    return best;
}

} // namespace fascicle
