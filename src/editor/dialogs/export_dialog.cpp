#include "editor/dialogs/export_dialog.hpp"

#include "editor/dialogs/export_facts.hpp"
#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/io/animation.hpp"
#include "fascicle/io/gif_file.hpp"

#include <algorithm>
#include <cstdio>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

constexpr const char* popup_name = "Export";
constexpr float label_width = 96;

/// Text of a colour, wrapped to the width.
void paragraph(ImU32 colour, const std::string& text, float width) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

bool number(const EditorContext& context, const char* name, int& value, int low, int high, const char* tip) {
    ImGui::SetNextItemWidth(context.px(64));
    ImGui::PushID(name);
    const bool changed = ImGui::InputInt("##number", &value, 0);
    ImGui::PopID();
    record_item(std::string("export/") + name);
    item_tooltip(tip);
    value = std::clamp(value, low, high);
    return changed;
}

} // namespace

// Folders alone are chosen here; what is in them shows what may be replaced.
ExportDialog::ExportDialog()
    : browser_({".png", ".gif", ".mp4", ".vtp", ".obj", ".csv", ".html", ".json", ".pvd", ".glb", ".usda",
                ".pc2", ".mdd"},
               "No exports here") {}

void ExportDialog::open(EditorContext& context) {
    ExportChoices& choices = context.state.exporting;
    std::error_code error;
    if (choices.folder.empty() || !fs::is_directory(choices.folder, error))
        choices.folder = fs::current_path(error);
    choices.name = choices.name.empty() ? export_name(context.document.scene().name) : choices.name;
    open_ = appears_ = true;
    browsing_ = false;
    problem_.clear();
    instead_.clear();
}

void ExportDialog::fail(EditorContext& context, const output::ExportRequest& request,
                        const std::string& text) {
    open(context);
    problem_ = text;
    instead_ = output::free_name(request.target);
}

void ExportDialog::label(const EditorContext& context, const char* text) {
    const float x = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    ImGui::SameLine(x + context.px(label_width));
}

std::pair<int, int> ExportDialog::picture_size(const EditorContext& context) const {
    const ExportChoices& choices = context.state.exporting;
    const bool own = choices.scale == 0;
    const int width = own ? choices.width : context.state.view_width * choices.scale;
    const int height = own ? choices.height : context.state.view_height * choices.scale;
    return {output::allowed_side(width, choices.kind), output::allowed_side(height, choices.kind)};
}

fs::path ExportDialog::target(const EditorContext& context) const {
    const ExportChoices& choices = context.state.exporting;
    return output::with_extension(choices.folder / choices.name, choices.kind);
}

output::ExportRequest ExportDialog::request(const EditorContext& context) const {
    const ExportChoices& choices = context.state.exporting;
    output::ExportRequest request;
    request.kind = choices.kind;
    request.target = target(context);
    const ShownFrame shown = context.shown();
    request.frame = shown.frame == nullptr ? 0 : shown.frame->index;
    const int last = last_exported_frame(context);
    request.first = choices.all_frames ? 0 : std::min(choices.first, last);
    request.last = choices.all_frames ? last : std::clamp(choices.last, request.first, last);
    request.step = std::max(1, choices.step);
    request.fps = choices.fps;
    request.dither = choices.dither;
    request.morph_targets = choices.morph_targets;
    request.up = choices.up;
    return request;
}

int ExportDialog::picture_count(const EditorContext& context) const {
    const output::ExportRequest r = request(context);
    if (!output::export_kind(r.kind).traits.frames)
        return 1;
    const int count = (r.last - r.first) / r.step + 1;
    return count + ((r.last - r.first) % r.step != 0 ? 1 : 0);
}

void ExportDialog::start(EditorContext& context) {
    const auto [width, height] = picture_size(context);
    problem_.clear();
    if (context.features.exporter.start(context, request(context), width, height,
                                        context.state.exporting.transparent))
        open_ = false;
}

