#include "editor/panels/motion.hpp"

#include "editor/dialogs/modal.hpp"
#include "editor/panels/panels.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

namespace fascicle::editor {

namespace motion_rows {

namespace {
constexpr float label_width = 82;
}

void say(ImU32 colour, const std::string& text) {
    wrapped_text(colour, text);
}

void heading(const EditorContext& context, const char* text) {
    ImGui::Dummy({1, context.px(4)});
    say(context.theme.text_faint, text);
}

void label(const EditorContext& context, const char* text) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = context.px(label_width), height = ImGui::GetFrameHeight();
    draw_text_in(*ImGui::GetWindowDrawList(), {at, {at.x + width - context.px(6), at.y + height}},
                 context.theme.text_dim, text);
    ImGui::Dummy({width, height});
    ImGui::SameLine(0, 0);
}

Held number(const EditorContext& context, const char* name, double& value, float speed, const char* format,
            const std::string& tip, float width) {
    static_cast<void>(context);
    ImGui::PushID(name);
    ImGui::SetNextItemWidth(width > 0 ? width : std::max(20.0f, ImGui::GetContentRegionAvail().x));
    double changed = value;
    Held held;
    held.changed =
        ImGui::DragScalar("##value", ImGuiDataType_Double, &changed, speed, nullptr, nullptr, format);
    held.ended = ImGui::IsItemDeactivated();
    record_item(name);
    if (!ImGui::IsItemActive())
        item_tooltip(tip + "\nDrag, or double-click and type.");
    ImGui::PopID();
    if (held.changed && std::isfinite(changed))
        value = changed;
    return held;
}

Held triple(const EditorContext& context, const char* name, Vec3& value, float speed, const char* format,
            const std::string& tip) {
    const float gap = context.px(3);
    const float width = std::max(20.0f, (ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
    Held all;
    for (int i = 0; i < 3; ++i) {
        if (i > 0)
            ImGui::SameLine(0, gap);
        const std::string part = std::string(name) + "/" + "xyz"[i];
        const Held held = number(context, part.c_str(), value[i], speed, format, tip, width);
        all.changed |= held.changed;
        all.ended |= held.ended;
    }
    return all;
}

bool button(const EditorContext& context, const char* name, const char* text, bool enabled,
            const std::string& tip, bool important, float width) {
    ImGui::BeginDisabled(!enabled);
    if (important)
        ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
    const bool clicked =
        ImGui::Button(text, {width > 0 ? width : std::max(20.0f, ImGui::GetContentRegionAvail().x), 0});
    if (important)
        ImGui::PopStyleColor();
    record_item(name);
    ImGui::EndDisabled();
    item_tooltip(tip);
    return clicked;
}

} // namespace motion_rows

namespace {

class MotionPanel : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        MotionEdit& motion = context.features.motion;
        if (context.document.scene().bones.empty()) {
            motion_rows::say(context.theme.text, "No bone to move");
            motion_rows::say(context.theme.text_faint, "Add the meshes of bones first (" +
                                                           shortcut(Command::open_file) +
                                                           "), or drop them on the window.");
            return;
        }
        ways(context, motion);
        ImGui::Dummy({1, context.px(2)});
        if (motion.way == MotionWay::hinge)
            draw_hinge_way(context);
        else if (motion.way == MotionWay::keys)
            draw_keys_way(context);
        else
            draw_file_way(context);
    }

private:
    static void ways(const EditorContext& context, MotionEdit& motion) {
        struct Way {
            MotionWay way;
            const char *text, *name, *tip;
        };
        constexpr Way all[] = {
            {MotionWay::hinge, "Hinge", "motion/hinge", "Bones turn about one axis, there and back."},
            {MotionWay::keys, "Keys", "motion/keys", "Poses of single bones at single frames."},
            {MotionWay::file, "From a file", "motion/file",
             "A column of a .mot or .sto file, the joints of a model, or a table of poses."}};
        const float gap = context.px(3),
                    width = std::max(20.0f, (ImGui::GetContentRegionAvail().x - 2 * gap) / 3);
        for (const Way& way : all) {
            if (way.way != MotionWay::hinge)
                ImGui::SameLine(0, gap);
            if (motion_rows::button(context, way.name, way.text, true, way.tip, way.way == motion.way, width))
                motion.way = way.way;
        }
    }
};

} // namespace

std::unique_ptr<Panel> make_motion() {
    return std::make_unique<MotionPanel>();
}

} // namespace fascicle::editor
