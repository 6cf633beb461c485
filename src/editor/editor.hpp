#pragma once
// The whole editor, without a window: takes input events, draws itself with ImGui, runs simulations.

#include "editor/input_queue.hpp"
#include "editor/panel.hpp"
#include "editor/scene_view.hpp"
#include "render/imgui_host.hpp"

#include <map>

namespace fascicle::editor {

struct EditorOptions {
    bool dark = true;
    /// For pictures and tests: every view supersampled, no numbers that depend on the machine's speed.
    bool still = false;
    /// Where settings, autosaves, presets are kept (io/user_folder.hpp); empty: nothing is kept.
    std::filesystem::path user_folder{};
};

class Editor {
public:
    /// host: the process's ImGui context, which outlives the editor; its scale is taken over.
    /// start: how runs are made; null: recordings are only shown.
    Editor(render::ImguiHost& host, Document document, StartRun start, const EditorOptions& options = {});
    ~Editor();
    Editor(const Editor&) = delete;
    Editor& operator=(const Editor&) = delete;

    /// From here on the viewport shows the scene. A GL context must be current, now and in every draw_frame().
    void use_gl();
    /// Another document in place of the present one: its results, selection and camera go with it.
    void replace_document(Document document);
    /// The document came from its path(), a file with this text (empty: from no project).
    void project_opened(const std::string& text);
    /// Shows a recording of the document's scene instead of running it.
    void show(RecordingPtr recording);

    InputQueue& input() { return input_; }
    void drop_files(const std::vector<std::filesystem::path>& files);

    /// Fonts and style for the present scale and theme. To be called before ImguiRenderer::new_frame(), which sends the
    /// fonts to the GPU.
    void apply_look();
    /// Takes the next input event and lays out one frame of width x height pixels, `seconds` after the one before;
    /// ImGui::GetDrawData() is then to be drawn.
    void draw_frame(float width, float height, double seconds);
    /// Seconds until a frame without any input is worth drawing: none while input waits, a monitor's frame while
    /// playing, more while something is computed or read in the background, nothing when all rests.
    std::optional<double> next_redraw() const;

    EditorState& state() { return state_; }
    Document& document() { return document_; }
    RunManager& runs() { return runs_; }
    MetricsWorker& metrics() { return metrics_; }
    MessageLog& log() { return log_; }
    Dialogs& dialogs() { return *dialogs_; }
    Features& features() { return *features_; }
    SceneView* view() { return view_.get(); }
    const Layout& layout() const { return layout_; } ///< of the last frame
    /// For tests: does what the row of the key table does.
    void run(Command command);
    /// What panels and commands get.
    EditorContext context();

private:
    void handle_keys();
    void follow_run();
    bool acts_on_start_page(const KeyBinding& row) const;
    void take_opened_scene();
    std::string& front_panel(Place place);
    void draw_place(EditorContext& context, Place place, const Rect& area);
    void draw_panel(EditorContext& context, const PanelRow& row, const Rect& area);
    void draw_tabs(EditorContext& context, const std::vector<const PanelRow*>& rows, const PanelRow& front,
                   const Rect& strip);
    void write_picture();

    render::ImguiHost& host_;
    Document document_;
    EditorState state_;
    RunManager runs_;
    MetricsWorker metrics_;
    MessageLog log_;
    InputQueue input_;
    std::unique_ptr<Dialogs> dialogs_;
    std::unique_ptr<Features> features_;
    std::unique_ptr<SceneView> view_;
    std::map<std::string, std::unique_ptr<Panel>> panels_;
    Layout layout_;
    std::filesystem::path user_folder_;
    bool still_ = false, styled_dark_ = false, styled_ = false;
    bool frames_to_play_ = true; ///< else the next one is being computed
    double now_ = 0;
    float smooth_seconds_ = 0;
    RecordingPtr reported_; ///< whose notes and end have been passed on to the log
    std::size_t reported_notes_ = 0;
    bool reported_end_ = false;
};

} // namespace fascicle::editor
