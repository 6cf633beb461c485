#pragma once
// The rows of a trial as the frames of a scene.

#include "fascicle/io/storage_file.hpp"
#include "fascicle/scene/model_motion.hpp"

namespace fascicle::io {

/// Coordinates turn by at most this in a frame of the lead-in, and shift by at most that.
inline constexpr double lead_in_rad = 0.026179938779914945; // 1.5 degrees
inline constexpr double lead_in_m = 0.02;

/// Fills values, lead_in, first_s, frame_s and moving of a motion whose model, rest_values and reading are set.
/// Where the time steps are all within 10 % of the median, rows are frames; else, and with reading.frames, frames are even and values
/// between rows linear. The lead-in goes from rest to the first row along 3 u^2 - 2 u^3 in all coordinates; none when they are the same.
/// notes: what was assumed, gaps, jumps, coordinates and columns without the other. Error naming file, line and column: no time, time
/// that does not ascend, no coordinate, fewer than two rows in the wanted part, cells that are no numbers, more than 100,000 frames.
void read_trial_frames(const StorageTable& table, ModelMotion& motion, std::vector<std::string>& notes);

} // namespace fascicle::io
