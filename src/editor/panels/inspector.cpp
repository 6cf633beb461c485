#include "editor/panels/panels.hpp"

#include "editor/commands.hpp"
#include "editor/frame_axis.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/document/actions/scene_actions.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "fascicle/geometry/volume.hpp"
#include "view/attachment_marks.hpp"

#include <cstdio>
#include <imgui_stdlib.h>
#include <numbers>
#include <utility>

namespace fascicle::editor {

namespace {

template <class... Args>
std::string print(const char* format, Args... args) {
    char buffer[160];
    std::snprintf(buffer, sizeof buffer, format, args...);
    return buffer;
}

ImU32 packed(const render::Rgba& c) {
    return ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], c[3]});
}

/// Facts of what is selected; of the scene when nothing is.
class Inspector : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(3)});
        const Scene& scene = context.document.scene();
        const Selection& selection = context.state.selection;
        const int bone = selection.kind == Selection::Kind::bone ? scene.bone_index(selection.name) : -1;
        const int muscle =
            selection.kind == Selection::Kind::muscle ? scene.muscle_index(selection.name) : -1;
        if (bone >= 0)
            draw_bone(context, bone);
        else if (muscle >= 0)
            draw_muscle(context, muscle);
        else {
            take_name(context);
            draw_scene(context);
        }
        ImGui::PopStyleVar();
    }

