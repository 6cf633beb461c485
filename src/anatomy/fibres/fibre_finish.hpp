#pragma once
// The last steps that all methods share: ends on the attachments, everything inside, bound to the surface.

#include "anatomy/fibres/muscle_inside.hpp"
#include "anatomy/fibres/stopwatch.hpp"
#include "fascicle/anatomy/fibre_problem.hpp"

namespace fascicle {

/// Puts the first point of each fibre on the nearest place of the origins, the last on the insertions.
void ends_on_attachments(const FibreProblem& problem, FibreSet& fibres);

/// P_j <- (P_j-1 + 4 P_j + P_j+1) / 6 for all inner points at once, `passes` times; ends stay.
void smooth_fibres(FibreSet& fibres, int passes);

/// model.rest holds the fibres with their ends on the attachments. Moves inner points inside, then, a few times, those
/// whose segments' middles are outside; binds all; adds seconds ("inside", "bind") and notes.
void finish_fibres(const FibreProblem& problem, const MuscleInside& inside, FibreModel& model);

} // namespace fascicle
