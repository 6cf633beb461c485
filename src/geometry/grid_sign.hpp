#pragma once
// Which nodes of a regular grid lie inside a surface.

#include "fascicle/geometry/tri_mesh.hpp"
#include "fascicle/geometry/winding_number.hpp"

namespace fascicle {

/// Nodes low + h (i, j, k), 0 <= i < nodes[0] and so on; node number i + nodes[0] (j + nodes[1] k).
struct GridShape {
    Vec3 low = Vec3::Zero();
    double h = 1;
    std::array<int, 3> nodes{};

    std::size_t node_count() const {
        return static_cast<std::size_t>(nodes[0]) * static_cast<std::size_t>(nodes[1]) *
               static_cast<std::size_t>(nodes[2]);
    }
    std::size_t row(int j, int k) const {
        return static_cast<std::size_t>(nodes[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(nodes[1]) * static_cast<std::size_t>(k));
    }
    Vec3 node(int i, int j, int k) const { return low + h * Vec3(i, j, k); }
};

/// Inside = generalised winding number > 0.5, for any triangle list, without evaluating it at every node:
/// w(surface) = w(surface + cap) - w(cap), where the cap closes the surface (boundary_cap). The first term is
/// an integer, the signed number of crossings of the ray from the node along +x with surface and cap; the
/// second is zero for closed surfaces, and otherwise is evaluated only near the cap, where it can reach a
/// half. The columns of nodes are shifted sideways by about 1e-5 h and cut with an exact rule for edges, so
/// that a ray passes every shared edge on exactly one side.
class GridSign {
public:
    /// All vertices that triangles use must lie within the grid.
    /// The same for every number of threads.
    GridSign(const GridShape& shape, const Points& points, const std::vector<Tri>& triangles,
             int threads = 1);

    /// inside[i] = 1 for the nodes (i, j, k) of one row that are inside, else 0; `inside` holds nodes[0]
    /// entries.
    void mark_row(int j, int k, std::vector<unsigned char>& inside) const;

private:
    struct Crossing {
        double x;
        int direction; ///< +1 where the ray along +x leaves, -1 where it enters
    };
    template <typename Visit>
    void cut(const Points& points, const Tri& triangle, const Visit& visit) const;
    bool cap_decides_inside(const Vec3& p, int crossings) const;

    GridShape shape_;
    std::vector<std::size_t> first_; ///< by row (j, k) and one more: range of crossings_
    std::vector<Crossing> crossings_;
    WindingNumber cap_;
    Vec3 cap_low_ = Vec3::Zero(), cap_high_ = Vec3::Zero();
    double cap_reach_ = 0; ///< farther than this from the cap's box |w(cap)| < 0.49
};

} // namespace fascicle
