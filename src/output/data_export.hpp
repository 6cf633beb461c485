#pragma once
// Meshes, fibres and numbers of a run as files. For any thread: needs no GL.

#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/recording.hpp"
#include "output/export_kinds.hpp"

namespace fascicle::output {

/// Places in the recording of the frames that a request names: numbers first to last in steps, last itself too.
/// Error (usage) when there is none.
std::vector<int> chosen_frames(const Recording& recording, const ExportRequest& request);
/// Place of the frame with that number. Error (usage) naming the nearest when there is none.
int place_of_frame(const Recording& recording, int number);

/// Writes the request; its kind draws nothing. The frames that the recording has now count. Error naming the file; Cancelled.
/// Either all files are there afterwards, or none is new.
void export_data(const ExportRequest& request, const Recording& recording, const JobControl& control);

} // namespace fascicle::output
