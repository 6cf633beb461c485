#include "editor/dialogs/repair_dialog.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/document/actions/repair_actions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::editor {

namespace {

constexpr double settle_seconds = 0.3; ///< choices must rest for so long before a job is worth beginning

} // namespace

void RepairDialog::open(EditorContext& context) {
    const Scene& scene = context.document.scene();
    object_ = context.state.selection;
    const int bone = object_.kind == Selection::Kind::bone ? scene.bone_index(object_.name) : -1;
    const int muscle = object_.kind == Selection::Kind::muscle ? scene.muscle_index(object_.name) : -1;
    if (bone < 0 && muscle < 0)
        return;
    input_ = bone >= 0 ? scene.bones[static_cast<std::size_t>(bone)].mesh
                       : scene.muscles[static_cast<std::size_t>(muscle)].mesh;
    mm_ = static_cast<int>(millimetres_per_unit(scene.unit));
    choices_ = {};
    outcome_.reset();
    problem_.clear();
    open_ = appears_ = changed_ = show_after_ = true;
    changed_at_ = -settle_seconds;
    batch_.clear();
}

void RepairDialog::close() {
    open_ = changed_ = false;
    if (job_ != nullptr) {
        job_->cancel();
        given_up_.push_back(std::move(job_));
    }
    outcome_.reset();
    batch_.clear();
    preview_.release();
    input_ = nullptr;
}

RepairOptions RepairDialog::options(const EditorContext& context) const {
    RepairOptions o;
    if (choices_.own_weld)
        o.weld = choices_.weld_mm / mm_;
    o.fill_edges = choices_.fill_edges;
    if (choices_.fill_large)
        o.fill_share = std::numeric_limits<double>::infinity();
    o.island_share = choices_.island_percent / 100;
    o.smooth_passes = choices_.smooth_passes;
    if (choices_.remesh == 1)
        o.edge_length = choices_.edge_mm / mm_;
    if (choices_.remesh == 2)
        o.triangles = choices_.triangles;
    o.untangle = choices_.untangle;
    o.threads = hardware_threads();
    o.unit = to_text(context.document.scene().unit);
    return o;
}

void RepairDialog::poll(EditorContext& context) {
    std::erase_if(given_up_, [](const std::unique_ptr<RepairJob>& job) { return job->ready(); });
    if (!open_)
        return;
    if (changed_ && context.now - changed_at_ >= settle_seconds) {
        if (job_ != nullptr) {
            job_->cancel();
            given_up_.push_back(std::move(job_));
        }
        changed_ = false;
        job_ = std::make_unique<RepairJob>(input_, options(context));
    }
    if (job_ == nullptr || !job_->ready())
        return;
    problem_.clear();
    outcome_.reset();
    try {
        outcome_ = job_->take();
        show(show_after_);
    } catch (const Cancelled&) {
    } catch (const std::exception& error) {
        problem_ = error.what();
    }
    job_ = nullptr;
}

/// Puts one of the two meshes into the picture, in place of the scene's own.
void RepairDialog::show(bool after) {
    show_after_ = after;
    if (!outcome_)
        return;
    auto read = std::make_shared<ReadMesh>();
    read->surface = after ? outcome_->after : outcome_->before;
    MeshEntry entry;
    entry.name = entry.stands_for = object_.name;
    entry.read = std::move(read);
    entry.role = object_.kind == Selection::Kind::bone ? actions::MeshRole::bone : actions::MeshRole::muscle;
    batch_.clear();
    batch_.add_ready(std::move(entry));
}

std::string RepairDialog::why_not() const {
    if (job_ != nullptr || changed_)
        return "The repair is being tried.";
    if (!problem_.empty())
        return problem_;
    if (!outcome_)
        return "There is no result.";
    if (!outcome_->result.good())
        return "It cannot be made a closed surface with these settings.";
    if (!outcome_->result.changed())
        return "There is nothing to repair.";
    return {};
}

void RepairDialog::apply(EditorContext& context) {
    const Scene& scene = context.document.scene();
    const bool bone = object_.kind == Selection::Kind::bone;
    const int index = bone ? scene.bone_index(object_.name) : scene.muscle_index(object_.name);
    const auto i = static_cast<std::size_t>(index);
    if (index < 0 || (bone ? scene.bones[i].mesh : scene.muscles[i].mesh) != input_) {
        // Another scene was opened, or its file read anew, beneath the dialog.
        context.log.add(Severity::warning,
                        "The mesh of " + object_.name + " is another one now; nothing was replaced.");
        return;
    }
    const auto carried = (bone ? actions::replace_bone_mesh : actions::replace_muscle_mesh)(
        context.document, index, outcome_->after.mesh, outcome_->result.origins);
    std::string text = std::string(bone ? "Bone " : "Muscle ") + object_.name + " repaired";
    if (carried.before > 0)
        text += std::string(bone ? "; areas on it have " : "; fixed to bones are ") +
                std::to_string(carried.after) + " vertices in place of " + std::to_string(carried.before);
    context.log.add(Severity::note, text + ".");
}

void RepairDialog::draw(EditorContext& context) {
    poll(context);
    if (!open_)
        return;
    bool keep = true;
    const bool opening = appears_;
    const std::string title = "Repair mesh, " + object_.name + "###repair";
    if (!begin_modal(context, title.c_str(), appears_, 1060, 620, &keep)) {
        if (!opening)
            close(); // Esc closed it
        return;
    }
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    record_item("repair", {at, {at.x + size.x, at.y + size.y}});
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float gap = context.px(14), height = room.y - ImGui::GetFrameHeight() - context.px(16);
    const bool wide = room.x > context.px(820);
    const float left = wide ? context.px(270) : room.x * 0.45f;
    const float right = wide ? context.px(330) : room.x - left - gap;
    if (ImGui::BeginChild("choices", {left, height}))
        draw_choices(context);
    ImGui::EndChild();
    ImGui::SameLine(0, gap);
    if (wide) {
        draw_preview(context, {room.x - left - right - 2 * gap, height});
        ImGui::SameLine(0, gap);
    }
    if (ImGui::BeginChild("outcome", {right, height}))
        draw_outcome(context);
    ImGui::EndChild();
    draw_foot(context);
    if (!keep || !open_) {
        close();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void RepairDialog::draw_foot(EditorContext& context) {
    button_row(context, 2);
    if (row_button(context, "repair/cancel", "Cancel", "Leaves the mesh as it is."))
        open_ = false;
    if (row_button(context, "repair/apply", "Apply", "Replaces the mesh, as one step that can be undone.",
                   ButtonKind::primary, why_not())) {
        apply(context);
        open_ = false;
    }
}

} // namespace fascicle::editor
