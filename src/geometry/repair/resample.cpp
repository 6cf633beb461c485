#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bvh.hpp"
#include "fascicle/geometry/remesh.hpp"
#include "fascicle/geometry/vertex_normals.hpp"
#include "fascicle/geometry/volume.hpp"
#include "geometry/repair/steps.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::detail {

namespace {

/// Moves all vertices along their normals by one distance until the surface encloses `volume`: Newton's method on
/// V(d) = volume, dV/dd = sum_i grad_i . n_i. Gives up beyond `limit`. Returns the distance.
double offset_to_volume(TriMesh& mesh, double volume, double limit) {
    const Points normals = vertex_normals(mesh.positions, mesh.triangles);
    Points gradient;
    TriMesh trial = mesh;
    double offset = 0;
    for (int step = 0; step < 20; ++step) {
        const double lack = volume - signed_volume(trial.positions, trial.triangles);
        if (std::abs(lack) <= 1e-12 * std::abs(volume))
            break;
        volume_gradient(trial.positions, trial.triangles, gradient);
        double rate = 0;
        for (std::size_t v = 0; v < gradient.size(); ++v)
            rate += gradient[v].dot(normals[v]);
        offset += lack / rate;
        if (!(std::abs(offset) <= limit))
            return 0;
        for (std::size_t v = 0; v < normals.size(); ++v)
            trial.positions[v] = mesh.positions[v] + offset * normals[v];
    }
    mesh.positions = std::move(trial.positions);
    return offset;
}

/// Nearest points of the surface, as shares of its corners.
std::vector<VertexOrigin> nearest_origins(const Points& points, const TriMesh& surface, int threads) {
    const TriangleBvh tree(surface);
    std::vector<VertexOrigin> origins(points.size());
    parallel_for(threads, points.size(), 512, [&](std::size_t begin, std::size_t end) {
        int hint = -1;
        for (std::size_t v = begin; v < end; ++v) {
            const SurfacePoint foot = tree.closest(points[v], std::numeric_limits<double>::infinity(), hint);
            if (foot.triangle < 0)
                continue;
            hint = foot.triangle;
            const Tri& t = surface.triangles[at(foot.triangle)];
            origins[v] = mean_origin({VertexOrigin::of(t[0]), VertexOrigin::of(t[1]), VertexOrigin::of(t[2])},
                                     {foot.weights[0], foot.weights[1], foot.weights[2]});
        }
    });
    return origins;
}

} // namespace

ResampleCounts resample(RepairMesh& m, const TriMesh& input, int triangles, int threads,
                        const JobControl& control) {
    ResampleCounts counts;
    counts.volume_before = signed_volume(m.mesh.positions, m.mesh.triangles);
    const TriangleBvh surface(m.mesh);
    RemeshOptions options;
    options.triangles = triangles;
    options.project = [&](const Vec3& p) {
        if (control.cancelled())
            throw Cancelled();
        return surface.closest(p).point;
    };
    m.mesh = remesh(m.mesh, options);
    counts.edge_length = mean_edge_length(m.mesh);
    control.checkpoint("remesh", 0.8);
    // Chords lie inside of what is round: the offset is the height of a chord, far below an edge.
    if (counts.volume_before > 0)
        counts.offset = offset_to_volume(m.mesh, counts.volume_before, 0.5 * counts.edge_length);
    counts.volume_after = signed_volume(m.mesh.positions, m.mesh.triangles);
    m.origins = nearest_origins(m.mesh.positions, input, threads);
    std::fill(m.now.begin(), m.now.end(), -1);
    return counts;
}

} // namespace fascicle::detail
