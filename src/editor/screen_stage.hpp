#pragma once
// An editor without a display that is led to a screen by clicks, keys and commands.

#include "editor/editor.hpp"
#include "editor/screens.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "render/imgui_renderer.hpp"
#include "render/offscreen_target.hpp"
#include "render/osmesa_context.hpp"

namespace fascicle::editor {

class ScreenStage {
public:
    /// runs: finished; the first is the one of the scene, the second that of a changed scene.
    ScreenStage(std::vector<RecordingPtr> runs, const ScreenOptions& options);
    ~ScreenStage();
    ScreenStage(const ScreenStage&) = delete;
    ScreenStage& operator=(const ScreenStage&) = delete;

    EditorState& state() { return editor_.state(); }
    const Scene& scene() { return editor_.document().scene(); }
    void run(Command command);
    /// Draws frames, waiting for what is measured or prepared in the background.
    void frames(int count);
    /// Draws frames until nothing is computed any more, or for so long.
    void wait(double most_seconds = 20);
    /// From here on changes of the scene are really run.
    void run_anew() { fresh_runs_ = true; }
    /// Place of a widget; empty when it is not there.
    Rect rect(const std::string& widget) const;
    void move(ImVec2 to);
    void hover(const std::string& widget);
    void click(const std::string& widget);
    void drag(ImVec2 from, ImVec2 to);
    void type(const std::string& text);
    /// Brings a panel of the right column to the front.
    void tab(const char* id);
    /// Changes the scene to that of the second run, whose run is there at once.
    void second_run();
    void start_lesson(const std::string& id);
    render::Image picture();

private:
    std::vector<RecordingPtr> runs_;
    ScreenOptions options_;
    const render::OsmesaContext gl_;
    render::ImguiHost host_;
    render::ImguiRenderer renderer_;
    ItemRecorder recorder_;
    std::size_t next_run_ = 0;
    bool fresh_runs_ = false;
    Editor editor_;
    render::OffscreenTarget target_;
};

} // namespace fascicle::editor
