#include "editor/dialogs/mesh_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/format_registry.hpp"

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

constexpr const char* popup_name = "Add meshes";

std::string count_text(int n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

} // namespace

MeshDialog::MeshDialog() : browser_(mesh_extensions()) {}

void MeshDialog::open() {
    if (!open_) {
        open_ = appears_ = true;
        problem_.clear();
    }
}

void MeshDialog::open_with(const std::vector<fs::path>& files) {
    if (files.empty())
        return;
    open();
    browser_.go_to(files.back());
    selected_ = batch_.add(files);
}

void MeshDialog::close() {
    if (open_ && appears_)
        return; // it waits behind another dialog, which is the one that is closed
    batch_.clear();
    preview_.release();
    selected_ = -1;
    seen_ready_ = 0;
    problem_.clear();
    open_ = false;
}

void MeshDialog::poll(EditorContext& context) {
    std::vector<std::string> problems;
    const std::vector<fs::path> lines = batch_.poll(context.document.scene(), problems);
    for (const std::string& problem : problems)
        context.log.add(Severity::error, problem);
    for (const fs::path& file : lines) {
        context.features.loader.load_surface_fibres(context, file);
        if (batch_.entries().empty())
            open_ = false;
    }
    if (batch_.ready_count() > seen_ready_)
        preview_.frame();
    seen_ready_ = batch_.ready_count();
    const int count = static_cast<int>(batch_.entries().size());
    selected_ = count == 0 ? -1 : std::clamp(selected_, 0, count - 1);
}

void MeshDialog::draw(EditorContext& context) {
    if (!open_)
        return;
    poll(context);
    if (!open_)
        return close();
    bool keep = true;
    if (!begin_modal(context, popup_name, appears_, 1140, 700, &keep)) {
        if (!appears_) // else another dialog is in front: one question after the other
            close();   // Esc closed it
        return;
    }
    const ImVec2 place = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    record_item("mesh", {place, {place.x + size.x, place.y + size.y}});
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float foot = ImGui::GetFrameHeight() + context.px(8) + ImGui::GetStyle().ItemSpacing.y;
    draw_columns(context, {room.x, std::max(40.0f, room.y - foot)});
    ImGui::Dummy({1, context.px(1)});
    draw_foot(context, room.x);
    if (!keep)
        close();
    if (!open_)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

/// Files and list at the left, picture in the middle, choices at the right; in a narrow window without the picture.
void MeshDialog::draw_columns(EditorContext& context, ImVec2 room) {
    const float gap = context.px(12);
    const bool wide = room.x > context.px(820);
    const float left = wide ? context.px(270) : room.x * 0.45f;
    const float right = wide ? context.px(300) : room.x - left - gap;
    if (ImGui::BeginChild("left", {left, room.y}, false, ImGuiWindowFlags_NoScrollbar)) {
        const float list = std::clamp(context.px(34.0f + 34.0f * static_cast<float>(batch_.entries().size())),
                                      context.px(80), room.y * 0.5f);

        if (browser_.draw(context, {left, std::max(60.0f, room.y - list - context.px(8))}) &&
            !browser_.chosen().empty())
            selected_ = batch_.add({browser_.chosen()});
        ImGui::Dummy({1, context.px(2)});
        draw_list(context, {left, ImGui::GetContentRegionAvail().y});
    }
    ImGui::EndChild();
    selected_ = std::min(selected_, static_cast<int>(batch_.entries().size()) - 1); // one may have gone
    ImGui::SameLine(0, gap);
    if (wide) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = room.x - left - right - 2 * gap;
        preview_.draw(context, batch_, selected_, {at, {at.x + width, at.y + room.y}});
        ImGui::SetCursorScreenPos({at.x + width + gap, at.y});
    }
    if (ImGui::BeginChild("details", {right, room.y}))
        draw_details(context);
    ImGui::EndChild();
}

