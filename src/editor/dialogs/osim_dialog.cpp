#include "editor/dialogs/osim_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/io/format_registry.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace fascicle::editor {

namespace {

std::vector<std::string> extensions() {
    std::vector<std::string> all{".osim", ".mot", ".sto"};
    for (const MeshFormat& format : mesh_formats())
        all.insert(all.end(), format.extensions.begin(), format.extensions.end());
    return all;
}

void fact(const EditorContext& context, const char* label, const std::string& value, ImU32 colour) {
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(context.px(76));
    wrapped_text(colour, value);
}

/// A combo of fixed choices; `chosen` is an index.
bool choose(const EditorContext& context, const char* label, const char* id,
            const std::vector<const char*>& names, int& chosen, const char* tip) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(context.px(76));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    bool changed = false;
    ImGui::PushID(id);
    if (ImGui::BeginCombo("##choice", names[static_cast<std::size_t>(chosen)])) {
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (ImGui::Selectable(names[i], static_cast<int>(i) == chosen)) {
                chosen = static_cast<int>(i);
                changed = true;
            }
            record_item(std::string(id) + "/" + std::to_string(i));
        }
        ImGui::EndCombo();
    }
    record_item(id);
    item_tooltip(tip);
    ImGui::PopID();
    return changed;
}

} // namespace

OsimDialog::OsimDialog() : browser_(extensions(), "No models, motions or meshes here") {}

void OsimDialog::open() {
    appears_ = true;
}

void OsimDialog::close() {
    if (std::exchange(in_front_, false))
        choice_.clear();
}

void OsimDialog::document_replaced() {
    if (!in_front_)
        choice_.clear();
}

void OsimDialog::draw_facts(EditorContext& context) {
    const auto file = [](const std::filesystem::path& path) {
        return path.empty() ? std::string("not chosen") : path.filename().string();
    };
    const Theme& theme = context.theme;
    fact(context, "Model", file(choice_.model()), choice_.model().empty() ? theme.text_faint : theme.text);
    fact(context, "Trial", file(choice_.trial()), choice_.trial().empty() ? theme.text_faint : theme.text);
    if (choice_.reading())
        fact(context, "", "Reading...", theme.text_dim);
    if (!choice_.problem().empty())
        wrapped_text(theme.bad, choice_.problem());
    if (!choice_.preview())
        return;
    const OsimPreview& p = *choice_.preview();
    int bones = 0;
    std::string missing;
    for (const OsimPreview::BodyRow& body : p.bodies) {
        bones += body.meshes_found > 0 ? 1 : 0;
        for (const std::string& name : body.missing)
            missing += (missing.empty() ? "" : ", ") + name;
    }
    fact(context, "Holds",
         std::to_string(p.bodies.size()) + " bodies, " + std::to_string(bones) + " with a mesh; " +
             std::to_string(p.coordinates) + " coordinates, " + std::to_string(p.muscles.size()) + " muscles",
         theme.text);
    record_item("osim/holds");
    if (!missing.empty())
        fact(context, "Not found", missing.size() > 120 ? missing.substr(0, 120) + " ..." : missing,
             theme.warning);
    if (p.rows > 0) {
        char text[120];
        std::snprintf(text, sizeof text, "%zu rows, %.3g to %.3g s, %zu of %zu coordinates", p.rows, p.from_s,
                      p.to_s, p.driven.size(), p.coordinates);
        fact(context, "Moves", text, theme.text);
        record_item("osim/moves");
    }
}

void OsimDialog::draw_body(const char* id, std::string& body, bool may_be_none, bool& guessed) {
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::PushID(id);
    if (ImGui::BeginCombo("##body", body.empty() ? "no body" : body.c_str())) {
        if (may_be_none && ImGui::Selectable("no body", body.empty())) {
            body.clear();
            guessed = false;
        }
        for (const OsimPreview::BodyRow& row :
             choice_.preview() ? choice_.preview()->bodies : std::vector<OsimPreview::BodyRow>{}) {
            if (ImGui::Selectable(row.name.c_str(), row.name == body)) {
                body = row.name;
                guessed = false;
            }
            record_item(std::string(id) + "/" + row.name);
        }
        ImGui::EndCombo();
    }
    record_item(id);
    item_tooltip(guessed ? "A body of the model\nGuessed from names: look at it." : "A body of the model");
    ImGui::PopID();
}

