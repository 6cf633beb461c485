#include "fascicle/geometry/implicit_tube.hpp"

#include "fascicle/base/assert.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace fascicle {

namespace {

struct Piece {
    Vec3 from, along;              // start and end minus start
    double inverse_squared_length; // of along
    double wide_from, wide_to, narrow_from, narrow_to;
    Vec3 direction_from, direction_to;
};

std::vector<TubeStation> refine(const std::vector<TubeStation>& stations, int pieces) {
    const int n = static_cast<int>(stations.size());
    const auto at = [&](int i) -> const TubeStation& {
        return stations[static_cast<std::size_t>(std::clamp(i, 0, n - 1))];
    };
    std::vector<TubeStation> fine;
    for (int i = 0; i + 1 < n; ++i) {
        const int steps = i + 2 == n ? pieces + 1 : pieces; // the last span also gives its end point
        for (int k = 0; k < steps; ++k) {
            const double t = static_cast<double>(k) / pieces;
            // Ends are continued straight on, so that the curve keeps its direction there.
            const Vec3 before = i > 0 ? at(i - 1).point : Vec3(2.0 * at(0).point - at(1).point);
            const Vec3 after = i + 2 < n ? at(i + 2).point : Vec3(2.0 * at(n - 1).point - at(n - 2).point);
            TubeStation s;
            s.point = catmull_rom(before, at(i).point, at(i + 1).point, after, t);
            s.wide = catmull_rom(at(i - 1).wide, at(i).wide, at(i + 1).wide, at(i + 2).wide, t);
            s.narrow = catmull_rom(at(i - 1).narrow, at(i).narrow, at(i + 1).narrow, at(i + 2).narrow, t);
            // The cubic may undershoot between very different sizes: a tube never gets thinner than its
            // thinner end.
            s.wide = std::max(s.wide, std::min(at(i).wide, at(i + 1).wide));
            s.narrow = std::max(s.narrow, std::min(at(i).narrow, at(i + 1).narrow));
            s.wide_direction = ((1.0 - t) * at(i).wide_direction + t * at(i + 1).wide_direction).normalized();
            fine.push_back(s);
        }
    }
    return fine;
}

double value_at(const std::vector<Piece>& pieces, const Vec3& p) {
    double best = std::numeric_limits<double>::max();
    double best_t = 0.0;
    std::size_t index = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Vec3 q = p - pieces[i].from;
        const double t = std::clamp(q.dot(pieces[i].along) * pieces[i].inverse_squared_length, 0.0, 1.0);
        const double squared = (q - t * pieces[i].along).squaredNorm();
        if (squared < best) {
            best = squared;
            best_t = t;
            index = i;
        }
    }
    const Piece& piece = pieces[index];
    const double t = best_t;
    const double wide = piece.wide_from + t * (piece.wide_to - piece.wide_from);
    const double narrow = piece.narrow_from + t * (piece.narrow_to - piece.narrow_from);
    const Vec3 tangent = piece.along * std::sqrt(piece.inverse_squared_length);
    Vec3 u = piece.direction_from + t * (piece.direction_to - piece.direction_from);
    u = (u - u.dot(tangent) * tangent).normalized();
    const Vec3 q = p - piece.from - t * piece.along;
    // What points along the curve (only beyond the ends and at kinks) counts with the narrow half axis.
    const double across = q.dot(u);
    const double rest = (q - across * u).norm();
    const double a = across / wide, b = rest / narrow;
    const double k0 = std::hypot(a, b);
    const double k1 = std::hypot(a / wide, b / narrow);
    return k1 > 0.0 ? k0 * (k0 - 1.0) / k1 : -std::min(wide, narrow);
}

} // namespace

ImplicitShape tube_shape(const std::vector<TubeStation>& stations, int pieces) {
    FASCICLE_ASSERT(stations.size() >= 2 && pieces >= 1);
    const std::vector<TubeStation> fine = refine(stations, pieces);
    auto list = std::make_shared<std::vector<Piece>>();
    for (std::size_t i = 0; i + 1 < fine.size(); ++i) {
        const TubeStation &s = fine[i], &e = fine[i + 1];
        const Vec3 along = e.point - s.point;
        FASCICLE_ASSERT(along.squaredNorm() > 0.0);
        list->push_back({s.point, along, 1.0 / along.squaredNorm(), s.wide, e.wide, s.narrow, e.narrow,
                         s.wide_direction, e.wide_direction});
    }
    Eigen::AlignedBox3d box;
    for (const TubeStation& s : fine)
        box.extend(s.point);
    double radius = 0.0;
    for (const TubeStation& s : fine)
        radius = std::max(radius, (s.point - box.center()).norm() + std::max(s.wide, s.narrow));
    return {[list](const Vec3& p) { return value_at(*list, p); }, box.center(), radius};
}

} // namespace fascicle
