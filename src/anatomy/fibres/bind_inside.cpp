#include "fascicle/anatomy/fibre_carrier.hpp"

#include "anatomy/fibres/bind_to_chords.hpp"
#include "anatomy/fibres/carrier_builder.hpp"
#include "anatomy/fibres/muscle_inside.hpp"
#include "fascicle/base/assert.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/bounding_box.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace fascicle {

namespace {

/// A point between (or beyond) two surface points: x = (1 - share) from + share to.
struct Chord {
    LineCrossing from, to;
    double share = 0;
    double length = 0;
};

/// What one direction says about one point.
struct ChordFind {
    std::optional<Chord> chord;   ///< through the point
    std::optional<Chord> outside; ///< of a line whose nearest crossings are both on one side
    int winding = 0;
};

Chord chord_between(const LineCrossing& from, const LineCrossing& to) {
    Chord chord{from, to, 0.0, std::abs(to.distance - from.distance)};
    chord.share = -from.distance / (to.distance - from.distance);
    return chord;
}

ChordFind find_chords(const LineCrossings& lines, const Vec3& p, double tiny) {
    ChordFind find;
    const LineNeighbours n = lines.at(p);
    find.winding = n.winding;
    if (n.ahead.triangle >= 0 && n.behind.triangle >= 0) {
        if (n.ahead.distance - n.behind.distance > tiny)
            find.chord = chord_between(n.behind, n.ahead);
    }
    const bool ahead = std::abs(n.ahead.distance) < std::abs(n.behind.distance);
    const LineCrossing &first = ahead ? n.ahead : n.behind,
                       &second = ahead ? n.ahead_second : n.behind_second;
    if (first.triangle >= 0 && second.triangle >= 0 && std::abs(second.distance - first.distance) > tiny)
        find.outside = chord_between(first, second);
    return find;
}

/// What the carrier keeps of one point.
struct BoundRow {
    std::vector<std::pair<int, double>> entries;
    HoldEnds ends{};
    double depth = 0; ///< about the distance to the surface; 0 for a point that is not held
};

class RowMaker {
public:
    RowMaker(const TriMesh& surface, const MeshTopology& topology, double size)
        : surface_(surface), topology_(topology), tiny_(1e-9 * size) {}

    void make(const Vec3& p, const std::array<ChordFind, 13>& finds, CarrierRow& row, BoundRow& bound) const;

private:
    void add(const Chord& chord, double weight, CarrierRow& row) const {
        row.add(triangle(chord.from.triangle), chord.from.weights, weight * (1.0 - chord.share));
        row.add(triangle(chord.to.triangle), chord.to.weights, weight * chord.share);
    }
    const Tri& triangle(int t) const { return surface_.triangles[static_cast<std::size_t>(t)]; }
    /// Whether p is clearly behind the plane of a triangle: where a chord only grazes it, rounding would decide.
    bool behind(int t, const Vec3& p) const {
        const Tri& tri = triangle(t);
        const auto corner = [&](std::size_t k) {
            return surface_.positions[static_cast<std::size_t>(tri[k])];
        };
        const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        return (p - corner(0)).dot(normal) < -tiny_ * normal.norm();
    }
    double watched_ends(const std::array<ChordFind, 13>& finds, const Vec3& p, HoldEnds& ends) const;
    Vec3 at(const LineCrossing& c) const {
        Vec3 sum = Vec3::Zero();
        for (int k = 0; k < 3; ++k)
            sum += c.weights[k] *
                   surface_.positions[static_cast<std::size_t>(triangle(c.triangle)[std::size_t(k)])];
        return sum;
    }
    /// Whether the chord gives the point back: not so where a line grazes a triangle.
    bool exact(const Chord& chord, const Vec3& p) const {
        const Vec3 x = (1.0 - chord.share) * at(chord.from) + chord.share * at(chord.to);
        return (x - p).norm() <= 0.1 * tiny_;
    }
    void add_tetrahedron(const Vec3& p, CarrierRow& row) const;

