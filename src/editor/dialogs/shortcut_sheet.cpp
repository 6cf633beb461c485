#include "editor/dialogs/shortcut_sheet.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

#include <algorithm>

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

constexpr std::size_t mouse_lines = 8;

/// The groups of the table that have a key, in its order.
struct Group {
    const char* name;
    std::size_t lines; ///< with the heading
};
std::vector<Group> groups_with_keys() {
    std::vector<Group> groups;
    for (const KeyBinding& row : key_bindings()) {
        if (row.chords[0].key == key_none)
            continue;
        const auto same = [&](const Group& group) { return std::string_view(group.name) == row.group; };
        const auto it = std::find_if(groups.begin(), groups.end(), same);
        if (it == groups.end())
            groups.push_back({row.group, 2});
        else
            ++it->lines;
    }
    return groups;
}

} // namespace

void draw_shortcut_sheet(EditorContext& context) {
    if (!context.state.show_shortcuts)
        return;
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize(
        {std::min(window.x * 0.94f, context.px(960)), std::min(window.y * 0.94f, context.px(860))});
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
            const std::vector<Group> groups = groups_with_keys();
            std::size_t lines = mouse_lines;
            for (const Group& group : groups)
                lines += group.lines;
            // From the left to the right, a column about as long as the other.
            std::size_t column = 0, used = 0;
            ImGui::TableNextColumn();
            for (const Group& group : groups) {
                const std::size_t most = (column + 1) * lines / static_cast<std::size_t>(columns);
                if (used > 0 && used + group.lines / 2 > most &&
                    column + 1 < static_cast<std::size_t>(columns)) {
                    ImGui::TableNextColumn();
                    ++column;
                }
                draw_group(context, group.name);
                used += group.lines;
            }
            draw_mouse(context);
            ImGui::EndTable();
        }
    }
    ImGui::End();
    ImGui::PopStyleVar(3);
    ImGui::PopStyleColor();
}

} // namespace fascicle::editor
