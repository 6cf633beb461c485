#pragma once
// Curves through given points: centripetal Catmull-Rom, which makes no loops or cusps between close points
// (Yuksel, Schaefer, Keyser 2011, "Parameterization and applications of Catmull-Rom curves").

#include "fascicle/base/types.hpp"

#include <span>

namespace fascicle {

/// Knots t_0 = 0, t_{i+1} = t_i + |P_{i+1} - P_i|^(1/2); unit: root of the scene unit. Not descending; equal for equal
/// points. As many as points.
std::vector<double> centripetal_knots(std::span<const Vec3> points);

/// A cubic between each two neighbours that passes through both, with the tangent of Catmull-Rom curves on uneven knots
/// (the derivative of the pyramid of Barry & Goldman 1988 at P_i):
///     P_i' = (P_i - P_{i-1}) / (t_i - t_{i-1}) - (P_{i+1} - P_{i-1}) / (t_{i+1} - t_{i-1})
///            + (P_{i+1} - P_i) / (t_{i+1} - t_i).
/// Beyond the ends the neighbour is mirrored, P_{-1} = 2 P_0 - P_1, so that P_0' = (P_1 - P_0) / (t_1 - t_0). A neighbour
/// at the same knot counts as mirrored too, and a span without length is a point. Knots fixed, the curve is affinely
/// invariant; with its own knots it is so under similarities, since the knots are distances.
class CentripetalSpline {
public:
    /// At least 1 point, finite.
    explicit CentripetalSpline(Points points);
    /// With given knots, ascending, as many as points.
    CentripetalSpline(Points points, std::vector<double> knots);

    int spans() const { return static_cast<int>(points_.size()) - 1; }
    /// Point of span i in [0, spans()) at share in [0, 1] of its knots: share 0 is point i, 1 point i + 1, exactly.
    Vec3 at(int span, double share) const;
    const Points& points() const { return points_; }
    const std::vector<double>& knots() const { return knots_; }
    const Points& tangents() const { return tangents_; } ///< per knot unit, one per point

private:
    void find_tangents();
    Points points_;
    std::vector<double> knots_;
    Points tangents_;
};

} // namespace fascicle
