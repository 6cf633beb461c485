#include "editor/editor_context.hpp"

#include "editor/features.hpp"

#include <algorithm>

namespace fascicle::editor {

ShownFrame EditorContext::shown() const {
    if (const std::optional<ShownFrame> compared = features.compare.shown())
        return *compared;
    return runs.at_or_before(playhead());
}

const Scene& EditorContext::shown_scene() const {
    const ShownFrame frame = shown();
    return frame.recording == nullptr ? document.scene() : frame.recording->scene();
}

void EditorContext::move_playhead(int frame) {
    state.playback.position = std::clamp(frame, 0, last_frame());
}

} // namespace fascicle::editor
