#include "finish.hpp"

#include "curve_tools.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::chmd {

namespace {

/// Puts inner points that are outside the muscle onto its surface. Returns whether any was.
bool push_inside(const SolidQuery& solid, Points& line) {
    bool moved = false;
    int hint = -1;
    Vec3 centre = Vec3::Zero();
    double clear = 0; // the open ball about `centre` is inside
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        if ((line[i] - centre).squaredNorm() < clear * clear)
            continue;
        const SolidSide side = solid.side(line[i], std::numeric_limits<double>::infinity(), hint);
        clear = side.distance < 0.0 ? side.radius : 0.0;
        centre = line[i];
        if (side.distance <= 0.0)
            continue;
        line[i] = solid.bvh().closest(line[i], std::numeric_limits<double>::infinity(), hint).point;
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

Points finish_fibre(const SolidQuery& solid, const Strand& strand, double trim_from, double trim_to, const Vec3& from,
                    const Vec3& to, int segments) {
    const Points middle = part_of_line(strand.path, trim_from, 1.0 - trim_to);
    Points knots{from};
    // A knot that is very near the next would only make a kink.
    const double close = 0.02 * polyline_length(strand.path);
    for (const Vec3& p : middle)
        if ((p - knots.back()).norm() > close && (p - to).norm() > close)
            knots.push_back(p);
    knots.push_back(to);
    smooth(knots, 2);
    const int spans = static_cast<int>(knots.size()) - 1;
    const int dense = std::max(48, 2 * segments);
    Points line = smooth_line(std::move(knots), (dense + spans - 1) / spans);
    for (int round = 0; round < 3 && push_inside(solid, line); ++round)
        smooth(line, 3);
    Points fibre = equal_arcs(line, segments);
    push_inside(solid, fibre);
    return fibre;
}

} // namespace fascicle::chmd
