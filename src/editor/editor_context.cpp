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

int EditorContext::available_frames() const {
    const Compare& compare = features.compare;
    if (!compare.active())
        return runs.available_count();
    return std::max(compare.a().recording->frame_count(), compare.b().recording->frame_count());
}

bool EditorContext::frames_come() const {
    const Compare& compare = features.compare;
    if (!compare.active())
        return runs.running() || runs.outdated();
    return compare.a().recording->state() == RunState::running ||
           compare.b().recording->state() == RunState::running;
}

void EditorContext::move_playhead(int frame) {
    state.playback.position = std::clamp(frame, 0, last_frame());
}

} // namespace fascicle::editor
