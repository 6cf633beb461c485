#include "fascicle/anatomy/fibre_carrier.hpp"

#include "anatomy/fibres/muscle_inside.hpp"
#include "fascicle/base/parallel.hpp"

#include <algorithm>
#include <optional>

namespace fascicle {

std::vector<LineCrossings> chord_lines(const TriMesh& surface, int threads) {
    const auto& directions = chord_directions();
    std::array<std::optional<LineCrossings>, 13> made;
    parallel_for(threads, directions.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t d = begin; d < end; ++d)
            made[d].emplace(surface, directions[d]);
    });
    std::vector<LineCrossings> lines;
    for (auto& line : made)
        lines.push_back(std::move(*line));
    return lines;
}

MuscleInside::MuscleInside(const TriMesh& surface, int threads)
    : surface_(&surface), tree_(surface), lines_(chord_lines(surface, threads)),
      normals_(vertex_normals(surface.positions, surface.triangles)) {}

bool MuscleInside::inside(const Vec3& p) const {
    int votes = 0;
    for (const std::size_t d : {std::size_t{0}, std::size_t{4}, std::size_t{9}})
        votes += lines_[d].at(p).winding > 0 ? 1 : -1;
    return votes > 0;
}

double MuscleInside::depth(const Vec3& p) const {
    const double distance = std::sqrt(tree_.closest(p).squared_distance);
    return inside(p) ? distance : -distance;
}

bool MuscleInside::move(Vec3& p, double depth) const {
    const bool within = inside(p);
    const SurfacePoint foot =
        within ? tree_.closest(p, depth) : tree_.closest(p); // the first is cheap where it finds nothing
    if (foot.triangle < 0)
        return false;
    const double distance = std::sqrt(foot.squared_distance);
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
        if (inside(candidate) && tree_.closest(candidate, 0.5 * d).triangle < 0) {
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
    return MuscleInside(surface, threads).move_all(points, depth, threads);
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
