#include "editor/widgets/param_row.hpp"

#include "editor/control_guard.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui_internal.h>

namespace fascicle::editor {

namespace {

std::string with_unit(const ParamRow& row, const std::string& number) {
    std::string text = number;
    if (row.unit != "1")
        text.append(" ").append(row.unit);
    return text;
}

std::string shown_value(const EditorContext& context, const ParamRow& row, double value) {
    if (row.kind == ParamKind::choice)
        return row.choices[static_cast<std::size_t>(value)];
    if (row.key == "solver.iterations" && value == 0)
        return "method's own (" + std::to_string(passes_per_frame(context.document.scene().parameters)) + ")";
    char buffer[40];
    if (row.kind == ParamKind::integer)
        std::snprintf(buffer, sizeof buffer, "%.0f", value);
    else
        std::snprintf(buffer, sizeof buffer, "%.4g", value);
    return with_unit(row, buffer);
}

std::string tooltip_text(const EditorContext& context, const ParamRow& row,
                         const std::string& disabled_reason) {
    const ParamSet& parameters = context.document.scene().parameters;
    std::string tip = row.label + "\n" + row.meaning + "\n\n";
    if (row.kind != ParamKind::choice)
        tip +=
            "Range " + number_text(row.minimum) + " to " + with_unit(row, number_text(row.maximum)) + "   ";
    tip += "Default " + shown_value(context, row, parameters.default_value(row.key)) +
           "\nSource: " + row.source + "\nKey: " + row.key;
    if (row.kind != ParamKind::choice)
        tip += "\nCtrl+click types a value.";
    if (!disabled_reason.empty())
        tip += "\nNot now: " + disabled_reason + ".";
    return tip;
}

/// Errors go to the messages, the document stays as it was.
template <class F>
void attempt(EditorContext& context, F change) {
    try {
        change();
    } catch (const Error& error) {
        context.log.add(Severity::error, error.what());
    }
}

/// Share of the slider's way at which a value sits, as ImGui has it.
float slider_share(const ParamRow& row, double value) {
    const bool logarithmic = row.logarithmic && row.minimum > 0;
    const double share = logarithmic ? std::log(value / row.minimum) / std::log(row.maximum / row.minimum)
                                     : (value - row.minimum) / (row.maximum - row.minimum);
    return static_cast<float>(std::clamp(share, 0.0, 1.0));
}

/// Where on the frame a value sits; ImGui keeps its grab inside the frame by half the grab's width.
float slider_x(const ParamRow& row, const Rect& frame, double value) {
    float grab = ImGui::GetStyle().GrabMinSize;
    const float room = frame.width() - 4;
    if (row.kind == ParamKind::integer)
        grab = std::min(room, std::max(room / static_cast<float>(row.maximum - row.minimum + 1), grab));
    const float low = frame.min.x + 2 + grab / 2, high = frame.max.x - 2 - grab / 2;
    return low + (high - low) * slider_share(row, value);
}

/// Our own look: the value above a track with a handle and a notch at the default, so that neither hides the number.
void paint_slider(const EditorContext& context, const ParamRow& row, const Rect& frame, double value,
                  bool active) {
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float dim = ImGui::GetStyle().Alpha, rounding = ImGui::GetStyle().FrameRounding;
    const bool hovered = ImGui::IsItemHovered() || active;
    list.AddRectFilled(frame.min, frame.max, with_alpha(hovered ? theme.field_hovered : theme.field, dim),
                       rounding);
    const float x = std::round(slider_x(row, frame, value)), track = context.px(3);
    list.PushClipRect({frame.min.x, frame.max.y - track}, {x, frame.max.y}, true);
    list.AddRectFilled(frame.min, frame.max, with_alpha(theme.accent, (hovered ? 1.0f : 0.75f) * dim),
                       rounding);
    list.PopClipRect();
    const float mark =
        std::round(slider_x(row, frame, context.document.scene().parameters.default_value(row.key)));
    const float notch = context.px(1);
    list.AddRectFilled({mark - notch, frame.max.y - track}, {mark + notch, frame.max.y + context.px(2)},
                       with_alpha(theme.text_dim, dim));
    const float half = context.px(2.5f);
    list.AddRectFilled({x - half, frame.max.y - context.px(7)}, {x + half, frame.max.y + context.px(1)},
                       with_alpha(hovered ? theme.text : theme.accent, dim), context.px(2));
    draw_text_in(list, {frame.min, {frame.max.x, frame.max.y - track}}, with_alpha(theme.text, dim),
                 shown_value(context, row, value), Align::centre);
}

void draw_slider(EditorContext& context, const ParamRow& row) {
    const std::string key = row.key;
    double value = context.document.scene().parameters.get(key);
    const bool typing = ImGui::TempInputIsActive(ImGui::GetID("##value"));
    if (!typing) // ImGui's own look is made invisible; it keeps the behaviour
        for (const ImGuiCol colour : {ImGuiCol_Text, ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered,
                                      ImGuiCol_FrameBgActive, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive})
            ImGui::PushStyleColor(colour, ImU32{0});
    ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
    bool changed = false;
    if (row.kind == ParamKind::integer) {
        int whole = static_cast<int>(value);
        const int low = static_cast<int>(row.minimum), high = static_cast<int>(row.maximum);
        changed = ImGui::SliderInt("##value", &whole, low, high, "%d", flags);
        value = whole;
    } else {
        // The digits of the format decide where ImGui's logarithmic scale begins: enough of them for every range.
        flags |= ImGuiSliderFlags_NoRoundToFormat | (row.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
        changed = ImGui::SliderScalar("##value", ImGuiDataType_Double, &value, &row.minimum, &row.maximum,
                                      row.logarithmic ? "%.6f" : "%.4f", flags);
        if (changed && ImGui::IsMouseDown(0) && !typing) { // three digits are as fine as a hand is
            char buffer[40];
            std::snprintf(buffer, sizeof buffer, "%.3g", value);
            parse_number(buffer, value);
            value = std::clamp(value, row.minimum, row.maximum);
        }
    }
    if (!typing)
        ImGui::PopStyleColor(6);
    const bool ended = ImGui::IsItemDeactivated();
    record_item("parameter/" + key);
    if (!typing)
        paint_slider(context, row, {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()}, value,
                     ImGui::IsItemActive());
    if (changed)
        attempt(context, [&] { actions::edit_parameter(context.document, key, value); });
    if (ended && context.document.has_uncommitted_edits())
        actions::commit_parameter(context.document, key);
}

void draw_choice(EditorContext& context, const ParamRow& row) {
    const auto now = static_cast<std::size_t>(context.document.scene().parameters.get(row.key));
    const bool open = ImGui::BeginCombo("##value", row.choices[now].c_str());
    const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (open) {
        for (std::size_t i = 0; i < row.choices.size(); ++i) {
            if (ImGui::Selectable(row.choices[i].c_str(), i == now) && i != now)
                attempt(context, [&] {
                    if (row.key == "solver.method")
                        actions::set_method(context.document, row.choices[i]);
                    else
                        actions::set_parameter(context.document, row.key, double(i));
                });
            record_item("parameter/" + row.key + "/" + row.choices[i]);
        }
        ImGui::EndCombo();
    }
    record_item("parameter/" + row.key, frame);
}

} // namespace

void draw_param_row(EditorContext& context, const ParamRow& row, float label_width,
                    const std::string& no_effect) {
    const std::string locked = lock_reason("parameter/" + row.key);
    const std::string& disabled_reason = locked.empty() ? no_effect : locked;
    const Theme& theme = context.theme;
    const float height = ImGui::GetFrameHeight(), width = ImGui::GetContentRegionAvail().x;
    const bool edited = context.document.scene().parameters.edited(row.key);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(row.key.c_str());
    ImGui::BeginDisabled(!disabled_reason.empty());

    draw_text_in(*ImGui::GetWindowDrawList(), {at, {at.x + label_width - context.px(8), at.y + height}},
                 !disabled_reason.empty() ? theme.text_faint
                 : edited                 ? theme.text
                                          : theme.text_dim,
                 row.label);
    ImGui::Dummy({label_width, height});
    item_tooltip(tooltip_text(context, row, disabled_reason));
    ImGui::SameLine(0, 0);
    const float reset = height;
    ImGui::SetNextItemWidth(std::max(20.0f, width - label_width - reset - context.px(2)));
    if (row.kind == ParamKind::choice)
        draw_choice(context, row);
    else
        draw_slider(context, row);
    if (!ImGui::IsItemActive())
        item_tooltip(tooltip_text(context, row, disabled_reason));
    ImGui::EndDisabled();
    ImGui::SameLine(0, context.px(2));
    const std::string name = "parameter/" + row.key + "/reset";
    const double standard = context.document.scene().parameters.default_value(row.key);
    if (!edited || !locked.empty())
        ImGui::Dummy({reset, height});
    else if (icon_button(context, name.c_str(), icons::reset, false, true,
                         std::string("Back to the default, ").append(shown_value(context, row, standard)),
                         reset / context.scale()))
        actions::reset_parameter(context.document, row.key);
    ImGui::PopID();
}

} // namespace fascicle::editor