void ExportDialog::draw(EditorContext& context) {
    if (auto failure = context.features.exporter.take_failure())
        fail(context, failure->request, failure->text);
    if (!open_)
        return;
    bool keep = true;
    const bool opening = appears_;
    if (!begin_modal(context, popup_name, appears_, 820, 600, &keep)) {
        if (opening)
            return;    // another one is in front
        open_ = false; // Esc closed it
        return;
    }
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float left = std::min(room.x * 0.34f, context.px(214)), gap = context.px(18);
    const float foot = ImGui::GetFrameHeight() + context.px(10) + 2 * ImGui::GetStyle().ItemSpacing.y;
    const ImVec2 right{room.x - left - gap, room.y - foot};
    draw_kinds(context, {left, right.y});
    ImGui::SameLine(0, gap);
    if (ImGui::BeginChild("options", right, false, ImGuiWindowFlags_NoBackground)) {
        if (browsing_)
            draw_target(context, right);
        else
            draw_options(context, right);
    }
    ImGui::EndChild();
    ImGui::Dummy({1, context.px(4)});

    const std::string reason = reason_against(context, context.state.exporting.kind);
    const bool named = !context.state.exporting.name.empty();
    const float button = context.px(110);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room.x - 2 * button - context.px(8));
    if (ImGui::Button(browsing_ ? "Back" : "Cancel", {button, 0}))
        browsing_ ? browsing_ = false : keep = false;
    record_item("export/cancel");
    ImGui::SameLine(0, context.px(8));
    ImGui::BeginDisabled(!reason.empty() || !named);
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    if (ImGui::Button(browsing_ ? "Use folder" : "Export", {button, 0})) {
        if (std::exchange(browsing_, false))
            context.state.exporting.folder = browser_.folder();
        else
            start(context);
    }
    ImGui::PopStyleColor();
    record_item("export/start");
    ImGui::EndDisabled();
    item_tooltip(!reason.empty() ? "Not now: " + reason + "." : named ? "" : "Give it a name first.");
    if (!keep)
        open_ = false;
    if (!open_)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void ExportDialog::draw_kinds(EditorContext& context, ImVec2 size) {
    const Theme& theme = context.theme;
    ImGui::PushStyleColor(ImGuiCol_ChildBg, theme.plot);
    if (ImGui::BeginChild("kinds", size, false)) {
        const float line = context.px(25);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0}); // all kinds fit a small window
        for (const output::ExportKindRow& row : output::export_kinds()) {
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float width = ImGui::GetContentRegionAvail().x;
            const bool chosen = context.state.exporting.kind == row.key;
            const std::string reason = reason_against(context, row.key);
            ImGui::PushID(row.key);
            if (ImGui::Selectable("##kind", chosen, 0, {width, line})) {
                context.state.exporting.kind = row.key;
                problem_.clear();
                instead_.clear();
                browsing_ = false;
            }
            record_item(std::string("export/kind/") + row.key);
            ImGui::PopID();
            item_tooltip(std::string(chosen ? "" : row.help) +
                         (reason.empty() ? "" : "\nNot now: " + reason + "."));
            ImDrawList& list = *ImGui::GetWindowDrawList();
            const ImU32 text = !reason.empty() ? theme.text_faint : theme.text;
            const float x = at.x + context.px(12), mark = context.px(22);
            if (icons_available())
                draw_text_in(list, {{x, at.y}, {x + mark, at.y + line}},
                             chosen ? theme.accent : theme.text_dim, row.icon, Align::centre);
            draw_text_in(list,
                         {{x + mark + context.px(10), at.y}, {at.x + width - context.px(6), at.y + line}},
                         text, row.label);
        }
        ImGui::PopStyleVar();
    }
    ImGui::EndChild();
    ImGui::PopStyleColor();
}

