#pragma once
// Moves the playhead while playing.

#include "editor/editor_state.hpp"

namespace fascicle::editor {

/// The frames that are played: the playback's range within the timeline, or all. first <= last.
std::pair<int, int> played_range(const Playback& playback, int last_frame);

/// seconds: since the last call; frame_time: seconds of a frame at speed 1, > 0; available: frames [0, n) can
/// be shown; coming: more frames are being computed, so that the end is waited at. At an end of the range it stops, starts
/// again or turns round, as the playback says.
void advance(Playback& playback, double seconds, double frame_time, int available, int last_frame,
             bool coming);

} // namespace fascicle::editor
