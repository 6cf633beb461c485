#pragma once
// The superficial layer as a net: rows across the fibres, lines through the thickness, and gaps between heads.

#include "control_fibres.hpp"

#include "fascicle/geometry/centripetal_spline.hpp"

namespace fascicle::chmd {

/// Where a line through the thickness enters and leaves the muscle; top is the superficial end.
struct Thickness {
    Vec3 top = Vec3::Zero();
    Vec3 bottom = Vec3::Zero();
    bool hit = false; ///< false: the line misses the muscle near its start
    double length() const { return hit ? (bottom - top).norm() : 0.0; }
};

/// Between two neighbouring control fibres in one row: knot shares where the muscle ends on the left and begins again on
/// the right; no gap: both 0.5.
struct Gap {
    bool open = false;
    double left = 0.5, right = 0.5;
};

/// Const calls may run on several threads.
class Rows {
public:
    Rows(const FibreProblem& problem, const SolidQuery& solid, const ControlFibres& control);

    int rows() const { return static_cast<int>(across_.size()); }
    int spans() const { return across_.front().spans(); }
    /// Unit direction out of the muscle: the row's mean normal, which keeps the lines of a row from crossing, with up to
    /// as much of the surface's normals round about, the less the more they differ from it.
    Vec3 normal(int row, int span, double share) const;
    const Gap& gap(int row, int span) const { return gaps_[static_cast<std::size_t>(row * spans() + span)]; }
    /// Whether the muscle is split into heads at this span at its origin end (else insertion end): the gap is open in
    /// the first rows, at least two and an eighth of all.
    bool splits(int span, bool at_origin) const;
    /// Head that a control fibre belongs to at one end: splits to the left of it.
    int head(int fibre, bool at_origin) const;
    /// First or last point of a control fibre.
    const Vec3& end(int fibre, bool at_origin) const {
        return (at_origin ? across_.front() : across_.back()).points()[static_cast<std::size_t>(fibre)];
    }

    /// Place on the superficial layer at share in [0, 1] of a span; where the row has a gap the first half of the
    /// shares is pushed to its left side, the rest to its right.
    Vec3 place(int row, int span, double share) const;
    /// The line through that place along its normal. Where it misses the muscle or only grazes it (given fibres often lie
    /// beside the rim): the same line from a little below the nearest surface point.
    Thickness thickness(int row, int span, double share) const;
    /// The stretch inside the muscle nearest to p of the line along `outward` through it, if it comes within `reach`.
    Thickness probe(const Vec3& p, const Vec3& outward, double reach) const;

private:
    void find_normals(const ControlFibres& control);
    void find_gaps(int threads);
    Vec3 surface_normal(int triangle) const;

    const TriMesh& mesh_;
    const SolidQuery& solid_;
    double reach_ = 0; ///< how far a line's stretch inside may be from the place it goes through
    double thin_ = 0;  ///< 1 mm: less is a gap
    std::vector<CentripetalSpline> across_;
    Points normals_; ///< row by row, one per control fibre
    std::vector<Gap> gaps_;
};

} // namespace fascicle::chmd
