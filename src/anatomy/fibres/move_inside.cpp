#include "fascicle/anatomy/fibre_carrier.hpp"

#include "anatomy/fibres/muscle_inside.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>

namespace fascicle {

MuscleInside::MuscleInside(const TriMesh& surface)
    : surface_(&surface), tree_(surface), normals_(vertex_normals(surface.positions, surface.triangles)) {
    const auto& directions = chord_directions();
    for (const std::size_t d : {std::size_t{0}, std::size_t{4}, std::size_t{9}})
        lines_.emplace_back(surface, directions[d]);
}

bool MuscleInside::inside(const Vec3& p) const {
    int votes = 0;
    for (const LineCrossings& lines : lines_)
        votes += lines.at(p).winding > 0 ? 1 : -1;
    return votes > 0;
}

double MuscleInside::depth(const Vec3& p) const {
    const double distance = std::sqrt(tree_.closest(p).squared_distance);
    return inside(p) ? distance : -distance;
}

bool MuscleInside::move(Vec3& p, double depth) const {
    const SurfacePoint foot = tree_.closest(p);
    const double distance = std::sqrt(foot.squared_distance);
    const bool within = inside(p);
    if (within && distance >= depth)
        return false;
    const Tri& t = surface_->triangles[static_cast<std::size_t>(foot.triangle)];
    Vec3 inwards = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
        inwards -= foot.weights[k] * normals_[static_cast<std::size_t>(t[std::size_t(k)])];
    // The foot's own direction is exact; so near to the surface that it is rounding, the normal has to do.
    if (distance > 1e-3 * depth)
        inwards = within ? p - foot.point : foot.point - p;
    if (!(inwards.norm() > 0))
        return false;
    inwards.normalize();
    for (double d = depth; d > 0.01 * depth; d *= 0.5) {
        const Vec3 candidate = foot.point + d * inwards;
        // Where the muscle is thin the other side is nearer than the depth: half of it, and so on.
        if (inside(candidate) && tree_.closest(candidate).squared_distance >= 0.25 * d * d) {
            if (within && d <= distance)
                return false; // it was as deep as can be
            p = candidate;
            return true;
        }
    }
    if (within)
        return false;
    p = foot.point;
    return true;
}

int move_inside(const TriMesh& surface, std::span<Vec3> points, double depth, int threads) {
    return MuscleInside(surface).move_all(points, depth, threads);
}

int MuscleInside::move_all(std::span<Vec3> points, double depth, int threads) const {
    std::vector<char> moved(points.size(), 0);
    parallel_for(threads, points.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            moved[i] = move(points[i], depth) ? 1 : 0;
    });
    return static_cast<int>(std::count(moved.begin(), moved.end(), 1));
}

} // namespace fascicle
