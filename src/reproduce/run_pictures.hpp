#pragma once
// Pictures of a run at the paper's frames, from the paper's side.

#include "fascicle/scene/recording.hpp"
#include "reproduce/results.hpp"

namespace fascicle::reproduce {

/// Fills row.pictures: frames 0, 50, 100, 150, 200, 300 of the paper's count for the program's own and the published method, 100 and 300
/// for the others; and row.fibre_pictures, at rest and flexed, where there are fibres and the method is the program's own, row.line_pictures
/// the same where there is a model of lines (null: there is none). recording: the run, with surfaces at every sixth of the motion. Where
/// there is no OSMesa the row is left without pictures.
void draw_pictures(const Recording& recording, const std::shared_ptr<const LineMuscles>& lines,
                   const Experiment& experiment, MethodRun& row, bool is_short);

} // namespace fascicle::reproduce
