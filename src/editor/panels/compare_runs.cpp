#include "editor/panels/compare_parts.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"

#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace {

using C = Command;

/// A round button with the letter of a run. True when clicked.
bool letter_button(const EditorContext& context, const std::string& name, const char* letter, bool on,
                   ImVec2 at, float side, const std::string& tip) {
    const Theme& theme = context.theme;
    ImGui::SetCursorScreenPos(at);
    ImGui::PushID(name.c_str());
    const bool clicked = ImGui::InvisibleButton("letter", {side, side});
    record_item(name);
    const bool hovered = ImGui::IsItemHovered();
    ImGui::PopID();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 middle{at.x + side / 2, at.y + side / 2};
    const float radius = side * 0.44f;
    if (on)
        list.AddCircleFilled(middle, radius, theme.accent);
    else if (hovered)
        list.AddCircleFilled(middle, radius, theme.field_hovered);
    if (!on)
        list.AddCircle(middle, radius, theme.text_faint, 0, std::max(1.0f, context.scale()));
    draw_text_in(list, {at, {at.x + side, at.y + side}}, on ? theme.on_accent : theme.text_dim, letter,
                 Align::centre);
    item_tooltip(tip);
    return clicked;
}

std::string frames_text(const Recording& recording) {
    const int count = recording.frame_count();
    const FramePtr last = recording.last_frame();
    std::string text = std::to_string(std::max(0, count - 1)) + (count == 2 ? " frame" : " frames");
    if (last != nullptr && last->index != count - 1) // written with --every
        text += " to " + std::to_string(last->index);
    if (recording.state() == RunState::running)
        text += ", running";
    else if (recording.state() == RunState::cancelled)
        text += ", stopped";
    return text;
}

void use_parameters(EditorContext& context, const KeptRun& run) {
    const bool changed = actions::use_parameters(context.document, run.recording->scene().parameters,
                                                 "Use parameters of " + run.name);
    context.log.add(Severity::note, changed ? "Parameters of " + run.name + " are used now."
                                            : "The parameters are those of " + run.name + " already.");
}

} // namespace

std::string parameter_text(const ParamRow& row, const std::string& value) {
    return row.unit == "1" || row.kind == ParamKind::choice ? value : value + " " + row.unit;
}

/// What a run was made with that the document has otherwise, short.
const std::string& CompareRuns::difference_text(const EditorContext& context, const KeptRun& run) {
    const int shelf = context.features.shelf.version();
    if (texts_version_ != context.document.version() || texts_shelf_ != shelf) {
        texts_.clear();
        texts_version_ = context.document.version();
        texts_shelf_ = shelf;
    }
    const auto [it, fresh] = texts_.try_emplace(run.id);
    if (!fresh)
        return it->second;
    const auto rows =
        parameter_differences(run.recording->scene().parameters, context.document.scene().parameters);
    for (const ParamDifference& row : rows)
        it->second +=
            (it->second.empty() ? "" : ", ") + row.row->label + " " + parameter_text(*row.row, row.a);
    if (rows.empty())
        it->second = "parameters as now";
    return it->second;
}

void CompareRuns::draw_name(EditorContext& context, const KeptRun& run, const Rect& place) {
    const std::string name = "compare/run/" + std::to_string(run.id) + "/name";
    if (renaming_ == run.id) {
        ImGui::SetCursorScreenPos(place.min);
        ImGui::SetNextItemWidth(std::max(context.px(40), place.width()));
        if (rename_begins_)
            ImGui::SetKeyboardFocusHere();
        const bool entered = ImGui::InputText(
            "##name", &typed_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
        record_item(name);
        const bool left = !rename_begins_ && ImGui::IsItemDeactivated();
        rename_begins_ = false;
        if (entered)
            context.features.shelf.rename(run.id, typed_);
        if (entered || left)
            renaming_ = 0;
        return;
    }
    ImGui::SetCursorScreenPos(place.min);
    ImGui::InvisibleButton("name", {std::max(1.0f, place.width()), place.height()});
    record_item(name);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
        renaming_ = run.id;
        typed_ = run.name;
        rename_begins_ = true;
    }
    std::string tip = run.name + "\n" + frames_text(*run.recording) + ", kept at " + run.time + ", " +
                      std::to_string((run.bytes + 500'000) / 1'000'000) + " MB";
    if (!run.folder.empty())
        tip += "\nRead from " + run.folder.string();
    item_tooltip(tip + "\nAgainst the scene now: " + difference_text(context, run) +
                 "\nDouble-click renames it.");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_text_in(list, place, context.theme.text, run.name);
    const float used = text_size(run.name).x + context.px(8);
    if (place.width() > used)
        draw_text_in(list, {{place.min.x + used, place.min.y}, place.max}, context.theme.text_faint,
                     frames_text(*run.recording) + "  " + run.time);
}

void CompareRuns::draw_run(EditorContext& context, const KeptRun& run, float width) {
    Compare& compare = context.features.compare;
    const Theme& theme = context.theme;
    const bool present = run.recording == context.runs.recording();
    const bool is_a = compare.a().recording == run.recording, is_b = compare.b().recording == run.recording;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float line = context.px(22), side = context.px(22), height = 2 * line;
    const std::string name = "compare/run/" + std::to_string(run.id);
    ImGui::PushID(run.id);
    if (is_a || is_b)
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + height}, theme.field,
                                                  context.px(4));
    const float y = at.y + (height - side) / 2;
    if (letter_button(context, name + "/a", "A", is_a, {at.x + context.px(4), y}, side,
                      is_a ? "This is run A." : "Makes this run A."))
        compare.choice.a = present ? present_run : run.id;
    if (letter_button(context, name + "/b", "B", is_b, {at.x + context.px(30), y}, side,
                      is_b ? "This is run B." : "Makes this run B."))
        compare.choice.b = present ? present_run : run.id;

    const float left = at.x + context.px(60), icons_left = at.x + width - 3 * side - context.px(4);
    draw_name(context, run, {{left, at.y}, {icons_left - context.px(4), at.y + line}});
    draw_text_in(*ImGui::GetWindowDrawList(),
                 {{left, at.y + line}, {at.x + width - context.px(6), at.y + height}}, theme.text_dim,
                 present ? "present run" : difference_text(context, run));
    ImGui::SetCursorScreenPos({icons_left, at.y});
    const float icon = side / context.scale();
    if (icon_button(context, (name + "/use").c_str(), icons::sliders, false, true,
                    "Use these parameters\nThe scene gets all parameters of " + run.name +
                        ", as one step that can be undone.",
                    icon))
        use_parameters(context, run);
    ImGui::SameLine(0, 0);
    const int id = run.id;
    if (icon_button(context, (name + "/pin").c_str(), icons::pin, run.pinned, true,
                    run.pinned ? "Pinned: it stays until it is deleted.\nA click lets it go."
                               : "Pin\nKeeps this run; of the others only the last " +
                                     std::to_string(RunShelf::kept_runs) + " are kept.",
                    icon))
        pin_ = {id, !run.pinned};
    ImGui::SameLine(0, 0);
    if (icon_button(context, (name + "/delete").c_str(), icons::trash, false, true,
                    "Delete\nForgets the frames of this run; files are left alone.", icon))
        delete_ = id;
    ImGui::PopID();
    ImGui::SetCursorScreenPos(at);
    ImGui::Dummy({width, height});
}

