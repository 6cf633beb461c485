#pragma once
// Where the clusters of a ClusterBasis sit, who is near to them, and in which order they are numbered.

#include "fascicle/geometry/mesh_topology.hpp"

#include <array>

namespace fascicle::solver {

struct ClusterWeights;

struct ClusterSeeds {
    /// Up to five nearest seeds of a vertex along edges, ascending by distance.
    struct Nearest {
        int count = 0;
        std::array<int, 5> seed{};
        std::array<double, 5> distance{};
    };
    std::vector<int> vertices;    ///< the seeds
    std::vector<Nearest> nearest; ///< V
    std::vector<double>
        from_fixed;    ///< V: distance to the nearest fixed vertex along edges, huge when none is reached
    double radius = 0; ///< largest distance of a free vertex to its seed or to a fixed vertex
};

/// Farthest-point sampling along edges, starting from the fixed vertices (inverse mass 0): at most `wanted` seeds and
/// one for every 20 free vertices. Ties go to the lowest vertex.
ClusterSeeds find_cluster_seeds(const Points& rest, const MeshTopology& topology,
                                const std::vector<double>& inverse_mass, int wanted);

/// Renumbers the clusters in weights by reverse Cuthill-McKee and returns the half-width, in unknowns (6 a cluster), of
/// a matrix that couples clusters whose vertices share an edge or a hinge.
int order_clusters(const MeshTopology& topology, std::vector<ClusterWeights>& weights, int clusters);

} // namespace fascicle::solver
