#pragma once
// The hard bound of contact: a point that starts outside of every solid ends outside of every solid, whatever the constraints
// ask for and however far it or the solids move in a substep. Source: methods notes 5.4, with one change: the way is the
// straight line in each solid's own rest frame, where the solid stands still. Each solid alone has not been crossed then, which
// is all that being outside needs, and no pose between has to be formed.

#include "solver/contact/solid_contact.hpp"

namespace fascicle::solver {

enum class ClampResult {
    clear,     ///< was as it should be
    slid,      ///< stopped at a solid and slid on along it
    ejected,   ///< put to the nearest place outside of all solids
    impossible ///< no such place was found: left where it is the least deep
};

/// The share in [0, 1] of the straight way from a to b, in the grid's frame, on which the interpolant stays >= least: 1 when all of
/// it does, b included; 0 when a does not. slope: a Lipschitz constant of the interpolant. Steps by value / slope, but not by less than a hundredth of
/// `offset` or a thousandth of the spacing.
double free_share(const DistanceGrid& grid, const Vec3& a, const Vec3& b, double least, double offset,
                  double slope);

/// Moves x, wanted by the constraints for a point that was at `before` at the start of the substep, so that it has settings.least
/// to every solid now and has crossed none. At most four times it stops where a solid holds it, loses what is left of the motion into that
/// solid and goes on; then it is ejected: carried along with one of the solids, or by the gradients, or to the nearest of a
/// growing set of places around it.
ClampResult clamp_motion(Vec3& x, const Vec3& before, std::span<const ContactSolid> solids,
                         const ContactSettings& settings);

/// Least value of the solids' interpolants at x now, and whose it is (-1 without solids; infinite).
struct NearestSolid {
    double value;
    int solid;
};
NearestSolid nearest_solid(const Vec3& x, std::span<const ContactSolid> solids);

} // namespace fascicle::solver
