#include "editor/panels/compare_parts.hpp"

#include "editor/panels/panels.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"

namespace fascicle::editor {

namespace {

using C = Command;

/// A button of a row of them, lit up while it is the choice. True when clicked.
bool choice_button(const EditorContext& context, const std::string& name, const char* label, bool on,
                   bool enabled, float width, const std::string& tip) {
    const Theme& theme = context.theme;
    ImGui::PushID(name.c_str());
    ImGui::PushStyleColor(ImGuiCol_Button, on ? theme.accent_dim : theme.field);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, on ? with_alpha(theme.accent, 0.45f) : theme.field_hovered);
    ImGui::PushStyleColor(ImGuiCol_Text, on ? theme.text : theme.text_dim);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, ImGui::GetStyle().FramePadding.y});
    ImGui::BeginDisabled(!enabled);
    const bool clicked = ImGui::Button(label, {width, 0});
    record_item(name);
    ImGui::EndDisabled();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(3);
    ImGui::PopID();
    item_tooltip(tip);
    return clicked;
}

void draw_mode_row(EditorContext& context) {
    Compare& compare = context.features.compare;
    std::vector<std::pair<CompareMode, const char*>> buttons{{CompareMode::off, "Off"}};
    float text = text_size("Off").x;
    for (const CompareModeRow& row : compare_modes()) {
        buttons.emplace_back(row.mode, row.short_label);
        text += text_size(row.short_label).x;
    }
    const float gap = context.px(2);
    const auto count = static_cast<float>(buttons.size());
    const float room = ImGui::GetContentRegionAvail().x - gap * (count - 1);
    const float pad = std::max(0.0f, (room - text) / count);
    const std::string& reason = compare.reason();
    for (std::size_t i = 0; i < buttons.size(); ++i) {
        const auto [mode, label] = buttons[i];
        const bool off = mode == CompareMode::off;
        std::string name = "compare/off", tip = "Off\nThe present run alone, as always.";
        if (!off) {
            const CompareModeRow& row = compare_modes()[i - 1];
            name = std::string("compare/") + row.key;
            tip = std::string(row.label) + "\n" + row.help;
            if (mode == CompareMode::blink)
                tip += "\nKey: " + shortcut(C::blink_runs);
            if (!reason.empty())
                tip += "\nNot now: " + reason + ".";
        }
        if (i > 0)
            ImGui::SameLine(0, gap);
        if (choice_button(context, name, label, compare.choice.mode == mode, off || reason.empty(),
                          std::floor(text_size(label).x + pad), tip))
            compare.choice.mode = mode;
    }
}

void draw_ghost_options(CompareChoice& choice, const EditorContext& context) {
    if (ImGui::RadioButton("Translucent", !choice.wire))
        choice.wire = false;
    record_item("compare/translucent");
    item_tooltip("Run B as a blue translucent surface over A.");
    ImGui::SameLine(0, context.px(14));
    if (ImGui::RadioButton("Edges", choice.wire))
        choice.wire = true;
    record_item("compare/wire");
    item_tooltip("The edges of run B's triangles over A.");
}

void draw_blink_options(Compare& compare, const EditorContext& context) {
    CompareChoice& choice = compare.choice;
    const ComparedRun& seen = choice.shows_b ? compare.b() : compare.a();
    const std::string label = (choice.shows_b ? "Shows B, " : "Shows A, ") + seen.name;
    if (ImGui::Button((label + "###flip").c_str(), {ImGui::GetContentRegionAvail().x, 0}))
        compare.blink();
    record_item("compare/flip");
    item_tooltip(tooltip(C::blink_runs));
    ImGui::Checkbox("By itself, every", &choice.blinks_by_itself);
    record_item("compare/blink_auto");
    item_tooltip("Goes to the other run again and again.\nDefault: off, by key alone.");
    ImGui::SameLine(0, context.px(8));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    constexpr double low = 0.2, high = 3;
    ImGui::SliderScalar("##seconds", ImGuiDataType_Double, &choice.blink_seconds, &low, &high, "%.1f s",
                        ImGuiSliderFlags_AlwaysClamp);
    record_item("compare/blink_seconds");
    item_tooltip("How long each run is seen, seconds.\nRange 0.2 to 3 s   Default 0.7 s");
}

