#include "editor/panels/panels.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/setting_row.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fascicle::editor {

namespace {

using C = Command;

template <class... Args>
std::string print(const char* format, Args... args) {
    char buffer[120];
    std::snprintf(buffer, sizeof buffer, format, args...);
    return buffer;
}

std::string with_unit(const std::string& number, const std::string& unit) {
    return unit.empty() ? number : unit == "\xC2\xB0" ? number + unit : number + " " + unit;
}

/// All that the 3D picture depends on besides scene, frame and camera. Nothing here changes the scene.
class Display : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(5)});
        section_heading(context, "Colours of muscles", true);
        colouring(context);
        range(context);
        switch_row(context, "display/attachments", C::toggle_attachments, true);
        section_heading(context, "Surfaces", false);
        opacity(
            context, "display/muscle_opacity", "Muscle opacity", context.state.muscle_opacity,
            "How much muscles hide of what is inside and behind them; below 100 % their fibres are seen.\n" +
                shortcut(C::toggle_see_through) + " makes them transparent and opaque again.");
        opacity(context, "display/bone_opacity", "Bone opacity", context.state.bone_opacity,
                "How much bones hide of what is inside and behind them.");
        switch_row(context, "display/occlusion", C::toggle_occlusion, true);
        switch_row(context, "display/wireframe", C::toggle_wireframe, false);
        switch_row(context, "display/ghost", C::toggle_rest_ghost, false);
        section_heading(context, "Lines", false);
        switch_row(context, "display/fibres", C::toggle_fibres, true);
        switch_row(context, "display/line_muscles", C::toggle_line_muscles, true);
        switch_row(context, "display/axis", C::toggle_joint_axis, true);
        section_heading(context, "Section", false);
        switch_row(context, "display/section", C::toggle_section, false);
        direction(context);
        position(context);
        switch_row(context, "display/section/flip", C::flip_section, false);
        ImGui::Dummy({1, context.px(6)});
        reset_all(context);
        ImGui::PopStyleVar();
    }

