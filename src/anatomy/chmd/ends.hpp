#pragma once
// Which place of its attachment each fibre runs to.

#include "patch_surface.hpp"
#include "strands.hpp"

namespace fascicle::chmd {

/// Of one end of all strands: where the strand is left, as a share of its length from that end, and the place on the
/// attachment it runs to from there.
struct StrandEnds {
    std::vector<double> trim;
    Points targets;
};

/// As many places as strands are drawn on the attachments of the kind, head by head (a triangle belongs to the head with
/// the nearest end of a control fibre), and assigned at least sum of distance^2 (1 / 10 + bend / pi), bend in [0, pi]: the angle
/// between the strand's direction at its end and the way to the place. (The published cost is distance * bend / pi. Squared
/// distances make many strands shift a little where the attachment is too small beside them; plain ones send a few across
/// all others. The tenth makes a long way straight ahead cost something.) While a bend is above 4 pi / 9 the strand is
/// shortened at this end by a tenth of its length times its depth (a third at least, so that superficial strands
/// give way too), and all are assigned anew: at most 10 rounds, at most 45 % of a strand.
StrandEnds assign_ends(const FibreProblem& problem, const Rows& rows, const std::vector<Strand>& strands,
                       const PatchSurface& patch, bool at_origin);

} // namespace fascicle::chmd
