#include "simulation/muscle_contact.hpp"

#include "fascicle/base/parallel.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace fascicle {

namespace {

constexpr double near_mm = 3.0;  ///< within it a vertex gets a plane
constexpr double reach_mm = 9.0; ///< as far as distances are looked for
constexpr std::size_t chunk = 512;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// Signed distance to a surface by its nearest point, and the direction away from it. Inside is where the normals around that
/// point say: near a surface that is as good as a winding number, and far cheaper.
struct SurfaceSide {
    double distance;
    Vec3 normal;
};

SurfaceSide side_of(const Vec3& x, const SurfacePoint& nearest, const std::vector<Tri>& triangles,
                    const MeshTopology& topology, const Points& points, double rounding) {
    const auto area = [&](int triangle) {
        const Tri& t = triangles[at(triangle)];
        return (points[at(t[1])] - points[at(t[0])]).cross(points[at(t[2])] - points[at(t[0])]);
    };
    Vec3 n = Vec3::Zero(); // interpolated from those of the corners; only here are they needed
    for (std::size_t k = 0; k < 3; ++k) {
        const int corner = triangles[at(nearest.triangle)][k];
        Vec3 sum = Vec3::Zero();
        for (const int triangle : topology.vertex_triangles(corner))
            sum += area(triangle);
        n += nearest.weights[static_cast<Eigen::Index>(k)] * sum.normalized();
    }
    const Vec3 away = x - nearest.point;
    const double distance = away.norm(), side = away.dot(n) < 0.0 ? -1.0 : 1.0;
    if (distance > rounding)
        return {side * distance, side / distance * away};
    // So near that the direction is rounding: the surface's own.
    const double length = n.norm();
    return {side * distance, length > 0.0 ? Vec3(n / length) : Vec3::Zero()};
}

double largest_move(const Points& a, const Points& b) {
    double squared = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        squared = std::max(squared, (a[i] - b[i]).squaredNorm());
    return std::sqrt(squared);
}

} // namespace

MuscleContact::MuscleContact(const Scene& scene, const PreparedScene& prepared) {
    if (prepared.muscles.size() < 2)
        return;
    const double unit_mm = millimetres_per_unit(scene.unit);
    offset_ = scene.parameters.get("contact.offset_mm") / unit_mm;
    near_ = near_mm / unit_mm;
    reach_ = reach_mm / unit_mm;
    for (const PreparedMuscle& prepared_muscle : prepared.muscles) {
        const SoftBodyProblem& problem = prepared_muscle.problem;
        Muscle muscle{problem.surface,
                      problem.body_of_vertex,
                      problem.carry_weights,
                      MeshTopology(problem.surface->vertex_count(), problem.surface->triangles),
                      {},
                      {},
                      0,
                      false};
        muscle.tree = TriangleBvh(*problem.surface);
        muscle.last = problem.surface->positions;
        muscles_.push_back(std::move(muscle));
    }
    planes_.resize(muscles_.size());
    for (std::size_t m = 0; m < muscles_.size(); ++m)
        for (std::size_t o = 0; o < muscles_.size(); ++o) {
            if (m == o)
                continue;
            const Muscle &own = muscles_[m], &other = muscles_[o];
            Pair pair{m,
                      o,
                      {},
                      std::vector<double>(own.last.size(), offset_),
                      std::vector<int>(own.last.size(), -1)};
            pair.slack.assign(own.last.size(), -1.0);
            for (std::size_t i = 0; i < own.last.size(); ++i) {
                const SurfacePoint nearest = other.tree.closest(own.last[i], reach_);
                if (nearest.triangle >= 0)
                    pair.least[i] = std::min(offset_, side_of(own.last[i], nearest, other.surface->triangles,
                                                              other.topology, other.last, 1e-6 * near_)
                                                          .distance);
            }
            pairs_.push_back(std::move(pair));
        }
}

/// Where the bones are expected to take a point of the muscle next to its vertex: rigidly with its bone, or with its shares.
Vec3 MuscleContact::carried(const Muscle& muscle, int vertex, const Vec3& x, std::span<const Pose> from,
                            std::span<const Pose> to) const {
    const auto moved = [&](std::size_t b) { return Vec3(to[b].apply(from[b].apply_inverse(x)) - x); };
    if (const int body = muscle.body_of_vertex[at(vertex)]; body >= 0)
        return moved(at(body));
    Vec3 shift = Vec3::Zero();
    for (std::size_t b = 0; b < from.size() && !muscle.carry.empty(); ++b)
        if (const double w = muscle.carry[at(vertex) * from.size() + b]; w != 0.0)
            shift += w * moved(b);
    return shift;
}

void MuscleContact::find_planes(Pair& pair, std::span<const Pose> from, std::span<const Pose> to,
                                int threads) {
    const Muscle& own = muscles_[pair.muscle];
    Muscle& other = muscles_[pair.other];
    const std::size_t count = own.last.size();
    const double moved = own.travel + other.travel;
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
        pair.slack[i] -= moved;
        any = any || (pair.slack[i] < 0.0 && own.body_of_vertex[i] < 0);
    }
    if (!any)
        return;
    if (other.stale) { // one fit serves all that look at it
        other.tree.refit(other.last);
        other.stale = false;
    }
    found_.resize(count);
    parallel_for(threads, count, chunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            found_[i].vertex = -1;
            if (pair.slack[i] >= 0.0 || own.body_of_vertex[i] >= 0)
                continue;
            const Vec3& x = own.last[i];
            const SurfacePoint nearest = other.tree.closest(x, reach_, pair.hint[i]);
            if (nearest.triangle < 0) {
                pair.slack[i] = reach_ - near_;
                continue;
            }
            pair.hint[i] = nearest.triangle;
            const SurfaceSide side =
                side_of(x, nearest, other.surface->triangles, other.topology, other.last, 1e-6 * near_);
            pair.slack[i] = std::abs(side.distance) - near_;
            if (pair.slack[i] >= 0.0 || side.normal.isZero(0.0))
                continue;
            // The border goes with both: half the way that bones take either.
            Vec3 shift = carried(own, static_cast<int>(i), x, from, to);
            const Tri& t = other.surface->triangles[at(nearest.triangle)];
            for (std::size_t k = 0; k < 3; ++k)
                shift += nearest.weights[static_cast<Eigen::Index>(k)] *
                         carried(other, t[k], nearest.point, from, to);
            found_[i] = {static_cast<int>(i), nearest.point, nearest.point + 0.5 * shift, side.normal,
                         pair.least[i]};
        }
    });
    std::vector<PointPlane>& planes = planes_[pair.muscle];
    for (const PointPlane& plane : found_)
        if (plane.vertex >= 0)
            planes.push_back(plane);
}

const std::vector<std::vector<PointPlane>>& MuscleContact::planes(const std::vector<const Points*>& positions,
                                                                  std::span<const Pose> from,
                                                                  std::span<const Pose> to, int threads) {
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
        Muscle& muscle = muscles_[m];
        muscle.travel = largest_move(muscle.last, *positions[m]);
        muscle.stale = muscle.stale || muscle.travel > 0.0;
        muscle.last = *positions[m];
        planes_[m].clear();
    }
    for (Pair& pair : pairs_)
        find_planes(pair, from, to, threads);
    for (std::vector<PointPlane>& planes : planes_)
        std::stable_sort(planes.begin(), planes.end(),
                         [](const PointPlane& a, const PointPlane& b) { return a.vertex < b.vertex; });
    return planes_;
}

} // namespace fascicle