private:
    static void colouring(EditorContext& context) {
        view::Colouring& colouring = context.state.colouring;
        const view::ColouringRow& now = view::colouring_row(colouring);
        const bool edited = colouring != view::Colouring::anatomy;
        const std::string tip = std::string(now.label) + "\n" + now.help +
                                "\nDefault: " + view::colouring_row(view::Colouring::anatomy).label + "   " +
                                shortcut(C::next_colouring) + " goes on to the next.";
        row_label(context, "Show", tip, edited);
        ImGui::SetNextItemWidth(row_columns(context).control);
        const bool open = ImGui::BeginCombo("##colouring", now.label, ImGuiComboFlags_HeightLarge);
        const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
        if (open) {
            for (const view::ColouringRow& row : view::colourings()) {
                if (ImGui::Selectable(row.label, row.colouring == colouring))
                    colouring = row.colouring;
                item_tooltip(row.help);
                record_item(std::string("display/colouring/") + row.key);
            }
            ImGui::EndCombo();
        } else {
            item_tooltip(tip);
        }
        record_item("display/colouring", frame);
        if (row_reset(context, "display/colouring", edited, "Anatomy"))
            colouring = view::Colouring::anatomy;
    }

    /// Both ends of the legend, side by side.
    static void range(EditorContext& context) {
        const view::ColouringRow& row = view::colouring_row(context.state.colouring);
        view::ColourScale& scale = context.state.colour_scales[row.colouring];
        const bool there = row.has_scale(), edited = there && !(scale == row.scale);
        const std::string standard =
            with_unit(number(row.scale.low) + " to " + number(row.scale.high), row.unit);
        const std::string tip =
            !there
                ? "Ends of the colour bar\nNot now: this colouring has no bar."
                : "Ends of the colour bar\nValues beyond take the colour of the end. Drag, or double-click "
                  "to type.\nRange " +
                      with_unit(number(row.least) + " to " + number(row.most), row.unit) + "   Default " +
                      standard;
        row_label(context, "Range", tip, edited, there);
        ImGui::BeginDisabled(!there);
        const float gap = context.px(4), width = std::floor((row_columns(context).control - gap) / 2);
        double low = there ? scale.low : 0, high = there ? scale.high : 0;
        const std::string format = there ? with_unit("%.3g", row.unit) : "-";
        const float speed = static_cast<float>((row.scale.high - row.scale.low) / 200);
        const auto field = [&](const char* name, double& value) {
            ImGui::SetNextItemWidth(width);
            const bool changed = ImGui::DragScalar(name, ImGuiDataType_Double, &value, speed, &row.least,
                                                   &row.most, format.c_str(), ImGuiSliderFlags_AlwaysClamp);
            record_item(std::string("display/range/") + (name + 2));
            if (!ImGui::IsItemActive())
                item_tooltip(tip);
            return changed;
        };
        bool changed = field("##min", low);
        ImGui::SameLine(0, gap);
        changed |= field("##max", high);
        ImGui::EndDisabled();
        if (changed && there)
            view::set_range(scale, row, low, high);
        if (row_reset(context, "display/range", edited, standard))
            scale = row.scale;
    }

    static void opacity(EditorContext& context, const char* name, const char* label, float& opacity,
                        const std::string& help) {
        const std::string tip = std::string(label) + "\n" + help +
                                "\nRange 5 to 100 %   Default 100 %\nCtrl+click types a value.";
        const bool edited = opacity != 1.0f;
        row_label(context, label, tip, edited);
        double percent = std::round(double(opacity) * 1000) / 10;
        if (slider_control(context, name, percent, 5, 100, 100, print("%.0f %%", percent), tip))
            opacity = static_cast<float>(std::round(percent) / 100);
        if (row_reset(context, name, edited, "100 %"))
            opacity = 1;
    }

    static void direction(EditorContext& context) {
        EditorState& state = context.state;
        Section& section = state.section;
        static constexpr const char* helps[] = {
            "Square to where the camera looks now; a click takes the present view over.",
            "Divides left from right.", "Divides front from back.", "Divides upper from lower."};
        const std::string why = section.on ? "" : "\nNot now: there is no section plane.";
        row_label(context, "Direction", "Direction\nWhich way the section plane faces." + why, false,
                  section.on);
        ImGui::BeginDisabled(!section.on);
        const float gap = context.px(2), width = row_columns(context).control;
        const float piece = std::floor((width - gap) / 2);
        for (const SectionAxis axis :
             {SectionAxis::view, SectionAxis::sagittal, SectionAxis::coronal, SectionAxis::axial}) {
            const auto i = static_cast<std::size_t>(axis);
            const bool chosen = section.on && section.axis == axis;
            if (i == 2) { // two lines of two: the names stay readable in a narrow column
                ImGui::Dummy({row_columns(context).label, 1});
                ImGui::SameLine(0, 0);
            }
            if (chosen)
                ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
            if (ImGui::Button(to_text(axis), {piece, 0}))
                orient(section, axis, state.camera, section_place(context));
            if (chosen)
                ImGui::PopStyleColor();
            record_item(std::string("display/section/") + to_text(axis));
            item_tooltip(std::string(to_text(axis)) + "\n" + helps[i] + why);
            if (i % 2 == 0)
                ImGui::SameLine(0, gap);
        }
        ImGui::EndDisabled();
    }

    /// In mm from the middle of the scene.
    static void position(EditorContext& context) {
        Section& section = context.state.section;
        const auto [low, high] = section_range(section, context.state.scene_box);
        const double mm = millimetres_per_unit(context.shown_scene().unit), middle = (low + high) / 2;
        const bool there = section.on && high > low;
        double place = there ? (section.position - middle) * mm : 0;
        const double reach = there ? (high - middle) * mm : 1;
        const std::string tip = "Position\nDistance of the cut from the middle of the scene, mm. Ctrl+wheel "
                                "in the view moves it.\n" +
                                (there ? print("Range %.4g to %.4g mm   Default 0 mm", -reach, reach)
                                       : std::string("Not now: there is no section plane."));
        row_label(context, "Position", tip, false, there);
        ImGui::BeginDisabled(!there);
        if (slider_control(context, "display/section/position", place, -reach, reach, 0,
                           there ? print("%.1f mm", place) : "-", tip) &&
            there)
            section.position = middle + place / mm;
        ImGui::EndDisabled();
        if (row_reset(context, "display/section/position", there && std::abs(place) > 1e-6 * reach, "0 mm"))
            section.position = middle;
    }

    static void reset_all(EditorContext& context) {
        EditorState& state = context.state;
        const EditorState standard;
        const bool edited =
            state.colouring != standard.colouring || !(state.colour_scales == standard.colour_scales) ||
            state.attachments != standard.attachments || state.muscle_opacity != standard.muscle_opacity ||
            state.bone_opacity != standard.bone_opacity || state.occlusion != standard.occlusion ||
            state.wireframe != standard.wireframe || state.rest_ghost != standard.rest_ghost ||
            state.fibres != standard.fibres || state.line_muscles != standard.line_muscles ||
            state.joint_axis != standard.joint_axis || state.section.on;
        ImGui::BeginDisabled(!edited);
        if (ImGui::Button("Reset all", {ImGui::GetContentRegionAvail().x, 0})) {
            state.colouring = standard.colouring;
            state.colour_scales = standard.colour_scales;
            state.attachments = standard.attachments;
            state.muscle_opacity = standard.muscle_opacity;
            state.bone_opacity = standard.bone_opacity;
            state.occlusion = standard.occlusion;
            state.wireframe = standard.wireframe;
            state.rest_ghost = standard.rest_ghost;
            state.fibres = standard.fibres;
            state.line_muscles = standard.line_muscles;
            state.joint_axis = standard.joint_axis;
            state.section.on = false;
        }
        record_item("display/reset_all");
        ImGui::EndDisabled();
        item_tooltip(edited ? "Everything in this panel back to its default."
                            : "Everything in this panel is at its default.");
    }

    static std::string number(double value) { return print("%.4g", value); }
};

} // namespace

std::unique_ptr<Panel> make_display() {
    return std::make_unique<Display>();
}

} // namespace fascicle::editor
