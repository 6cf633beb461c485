#include "editor/dialogs/shortcut_sheet.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

namespace fascicle::editor {

namespace {

void draw_line(const EditorContext& context, const std::string& keys, const char* label) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = context.px(21), column = context.px(118);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_text_in(list, {at, {at.x + column, at.y + height}}, context.theme.accent, keys);
    draw_text_in(list, {{at.x + column, at.y}, {at.x + width, at.y + height}}, context.theme.text, label);
    ImGui::Dummy({width, height});
}

void draw_heading(const EditorContext& context, const char* title) {
    ImGui::Dummy({1, context.px(4)});
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
    ImGui::TextUnformatted(title);
    ImGui::PopStyleColor();
}

void draw_group(const EditorContext& context, const char* group) {
    draw_heading(context, group);
    for (const KeyBinding& row : key_bindings()) {
        if (std::string_view(row.group) != group || row.chords[0].key == key_none)
            continue;
        // Shift+= is only how some keyboards write the plus sign.
        const std::string second = row.chords[1].key == row.chords[0].key ? "" : to_text(row.chords[1]);
        draw_line(context, to_text(row.chords[0]) + (second.empty() ? "" : ", " + second), row.label);
    }
}

void draw_mouse(const EditorContext& context) {
    draw_heading(context, "Mouse in the view");
    draw_line(context, "Left drag", "Orbit (also middle drag)");
    draw_line(context, "Right drag", "Pan (also Shift+left drag)");
    draw_line(context, "Wheel", "Zoom towards the pointer");
    draw_line(context, "Ctrl+left drag", "Zoom");
    draw_line(context, "Click", "Select");
    draw_line(context, "Double-click", "Pivot here");
    draw_line(context, "Right click", "Menu");
}

} // namespace

void draw_shortcut_sheet(EditorContext& context) {
    if (!context.state.show_shortcuts)
        return;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize(
        {std::min(window.x * 0.94f, context.px(920)), std::min(window.y * 0.92f, context.px(620))});
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowFocus();
    ImGui::PushStyleColor(ImGuiCol_WindowBg, context.theme.header);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.px(6));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(8), context.px(1)});
    if (ImGui::Begin("Keyboard and mouse", &context.state.show_shortcuts,
                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoSavedSettings)) {
        record_item("shortcuts", {ImGui::GetWindowPos(),
                                  {ImGui::GetWindowPos().x + ImGui::GetWindowSize().x,
                                   ImGui::GetWindowPos().y + ImGui::GetWindowSize().y}});
        const int columns = ImGui::GetContentRegionAvail().x > context.px(600) ? 3 : 1;
        if (ImGui::BeginTable("sheet", columns)) {
            ImGui::TableNextColumn();
            draw_group(context, "File");
            draw_group(context, "Scene");
            draw_group(context, "Edit");
            draw_group(context, "Timeline");
            ImGui::TableNextColumn();
            draw_group(context, "View");
            ImGui::TableNextColumn();
            draw_group(context, "Show");
            draw_group(context, "Window");
            draw_mouse(context);
            ImGui::EndTable();
        }
    }
    ImGui::End();
    ImGui::PopStyleVar(3);
    ImGui::PopStyleColor();
}

} // namespace fascicle::editor
