#include "editor/playback.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

namespace {

/// Just below the next frame: the playhead still shows this one.
constexpr double almost_one = 0.999;

/// What happens at the end that is `beyond` frames behind the playhead. low, high: first and last frame played.
void at_end(Playback& playback, bool forward, double beyond, double low, double high) {
    const double span = high - low + 1;
    if (playback.repeat == Repeat::once || high <= low) {
        playback.position = forward ? high : low;
        playback.playing = playback.playing && playback.repeat != Repeat::once;
    } else if (playback.repeat == Repeat::loop) {
        const double over = std::fmod(beyond, span);
        playback.position = forward ? low + over : std::min(high + almost_one, high + 1 - over);
    } else {
        playback.turned = !playback.turned;
        // Into the last frame but one, from its other side; the frame of the end is not shown twice.
        const double over = std::clamp(beyond, 1 - almost_one, span - 1);
        playback.position = forward ? high - over : std::min(high + almost_one, low + 1 + over);
    }
}

} // namespace

std::pair<int, int> played_range(const Playback& playback, int last_frame) {
    const int last = std::max(0, last_frame);
    if (!playback.range)
        return {0, last};
    const int low = std::clamp(playback.range->first, 0, last);
    return {low, std::clamp(playback.range->second, low, last)};
}

void advance(Playback& playback, double seconds, double frame_time, int available, int last_frame,
             bool coming) {
    const double last = std::max(0, last_frame);
    if (!(playback.position < last + 1))
        playback.position = last;
    playback.position = std::max(playback.position, 0.0);
    if (!playback.playing)
        return;
    const auto [low, high] = played_range(playback, last_frame);
    const double end = std::min(available - 1, high);
    if (end < low)
        return;
    const bool forward = (playback.speed < 0) == playback.turned;
    if (playback.playhead() < low || playback.playhead() > high)
        playback.position = forward ? low : end + almost_one;
    // A hitch of the program must not make the playhead jump.
    double step = std::abs(playback.speed) * std::min(seconds, 0.25) / frame_time;
    if (playback.every_frame)
        step = std::min(step, 1.0);
    const double next = playback.position + (forward ? step : -step);
    if (forward ? next < end + 1 : next >= low) {
        playback.position = std::min(next, end + almost_one);
    } else if (forward && coming && end < high) {
        playback.position = end; // waits for the next frame
    } else {
        at_end(playback, forward, forward ? next - (end + 1) : low - next, low, end);
    }
}

} // namespace fascicle::editor