void OsimDialog::draw_rows(EditorContext& context, float height) {
    std::vector<OsimChoice::Row>& rows = choice_.rows();
    if (!ImGui::BeginTable("meshes", 5, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg, {0, height}))
        return;
    ImGui::TableSetupColumn("Mesh", ImGuiTableColumnFlags_WidthStretch, 1.4f);
    ImGui::TableSetupColumn("Is a", ImGuiTableColumnFlags_WidthFixed, context.px(76));
    ImGui::TableSetupColumn("Origin, or body", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("Insertion", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, context.px(24));
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    std::size_t removed = rows.size();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        OsimChoice::Row& row = rows[i];
        const std::string name = row.mesh.filename().string(), id = "osim/mesh/" + name;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(name.c_str());
        record_item(id);
        ImGui::TableNextColumn();
        if (row.stand_in) {
            ImGui::AlignTextToFramePadding();
            ImGui::TextDisabled("stand-in");
            item_tooltip("A spindle about the path of the model's line muscle, of the volume that its force "
                         "and fibre length imply.");
        } else {
            ImGui::PushID(id.c_str());
            if (ImGui::Button(row.bone ? "bone" : "muscle", {ImGui::GetContentRegionAvail().x, 0}))
                row.bone = !row.bone;
            ImGui::PopID();
            record_item(id + "/role");
            item_tooltip("Bone or muscle; a click changes it.");
        }
        ImGui::TableNextColumn();
        ImGui::BeginDisabled(row.stand_in);
        draw_body((id + "/origin").c_str(), row.origin, false, row.guessed);
        ImGui::TableNextColumn();
        if (!row.bone)
            draw_body((id + "/insertion").c_str(), row.insertion, true, row.guessed);
        ImGui::EndDisabled();
        ImGui::TableNextColumn();
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::SmallButton("x"))
            removed = i;
        ImGui::PopID();
        record_item(id + "/remove");
        item_tooltip("Leaves it out.");
    }
    ImGui::EndTable();
    if (removed < rows.size())
        choice_.remove(removed);
}

void OsimDialog::draw_stand_ins(EditorContext& context) {
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::BeginDisabled(!choice_.preview());
    if (ImGui::BeginCombo("##stand_in", "Add a muscle that has no mesh...")) {
        // A list that is open stays open while what it shows is read anew, or cannot be.
        const std::vector<OsimPreview::MuscleRow> none;
        for (const OsimPreview::MuscleRow& muscle : choice_.preview() ? choice_.preview()->muscles : none) {
            const auto has_mesh = [&](const std::string& body) {
                return std::any_of(choice_.preview()->bodies.begin(), choice_.preview()->bodies.end(),
                                   [&](const auto& b) { return b.name == body && b.meshes_found > 0; }) ||
                       std::any_of(choice_.rows().begin(), choice_.rows().end(),
                                   [&](const auto& row) { return row.bone && row.origin == body; });
            };
            const bool possible =
                muscle.volume_cm3 > 0 && has_mesh(muscle.origin) && has_mesh(muscle.insertion);
            char text[200];
            std::snprintf(text, sizeof text, "%s: %s to %s, %.0f cm\u00b3", muscle.name.c_str(),
                          muscle.origin.c_str(), muscle.insertion.c_str(), muscle.volume_cm3);
            if (ImGui::Selectable(text, false, possible ? 0 : ImGuiSelectableFlags_Disabled))
                choice_.add_stand_in(muscle.name);
            record_item("osim/stand_in/" + muscle.name);
        }
        ImGui::EndCombo();
    }
    record_item("osim/stand_in");
    ImGui::EndDisabled();
    item_tooltip("Line muscles of the model between bodies that have a bone: a spindle about the path stands "
                 "in for the surface.");
    (void)context;
}

