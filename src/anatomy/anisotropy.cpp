#include "fascicle/anatomy/anisotropy.hpp"

#include "fascicle/anatomy/harmonic_field.hpp"
#include "fascicle/base/assert.hpp"
#include "fascicle/geometry/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle {

namespace {

struct FibreSegment {
    Vec3 a, b;   ///< ends
    Vec3 ta, tb; ///< tangents at the ends: the mean of the two segments that meet there
};

Vec3 unit_or_zero(const Vec3& v) {
    const double length = v.norm();
    return length > 0.0 ? Vec3(v / length) : Vec3::Zero();
}

std::vector<FibreSegment> make_segments(const Polylines& fibres) {
    std::vector<FibreSegment> segments;
    for (const std::vector<int>& line : fibres.lines) {
        const auto at = [&](std::size_t k) -> const Vec3& {
            return fibres.points[static_cast<std::size_t>(line[k])];
        };
        const auto tangent = [&](std::size_t k) {
            const Vec3 in = k > 0 ? unit_or_zero(at(k) - at(k - 1)) : Vec3::Zero();
            const Vec3 out = k + 1 < line.size() ? unit_or_zero(at(k + 1) - at(k)) : Vec3::Zero();
            return unit_or_zero(in + out);
        };
        for (std::size_t k = 0; k + 1 < line.size(); ++k)
            if ((at(k + 1) - at(k)).norm() > 0.0)
                segments.push_back({at(k), at(k + 1), tangent(k), tangent(k + 1)});
    }
    return segments;
}

const Vec3& position(const TriMesh& mesh, int vertex) {
    return mesh.positions[static_cast<std::size_t>(vertex)];
}

} // namespace

Points edge_tangents_from_fibres(const TriMesh& mesh, const MeshTopology& topology, const Polylines& fibres) {
    const std::vector<FibreSegment> segments = make_segments(fibres);
    Points tangents(topology.edges().size(), Vec3::Zero());
    if (segments.empty())
        return tangents;
    // A tree of triangles without area, one a segment. Where two are equally near they meet, and have one tangent there.
    TriMesh lines;
    for (const FibreSegment& segment : segments) {
        const int a = lines.vertex_count();
        lines.positions.insert(lines.positions.end(), {segment.a, segment.b});
        lines.triangles.push_back({a, a + 1, a + 1});
    }
    const TriangleBvh tree(lines);
    int hint = -1;
    for (std::size_t e = 0; e < tangents.size(); ++e) {
        const Edge& edge = topology.edges()[e];
        const Vec3 middle = 0.5 * (position(mesh, edge.a) + position(mesh, edge.b));
        hint = tree.closest(middle, std::numeric_limits<double>::infinity(), hint).triangle;
        if (hint < 0)
            continue; // a middle that is not finite
        const FibreSegment& segment = segments[static_cast<std::size_t>(hint)];
        const Vec3 d = segment.b - segment.a;
        const double s = std::clamp((middle - segment.a).dot(d) / d.squaredNorm(), 0.0, 1.0);
        tangents[e] = unit_or_zero((1.0 - s) * segment.ta + s * segment.tb);
    }
    return tangents;
}

Points edge_tangents_from_field(const TriMesh& mesh, const MeshTopology& topology,
                                const std::vector<double>& field) {
    const Points gradients = triangle_gradients(mesh, field);
    double largest = 0;
    for (const Vec3& g : gradients)
        largest = std::max(largest, g.norm());
    Points tangents(topology.edges().size(), Vec3::Zero());
    for (std::size_t e = 0; e < tangents.size(); ++e) {
        Vec3 sum = Vec3::Zero();
        for (const int half_edge : topology.edge_half_edges(static_cast<int>(e)))
            sum += gradients[static_cast<std::size_t>(half_edge / 3)];
        if (sum.norm() > 1e-9 * largest) // below: rounding on a flat part, not a direction
            tangents[e] = unit_or_zero(sum);
    }
    return tangents;
}

std::vector<double> edge_softness(const TriMesh& mesh, const MeshTopology& topology, const Points& tangents,
                                  double exponent) {
    FASCICLE_ASSERT(tangents.size() == topology.edges().size());
    std::vector<double> softness(tangents.size(), 1.0);
    for (std::size_t e = 0; e < softness.size(); ++e) {
        const Edge& edge = topology.edges()[e];
        const Vec3 direction = unit_or_zero(position(mesh, edge.b) - position(mesh, edge.a));
        const double along = std::min(1.0, std::abs(direction.dot(tangents[e])));
        softness[e] = std::max(min_edge_softness, std::pow(1.0 - along, exponent));
    }
    return softness;
}

} // namespace fascicle
