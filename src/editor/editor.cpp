#include "editor/editor.hpp"

#include "editor/commands.hpp"
#include "editor/dialogs/dialogs.hpp"
#include "editor/dialogs/shortcut_sheet.hpp"
#include "editor/features.hpp"
#include "editor/frame_axis.hpp"
#include "editor/initial_view.hpp"
#include "editor/playback.hpp"
#include "editor/project/project_flow.hpp"
#include "editor/widgets/icons.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tab_strip.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/png.hpp"

#include <algorithm>
#include <cstdio>
#include <imgui_internal.h>

namespace fascicle::editor {

Editor::Editor(render::ImguiHost& host, Document document, StartRun start, const EditorOptions& options)
    : host_(host), document_(std::move(document)), runs_(std::move(start)),
      dialogs_(std::make_unique<Dialogs>()), features_(std::make_unique<Features>()),
      user_folder_(options.user_folder), still_(options.still) {
    InputQueue::map_keys(ImGui::GetIO());
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    set_icons_available(host.has_icons());
    state_.dark = options.dark;
    state_.scale = state_.start_scale = host.scale();
    look_at_muscles(state_.camera, document_.scene());
    for (const PanelRow& row : panel_registry())
        panels_[row.id] = row.make();
    apply_look();
}

Editor::~Editor() {
    features_->autosave.close(state_.wants_quit || !user_document(context()).dirty());
}

void Editor::use_gl() {
    view_ = std::make_unique<SceneView>(still_);
}

void Editor::project_opened(const std::string& text) {
    EditorContext c = context();
    OpenedScene opened;
    opened.scene.name = document_.scene().name;
    opened.path = document_.path();
    opened.project_text = text;
    opened.carry_meshes = carries_meshes(text);
    features_->project.opened(c, opened);
}

void Editor::show(RecordingPtr recording) {
    runs_.show(std::move(recording));
}

void Editor::drop_files(const std::vector<std::filesystem::path>& files) {
    EditorContext c = context();
    const bool project = std::any_of(files.begin(), files.end(),
                                     [](const auto& file) { return file.extension() == ".fascicle"; });
    if (project && files.size() == 1)
        open_project(c, files.front());
    else if (state_.show_start && !project)
        start_with_meshes(c, files);
    else
        features_->loader.drop(files);
}

EditorContext Editor::context() {
    const bool live = !still_ && smooth_seconds_ > 0;
    return {document_,    state_,
            runs_,        metrics_,
            log_,         *dialogs_,
            *features_,   view_.get(),
            user_folder_, state_.dark ? dark_theme() : light_theme(),
            now_,         live ? 1 / smooth_seconds_ : 0.0f};
}

void Editor::apply_look() {
    if (!styled_ || styled_dark_ != state_.dark) {
        host_.set_style(make_style(state_.dark ? dark_theme() : light_theme()));
        styled_dark_ = state_.dark;
        styled_ = true;
    }
    host_.set_scale(state_.scale);
    state_.scale = host_.scale();
}

void Editor::run(Command command) {
    EditorContext c = context();
    run_command(c, command);
}

std::optional<double> Editor::next_redraw() const {
    if (!input_.empty())
        return 0;
    if (state_.playback.playing && frames_to_play_)
        return 1.0 / 60;
    // The solver needs the processor more than a progress bar does.
    std::optional<double> next;
    const auto no_later_than = [&](double seconds) { next = std::min(next.value_or(seconds), seconds); };
    if (runs_.running() || runs_.outdated() || metrics_.behind())
        no_later_than(1.0 / 25);
    for (const Dialog* dialog : dialogs_->all())
        if (dialog->busy())
            no_later_than(1.0 / 25);
    for (const Feature* feature : features_->all())
        if (const std::optional<double> wish = feature->redraw_after())
            no_later_than(*wish);
    if (view_ != nullptr && view_->waiting())
        no_later_than(1.0 / 25);
    if (view_ != nullptr && view_->refinement_pending())
        no_later_than(SceneView::refine_after_seconds / 2);
    return next;
}

void Editor::handle_keys() {
    const bool modal = ImGui::GetTopMostPopupModal() != nullptr;
    for (const InputQueue::Press& press : input_.presses()) {
        if (modal && press.chord.key == key_escape && !ImGui::GetIO().WantTextInput) {
            // A list that is open in front of the dialog goes first.
            const ImVector<ImGuiPopupData>& popups = ImGui::GetCurrentContext()->OpenPopupStack;
            if (const ImGuiWindow* front = popups.empty() ? nullptr : popups.back().Window;
                front != nullptr && (front->Flags & ImGuiWindowFlags_Modal) == 0) {
                ImGui::ClosePopupToLevel(popups.Size - 1, true);
                continue;
            }
            for (Dialog* dialog : dialogs_->all())
                dialog->close();
            ImGui::ClosePopupToLevel(0, true);
            continue;
        }
        // Esc closes a menu or a popup before it does anything else.
        if (!modal && press.chord.key == key_escape && !ImGui::GetIO().WantTextInput &&
            ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup)) {
            ImGui::ClosePopupToLevel(0, true);
            continue;
        }
        if (modal || ImGui::GetIO().WantTextInput)
            continue; // the keys belong to the text
        const bool painting = state_.tool == Tool::paint;
        const KeyBinding* row = find_binding(press.chord, painting);
        if (const std::optional<Command> preset = preset_binding(press.chord, state_.navigation);
            preset && !painting)
            row = &binding(*preset);
        if (state_.show_start && row != nullptr && !acts_on_start_page(*row)) {
            state_.show_start = row->command != Command::escape;
            continue;
        }
        if (row == nullptr || (press.repeat && !row->repeats))
            continue;
        if (features_->paint.stroke_open() && row->command != Command::escape) {
            if (row->command == Command::undo) { // takes back what is being painted
                EditorContext c = context();
                features_->paint_tool.cancel(c);
            }
            continue; // nothing else touches the scene before the button comes up
        }
        if (document_.has_uncommitted_edits() && ImGui::IsAnyMouseDown() && row->command != Command::escape &&
            row->command != Command::undo)
            continue; // a drag is one step of its own
        if (row->command == Command::escape && document_.has_uncommitted_edits())
            ImGui::ClearActiveID(); // the drag ends here, whatever the mouse does
        state_.last_command = static_cast<int>(row->command);
        run(row->command);
    }
}

