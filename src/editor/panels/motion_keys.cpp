// Poses of single bones at single frames, as a table.
#include "editor/panels/motion.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/param_table.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace fascicle::editor {

using namespace motion_rows;
using actions::Screw;

namespace {

constexpr double degree = std::numbers::pi / 180;

template <class F>
void attempt(EditorContext& context, F change) {
    try {
        change();
    } catch (const Error& error) {
        context.document.discard_edits();
        context.log.add(Severity::error, error.what());
    }
}

const std::vector<PoseKey>& keys_of(const Scene& scene, int bone) {
    static const std::vector<PoseKey> none;
    const auto b = static_cast<std::size_t>(bone);
    return b < scene.timeline.bone_tracks.size() ? scene.timeline.bone_tracks[b].keys : none;
}

/// Points of screws are told near the joint, or near the bone where there is none.
Vec3 near_point(const EditorContext& context, int bone) {
    const Scene& scene = context.document.scene();
    if (scene.timeline.hinge)
        return scene.timeline.hinge->centre;
    const TriMesh& mesh = *scene.bones[static_cast<std::size_t>(bone)].mesh;
    return mesh.positions.empty() ? Vec3::Zero() : mesh.positions.front();
}

int draw_bone_choice(EditorContext& context) {
    MotionEdit& edit = context.features.motion;
    const Scene& scene = context.document.scene();
    if (context.state.selection.kind == Selection::Kind::bone &&
        scene.bone_index(context.state.selection.name) >= 0 &&
        edit.key_bone != context.state.selection.name) {
        edit.key_bone = context.state.selection.name; // what is selected is what is edited
        edit.key = -1;
    }
    if (scene.bone_index(edit.key_bone) < 0) {
        int first = 0;
        for (int b = static_cast<int>(scene.bones.size()) - 1; b >= 0; --b)
            if (actions::bone_moves(scene, b))
                first = b;
        edit.key_bone = scene.bones[static_cast<std::size_t>(first)].name;
        edit.key = -1;
    }
    label(context, "Bone");
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    const bool open = ImGui::BeginCombo("##bone", edit.key_bone.c_str());
    const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
    if (open) {
        for (const Bone& bone : scene.bones) {
            if (ImGui::Selectable(bone.name.c_str(), bone.name == edit.key_bone)) {
                context.state.selection = {Selection::Kind::bone, bone.name};
                edit.key_bone = bone.name;
                edit.key = -1;
            }
            record_item("motion/key_bone/" + bone.name);
        }
        ImGui::EndCombo();
    }
    record_item("motion/key_bone", frame);
    item_tooltip("The bone whose keys are shown");
    return scene.bone_index(edit.key_bone);
}

void draw_table(EditorContext& context, int bone) {
    MotionEdit& edit = context.features.motion;
    const std::vector<PoseKey>& keys = keys_of(context.document.scene(), bone);
    const float rows = static_cast<float>(std::clamp<std::size_t>(keys.size(), 3, 9)) + 1.5f;
    const ImVec2 size{ImGui::GetContentRegionAvail().x, rows * ImGui::GetFrameHeight()};
    ImGui::PushStyleColor(ImGuiCol_ChildBg, context.theme.plot);
    if (ImGui::BeginTable("keys", 3,
                          ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp,
                          size)) {
        ImGui::TableSetupScrollFreeze(0, 1);
        for (const char* title : {"Frame", "Angle", "Axis"})
            ImGui::TableSetupColumn(title, 0, *title == 'A' && title[1] == 'x' ? 2.0f : 1.0f);
        ImGui::TableHeadersRow();
        const Vec3 near = near_point(context, bone);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(keys.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                const PoseKey& key = keys[static_cast<std::size_t>(i)];
                const Screw screw = actions::screw_of(key.pose, near);
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::PushID(i);
                if (ImGui::Selectable(number_text(key.frame).c_str(), edit.key == i,
                                      ImGuiSelectableFlags_SpanAllColumns)) {
                    edit.key = i;
                    context.state.playback.playing = false;
                    context.move_playhead(static_cast<int>(key.frame));
                }
                record_item("motion/key/" + std::to_string(i));
                ImGui::PopID();
                ImGui::TableNextColumn();
                if (i == 0)
                    ImGui::TextDisabled("rest");
                else
                    ImGui::Text("%.2f\xC2\xB0", screw.angle_rad / degree);
                ImGui::TableNextColumn();
                if (i > 0 && screw.angle_rad > 1e-9)
                    ImGui::TextDisabled("%.2f  %.2f  %.2f", screw.axis.x(), screw.axis.y(), screw.axis.z());
            }
        ImGui::EndTable();
    }
    ImGui::PopStyleColor();
    if (keys.empty())
        say(context.theme.text_faint, "No keys: the bone stays at rest.");
}

void draw_buttons(EditorContext& context, int bone) {
    MotionEdit& edit = context.features.motion;
    const std::size_t count = keys_of(context.document.scene(), bone).size();
    const float half = (ImGui::GetContentRegionAvail().x - context.px(3)) / 2;
    const int frame = context.playhead();
    const std::string text = "Key at frame " + std::to_string(frame) + "###insert";
    if (button(context, "motion/insert", text.c_str(), frame > 0,
               frame > 0 ? "Sets a key at the playhead, with the pose that the bone has there."
                         : "Frame 0 is rest. Move the playhead first.",
               false, half))
        attempt(context, [&] {
            actions::set_pose_key(context.document, bone, frame,
                                  context.document.scene().timeline.bone_pose(bone, frame));
            const std::vector<PoseKey>& now = keys_of(context.document.scene(), bone);
            for (std::size_t i = 0; i < now.size(); ++i)
                if (now[i].frame == frame)
                    edit.key = static_cast<int>(i);
        });
    ImGui::SameLine(0, context.px(3));
    const bool removable = edit.key > 0 && edit.key < static_cast<int>(count);
    if (button(context, "motion/remove", "Remove key", removable,
               removable ? "Removes the selected key." : "Select a key other than rest.", false, half))
        attempt(context, [&] {
            actions::remove_pose_key(context.document, bone, static_cast<std::size_t>(edit.key));
            edit.key = -1;
        });
}

void draw_key(EditorContext& context, int bone) {
    MotionEdit& edit = context.features.motion;
    const std::vector<PoseKey>& keys = keys_of(context.document.scene(), bone);
    if (edit.key <= 0 || edit.key >= static_cast<int>(keys.size()))
        return;
    const auto index = static_cast<std::size_t>(edit.key);
    const std::string unit = to_text(context.document.scene().unit);
    Screw screw = edit.key_screw(bone, index, keys[index].pose, near_point(context, bone));
    double angle = screw.angle_rad / degree, frame = keys[index].frame;
    const bool metres = unit == "m";
    heading(context, "Selected key");
    label(context, "Frame");
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::InputDouble("##frame", &frame, 0, 0, "%.6g", ImGuiInputTextFlags_AutoSelectAll);
    record_item("motion/key_frame");
    if (ImGui::IsItemDeactivatedAfterEdit() && frame != keys[index].frame)
        return attempt(context, [&] {
            actions::move_pose_key(context.document, bone, index, frame);
            const std::vector<PoseKey>& now = keys_of(context.document.scene(), bone);
            for (std::size_t i = 0; i < now.size(); ++i)
                if (now[i].frame == frame)
                    edit.key = static_cast<int>(i);
        });
    item_tooltip("Frame of the key, 1 to 1000000\nIt must be free.");
    Held all;
    const auto add = [&](const Held& held) {
        all.changed |= held.changed;
        all.ended |= held.ended;
    };
    label(context, "Angle");
    add(number(context, "motion/key_angle", angle, 0.25f, "%.2f\xC2\xB0",
               "Turn from rest about the axis [degrees], right-hand rule"));
    label(context, "Axis");
    add(triple(context, "motion/key_axis", screw.axis, 0.01f, "%.3f", "Direction of the axis, any length"));
    label(context, "Through");
    add(triple(context, "motion/key_point", screw.centre, metres ? 0.0002f : 0.2f, metres ? "%.4f" : "%.1f",
               "A point of the axis [" + unit + "]"));
    label(context, "Slide");
    add(number(context, "motion/key_slide", screw.slide, metres ? 0.0002f : 0.2f,
               metres ? "%.5f m" : "%.2f mm", "Shift along the axis [" + unit + "]"));
    if (all.changed && screw.axis.norm() > 0) {
        screw.angle_rad = angle * degree;
        edit.edit_key(context, bone, index, screw);
    }
    if (all.ended)
        edit.commit(context, "Set key, " + edit.key_bone);
    const bool picking = edit.picking() == PickFor::key_point;
    if (button(context, "motion/pick_key", picking ? "Click on a bone..." : "Pick the point in the view",
               true, "The next click on a bone is a point of the axis (Esc ends).", picking))
        edit.pick(context, picking ? PickFor::nothing : PickFor::key_point);
}

} // namespace

void draw_keys_way(EditorContext& context) {
    const int bone = draw_bone_choice(context);
    ImGui::Dummy({1, context.px(1)});
    draw_table(context, bone);
    draw_buttons(context, bone);
    draw_key(context, bone);
    heading(context, "Whole motion");
    label(context, "Last frame");
    int last = context.last_frame();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::InputInt("##last", &last, 0, 0);
    record_item("motion/last_frame");
    if (ImGui::IsItemDeactivatedAfterEdit())
        attempt(context, [&] { actions::set_last_frame(context.document, last); });
    item_tooltip("Number of the last frame, 1 to 1000000");
    if (!context.document.scene().timeline.hinge)
        say(context.theme.text_faint, "No single joint angle: plots go over frames or seconds.");
    if (button(context, "motion/load_keys", "Load keys from a table...", true,
               "Keyed poses of all bones from a .csv, in place of this motion."))
        context.dialogs.load.open(FileKind::motion);
}

} // namespace fascicle::editor
