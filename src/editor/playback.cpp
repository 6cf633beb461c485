#include "editor/playback.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

void advance(Playback& playback, double seconds, double frame_time, int available, int last_frame,
             bool coming) {
    playback.position = std::clamp(playback.position, 0.0, double(std::max(0, last_frame)));
    if (!playback.playing)
        return;
    const double end = std::min(available - 1, last_frame);
    if (end < 0)
        return;
    // A hitch of the program must not make the playhead jump.
    const double step = playback.speed * std::min(seconds, 0.25) / frame_time;
    const double next = playback.position + step;
    if (next < end + 1) {
        playback.position = std::min(next, end + 0.999);
        return;
    }
    if (coming && end < last_frame) {
        playback.position = end; // waits for the next frame
    } else if (playback.loop && end > 0) {
        playback.position = std::fmod(next, end + 1);
    } else {
        playback.position = end;
        playback.playing = false;
    }
}

} // namespace fascicle::editor
