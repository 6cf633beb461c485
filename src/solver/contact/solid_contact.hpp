#pragma once
// Contact of free points with moving solids: every point that is nearer to a solid than the offset is put
// back along the gradient of the solid's distance grid. Source: methods notes 5.2 and 5.4; friction: Macklin
// et al. 2014.

#include "fascicle/base/pose.hpp"
#include "fascicle/geometry/distance_grid.hpp"

#include <cstdint>
#include <memory>
#include <span>

namespace fascicle::solver {

/// One solid as the contact sees it: its grid (rest frame), its pose now and at the start of the substep.
struct ContactSolid {
    const DistanceGrid* grid = nullptr;
    Pose now;
    Pose before;
    double slope = 2.0; ///< a Lipschitz constant of the grid's interpolant, see largest_slope()
};

/// The hard bound, as a share of the offset.
inline constexpr double least_of_offset = 0.1;

struct ContactSettings {
    double offset = 0.1;   ///< wanted distance to the grid's zero set, scene units
    double least = 0.01;   ///< the distance that is kept whatever happens, below the offset
    double friction = 0.0; ///< Coulomb coefficient, 0 slides freely
    int passes = 4;        ///< alternating projections over the solids: two solids at once need more than one
};

struct ContactResult {
    bool touched = false;
    Vec3 normal = Vec3::Zero(); ///< of the last solid that pushed, unit; zero when none did
    bool outside = true; ///< false when the passes ended with the point still nearer than half the offset
};

/// Moves x (a point that was at `before` at the start of the substep) out of all solids.
/// Each projection: x += (offset - phi) g / |g|^2 with phi, g the value and gradient at x. Friction takes
/// away up to friction times the normal correction from the slip along the surface, relative to the moving
/// solid, once. A point deep inside, where the grid is saturated and g = 0, cannot be helped here and is
/// reported as not outside.
ContactResult resolve_contact(Vec3& x, const Vec3& before, std::span<const ContactSolid> solids,
                              const ContactSettings& settings);

} // namespace fascicle::solver