void ExportDialog::draw_options(EditorContext& context, ImVec2 size) {
    const Theme& theme = context.theme;
    ExportChoices& choices = context.state.exporting;
    const output::ExportKindRow& row = output::export_kind(choices.kind);
    const float width = size.x - context.px(4);
    paragraph(theme.text, row.label, width);
    paragraph(theme.text_dim, row.help, width);
    ImGui::Dummy({1, context.px(8)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(8), context.px(9)});
    if (const std::string reason = reason_against(context, choices.kind); !reason.empty()) {
        paragraph(theme.warning, "Not now: " + reason + ".", width);
    } else {
        if (row.traits.frames)
            draw_frames(context);
        else if (row.traits.one) {
            label(context, "Frame");
            ImGui::TextUnformatted(
                (std::to_string(request(context).frame) + ", the one that is shown").c_str());
        } else {
            label(context, "Frames");
            ImGui::TextUnformatted(frames_text(context).c_str());
        }
        if (row.traits.size)
            draw_size(context);
        if (row.traits.speed)
            draw_speed(context);
        if (choices.kind == "gif") {
            label(context, "Colours");
            ImGui::Checkbox("Dither", &choices.dither);
            record_item("export/dither");
            item_tooltip(
                "A fine pattern hides the steps between 255 colours; the file is larger.\nDefault: on.");
        }
        if (row.traits.morphs)
            draw_morphs(context);
        if (row.traits.up)
            draw_up(context);
        label(context, "Estimate");
        const auto [w, h] = picture_size(context);
        ImGui::TextUnformatted(
            estimate_text(context, request(context), picture_count(context), w, h).c_str());
        record_item("export/estimate");
    }
    ImGui::PopStyleVar();

    const float block =
        2 * ImGui::GetFrameHeightWithSpacing() + 2 * ImGui::GetTextLineHeightWithSpacing() + context.px(20);
    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY() + context.px(6), size.y - block));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddLine(at, {at.x + width, at.y}, theme.line);
    ImGui::Dummy({1, context.px(6)});
    label(context, "Folder");
    const float choose = context.px(92);
    const float room = width - context.px(label_width) - choose - context.px(8);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight();
    draw_text_in(*ImGui::GetWindowDrawList(), {from, {from.x + room, from.y + height}}, theme.text,
                 elided_front(choices.folder.string(), room));
    ImGui::Dummy({room, height});
    item_tooltip(choices.folder.string());
    ImGui::SameLine(0, context.px(8));
    if (ImGui::Button("Choose...", {choose, 0})) {
        browsing_ = true;
        browser_.go_to(choices.folder);
    }
    record_item("export/choose");
    item_tooltip("Another folder.");
    label(context, "Name");
    const std::string extension = row.extension;
    const float tail =
        extension.empty() ? text_size("/").x + context.px(8) : text_size(extension).x + context.px(8);
    ImGui::SetNextItemWidth(width - context.px(label_width) - tail);
    if (ImGui::InputText("##name", &choices.name, ImGuiInputTextFlags_AutoSelectAll)) {
        problem_.clear();
        instead_.clear();
    }
    record_item("export/name");
    item_tooltip("Name of the file or folder, without its extension.");
    ImGui::SameLine(0, context.px(6));
    ImGui::AlignTextToFramePadding();
    paragraph(theme.text_dim, extension.empty() ? "/" : extension, tail);
    draw_note(context, target(context), width);
}

/// What happened at the last try, or what would be replaced.
void ExportDialog::draw_note(EditorContext& context, const fs::path& path, float width) {
    const Theme& theme = context.theme;
    if (problem_.empty()) {
        const std::string warning = replace_warning(path, context.state.exporting.kind);
        paragraph(warning.empty() ? theme.text_faint : theme.warning,
                  warning.empty() ? path.filename().string() + " is a new name here." : warning, width);
        record_item("export/note");
        return;
    }
    const std::string use = "Use \"" + instead_.filename().string() + "\"";
    const float button = instead_.empty() ? 0 : text_size(use).x + context.px(24);
    ImGui::BeginGroup();
    paragraph(theme.bad, problem_, width - button - context.px(10));
    ImGui::EndGroup();
    record_item("export/problem");
    if (instead_.empty())
        return;
    ImGui::SameLine(width - button);
    if (ImGui::Button(use.c_str(), {button, 0})) {
        context.state.exporting.name = instead_.stem().string();
        problem_.clear();
        instead_.clear();
    }
    record_item("export/instead");
    item_tooltip("Another name in the same folder. If the folder cannot be written to, choose another one.");
}

void ExportDialog::draw_frames(EditorContext& context) {
    ExportChoices& choices = context.state.exporting;
    const int last = last_exported_frame(context);
    label(context, "Frames");
    if (ImGui::RadioButton(("All " + std::to_string(last + 1)).c_str(), choices.all_frames))
        choices.all_frames = true;
    record_item("export/all_frames");
    item_tooltip(frames_text(context));
    ImGui::SameLine(0, context.px(16));
    if (ImGui::RadioButton("From", !choices.all_frames)) {
        choices.all_frames = false;
        if (choices.last == 0)
            choices.last = last;
    }
    record_item("export/some_frames");
    ImGui::SameLine(0, context.px(8));
    ImGui::BeginDisabled(choices.all_frames);
    int first = choices.all_frames ? 0 : std::min(choices.first, last),
        end = choices.all_frames ? last : std::min(choices.last, last);
    if (number(context, "first", first, 0, last, "First frame; 0 is rest."))
        choices.first = first;
    ImGui::SameLine(0, context.px(8));
    ImGui::TextUnformatted("to");
    ImGui::SameLine(0, context.px(8));
    if (number(context, "last", end, 0, last, "Last frame; it is always among them."))
        choices.last = std::max(end, first);
    ImGui::EndDisabled();
    ImGui::SameLine(0, context.px(16));
    ImGui::TextUnformatted("every");
    ImGui::SameLine(0, context.px(8));
    number(context, "step", choices.step, 1, std::max(1, last),
           "1: every frame, 2: every other one, and so on.\nDefault: 1.");
}