private:
    static void fact(const EditorContext& context, const char* name, const std::string& value,
                     const char* tip = nullptr) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x, height = context.px(20), label = context.px(92);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        draw_text_in(list, {at, {at.x + label, at.y + height}}, context.theme.text_faint, name);
        draw_text_in(list, {{at.x + label, at.y}, {at.x + width, at.y + height}}, context.theme.text, value);
        ImGui::Dummy({width, height});
        item_tooltip(tip != nullptr ? tip : width - label < text_size(value).x ? value : std::string());
    }

    /// What was being typed when something else was selected, by a click in the tree or the view.
    void take_name(EditorContext& context) {
        const Scene& scene = context.document.scene();
        const std::string was = std::exchange(edited_name_for_, {});
        if (!std::exchange(typing_, false) || edited_name_ == was)
            return;
        const int bone = scene.bone_index(was), muscle = scene.muscle_index(was);
        if (bone < 0 && muscle < 0)
            return; // undone or removed meanwhile
        if ((bone >= 0 ? scene.bones[static_cast<std::size_t>(bone)].mesh
                       : scene.muscles[static_cast<std::size_t>(muscle)].mesh) != edited_mesh_)
            return; // another document has something of that name
        if (!(bone >= 0 ? actions::rename_bone(context.document, bone, edited_name_)
                        : actions::rename_muscle(context.document, muscle, edited_name_)))
            refuse_name(context);
    }

    void refuse_name(EditorContext& context) {
        context.log.add(Severity::warning, "Name '" + edited_name_ + "' is empty or taken.");
    }

    /// The name, to be typed over. Taken and empty names are refused on Enter.
    template <class Rename>
    void name_field(EditorContext& context, const std::string& name, const MeshPtr& mesh, Rename rename) {
        if (edited_name_for_ != name) {
            take_name(context);
            edited_name_ = name;
            edited_name_for_ = name;
            edited_mesh_ = mesh;
        }
        ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
        ImGui::InputText("##name", &edited_name_, ImGuiInputTextFlags_AutoSelectAll);
        record_item("selection/name");
        typing_ = ImGui::IsItemActive();
        if (ImGui::IsItemDeactivatedAfterEdit() && edited_name_ != name) {
            if (rename(edited_name_)) {
                context.state.selection.name = edited_name_;
            } else {
                refuse_name(context);
                edited_name_ = name;
            }
        }
        item_tooltip("Name\nTo be typed over.");
        ImGui::Dummy({1, context.px(2)});
    }

    static void mesh_facts(const EditorContext& context, const TriMesh& mesh, const MeshSource& source) {
        const Scene& scene = context.document.scene();
        fact(context, "Vertices", std::to_string(mesh.vertex_count()));
        fact(context, "Triangles", std::to_string(mesh.triangle_count()));
        const Vec3 size = bounding_box(mesh.positions, mesh.triangles).size();
        fact(context, "Size",
             print("%.4g x %.4g x %.4g %s", size.x(), size.y(), size.z(), to_text(scene.unit)));
        const double cubic_cm = signed_volume(mesh.positions, mesh.triangles) *
                                std::pow(millimetres_per_unit(scene.unit) / 10, 3);
        fact(context, "Volume", print("%.4g cm\xC2\xB3", cubic_cm), "Enclosed volume at rest");
        fact(context, "File", source.path.empty() ? "made by the program" : source.path);
    }

    static void motion_button(EditorContext& context) {
        if (ImGui::Button("Motion...", {ImGui::GetContentRegionAvail().x, 0}))
            run_command(context, Command::show_motion);
        record_item("selection/motion");
        item_tooltip(tooltip(Command::show_motion));
    }

    void draw_bone(EditorContext& context, int index) {
        const Bone bone = context.document.scene().bones[static_cast<std::size_t>(index)];
        name_field(context, bone.name, bone.mesh, [&](const std::string& name) {
            return actions::rename_bone(context.document, index, name);
        });
        const bool moves = actions::bone_moves(context.document.scene(), index);
        if (context.document.scene().timeline.hinge) {
            bool wanted = moves;
            if (ImGui::Checkbox("Turns with the joint", &wanted))
                actions::set_bone_moving(context.document, index, wanted);
            record_item("selection/moves");
        } else {
            fact(context, "Motion", moves ? "moves" : "stays at rest");
        }
        motion_button(context);
        mesh_facts(context, *bone.mesh, bone.source);
    }

    void draw_muscle(EditorContext& context, int index) {
        const Muscle muscle = context.document.scene().muscles[static_cast<std::size_t>(index)];
        name_field(context, muscle.name, muscle.mesh, [&](const std::string& name) {
            return actions::rename_muscle(context.document, index, name);
        });
        draw_attachments(context, muscle);
        mesh_facts(context, *muscle.mesh, muscle.source);
    }

    /// Those in force in the shown run.
    static void draw_attachments(const EditorContext& context, const Muscle& muscle) {
        const RecordingPtr recording = context.runs.recording();
        std::vector<Attachment> list = muscle.attachments;
        if (recording != nullptr) {
            const int index = recording->scene().muscle_index(muscle.name);
            const auto lists = recording->attachments();
            if (index >= 0 && static_cast<std::size_t>(index) < lists.size())
                list = lists[static_cast<std::size_t>(index)];
        }
        if (list.empty())
            fact(context, "Attachments",
                 recording == nullptr || recording->attachments().empty() ? "found by the run" : "none");
        const std::vector<Bone>& bones = context.document.scene().bones;
        for (const Attachment& attachment : list) {
            const auto bone = static_cast<std::size_t>(attachment.bone);
            const std::string where = attachment.bone >= 0 && bone < bones.size() ? bones[bone].name : "?";
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float size = context.px(8);
            const char* kind = attachment.kind == AttachmentKind::unknown  ? "Attachment"
                               : attachment.kind == AttachmentKind::origin ? "Origin"
                                                                           : "Insertion";
            fact(context, kind, where + ", " + std::to_string(attachment.vertices.size()) + " vertices");
            const float x = at.x + context.px(78), y = at.y + context.px(10);
            ImGui::GetWindowDrawList()->AddRectFilled({x, y - size / 2}, {x + size, y + size / 2},
                                                      packed(view::attachment_colour(attachment.kind)),
                                                      context.px(2));
        }
    }

    static void draw_scene(EditorContext& context) {
        const Scene& scene = context.document.scene();
        std::size_t triangles = 0;
        for (const Bone& bone : scene.bones)
            triangles += bone.mesh->triangles.size();
        for (const Muscle& muscle : scene.muscles)
            triangles += muscle.mesh->triangles.size();
        fact(context, "Triangles", std::to_string(triangles));
        fact(context, "Unit", scene.unit == LengthUnit::millimetre ? "millimetre" : "metre");
        const double seconds = scene.timeline.last_frame * frame_seconds(scene);
        fact(context, "Length", print("%d frames, %.3g s", scene.timeline.last_frame, seconds));
        double low = 0, high = 0;
        for (const AngleKey& key : scene.timeline.angles) {
            low = std::min(low, key.angle_rad);
            high = std::max(high, key.angle_rad);
        }
        const double degrees = 180 / std::numbers::pi;
        if (scene.timeline.hinge)
            fact(context, "Joint", print("%.4g\xC2\xB0 to %.4g\xC2\xB0", low * degrees, high * degrees));
        const RecordingPtr recording = context.runs.recording();
        if (recording != nullptr && recording->prepare_seconds() > 0)
            fact(context, "Prepared in", print("%.2f s", recording->prepare_seconds()),
                 "Attachments, distance grids and constraints of the run");
        if (!scene.bones.empty()) {
            ImGui::Dummy({1, context.px(2)});
            motion_button(context);
        }
    }

    std::string edited_name_, edited_name_for_;
    MeshPtr edited_mesh_; ///< of what that name is
    bool typing_ = false; ///< a name, in the frame before
};

} // namespace

std::unique_ptr<Panel> make_inspector() {
    return std::make_unique<Inspector>();
}

} // namespace fascicle::editor
