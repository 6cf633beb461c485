#pragma once
// The attachment areas of one kind as a surface to measure from and to put fibre ends on.

#include "fascicle/anatomy/fibre_problem.hpp"
#include "fascicle/geometry/bvh.hpp"

namespace fascicle::chmd {

/// Triangles of the muscle whose corners all belong to one attachment of the kind; of an attachment that covers no
/// triangle its vertices, as triangles without area.
struct PatchSurface {
    std::vector<Tri> triangles;
    TriangleBvh bvh;
};
PatchSurface make_patch_surface(const FibreProblem& problem, AttachmentKind kind);

/// `count` points spread over the given triangles of the patch in proportion to their area (over all alike when none has
/// any), one in each of `count` equal shares of the area along a curve that fills the patch's principal plane; where in
/// the share is drawn from `seed`. triangles: not empty.
Points sample_patch(const Points& positions, const std::vector<Tri>& triangles, int count, unsigned seed);

} // namespace fascicle::chmd