void ExportDialog::draw_morphs(EditorContext& context) {
    ExportChoices& choices = context.state.exporting;
    label(context, "Shapes");
    number(context, "morph_targets", choices.morph_targets, 1, 1000,
           "Shapes (morph targets) beside the first, 1 to 1000: of more frames every other one is taken, or "
           "every\n"
           "third, and other programs blend between them. Browsers are slow beyond 64.\nDefault: 64.");
    ImGui::SameLine(0, context.px(8));
    const auto shapes =
        spread_frames(static_cast<std::size_t>(picture_count(context)), choices.morph_targets).size();
    ImGui::TextUnformatted(
        ("at most; " + std::to_string(shapes > 0 ? shapes - 1 : 0) + " for these frames").c_str());
    record_item("export/morph_count");
}

void ExportDialog::draw_up(EditorContext& context) {
    ExportChoices& choices = context.state.exporting;
    label(context, "Up axis");
    for (const char axis : {'z', 'y'}) {
        if (ImGui::RadioButton(std::string(1, axis).c_str(), choices.up == axis))
            choices.up = axis;
        record_item(std::string("export/up/") + axis);
        item_tooltip(
            "Axis of the scene that points up, so that it stands upright elsewhere: z in medical data\n"
            "(LPS), y in OpenSim's. Nothing is mirrored.\nDefault: z.");
        ImGui::SameLine(0, context.px(12));
    }
    ImGui::NewLine();
}

void ExportDialog::draw_size(EditorContext& context) {
    ExportChoices& choices = context.state.exporting;
    label(context, "Size");
    for (int scale = 1; scale <= 4; ++scale) {
        const std::string name = std::to_string(scale) + "x";
        if (ImGui::RadioButton(name.c_str(), choices.scale == scale))
            choices.scale = scale;
        record_item("export/scale/" + std::to_string(scale));
        item_tooltip("Times the size of the view on the screen, drawn anew, not stretched.");
        ImGui::SameLine(0, context.px(12));
    }
    if (ImGui::RadioButton("Own", choices.scale == 0))
        choices.scale = 0;
    record_item("export/scale/own");
    item_tooltip("Width and height in pixels.");
    const auto [w, h] = picture_size(context);
    label(context, "");
    if (choices.scale == 0) {
        number(context, "width", choices.width, 16, 16384, "Width in pixels, 16 to 16384.");
        ImGui::SameLine(0, context.px(6));
        ImGui::TextUnformatted("x");
        ImGui::SameLine(0, context.px(6));
        number(context, "height", choices.height, 16, 16384, "Height in pixels, 16 to 16384.");
        ImGui::SameLine(0, context.px(8));
        ImGui::TextUnformatted("pixels");
    } else {
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted((std::to_string(w) + " x " + std::to_string(h) + " pixels").c_str());
    }
    if (!output::export_kind(choices.kind).traits.clear)
        return;
    ImGui::SameLine(0, context.px(20));
    ImGui::Checkbox("Transparent background", &choices.transparent);
    record_item("export/transparent");
    item_tooltip("Nothing behind bones and muscles: for slides and posters.\nDefault: off.");
}

void ExportDialog::draw_speed(EditorContext& context) {
    ExportChoices& choices = context.state.exporting;
    const double most = choices.kind == "gif" ? gif_most_fps : 120.0;
    label(context, "Speed");
    ImGui::SetNextItemWidth(context.px(64));
    ImGui::InputDouble("##fps", &choices.fps, 0, 0, "%.4g");
    record_item("export/fps");
    item_tooltip(choices.kind == "gif" ? "Pictures a second, 1 to 50; a GIF cannot be faster.\nDefault: 25."
                                       : "Pictures a second, 1 to 120.\nDefault: 25.");
    choices.fps = choices.fps >= 1 ? std::min(choices.fps, most) : 1;
    ImGui::SameLine(0, context.px(8));
    ImGui::TextUnformatted(speed_text(context, picture_count(context), request(context)).c_str());
}

/// The folder to write into.
void ExportDialog::draw_target(EditorContext& context, ImVec2 size) {
    paragraph(context.theme.text, "Folder to write into", size.x);
    browser_.draw(context, {size.x, size.y - ImGui::GetTextLineHeightWithSpacing()});
}

} // namespace fascicle::editor
