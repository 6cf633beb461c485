#pragma once
// The superficial fibres that a user gives, put in order.

#include "patch_surface.hpp"

#include "fascicle/geometry/solid_query.hpp"

namespace fascicle::chmd {

/// n >= 2 fibres of `rows` points each at equal arcs of the centripetal curve through the given points, all from origin
/// to insertion, each beside its neighbours, from left to right seen from outside with the origin above.
struct ControlFibres {
    std::vector<Points> fibres;
    double farthest = 0; ///< greatest distance of a given point to the muscle's surface
    int rows() const { return static_cast<int>(fibres.front().size()); }
    int count() const { return static_cast<int>(fibres.size()); }
};

/// Whatever order and direction they have in the file: each is turned so that its ends are near their attachments (one
/// that is as near either way follows its nearest neighbour), then they are ordered along the shortest path from fibre to
/// fibre. Rows: one every 10 mm of the longest, 8 to 32. Error naming the muscle for: none given, fewer than two, more
/// than 500, one with fewer than 2 different points or one not finite, one that lies on average farther than 10 mm from
/// the surface (or a twentieth of the muscle's size where that is more).
ControlFibres order_control_fibres(const FibreProblem& problem, const SolidQuery& solid,
                                   const PatchSurface& origin, const PatchSurface& insertion);

} // namespace fascicle::chmd