    const TriMesh& surface_;
    const MeshTopology& topology_;
    double tiny_;
};

/// Triangles to watch: those that the shortest chords end in, both ends of each (the far side may be dented up to the
/// point), then the nearest ends of all other chords. Returns the distance of the nearest end.
double RowMaker::watched_ends(const std::array<ChordFind, 13>& finds, const Vec3& p, HoldEnds& ends) const {
    constexpr std::size_t whole_chords = 4;
    std::array<const Chord*, 13> chords{};
    std::size_t count = 0;
    for (const ChordFind& find : finds)
        if (find.chord && find.winding > 0)
            chords[count++] = &*find.chord;
    std::sort(chords.begin(), chords.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Chord* a, const Chord* b) { return a->length < b->length; });
    std::array<const LineCrossing*, 26> others{};
    std::size_t other_count = 0, filled = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < count; ++k)
        for (const LineCrossing* end : {&chords[k]->from, &chords[k]->to}) {
            nearest = std::min(nearest, std::abs(end->distance));
            if (!behind(end->triangle, p))
                continue;
            if (k < whole_chords)
                ends[filled++] = end->triangle;
            else
                others[other_count++] = end;
        }
    std::sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(other_count),
              [](const LineCrossing* a, const LineCrossing* b) {
                  return std::abs(a->distance) < std::abs(b->distance);
              });
    for (std::size_t k = 0; k < other_count && filled < ends.size(); ++k)
        ends[filled++] = others[k]->triangle;
    return count > 0 ? nearest : 0.0;
}

void RowMaker::make(const Vec3& p, const std::array<ChordFind, 13>& finds, CarrierRow& row,
                    BoundRow& bound) const {
    row.clear();
    bound.ends.fill(-1);
    // On the surface: the blend of its triangle.
    const LineCrossing* touching = nullptr;
    for (const ChordFind& find : finds)
        for (const auto* chord : {&find.chord, &find.outside})
            if (chord->has_value())
                for (const LineCrossing* end : {&(*chord)->from, &(*chord)->to})
                    if (std::abs(end->distance) <= tiny_ && (at(*end) - p).norm() <= tiny_ &&
                        (touching == nullptr || end->triangle < touching->triangle))
                        touching = end;
    if (touching != nullptr) {
        row.add(triangle(touching->triangle), touching->weights.cwiseMax(0.0), 1.0);
        return;
    }
    int inside = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (const ChordFind& find : finds) {
        inside += find.winding > 0 ? 1 : -1;
        if (find.chord && find.winding > 0 && exact(*find.chord, p))
            shortest = std::min(shortest, find.chord->length);
    }
    if (inside > 0 && std::isfinite(shortest)) {
        for (const ChordFind& find : finds)
            if (find.chord && find.winding > 0 && exact(*find.chord, p)) {
                const double ratio = shortest / find.chord->length;
                if (const double weight = ratio * ratio * ratio * ratio; weight > 5e-3)
                    add(*find.chord, weight, row);
            }
        bound.depth = watched_ends(finds, p, bound.ends);
        return;
    }
    const Chord* nearest = nullptr;
    for (const ChordFind& find : finds)
        if (find.outside && exact(*find.outside, p) &&
            (nearest == nullptr || std::abs(find.outside->from.distance) < std::abs(nearest->from.distance)))
            nearest = &*find.outside;
    // Far from the surface the extrapolation would magnify every motion of the chord.
    if (nearest != nullptr && std::abs(nearest->share) < 2.0)
        return add(*nearest, 1.0, row);
    add_tetrahedron(p, row);
}

