#include "fascicle/metrics/surface_samples.hpp"

namespace fascicle {

namespace {

const Vec3& at(const Points& points, int i) {
    return points[static_cast<std::size_t>(i)];
}

} // namespace

void face_centroids(const Points& points, const std::vector<Tri>& triangles, Points& centroids) {
    centroids.resize(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        centroids[t] =
            (at(points, triangles[t][0]) + at(points, triangles[t][1]) + at(points, triangles[t][2])) / 3.0;
}

void edge_midpoints(const Points& points, const std::vector<Edge>& edges, Points& midpoints) {
    midpoints.resize(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e)
        midpoints[e] = 0.5 * (at(points, edges[e].a) + at(points, edges[e].b));
}

} // namespace fascicle
