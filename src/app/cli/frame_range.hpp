#pragma once
// Frames of a run, as options name them.

#include <optional>
#include <string>

namespace fascicle::app {

struct FrameRange {
    int first = 0;
    std::optional<int> last; ///< nothing: to the end of the run
    int step = 1;
};

/// `--frames A:B` or `A:B:STEP`; without B to the last frame. Error (usage).
FrameRange read_frame_range(const std::string& text);

} // namespace fascicle::app
