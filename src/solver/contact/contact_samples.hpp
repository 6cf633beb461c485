#pragma once
// Points of a surface, besides its vertices, that contact keeps out of solids: face centroids, mid-points of long edges, and
// more of both where triangles are large. A vertex that is outside says nothing about the triangle around it.

#include "fascicle/geometry/mesh_topology.hpp"
#include "fascicle/geometry/tri_mesh.hpp"

#include <array>
#include <span>
#include <vector>

namespace fascicle {
class DistanceGrid;
}

namespace fascicle::solver {

/// The point sum weight[k] x[corner[k]]; weights are >= 0 and sum to one, some may be zero.
struct ContactSample {
    std::array<int, 3> corner{};
    std::array<float, 3> weight{};
    /// The distance to solids that it must keep, scene units: of the hard bound, or, for a sample that is nearer to the solid
    /// `near_solid` at rest, what it has there.
    float limit = 0;
    int near_solid = -1;

    Vec3 at(const Points& x) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            if (weight[k] != 0.0F)
                sum += static_cast<double>(weight[k]) * x[static_cast<std::size_t>(corner[k])];
        return sum;
    }
};

/// Samples of every triangle and edge with a corner that is free (inverse mass above 0). A face is cut into n^2 alike triangles, n the
/// power of two from 1 to 8 that brings its longest edge to `face_spacing` or below, and their centroids are taken: the face's own is
/// always among them. An edge gets n - 1 even points with `edge_spacing`. Order: faces, then edges; samples of equal weights
/// together.
std::vector<ContactSample> make_contact_samples(const Points& rest, const std::vector<Tri>& triangles,
                                                const MeshTopology& topology,
                                                const std::vector<double>& inverse_mass, double face_spacing,
                                                double edge_spacing);

/// Sets limit and near_solid by where the samples are at rest, solids at rest too.
void set_sample_limits(std::vector<ContactSample>& samples, const Points& rest,
                       std::span<const DistanceGrid* const> solids, double least);

} // namespace fascicle::solver
