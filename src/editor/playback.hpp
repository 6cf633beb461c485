#pragma once
// Moves the playhead while playing.

#include "editor/editor_state.hpp"

namespace fascicle::editor {

/// seconds: since the last call; frame_time: seconds of a frame at speed 1, > 0; available: frames [0, n) can
/// be shown; coming: more frames are being computed, so that the end is waited at. Stops at last_frame, or
/// starts again when looping.
void advance(Playback& playback, double seconds, double frame_time, int available, int last_frame,
             bool coming);

} // namespace fascicle::editor
