#include "editor/editor_context.hpp"

#include <algorithm>

namespace fascicle::editor {

const Scene& EditorContext::shown_scene() const {
    const ShownFrame frame = shown();
    return frame.recording == nullptr ? document.scene() : frame.recording->scene();
}

void EditorContext::move_playhead(int frame) {
    state.playback.position = std::clamp(frame, 0, last_frame());
}

} // namespace fascicle::editor
