#include "editor/dialogs/mesh_dialog.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/io/format_registry.hpp"

#include <chrono>
#include <cstdio>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> mesh_extensions() {
    std::vector<std::string> all;
    for (const MeshFormat& format : mesh_formats())
        all.insert(all.end(), format.extensions.begin(), format.extensions.end());
    return all;
}

constexpr const char* popup_name = "Open mesh";

} // namespace

MeshDialog::MeshDialog() : browser_(mesh_extensions()) {}

void MeshDialog::open() {
    open_ = appears_ = true;
    problem_.clear();
}

void MeshDialog::open_with(const std::vector<fs::path>& files) {
    waiting_.insert(waiting_.end(), files.begin(), files.end());
    if (!open_ && !waiting_.empty())
        next();
}

void MeshDialog::close() {
    waiting_.clear();
    next();
}

/// The next waiting file, or nothing more.
void MeshDialog::next() {
    mesh_.reset();
    problem_.clear();
    if (waiting_.empty()) {
        open_ = false;
        return;
    }
    open();
    browser_.go_to(waiting_.front());
    waiting_.pop_front();
    start_reading();
}

void MeshDialog::start_reading() {
    mesh_.reset();
    problem_.clear();
    scale_ = 1;
    file_ = browser_.chosen();
    if (!file_.empty())
        reading_ = std::async(std::launch::async, [path = file_] { return read_mesh_file(path); });
}