/// What changes or moves the scene does not act while the scene cannot be seen.
bool Editor::acts_on_start_page(const KeyBinding& row) const {
    return std::string_view(row.group) == "File" || std::string_view(row.group) == "Window" ||
           (row.command == Command::escape && state_.show_shortcuts);
}

void Editor::replace_document(Document document) {
    document_ = std::move(document);
    runs_.forget();
    metrics_.forget();
    reported_ = nullptr;
    dialogs_->osim.document_replaced();
    state_.selection = {};
    state_.hidden.clear();
    state_.tool = Tool::look;
    state_.playback = {};
    state_.camera_slots = {};
    state_.section = {};
    state_.frame_view_pending = true;
    look_at_muscles(state_.camera, document_.scene());
    EditorContext c = context();
    for (Feature* feature : features_->all())
        feature->document_replaced(c);
}

void Editor::take_opened_scene() {
    std::optional<OpenedScene> opened = features_->opener.take();
    if (!opened)
        return;
    const bool changed = document_.has_uncommitted_edits() || document_.head() != opened->asked_head;
    if (opened->document == nullptr && opened->asked_head != nullptr && changed && document_.dirty()) {
        // Work went on while it was read: asked again before that is lost.
        const auto kept = std::make_shared<OpenedScene>(std::move(*opened));
        kept->asked_head = nullptr;
        dialogs_->unsaved.ask("opening " + kept->scene.name,
                              [kept](EditorContext& c) { c.features.opener.open_scene(std::move(*kept)); });
        return;
    }
    for (const std::string& note : opened->notes)
        log_.add(Severity::note, note);
    const bool back = opened->document != nullptr; // what was set aside, with its undo history
    replace_document(back ? std::move(*opened->document) : Document(opened->scene, opened->path));
    if (opened->unsaved)
        document_.mark_unsaved();
    state_.show_start = opened->start_page;
    EditorContext c = context();
    if (back)
        features_->project.returned(c);
    else
        features_->project.opened(c, *opened);
    if (!opened->recovered_from.empty())
        features_->autosave.restored(opened->recovered_from);
}