/// The run under way, which is not kept yet.
void CompareRuns::draw_present(EditorContext& context, float width) {
    const RecordingPtr present = context.runs.recording();
    if (present == nullptr || context.features.shelf.find(present) != nullptr)
        return;
    Compare& compare = context.features.compare;
    const bool is_a = compare.a().recording == present, is_b = compare.b().recording == present;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = context.px(22), height = context.px(30);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (is_a || is_b)
        list.AddRectFilled(at, {at.x + width, at.y + height}, context.theme.field, context.px(4));
    const float y = at.y + (height - side) / 2;
    if (letter_button(context, "compare/present/a", "A", is_a, {at.x + context.px(4), y}, side,
                      "The present run as A, whichever it is."))
        compare.choice.a = present_run;
    if (letter_button(context, "compare/present/b", "B", is_b, {at.x + context.px(30), y}, side,
                      "The present run as B, whichever it is."))
        compare.choice.b = present_run;
    const Rect place{{at.x + context.px(60), at.y}, {at.x + width - context.px(6), at.y + height}};
    draw_text_in(list, place, context.theme.text, "Present run");
    draw_text_in(list, place, context.theme.text_faint, frames_text(*present), Align::right);
    ImGui::SetCursorScreenPos(at);
    ImGui::Dummy({width, height});
}

void CompareRuns::draw_loading(EditorContext& context, float width) {
    RunShelf& shelf = context.features.shelf;
    if (shelf.loading()) {
        const float side = context.px(22);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::PushStyleColor(ImGuiCol_PlotHistogram, context.theme.accent_dim);
        ImGui::ProgressBar(static_cast<float>(shelf.progress()), {width - side - context.px(4), side},
                           ("Reading " + shelf.loading_name()).c_str());
        ImGui::PopStyleColor();
        record_item("compare/loading");
        ImGui::SetCursorScreenPos({at.x + width - side, at.y});
        if (icon_button(context, "compare/cancel_loading", icons::close, false, true, "Stop reading",
                        side / context.scale()))
            shelf.cancel_loading();
    }
    if (!shelf.problem().empty()) {
        draw_compare_text(context.theme.bad, shelf.problem());
        record_item("compare/problem");
    }
}

void CompareRuns::draw(EditorContext& context) {
    RunShelf& shelf = context.features.shelf;
    ImGui::Dummy({1, context.px(2)});
    draw_compare_heading(context, "Runs");
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(3)});
    draw_present(context, width);
    for (const KeptRun& run : shelf.runs())
        draw_run(context, run, width);
    if (shelf.runs().empty() && context.runs.recording() == nullptr)
        draw_compare_text(context.theme.text_faint, "No runs yet. Each run is kept here when it ends.");
    draw_loading(context, width);
    ImGui::PopStyleVar();
    // After the list was gone through.
    if (pin_.first != 0)
        shelf.set_pinned(pin_.first, pin_.second);
    pin_ = {};
    if (delete_ != 0)
        shelf.remove(delete_);
    delete_ = 0;

    ImGui::Dummy({1, context.px(2)});
    const float half = std::floor((width - context.px(6)) / 2);
    const CommandState swap = command_state(context, C::swap_runs);
    ImGui::BeginDisabled(!swap.enabled);
    if (ImGui::Button("Swap A and B", {half, 0}))
        run_command(context, C::swap_runs);
    record_item("compare/swap");
    ImGui::EndDisabled();
    item_tooltip(tooltip(C::swap_runs) + (swap.enabled ? "" : "\nNot now: " + swap.reason + "."));
    ImGui::SameLine(0, context.px(6));
    if (ImGui::Button("Load a run folder...", {half, 0}))
        run_command(context, C::load_run);
    record_item("compare/load");
    item_tooltip(tooltip(C::load_run));
}

} // namespace fascicle::editor