void MeshDialog::draw_list(EditorContext& context, ImVec2 size) {
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
    ImGui::TextUnformatted(batch_.entries().empty() ? "To add: nothing yet" : "To add");
    ImGui::PopStyleColor();
    const float height = std::max(20.0f, size.y - ImGui::GetTextLineHeightWithSpacing());
    ImGui::PushStyleColor(ImGuiCol_ChildBg, context.theme.plot);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    if (ImGui::BeginChild("list", {size.x, height}))
        for (int i = 0; i < static_cast<int>(batch_.entries().size()); ++i) {
            const std::size_t before = batch_.entries().size();
            draw_row(context, i, ImGui::GetContentRegionAvail().x);
            if (batch_.entries().size() != before)
                break; // taken out of the list
        }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

void MeshDialog::draw_row(EditorContext& context, int index, float width) {
    const Theme& theme = context.theme;
    const MeshEntry& entry = batch_.entries()[static_cast<std::size_t>(index)];
    const std::string id = "mesh/entry/" + entry.path.filename().string();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = context.px(34), close = context.px(24);
    ImGui::PushID(entry.path.string().c_str());
    if (ImGui::Selectable("##row", index == selected_, 0, {std::max(1.0f, width - close), height}))
        selected_ = index;
    record_item(id);
    item_tooltip(entry.problem.empty() ? entry.path.string() : entry.problem);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float x = at.x + context.px(10), right = at.x + width - close - context.px(4);
    std::string what = "waiting";
    ImU32 colour = index == selected_ ? theme.text_dim : theme.text_faint;
    if (!entry.problem.empty()) {
        what = "cannot be read";
        colour = theme.bad;
    } else if (entry.read != nullptr) {
        const bool bone = entry.role == actions::MeshRole::bone;
        what = std::string(bone ? entry.moving ? "Moving bone" : "Bone" : "Muscle") + ", " +
               count_text(entry.surface().report.triangles, "triangle", "triangles");
        if (!entry.obstacle().empty()) {
            what = std::string("Cannot be a ") + (bone ? "bone" : "muscle");
            colour = theme.bad;
        }
    }
    const float half = height / 2;
    draw_text_in(list, {{x, at.y + context.px(2)}, {right, at.y + half + context.px(1)}}, theme.text,
                 entry.name);
    draw_text_in(list, {{x, at.y + half - context.px(1)}, {right, at.y + height - context.px(2)}}, colour,
                 what);
    ImGui::SetCursorScreenPos({at.x + width - close, at.y + (height - close) / 2});
    if (icon_button(context, (id + "/remove").c_str(), icons::close, false, true, "Leave this file out", 24))
        batch_.remove(index);
    ImGui::SetCursorScreenPos({at.x, at.y + height});
    ImGui::PopID();
}

void MeshDialog::draw_foot(EditorContext& context, float width) {
    const Theme& theme = context.theme;
    std::string why;
    const bool ready = batch_.ready(why);
    const float button = context.px(130), cancel = context.px(90), space = context.px(8);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = width - button - cancel - 2 * space, line = ImGui::GetFrameHeight();
    const int all = static_cast<int>(batch_.entries().size());
    if (batch_.reading()) {
        const float done = static_cast<float>(batch_.done_count()) / static_cast<float>(std::max(1, all));
        ImGui::PushStyleColor(ImGuiCol_PlotHistogram, theme.accent_dim);
        ImGui::ProgressBar(
            done, {std::min(room, context.px(320)), line},
            ("Read " + std::to_string(batch_.done_count()) + " of " + std::to_string(all)).c_str());
        ImGui::PopStyleColor();
        record_item("mesh/progress");
    } else {
        const bool serious = !problem_.empty() || (batch_.ready_count() > 0 && !ready);
        const int unread = all - batch_.ready_count();
        const std::string text =
            !problem_.empty() ? problem_
            : !why.empty()    ? why
            : unread > 0      ? count_text(unread, "file", "files") + " cannot be read and will be left out."
                              : "";
        draw_text_in(*ImGui::GetWindowDrawList(), {at, {at.x + room, at.y + line}},
                     serious ? theme.bad : theme.text_faint, text);
    }
    ImGui::SetCursorScreenPos({at.x + width - button - cancel - space, at.y});
    if (ImGui::Button("Cancel", {cancel, 0}))
        close();
    record_item("mesh/cancel");
    item_tooltip("Adds nothing (Esc).");
    ImGui::SameLine(0, space);
    ImGui::BeginDisabled(!ready);
    ImGui::PushStyleColor(ImGuiCol_Button, theme.accent_dim);
    const int count = batch_.ready_count();
    const std::string label = count > 1 ? "Add " + std::to_string(count) + " meshes" : "Add to scene";
    if (ImGui::Button((label + "###add").c_str(), {button, 0}) || (ready && browser_.confirmed()))
        load(context);
    ImGui::PopStyleColor();
    record_item("mesh/add");
    ImGui::EndDisabled();
    item_tooltip(ready ? "Adds them in one step of the history." : why);
}

void MeshDialog::load(EditorContext& context) {
    try {
        const std::vector<actions::NewMesh> meshes = batch_.meshes();
        const std::size_t bones = context.document.scene().bones.size(),
                          muscles = context.document.scene().muscles.size();
        actions::add_meshes(context.document, meshes);
        const Scene& scene = context.document.scene();
        const bool muscle = scene.muscles.size() > muscles;
        for (const actions::NewMesh& mesh : meshes)
            context.log.add(Severity::note,
                            std::string(mesh.role == actions::MeshRole::bone ? "Bone " : "Muscle ") +
                                "added from " + mesh.path.string());
        if (meshes.size() == 1 || muscle)
            context.state.selection = muscle ? Selection{Selection::Kind::muscle, scene.muscles[muscles].name}
                                             : Selection{Selection::Kind::bone, scene.bones[bones].name};
        context.state.frame_view_pending = true;
        close();
    } catch (const std::exception& error) {
        problem_ = error.what();
        context.log.add(Severity::error, problem_);
    }
}

} // namespace fascicle::editor
