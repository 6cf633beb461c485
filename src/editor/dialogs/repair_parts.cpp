// The three columns of the repair dialog: choices, picture, outcome.
#include "editor/dialogs/modal.hpp"
#include "editor/dialogs/repair_dialog.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fascicle::editor {

namespace {

template <class... Args>
std::string print(const char* format, Args... args) {
    char buffer[200];
    std::snprintf(buffer, sizeof buffer, format, args...);
    return buffer;
}

void heading(const EditorContext& context, const char* text) {
    ImGui::Dummy({1, context.px(3)});
    wrapped_text(context.theme.text_faint, text);
}

constexpr float field_width = 78;

/// A number with its unit behind it.
template <class Input>
void field(const EditorContext& context, const char* name, const char* label, const char* unit,
           const char* tip, const Input& input) {
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
    ImGui::TextUnformatted(label);
    ImGui::PopStyleColor();
    const float rest = context.px(field_width + 54);
    ImGui::SameLine(std::max(ImGui::GetContentRegionMax().x - rest, 0.0f));
    ImGui::SetNextItemWidth(context.px(field_width));
    ImGui::PushID(name);
    input();
    ImGui::PopID();
    record_item(std::string("repair/") + name);
    item_tooltip(tip);
    ImGui::SameLine(0, context.px(6));
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
    ImGui::TextUnformatted(unit);
    ImGui::PopStyleColor();
}

} // namespace

void RepairDialog::draw_choices(EditorContext& context) {
    const Choices before = choices_;
    heading(context, "Mend");
    ImGui::Checkbox("Weld distance of my own", &choices_.own_weld);
    record_item("repair/own_weld");
    item_tooltip(
        "Vertices at open borders that are nearer than this become one.\nDefault: a thousandth of the mean "
        "edge length.");
    if (choices_.own_weld)
        field(context, "weld", "Weld within", "mm", "mm, 0 to 100; 0: only what lies exactly together", [&] {
            ImGui::InputDouble("##v", &choices_.weld_mm, 0, 0, "%.4g");
            choices_.weld_mm = std::isfinite(choices_.weld_mm) ? std::clamp(choices_.weld_mm, 0.0, 100.0) : 0;
        });
    field(context, "fill", "Fill holes up to", "edges", "Edges of a hole, 0 (none) to 1000\nDefault: 100",
          [&] {
              ImGui::InputInt("##v", &choices_.fill_edges, 0);
              choices_.fill_edges = std::clamp(choices_.fill_edges, 0, RepairOptions::longest_hole);
          });
    ImGui::Checkbox("Large ones, too", &choices_.fill_large);
    record_item("repair/fill_large");
    item_tooltip(
        "Also holes of more than 15 % of the area: then the mesh may be a sheet rather than a solid.\n"
        "Default: off");
    field(context, "islands", "Drop parts below", "%",
          "Share of the largest part's area, 0 (none) to 100 %\nDefault: 1 %", [&] {
              ImGui::InputDouble("##v", &choices_.island_percent, 0, 0, "%.3g");
              choices_.island_percent = std::isfinite(choices_.island_percent)
                                            ? std::clamp(choices_.island_percent, 0.0, 100.0)
                                            : 0;
          });
    ImGui::Checkbox("Part crossing triangles", &choices_.untangle);
    record_item("repair/untangle");
    item_tooltip("Smooths around triangles that run through each other. What is left is told.\nDefault: off");
    heading(context, "Reshape");
    field(context, "smooth", "Smooth", "passes",
          "Passes, 0 to 1000, without shrinking (Taubin 1995)\nDefault: 0", [&] {
              ImGui::InputInt("##v", &choices_.smooth_passes, 0);
              choices_.smooth_passes = std::clamp(choices_.smooth_passes, 0, 1000);
          });
    draw_remesh(context);
    if (!(choices_ == before)) {
        changed_ = true;
        changed_at_ = context.now;
    }
}

