#include "finish.hpp"

#include "curve_tools.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::chmd {

namespace {

/// Whether p is outside by the side of the triangle in whose inside its nearest surface point lies: true of any closed
/// surface that does not cross itself. 0 when that point lies on an edge, else -1 inside, 1 outside.
int side_of_face(const TriMesh& mesh, const Vec3& p, const SurfacePoint& near) {
    if (near.weights.minCoeff() < 1e-6)
        return 0;
    const Tri& t = mesh.triangles[static_cast<std::size_t>(near.triangle)];
    const auto at = [&](std::size_t k) -> const Vec3& {
        return mesh.positions[static_cast<std::size_t>(t[k])];
    };
    return (p - near.point).dot((at(1) - at(0)).cross(at(2) - at(0))) < 0.0 ? -1 : 1;
}

/// Puts inner points that are outside the muscle onto its surface. Returns whether any was. quick: by side_of_face where
/// it tells; else always by the winding number.
bool push_inside(const TriMesh& mesh, const SolidQuery& solid, Points& line, bool quick) {
    bool moved = false;
    int hint = -1;
    Vec3 centre = Vec3::Zero();
    double clear = 0; // the open ball about `centre` is inside
    const double on_surface = 1e-6 * polyline_length(line);
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        if ((line[i] - centre).squaredNorm() < clear * clear)
            continue;
        const SurfacePoint near = solid.bvh().closest(line[i], std::numeric_limits<double>::infinity(), hint);
        hint = near.triangle;
        if (near.squared_distance < on_surface * on_surface)
            continue;
        int side = quick ? side_of_face(mesh, line[i], near) : 0;
        if (side == 0)
            side = solid.inside(line[i]) ? -1 : 1;
        if (side < 0) {
            centre = line[i];
            clear = std::sqrt(near.squared_distance);
            continue;
        }
        line[i] = near.point;
        moved = true;
    }
    return moved;
}

/// P_j <- (P_{j-1} + 4 P_j + P_{j+1}) / 6 at inner points, all at once.
void smooth(Points& line, int passes) {
    for (int pass = 0; pass < passes; ++pass) {
        Vec3 before = line.front();
        for (std::size_t i = 1; i + 1 < line.size(); ++i) {
            const Vec3 here = line[i];
            line[i] = (before + 4.0 * here + line[i + 1]) / 6.0;
            before = here;
        }
    }
}

} // namespace

Points finish_fibre(const TriMesh& mesh, const SolidQuery& solid, const Strand& strand, double trim_from,
                    double trim_to, const Vec3& from, const Vec3& to, int segments) {
    const Points middle = part_of_line(strand.path, trim_from, 1.0 - trim_to);
    Points knots{from};
    // A knot that is very near the next would only make a kink.
    const double close = 0.02 * polyline_length(strand.path);
    for (const Vec3& p : middle)
        if ((p - knots.back()).norm() > close && (p - to).norm() > close)
            knots.push_back(p);
    knots.push_back(to);
    smooth(knots, 5);
    const int spans = static_cast<int>(knots.size()) - 1;
    const int dense = std::max(32, 2 * segments);
    Points line = smooth_line(std::move(knots), (dense + spans - 1) / spans);
    for (int round = 0; round < 3 && push_inside(mesh, solid, line, true); ++round)
        smooth(line, 3);
    Points fibre = equal_arcs(line, segments);
    push_inside(mesh, solid, fibre, false);
    return fibre;
}

} // namespace fascicle::chmd