void draw_map_options(Compare& compare, const EditorContext& context) {
    CompareChoice& choice = compare.choice;
    const view::ColourScale scale = compare.difference_scale();
    for (const auto& [map, label, name] :
         {std::tuple{view::ColourMap::viridis, "viridis", "compare/viridis"},
          std::tuple{view::ColourMap::cividis, "cividis", "compare/cividis"}}) {
        if (ImGui::RadioButton(label, choice.map == map))
            choice.map = map;
        record_item(name);
        item_tooltip("Colour map, dark for near and light for far.\nDefault: viridis");
        ImGui::SameLine(0, context.px(14));
    }
    if (ImGui::Checkbox("Fit the range", &choice.range_follows) && !choice.range_follows) {
        choice.low_mm = scale.low; // begins as it was
        choice.high_mm = scale.high;
    }
    record_item("compare/fit_range");
    item_tooltip(
        "Colours go from 0 to a round number above twice the rms distance over all frames; what is farther "
        "has the last colour.\nDefault: on");
    float range[] = {static_cast<float>(scale.low), static_cast<float>(scale.high)};
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    if (ImGui::DragFloatRange2("##range", &range[0], &range[1], 0.02f, 0, 1000, "from %.2f mm", "to %.2f mm",
                               ImGuiSliderFlags_AlwaysClamp)) {
        choice.range_follows = false;
        choice.low_mm = double(range[0]);
        choice.high_mm = std::max(double(range[1]), choice.low_mm + 0.01);
    }
    record_item("compare/range");
    item_tooltip("Distances that the ends of the colour bar stand for, mm.\nDrag, or Ctrl+click to type.\n"
                 "Range 0 to 1000 mm   Default: fitted");
}

class ComparePanel : public Panel {
public:
    void draw(EditorContext& context, const Rect&) override {
        context.features.compare.want_distances();
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(5)});
        draw_compare_mode(context);
        runs_.draw(context);
        if (context.features.compare.reason().empty()) {
            draw_distances(context);
            parameters_.draw(context);
        }
        ImGui::PopStyleVar();
    }

private:
    CompareRuns runs_;
    CompareParameters parameters_;
};

} // namespace

void draw_compare_heading(const EditorContext& context, const std::string& title) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = context.px(22);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_text_in(list, {at, {at.x + width, at.y + height}}, context.theme.text_faint, title);
    const float x = at.x + text_size(title).x + context.px(8), y = std::round(at.y + height / 2);
    if (x < at.x + width)
        list.AddLine({x, y}, {at.x + width, y}, context.theme.line);
    ImGui::Dummy({width, height});
}

void draw_compare_text(ImU32 colour, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void draw_compare_mode(EditorContext& context) {
    Compare& compare = context.features.compare;
    draw_mode_row(context);
    if (!compare.reason().empty()) {
        draw_compare_text(context.theme.text_faint, "Nothing to compare: " + compare.reason() + ".");
        record_item("compare/reason");
        return;
    }
    if (compare.choice.mode != CompareMode::off && compare.aside()) {
        draw_compare_text(context.theme.text_faint, "The view shows the scene while it is painted or moved.");
        record_item("compare/aside");
    }
    for (const std::string& muscle : compare.match().left_out) {
        draw_compare_text(context.theme.warning, "Left out: " + muscle);
        record_item("compare/left_out");
    }
    if (compare.choice.mode == CompareMode::ghost)
        draw_ghost_options(compare.choice, context);
    if (compare.choice.mode == CompareMode::blink)
        draw_blink_options(compare, context);
    if (compare.choice.mode == CompareMode::difference)
        draw_map_options(compare, context);
}

std::unique_ptr<Panel> make_compare() {
    return std::make_unique<ComparePanel>();
}

} // namespace fascicle::editor
