#pragma once
// A way over a surface as the vertices it bends at and the edges it crosses, and how it becomes shortest.

#include "fascicle/geometry/geodesic_line.hpp"

namespace fascicle {

/// Built from a path of vertices; straighten() makes it the shortest of its kind.
class SurfaceStrip {
public:
    /// vertices: v_0 .. v_n, n >= 0, neighbours by edges; v_0 a corner of from.triangle, v_n of to.triangle.
    SurfaceStrip(const SurfaceGraph& graph, const SurfacePoint& from, const SurfacePoint& to,
                 const std::vector<int>& vertices);
    void straighten();
    GeodesicLine line() const;

private:
    /// vertex >= 0, or edge >= 0 crossed at a + share (b - a).
    struct Step {
        int vertex = -1;
        int edge = -1;
        double share = 0.5;
    };
    /// Neighbours of a vertex in turn, with the angle at which each lies; closed: the last triangle ends at the first.
    struct Fan {
        std::vector<int> neighbours, triangles; ///< triangle k lies between neighbours k and k + 1
        std::vector<double> angles;             ///< of neighbours; one more than triangles
        bool closed = false;
    };

    Vec3 place(std::size_t i) const; ///< of a step
    Vec3 before(std::size_t i) const;
    Vec3 after(std::size_t i) const;
    bool find_fan(int vertex, Fan& fan) const;
    /// slot: 2 k at neighbour k, 2 k + 1 within triangle k; -1 when not found.
    struct Bearing {
        int slot = -1;
        double angle = 0;
    };
    /// Where in the fan of a step's vertex the way comes from, or (forward) goes to.
    Bearing bearing(const Fan& fan, std::size_t step, bool forward) const;
    /// Leads the way round the vertex of a step when that is shorter.
    bool pass_vertex(std::size_t step);
    /// Takes away steps that say nothing: a vertex twice, an edge there and back, an edge crossed at a vertex beside it.
    void clean_up();
    /// Makes the crossings around the step (or just before it) lie on the shortest line between the vertices, or ends, on
    /// either side of them. Returns the first step of what changed.
    std::size_t tighten(std::size_t step);
    /// The triangle between step gap - 1 and step gap, or the ends; -1 when there is none.
    int shared_triangle(std::size_t gap) const;

    const SurfaceGraph& graph_;
    SurfacePoint from_, to_;
    std::vector<Step> steps_;
};

} // namespace fascicle
