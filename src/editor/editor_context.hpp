#pragma once
// What a panel gets to work with. Panels read the document and the recordings, change view state, and change
// the scene through document/actions/ alone.

#include "editor/editor_state.hpp"
#include "editor/key_bindings.hpp"
#include "editor/message_log.hpp"
#include "editor/metrics_worker.hpp"
#include "editor/run_manager.hpp"
#include "editor/theme.hpp"
#include "fascicle/document/document.hpp"

#include <cmath>

namespace fascicle::editor {

struct Dialogs;
struct Features;
class SceneView;

struct EditorContext {
    Document& document;
    EditorState& state;
    RunManager& runs;
    MetricsWorker& metrics;
    MessageLog& log;
    Dialogs& dialogs;
    Features& features;
    SceneView* view;                          ///< null without a GL context: the viewport stays empty
    const std::filesystem::path& user_folder; ///< empty: nothing is kept
    const Theme& theme;
    double now; ///< seconds
    float ui_fps;

    float scale() const { return state.scale; }
    /// Pixels of a length given at scale 1, whole.
    float px(float length) const { return std::round(length * state.scale); }
    int playhead() const { return state.playback.playhead(); }
    int last_frame() const { return document.scene().timeline.last_frame; }
    /// What is shown now: the playhead's frame, or the last one before it that exists; of run A (blinking: A or B) while
    /// runs are compared.
    ShownFrame shown() const;
    /// The scene that the shown frame belongs to; the document's when there is no frame.
    const Scene& shown_scene() const;
    /// Frames [0, n) can be shown, of the run or of those that are compared; more are being computed.
    int available_frames() const;
    bool frames_come() const;
    void move_playhead(int frame);
};

} // namespace fascicle::editor