/// What the run has to say goes to the log.
void Editor::follow_run() {
    const RecordingPtr recording = runs_.recording();
    if (recording != reported_) {
        reported_ = recording;
        reported_notes_ = 0;
        reported_end_ = false;
    }
    if (recording == nullptr)
        return;
    const std::vector<std::string> notes = recording->notes();
    for (; reported_notes_ < notes.size(); ++reported_notes_)
        log_.add(Severity::note, notes[reported_notes_]);
    if (reported_end_ || recording->state() == RunState::running)
        return;
    reported_end_ = true;
    if (recording->state() == RunState::failed)
        log_.add(Severity::error, recording->failure());
    if (recording->state() == RunState::finished && !still_) {
        double seconds = 0;
        for (int k = 1; k < recording->frame_count(); ++k)
            seconds += recording->frame(k)->report.solve_seconds;
        char text[80];
        std::snprintf(text, sizeof text, "Run finished: %d frames solved in %.1f s.",
                      recording->frame_count() - 1, seconds);
        log_.add(Severity::note, text);
    }
}

void Editor::draw_frame(float width, float height, double seconds) {
    apply_look();
    now_ += seconds;
    const auto step = static_cast<float>(std::clamp(seconds, 1e-4, 0.25));
    smooth_seconds_ = smooth_seconds_ == 0 ? step : smooth_seconds_ * 0.9f + step * 0.1f;
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {std::max(1.0f, width), std::max(1.0f, height)};
    io.DeltaTime = step;
    input_.feed(io);
    if (ItemRecorder* recorder = item_recorder(); recorder != nullptr)
        recorder->begin_frame();
    ImGui::NewFrame();
    take_opened_scene();
    handle_keys();

    runs_.update(document_.head(), document_.has_uncommitted_edits(), now_);
    follow_run();
    metrics_.follow(runs_.recording());
    if (const std::string error = metrics_.take_error(); !error.empty())
        log_.add(Severity::error, error);
    EditorContext c = context();
    advance(state_.playback, seconds, frame_seconds(document_.scene()), c.available_frames(),
            document_.scene().timeline.last_frame, c.frames_come());
    frames_to_play_ = state_.playback.playhead() + 1 < c.available_frames() || !c.frames_come();
    for (Feature* feature : features_->all())
        feature->update(c);
    layout_ = compute_layout(io.DisplaySize.x, io.DisplaySize.y, state_.layout, state_.scale);
    ImGui::GetBackgroundDrawList()->AddRectFilled({0, 0}, io.DisplaySize, c.theme.gap);
    drag_borders(layout_, state_.layout, state_.scale);
    // The hover line of one panel shows in all of them, so it comes from the frame before.
    state_.hover_frame = std::exchange(state_.next_hover_frame, std::nullopt);
    state_.hover_fibre = std::exchange(state_.next_hover_fibre, std::nullopt);
    const std::pair<Place, const Rect*> places[] = {
        {Place::menu, &layout_.menu},         {Place::toolbar, &layout_.toolbar},
        {Place::tree, &layout_.tree},         {Place::inspector, &layout_.inspector},
        {Place::viewport, &layout_.viewport}, {Place::parameters, &layout_.parameters},
        {Place::timeline, &layout_.timeline}, {Place::bottom, &layout_.bottom},
        {Place::status, &layout_.status},     {Place::lesson, &layout_.lesson}};
    for (const auto& [place, area] : places)
        if (area->width() >= 1 && area->height() >= 1 && (!state_.show_start || place == Place::menu))
            draw_place(c, place, *area);
    if (state_.show_start)
        features_->start.draw(c, {{0, layout_.menu.max.y}, io.DisplaySize}, host_.heading_font());
    for (Dialog* dialog : dialogs_->all())
        dialog->draw(c);
    draw_shortcut_sheet(c);
    ImGui::Render();
    write_picture();
}

/// Which tab of a place is in front.
std::string& Editor::front_panel(Place place) {
    return place == Place::parameters ? state_.side_panel : state_.bottom_panel;
}

