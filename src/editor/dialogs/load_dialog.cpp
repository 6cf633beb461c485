#include "editor/dialogs/load_dialog.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/io/format_registry.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace {

struct LoadRow {
    FileKind kind;
    const char* title;
    const char* help;
    std::vector<std::string> extensions;
    bool for_muscle;
    void (FileLoader::*load)(EditorContext&, const std::filesystem::path&);
};

const std::vector<LoadRow>& load_rows() {
    static const std::vector<LoadRow> rows{
        {FileKind::outlines,
         "Attachment outlines",
         "A table attachment,bone,x_mm,y_mm,z_mm (.csv): borders of origins and insertions, in place of "
         "those that the muscle has.",
         {".csv", ".tsv"},
         true,
         &FileLoader::load_outlines},
        {FileKind::mesh, "Surface fibres",
         "Polylines of superficial fibres, in the unit and axes of the scene.", mesh_extensions(), true,
         &FileLoader::load_surface_fibres},
        {FileKind::fibre_template,
         "Fibre template",
         "Your own arrangement of fibres in a unit cube (.json), in place of the parameter's.",
         {".json"},
         true,
         &FileLoader::load_fibre_template},
        {FileKind::model,
         "Line muscles",
         "The muscles of an OpenSim model (.osim) as lines beside the volumes, placed on the bones of "
         "the scene.",
         {".osim"},
         false,
         &FileLoader::load_lines},
        {FileKind::motion,
         "Keyed poses",
         "A table frame,bone,... (.csv) of poses or of turns about axes, in place of the motion.",
         {".csv", ".tsv"},
         false,
         &FileLoader::load_motion},
        {FileKind::storage,
         "Motion table",
         "A table over time of OpenSim or SIMM (.mot, .sto).",
         {".mot", ".sto"},
         false,
         &FileLoader::load_table},
    };
    return rows;
}

const LoadRow& row_of(FileKind kind) {
    const auto it = std::find_if(load_rows().begin(), load_rows().end(),
                                 [&](const LoadRow& row) { return row.kind == kind; });
    FASCICLE_ASSERT(it != load_rows().end());
    return *it;
}

} // namespace

void LoadDialog::open(FileKind kind) {
    kind_ = kind;
    appears_ = true;
    browser_.emplace(row_of(kind).extensions, "No such files here");
    if (!folder_.empty())
        browser_->go_to(folder_);
}

void LoadDialog::close() {
    kind_ = FileKind::unknown;
    browser_.reset();
}

void LoadDialog::draw(EditorContext& context) {
    if (!is_open())
        return;
    const LoadRow& row = row_of(kind_);
    const std::string popup = std::string(row.title) + "###load";
    if (appears_) {
        ImGui::OpenPopup(popup.c_str());
        appears_ = false;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize(
        {std::min(window.x * 0.94f, context.px(560)), std::min(window.y * 0.92f, context.px(480))});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    bool keep = true;
    if (!ImGui::BeginPopupModal(popup.c_str(), &keep,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings))
        return close(); // Esc closed it
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
    ImGui::TextWrapped("%s", row.help);
    ImGui::PopStyleColor();
    ImGui::Dummy({1, context.px(2)});
    if (row.for_muscle)
        draw_muscle(context);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float foot = ImGui::GetFrameHeight() + context.px(6) + 2 * ImGui::GetStyle().ItemSpacing.y;
    browser_->draw(context, {room.x, std::max(60.0f, room.y - foot)});
    ImGui::Dummy({1, context.px(2)});
    const bool muscle_there = !row.for_muscle || !context.document.scene().muscles.empty();
    const bool ready = !browser_->chosen().empty() && muscle_there;
    const float button = context.px(110);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room.x - 2 * button - context.px(8));
    if (ImGui::Button("Cancel", {button, 0}))
        keep = false;
    record_item("load/cancel");
    item_tooltip("Loads nothing (Esc).");
    ImGui::SameLine(0, context.px(8));
    ImGui::BeginDisabled(!ready);
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    const bool wanted = ImGui::Button("Load", {button, 0}) || browser_->confirmed();
    ImGui::PopStyleColor();
    record_item("load/load");
    ImGui::EndDisabled();
    item_tooltip(ready          ? "Reads the file in the background; Ctrl+Z takes it back."
                 : muscle_there ? "Choose a file first."
                                : "The scene has no muscle.");
    if (ready && wanted) {
        load(context);
        keep = false;
    }
    if (!keep) {
        close();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

/// Which muscle it is for: the selected one.
void LoadDialog::draw_muscle(EditorContext& context) {
    const std::vector<Muscle>& muscles = context.document.scene().muscles;
    Selection& selection = context.state.selection;
    const bool selected = selection.kind == Selection::Kind::muscle &&
                          context.document.scene().muscle_index(selection.name) >= 0;
    if (!selected && !muscles.empty())
        selection = {Selection::Kind::muscle, muscles.front().name};
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Muscle");
    ImGui::SameLine(0, context.px(10));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::BeginDisabled(muscles.empty());
    if (ImGui::BeginCombo("##muscle", muscles.empty() ? "The scene has no muscle" : selection.name.c_str())) {
        for (const Muscle& muscle : muscles) {
            if (ImGui::Selectable(muscle.name.c_str(), muscle.name == selection.name))
                selection = {Selection::Kind::muscle, muscle.name};
            record_item("load/muscle/" + muscle.name);
        }
        ImGui::EndCombo();
    }
    record_item("load/muscle");
    ImGui::EndDisabled();
    item_tooltip("The muscle that the file is for; it is selected, too.");
}

void LoadDialog::load(EditorContext& context) {
    const std::filesystem::path file = browser_->chosen();
    folder_ = file.parent_path();
    (context.features.loader.*row_of(kind_).load)(context, file);
}

} // namespace fascicle::editor