void OsimDialog::draw_options(EditorContext& context) {
    SceneRequest& r = choice_.request();
    int unit = !r.unit ? 0 : *r.unit == LengthUnit::millimetre ? 1 : 2;
    if (choose(context, "Unit", "osim/unit", {"of the meshes, from their size", "mm", "m"}, unit,
               "Length unit of the mesh files and the scene; the model is in metres.\nWhat was guessed is in "
               "the messages."))
        r.unit =
            unit == 0 ? std::nullopt : std::optional(unit == 1 ? LengthUnit::millimetre : LengthUnit::metre);
    int frame = !r.osim.mesh_frame ? 0 : 1 + static_cast<int>(*r.osim.mesh_frame);
    if (choose(context, "Meshes lie", "osim/frame",
               {"where muscles fit the bones best", "in their body's frame", "in the model's ground",
                "as scanned, one frame for all bodies"},
               frame, "Where the vertices of the mesh files are.\nWhat was guessed is in the messages."))
        r.osim.mesh_frame = frame == 0 ? std::nullopt : std::optional(static_cast<MeshFrame>(frame - 1));
    std::vector<const char*> names;
    int axes = 0;
    for (const AxisMappingRow& row : axis_mappings()) {
        if (row.mapping == r.osim.axes)
            axes = static_cast<int>(names.size());
        names.push_back(row.label);
    }
    if (choose(context, "Axes", "osim/axes", names, axes,
               "Turns the whole model. Views are named for x left, y posterior, z up;\nmost models are Y up: "
               "OpenSim to LPS."))
        r.osim.axes = axis_mappings()[static_cast<std::size_t>(axes)].mapping;
    if (!choice_.preview() || choice_.preview()->driven.empty())
        return;
    std::vector<const char*> coordinates{"the one that turns most"};
    int chosen = 0;
    for (const std::string& name : choice_.preview()->driven) {
        if (name == r.osim.coordinate)
            chosen = static_cast<int>(coordinates.size());
        coordinates.push_back(name.c_str());
    }
    if (choose(context, "Angle", "osim/coordinate", coordinates, chosen,
               "The coordinate that the plots' angle is."))
        r.osim.coordinate = chosen == 0 ? std::string() : coordinates[static_cast<std::size_t>(chosen)];
}

void OsimDialog::draw(EditorContext& context) {
    choice_.poll();
    in_front_ = begin_modal(context, "Open OpenSim model", appears_, 980, 620);
    if (!in_front_)
        return;
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float foot = ImGui::GetFrameHeightWithSpacing() + context.px(12), left = 0.4f * room.x;
    ImGui::BeginChild("files", {left, room.y - foot});
    wrapped_text(context.theme.text_dim,
                 "Choose a model (.osim), a trial (.mot, .sto) and, where you have them, meshes.");
    if (browser_.draw(context, {left, ImGui::GetContentRegionAvail().y}) && !browser_.chosen().empty())
        choice_.take(browser_.chosen());
    ImGui::EndChild();
    ImGui::SameLine(0, context.px(14));
    ImGui::BeginChild("choices", {0, room.y - foot});
    draw_facts(context);
    ImGui::Dummy({1, context.px(4)});
    draw_options(context);
    ImGui::Dummy({1, context.px(4)});
    draw_stand_ins(context);
    draw_rows(context, std::max(context.px(60), ImGui::GetContentRegionAvail().y));
    ImGui::EndChild();
    std::string why;
    const SceneRequest request = choice_.finished(why);
    button_row(context, 2);
    const bool cancel = row_button(context, "osim/cancel", "Cancel", "Opens nothing (Esc)");
    const bool go = row_button(context, "osim/open", "Open", "Makes the scene, in place of this one",
                               ButtonKind::primary, why);
    if (cancel || go)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    // What was chosen stays until its scene is there: for who does not want to lose changes after all, or mends a file.
    if (go) {
        in_front_ = false;
        unless_unsaved(context, "opening " + request.osim.model.filename().string(),
                       [request](EditorContext& c) { c.features.opener.open(request); });
    }
    if (cancel)
        close();
}

} // namespace fascicle::editor
