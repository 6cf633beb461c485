#include "editor/panels/compare_parts.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"

#include <array>
#include <cstdio>

namespace fascicle::editor {

namespace {

std::string millimetres(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value < 10 ? "%.2f" : "%.1f", value);
    return text;
}

/// A line of a table: a name at the left and numbers in columns of one width at the right.
struct TableLine {
    const EditorContext& context;
    ImVec2 at = ImGui::GetCursorScreenPos();
    float width = ImGui::GetContentRegionAvail().x, height = context.px(20);
    int columns = 5;
    float column_width = context.px(44);

    Rect cell(int column) const {
        const float right = at.x + width - column_width * static_cast<float>(columns - 1 - column);
        return {{right - column_width, at.y}, {right, at.y + height}};
    }
    Rect name() const { return {at, {cell(0).min.x, at.y + height}}; }
    void end() const {
        ImGui::SetCursorScreenPos(at);
        ImGui::Dummy({width, height});
    }
};

void draw_distance_header(const EditorContext& context) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 colour = context.theme.text_faint;
    const TableLine top{context};
    draw_text_in(list, {top.cell(0).min, top.cell(1).max}, colour, "this frame", Align::right);
    draw_text_in(list, {top.cell(2).min, top.cell(4).max}, colour, "all frames", Align::right);
    top.end();
    ImGui::SetCursorScreenPos({top.at.x, top.at.y + top.height});
    const TableLine line{context};
    draw_text_in(list, line.name(), colour, "Muscle");
    int column = 0;
    for (const char* text : {"rms", "max", "rms", "max", "at"})
        draw_text_in(list, line.cell(column++), colour, text, Align::right);
    const float y = std::round(line.at.y + line.height);
    list.AddLine({line.at.x, y}, {line.at.x + line.width, y}, context.theme.line);
    line.end();
    item_tooltip("Distances between the same vertices of A and B, mm.\nrms: root of the mean square over the "
                 "vertices (and frames); max: of the vertex farthest apart; at: the frame with the largest.");
}

} // namespace

void draw_distances(EditorContext& context) {
    const Compare& compare = context.features.compare;
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::Dummy({1, context.px(2)});
    draw_compare_heading(context, "Distance A to B [mm]");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    draw_distance_header(context);
    const FrameDifference* now = compare.at_playhead();
    for (std::size_t m = 0; m < compare.match().muscles.size(); ++m) {
        const MatchedMuscle& muscle = compare.match().muscles[m];
        const TableLine line{context};
        draw_text_in(list, line.name(), theme.text, muscle.name);
        if (now != nullptr) {
            draw_text_in(list, line.cell(0), theme.text, millimetres(now->muscles[m].rms_mm), Align::right);
            draw_text_in(list, line.cell(1), theme.text, millimetres(now->muscles[m].max_mm), Align::right);
        }
        if (m < compare.summary().size() && compare.summary()[m].max_index >= 0) {
            const DifferenceSummary& all = compare.summary()[m];
            draw_text_in(list, line.cell(2), theme.text, millimetres(all.rms_mm), Align::right);
            draw_text_in(list, line.cell(3), theme.text, millimetres(all.max_mm), Align::right);
            const Rect place = line.cell(4);
            ImGui::SetCursorScreenPos(place.min);
            ImGui::PushID(static_cast<int>(m));
            if (ImGui::InvisibleButton("at", {place.width(), place.height()})) {
                context.state.playback.playing = false;
                context.move_playhead(all.max_index);
            }
            record_item("compare/worst/" + muscle.name);
            draw_text_in(list, place, ImGui::IsItemHovered() ? theme.text : theme.accent,
                         std::to_string(all.max_index), Align::right);
            item_tooltip("Goes to frame " + std::to_string(all.max_index) + ", where vertex " +
                         std::to_string(all.max_vertex) + " of " + muscle.name + " is farthest apart.");
            ImGui::PopID();
        }
        line.end();
    }
    ImGui::PopStyleVar();
    if (compare.progress() < 1) {
        char text[60];
        std::snprintf(text, sizeof text, "Comparing frames, %.0f %%", 100 * compare.progress());
        draw_compare_text(theme.text_faint, text);
        record_item("compare/progress");
    }
    if (compare.a().ended || compare.b().ended)
        draw_compare_text(theme.warning, "Frame " + std::to_string(compare.a().frame->index) +
                                             " of A against frame " +
                                             std::to_string(compare.b().frame->index) + " of B");
    ImGui::Dummy({1, context.px(2)});
    if (ImGui::Button("Difference curves", {ImGui::GetContentRegionAvail().x, 0})) {
        context.state.bottom_panel = "differences";
        context.state.layout.show_bottom = true;
    }
    record_item("compare/curves");
    item_tooltip("Shows B - A over the frames below the view.");
}

void CompareParameters::draw(EditorContext& context) {
    const Compare& compare = context.features.compare;
    if (a_ != compare.a().recording || b_ != compare.b().recording) {
        a_ = compare.a().recording;
        b_ = compare.b().recording;
        rows_ = parameter_differences(a_->scene().parameters, b_->scene().parameters);
    }
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImGui::Dummy({1, context.px(2)});
    draw_compare_heading(context, "Parameters that differ");
    if (rows_.empty()) {
        draw_compare_text(theme.text_faint, "None: all parameters of A and B are the same.");
        return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    const auto line_of = [&] {
        TableLine line{context};
        line.columns = 2;
        line.column_width = context.px(84);
        return line;
    };
    const TableLine head = line_of();
    draw_text_in(list, head.cell(0), theme.text_faint, "A", Align::right);
    draw_text_in(list, head.cell(1), theme.text_faint, "B", Align::right);
    const float y = std::round(head.at.y + head.height);
    list.AddLine({head.at.x, y}, {head.at.x + head.width, y}, theme.line);
    head.end();
    for (const ParamDifference& row : rows_) {
        const TableLine line = line_of();
        draw_text_in(list, line.name(), theme.text_dim, row.row->label);
        draw_text_in(list, line.cell(0), theme.text, parameter_text(*row.row, row.a), Align::right);
        draw_text_in(list, line.cell(1), theme.text, parameter_text(*row.row, row.b), Align::right);
        line.end();
        record_item("compare/parameter/" + row.row->key);
        item_tooltip(row.row->label + "\n" + row.row->meaning + "\nKey: " + row.row->key);
    }
    ImGui::PopStyleVar();
}

} // namespace fascicle::editor
