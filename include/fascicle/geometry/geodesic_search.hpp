#pragma once
// Distances along a surface from points or vertices, out to a limit. The work of every brush.

#include "fascicle/geometry/surface_graph.hpp"

#include <functional>

namespace fascicle {

/// How the distance of a triangle's third corner follows from those of the other two, a and b.
///  round: as from a point source. In the plane of the triangle the source s lies where |s - a| = d_a and
///    |s - b| = d_b, on the side away from c; d_c = |s - c| when the line s - c meets the edge ab (Novotni & Klein,
///    "Computing geodesic distances on triangular meshes", WSCG 2002). Exact on a flat
///    surface with one point source. Where a and b are nearest to different points of `from`, as plane.
///  plane: as a straight front, d_c = min over x on ab of d(x) + |c - x|, d linear on ab (Kimmel & Sethian, "Computing
///    geodesic paths on manifolds", PNAS 95, 1998). For a front that starts from a whole region.
///  edges: along edges alone (Dijkstra). Symmetric and never too short, but up to 41 % too long on a regular grid.
/// With each of them d_c <= d_a + |ca| is used as well.
enum class WaveFront { round, plane, edges };

/// Where the wave may not go, and when it may stop. Empty function: everywhere.
struct GeodesicLimits {
    double distance = 0; ///< vertices up to it are reached, it included; infinity: all connected ones
    std::function<bool(int triangle)> passes; ///< only these triangles are crossed
    int until_triangle = -1;                  ///< stops when all three corners are reached
};

/// A workspace: holds arrays of the size of the surface, so that a search touches only what it reaches. One search at
/// a time; the graph must outlive it.
class GeodesicSearch {
public:
    struct Seed {
        int vertex = -1;
        double distance = 0; ///< not negative, scene units
    };

    explicit GeodesicSearch(const SurfaceGraph& graph);
    const SurfaceGraph& graph() const { return *graph_; }

    /// From points on the surface: corners of each point's triangle start at their straight distance. A point with
    /// triangle == -1 is passed over.
    void run(std::span<const SurfacePoint> from, const GeodesicLimits& limits,
             WaveFront front = WaveFront::round);
    void run(std::span<const Seed> from, const GeodesicLimits& limits, WaveFront front);

    /// Vertices reached, in the order of the wave: by distance, but for those whose distance was mended later.
    const std::vector<int>& reached() const { return reached_; }
    /// Scene units; infinity when not reached.
    double distance(int v) const {
        const auto i = static_cast<std::size_t>(v);
        return settled_[i] == run_ ? distance_[i] : std::numeric_limits<double>::infinity();
    }
    /// Vertex that the distance of v came from, -1 at a seed; WaveFront::edges only.
    int parent(int v) const { return parent_[static_cast<std::size_t>(v)]; }

private:
    struct Waiting {
        double distance;
        int vertex;
        bool operator>(const Waiting& o) const {
            return distance != o.distance ? distance > o.distance : vertex > o.vertex;
        }
    };
    void begin();
    void offer(int v, double distance, int from, int source);
    void spread(const GeodesicLimits& limits, WaveFront front);
    void pass_on(int v, const GeodesicLimits& limits, WaveFront front);

    const SurfaceGraph* graph_;
    std::vector<double> distance_;
    std::vector<int> parent_, source_; ///< source: number of the point or seed that the distance is from
    std::vector<unsigned> labelled_, settled_; ///< number of the run that last wrote the vertex
    std::vector<unsigned char> visits_;        ///< times settled in that run
    unsigned run_ = 0;
    double least_gain_ = 0; ///< a settled vertex is visited again only for this much
    std::vector<Waiting> heap_;
    std::vector<int> reached_;
};

} // namespace fascicle