void RepairDialog::draw_remesh(EditorContext& context) {
    constexpr const char* labels[] = {"Keep the triangles", "Remesh to an edge length", "Remesh to a number"};
    constexpr const char* names[] = {"repair/keep", "repair/by_edge", "repair/by_number"};
    for (int i = 0; i < 3; ++i) {
        if (ImGui::RadioButton(labels[i], choices_.remesh == i))
            choices_.remesh = i;
        record_item(names[i]);
        item_tooltip(
            i == 0 ? "Vertices stay where they are.\nDefault"
                   : "Even triangles; the volume is kept within 0.5 %. All vertices are new: attachments and "
                     "areas follow by the nearest point.");
    }
    if (choices_.remesh == 1)
        field(context, "edge", "Edges of", "mm", "mm, 0.01 to 1000", [&] {
            ImGui::InputDouble("##v", &choices_.edge_mm, 0, 0, "%.4g");
            choices_.edge_mm =
                std::isfinite(choices_.edge_mm) ? std::clamp(choices_.edge_mm, 0.01, 1000.0) : 3;
        });
    if (choices_.remesh == 2)
        field(context, "triangles", "Triangles", "", "4 to 2,000,000", [&] {
            ImGui::InputInt("##v", &choices_.triangles, 0);
            choices_.triangles = std::clamp(choices_.triangles, 4, 2000000);
        });
}

void RepairDialog::draw_preview(EditorContext& context, ImVec2 size) {
    ImGui::BeginGroup();
    for (const bool after : {false, true}) {
        if (after)
            ImGui::SameLine(0, context.px(14));
        if (ImGui::RadioButton(after ? "After" : "Before", show_after_ == after))
            show(after);
        record_item(after ? "repair/after" : "repair/before");
        item_tooltip(after ? "The mesh as it would become." : "The mesh as it is.");
    }
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = size.y - (ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.y);
    preview_.draw(context, batch_, 0, {at, {at.x + size.x, at.y + height}});
    ImGui::EndGroup();
}

void RepairDialog::draw_measures(EditorContext& context) {
    const SurfaceMeasures &a = outcome_->result.measured_before, &b = outcome_->result.measured_after;
    const double square_cm = mm_ * mm_ / 100.0, cubic_cm = std::pow(mm_, 3) / 1000.0;
    if (!ImGui::BeginTable("measures", 3))
        return;
    const auto row = [&](const char* name, const std::string& before, const std::string& after) {
        ImGui::TableNextRow();
        ImU32 colour = context.theme.text_faint;
        for (const std::string& text : {std::string(name), before, after}) {
            ImGui::TableNextColumn();
            ImGui::PushStyleColor(ImGuiCol_Text, colour);
            ImGui::TextUnformatted(text.c_str());
            ImGui::PopStyleColor();
            colour = context.theme.text;
        }
    };
    const auto volume = [&](const SurfaceMeasures& m) {
        return m.closed ? print("%.5g cm\xC2\xB3", m.volume * cubic_cm) : std::string("none");
    };
    row("", "Before", "After");
    row("Vertices", std::to_string(a.vertices), std::to_string(b.vertices));
    row("Triangles", std::to_string(a.triangles), std::to_string(b.triangles));
    row("Area", print("%.5g cm\xC2\xB2", a.area * square_cm), print("%.5g cm\xC2\xB2", b.area * square_cm));
    row("Volume", volume(a), volume(b));
    ImGui::EndTable();
}

void RepairDialog::draw_outcome(EditorContext& context) {
    const Theme& theme = context.theme;
    if (job_ != nullptr || changed_) {
        ImGui::ProgressBar(static_cast<float>(job_ != nullptr ? job_->fraction() : 0.0), {-1, 0},
                           "Trying the repair");
        record_item("repair/progress");
    }
    if (!problem_.empty()) {
        wrapped_text(theme.bad, problem_);
        return;
    }
    if (!outcome_)
        return;
    const RepairResult& result = outcome_->result;
    if (!result.good())
        wrapped_text(theme.bad, "Not yet a solid: " + result.reason + ".");
    else
        wrapped_text(theme.good, result.changed()
                                     ? "Closed, manifold, consistently oriented"
                                     : "Nothing to repair: closed, manifold, consistently oriented");
    draw_measures(context);
    if (!result.steps.empty())
        heading(context, "Found and done");
    for (const RepairStep& step : result.steps)
        wrapped_text(step.done < step.found ? theme.warning : theme.text, step.text);
    if (!result.left.empty())
        heading(context, "Left");
    for (const std::string& line : result.left)
        wrapped_text(theme.warning, line);
    heading(context, "What follows the mesh");
    wrapped_text(theme.text_dim,
                 choices_.remesh != 0
                     ? "Attachments and painted areas, by the nearest point of the old mesh."
                     : "Attachments and painted areas, vertex by vertex; new vertices as their nearest "
                       "old one.");
}

} // namespace fascicle::editor