/// The last resort: affine coordinates in the best shaped tetrahedron of a triangle at the nearest vertex and a vertex
/// far from its plane.
void RowMaker::add_tetrahedron(const Vec3& p, CarrierRow& row) const {
    int nearest = -1;
    double best = std::numeric_limits<double>::infinity();
    for (int v = 0; v < surface_.vertex_count(); ++v)
        if (const double d = (surface_.positions[static_cast<std::size_t>(v)] - p).squaredNorm();
            d < best && !topology_.vertex_triangles(v).empty()) {
            best = d;
            nearest = v;
        }
    const auto position = [&](int v) { return surface_.positions[static_cast<std::size_t>(v)]; };
    double largest = 0;
    const Tri* base = nullptr;
    for (const int t : topology_.vertex_triangles(nearest)) {
        const Tri& tri = triangle(t);
        const double area =
            (position(tri[1]) - position(tri[0])).cross(position(tri[2]) - position(tri[0])).norm();
        if (area > largest) {
            largest = area;
            base = &tri;
        }
    }
    if (base == nullptr)
        return row.add(nearest, 1.0);
    const Vec3 a = position((*base)[0]), u = position((*base)[1]) - a, v = position((*base)[2]) - a;
    const Vec3 normal = u.cross(v).normalized();
    int apex = -1;
    double height = 0;
    for (const Tri& t : surface_.triangles)
        for (const int k : t)
            if (const double h = std::abs((position(k) - a).dot(normal)); h > height) {
                height = h;
                apex = k;
            }
    Mat3 axes;
    axes << u, v, apex >= 0 ? Vec3(position(apex) - a) : normal;
    Vec3 share = axes.fullPivLu().solve(p - a);
    if (apex < 0)
        share[2] = 0; // a flat surface: its plane is all there is
    row.add((*base)[0], 1.0 - share.sum());
    row.add((*base)[1], share[0]);
    row.add((*base)[2], share[1]);
    if (apex >= 0)
        row.add(apex, share[2]);
}

} // namespace

FibreCarrier bind_inside(const TriMesh& surface, const MeshTopology& topology,
                         std::span<const Vec3> rest_points, int threads) {
    FASCICLE_ASSERT(topology.vertex_count() == surface.vertex_count());
    if (topology.component_count() == 0)
        throw_error("binding fibres", "the surface has no triangles", "a muscle's surface");
    return bind_to_chords(surface, topology, chord_lines(surface, threads), rest_points, threads);
}

FibreCarrier bind_to_chords(const TriMesh& surface, const MeshTopology& topology,
                            const std::vector<LineCrossings>& lines, std::span<const Vec3> rest_points,
                            int threads) {
    for (std::size_t i = 0; i < rest_points.size(); ++i)
        if (!rest_points[i].allFinite())
            throw_error("binding fibres", "point " + std::to_string(i) + " is not finite", "numbers");
    const double size = bounding_box(surface.positions, surface.triangles).diagonal();
    constexpr std::size_t chunk = 128;
    std::vector<std::vector<BoundRow>> chunks((rest_points.size() + chunk - 1) / chunk);
    const RowMaker rows(surface, topology, size);
    parallel_for(threads, rest_points.size(), chunk, [&](std::size_t begin, std::size_t end) {
        std::array<ChordFind, 13> finds;
        CarrierRow row;
        for (std::size_t i = begin; i < end; ++i) {
            for (std::size_t d = 0; d < 13; ++d)
                finds[d] = find_chords(lines[d], rest_points[i], 1e-9 * size);
            BoundRow& bound = chunks[i / chunk].emplace_back();
            rows.make(rest_points[i], finds, row, bound);
            bound.entries = row.merged();
        }
    });
    CarrierBuilder builder(surface, topology);
    std::size_t weights = 0;
    for (const auto& some : chunks)
        for (const BoundRow& bound : some)
            weights += bound.entries.size();
    builder.reserve(rest_points.size(), weights);
    const double margin = 1e-4 * size; // enough to be inside by any reckoning, too little to see
    for (const auto& some : chunks)
        for (const BoundRow& bound : some)
            builder.add_row(bound.entries, bound.ends, std::min(bound.depth, margin));
    return builder.take();
}

} // namespace fascicle