void MeshDialog::poll(EditorContext& context) {
    if (!reading_.valid() || reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    try {
        mesh_ = reading_.get();
        // A closed surface is most likely a muscle, an open one can only be a bone.
        role_ = mesh_->report.closed() && !context.document.scene().bones.empty() ? actions::MeshRole::muscle
                                                                                  : actions::MeshRole::bone;
        const auto guess = actions::guess_unit(mesh_->mesh);
        const LengthUnit unit = context.document.scene().unit;
        if (guess && *guess != unit) // offered, shown, and one click away from being undone
            scale_ = millimetres_per_unit(*guess) / millimetres_per_unit(unit);
    } catch (const std::exception& error) {
        problem_ = error.what();
        context.log.add(Severity::error, problem_);
    }
}

void MeshDialog::draw(EditorContext& context) {
    if (!open_)
        return;
    poll(context);
    if (appears_) {
        ImGui::OpenPopup(popup_name);
        appears_ = false;
    }
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const ImVec2 size{std::min(window.x * 0.94f, context.px(840)),
                      std::min(window.y * 0.92f, context.px(520))};
    ImGui::SetNextWindowSize(size);
    ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    bool keep = true;
    if (!ImGui::BeginPopupModal(popup_name, &keep,
                                ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings)) {
        open_ = false; // Esc closed it
        waiting_.clear();
        return;
    }
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float foot = ImGui::GetFrameHeight() + context.px(10) + 2 * ImGui::GetStyle().ItemSpacing.y,
                right = std::min(room.x * 0.45f, context.px(330));
    const float height = room.y - foot;
    ImGui::BeginGroup();
    if (browser_.draw(context, {room.x - right - context.px(14), height}))
        start_reading();
    ImGui::EndGroup();
    ImGui::SameLine(0, context.px(14));
    if (ImGui::BeginChild("facts", {right, height}))
        draw_facts(context, {right, height});
    ImGui::EndChild();
    ImGui::Dummy({1, context.px(4)});

    const bool ready = mesh_.has_value();
    const float button = context.px(110);
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room.x - 2 * button - context.px(8));
    if (ImGui::Button("Cancel", {button, 0}))
        keep = false;
    record_item("mesh/cancel");
    ImGui::SameLine(0, context.px(8));
    ImGui::BeginDisabled(!ready);
    ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    if (ImGui::Button("Add to scene", {button, 0}) || (ready && browser_.confirmed()))
        load(context);
    ImGui::PopStyleColor();
    record_item("mesh/add");
    ImGui::EndDisabled();
    item_tooltip(ready ? "" : "Choose a mesh file first.");
    if (!keep)
        close();
    if (!open_)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void MeshDialog::draw_facts(EditorContext& context, ImVec2 size) {
    const Theme& theme = context.theme;
    const auto line = [&](ImU32 colour, const std::string& text) {
        ImGui::PushStyleColor(ImGuiCol_Text, colour);
        ImGui::PushTextWrapPos(size.x);
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
    };
    if (!problem_.empty())
        return line(theme.bad, problem_);
    if (reading_.valid())
        return line(theme.text_dim, "Reading " + file_.filename().string());
    if (!mesh_)
        return line(theme.text_faint, "Choose a mesh. Files can also be dropped on the window.");
    line(theme.text, file_.filename().string());
    const std::string kind = mesh_->report.closed() ? "closed surface" : "surface with holes";
    line(theme.text_dim, mesh_->format + ", " + std::to_string(mesh_->mesh.vertex_count()) + " vertices, " +
                             std::to_string(mesh_->mesh.triangle_count()) + " triangles, " + kind);
    const Vec3 box = bounding_box(mesh_->mesh.positions, mesh_->mesh.triangles).size() * scale_;
    char text[120];
    std::snprintf(text, sizeof text, "%.4g x %.4g x %.4g %s", box.x(), box.y(), box.z(),
                  to_text(context.document.scene().unit));
    line(theme.text_dim, text);
    ImGui::Dummy({1, context.px(8)});
    draw_choices(context);
    ImGui::Dummy({1, context.px(8)});
    for (const std::string& note : mesh_->report.lines())
        line(theme.warning, note);
    for (const std::string& note : mesh_->notes)
        line(theme.text_dim, note);
}

void MeshDialog::draw_choices(EditorContext& context) {
    using actions::MeshRole;
    const Scene& scene = context.document.scene();
    if (ImGui::RadioButton("Muscle", role_ == MeshRole::muscle))
        role_ = MeshRole::muscle;
    record_item("mesh/muscle");
    item_tooltip("It will be deformed. Needs a closed surface.");
    ImGui::SameLine(0, context.px(18));
    if (ImGui::RadioButton("Bone", role_ == MeshRole::bone))
        role_ = MeshRole::bone;
    record_item("mesh/bone");
    item_tooltip("Rigid; muscles attach to it and cannot enter it.");
    if (scene.timeline.hinge && role_ == MeshRole::bone) {
        ImGui::Checkbox("Turns with the joint", &moving_);
        record_item("mesh/moving");
    }
    ImGui::Dummy({1, context.px(4)});
    ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Coordinates times");
    ImGui::PopStyleColor();
    for (const double factor : {0.001, 1.0, 1000.0}) {
        ImGui::SameLine(0, context.px(10));
        if (ImGui::RadioButton(number_text(factor).c_str(), scale_ == factor))
            scale_ = factor;
        record_item("mesh/scale/" + number_text(factor));
        item_tooltip("The scene is in " + std::string(to_text(scene.unit)) +
                     ".\nMeshes smaller than 5 are taken for metres, others for millimetres.");
    }
}

void MeshDialog::load(EditorContext& context) {
    try {
        const int index = actions::add_mesh(context.document, role_, file_, *mesh_, scale_, moving_);
        const auto i = static_cast<std::size_t>(index);
        const Scene& scene = context.document.scene();
        const bool bone = role_ == actions::MeshRole::bone;
        const std::string name = bone ? scene.bones[i].name : scene.muscles[i].name;
        context.log.add(Severity::note,
                        std::string(bone ? "Bone " : "Muscle ") + name + " added from " + file_.string());
        context.state.selection = {bone ? Selection::Kind::bone : Selection::Kind::muscle, name};
        context.state.frame_view_pending = true;
        next();
    } catch (const std::exception& error) {
        problem_ = error.what();
        context.log.add(Severity::error, problem_);
    }
}

} // namespace fascicle::editor
