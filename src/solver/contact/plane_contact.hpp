#pragma once
// Points held in half-spaces for one frame: how the surfaces of other soft bodies are seen.

#include "solver/contact/sample_guard.hpp"

namespace fascicle::solver {

/// Puts the plane's point, if it is free and on the wrong side at the given share of the frame, back to the plane, unless a solid
/// is in the way: solids come first. point: as the guarded points number it. Whether it was moved.
bool hold_to_plane(const PointPlane& plane, int point, double share, GuardedPoints& points,
                   std::span<const ContactSolid> solids, const ContactSettings& settings,
                   GuardCounts& counts);

} // namespace fascicle::solver