void Editor::draw_place(EditorContext& context, Place place, const Rect& area) {
    std::vector<const PanelRow*> rows;
    for (const PanelRow& row : panel_registry())
        if (row.place == place)
            rows.push_back(&row);
    const PanelRow* front = rows.front();
    for (const PanelRow* row : rows)
        if (front_panel(place) == row->id)
            front = row;

    const bool bar = place == Place::menu || place == Place::toolbar || place == Place::status;
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                             ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                             ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse;
    if (place == Place::menu)
        flags |= ImGuiWindowFlags_MenuBar;
    if (place == Place::viewport)
        flags |= ImGuiWindowFlags_NoBackground;
    ImGui::SetNextWindowPos(area.min);
    ImGui::SetNextWindowSize({area.width(), area.height()});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, bar ? context.theme.bar : context.theme.panel);
    const std::string name = std::string("place/") + rows.front()->id;
    if (place == Place::menu) // fills the row
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                            {context.px(9), (area.height() - ImGui::GetFontSize()) / 2});
    const bool shown = ImGui::Begin(name.c_str(), nullptr, flags);
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
    if (shown) {
        if (front->title != nullptr) {
            const Rect strip{area.min, {area.max.x, std::min(area.max.y, area.min.y + context.px(28))}};
            draw_tabs(context, rows, *front, strip);
            draw_panel(context, *front, {{area.min.x, strip.max.y}, area.max});
        } else {
            panels_[front->id]->draw(context, area);
        }
    }
    ImGui::End();
    if (place == Place::menu)
        ImGui::PopStyleVar();
}

void Editor::draw_panel(EditorContext& context, const PanelRow& row, const Rect& area) {
    if (area.empty())
        return;
    ImGui::SetCursorScreenPos(area.min);
    const ImVec2 padding = row.padded ? ImVec2{context.px(10), context.px(7)} : ImVec2{0, 0};
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::PushStyleVar(ImGuiStyleVar_ChildRounding, 0);
    const ImGuiWindowFlags flags =
        ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoNav |
        (row.scrolls ? 0 : ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    const bool shown = ImGui::BeginChild(row.id, {area.width(), area.height()}, false, flags);
    ImGui::PopStyleVar(2);
    if (shown)
        panels_[row.id]->draw(context, area);
    ImGui::EndChild();
}

void Editor::draw_tabs(EditorContext& context, const std::vector<const PanelRow*>& rows,
                       const PanelRow& front, const Rect& strip) {
    std::vector<Tab> tabs;
    std::size_t active = 0;
    for (const PanelRow* row : rows) {
        if (row == &front)
            active = tabs.size();
        Tab tab{row->id, row->title, row->icon, false};
        if (std::string_view(row->id) == "messages" && log_.unseen_errors() > 0) {
            tab.title += " (" + std::to_string(log_.unseen_errors()) + ")";
            tab.alarm = true;
        }
        tabs.push_back(std::move(tab));
    }
    float end = strip.max.x;
    if (const int clicked = draw_tab_strip(context, host_.heading_font(), tabs, active, strip, end);
        clicked >= 0)
        front_panel(front.place) = rows[static_cast<std::size_t>(clicked)]->id;
    panels_[front.id]->draw_strip(context, {{end, strip.min.y}, strip.max});
}

void Editor::write_picture() {
    const std::optional<std::filesystem::path> wish = std::exchange(state_.wants_picture, std::nullopt);
    if (!wish)
        return;
    std::error_code error;
    const std::string full = std::filesystem::absolute(*wish, error).string();
    try {
        if (view_ == nullptr)
            throw_error(full, "no picture was written", "a graphics context");
        const int width = std::max(1, static_cast<int>(layout_.viewport.width()));
        const int height = std::max(1, static_cast<int>(layout_.viewport.height()));
        const render::Image image = view_->picture(context(), width, height);
        write_png(*wish, image.width, image.height, image.rgba.data());
        log_.add(Severity::note, "Picture written to " + full);
    } catch (const std::exception& problem) {
        log_.add(Severity::error, problem.what());
    }
}

} // namespace fascicle::editor
