#include "editor/panels/panels.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"
#include "view/colour_map.hpp"

namespace fascicle::editor {

namespace {

using C = Command;

ImU32 packed(const render::Rgba& c) {
    return ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], c[3]});
}

std::string short_count(int count) {
    return count < 10000 ? std::to_string(count) : std::to_string((count + 500) / 1000) + "k";
}

class SceneTree : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        const Scene& scene = context.document.scene();
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(4), context.px(1)});
        heading(context, "Muscles", scene.muscles.size());
        for (std::size_t i = 0; i < scene.muscles.size(); ++i) {
            const Muscle& muscle = scene.muscles[i];
            row(context, {Selection::Kind::muscle, muscle.name},
                curve_colour(context.theme, static_cast<int>(i)), muscle.mesh->triangle_count(), false);
        }
        ImGui::Dummy({1, context.px(3)});
        heading(context, "Bones", scene.bones.size());
        for (std::size_t i = 0; i < scene.bones.size(); ++i) {
            const Bone& bone = scene.bones[i];
            row(context, {Selection::Kind::bone, bone.name}, packed(view::palette::bone),
                bone.mesh->triangle_count(), actions::bone_moves(scene, static_cast<int>(i)));
        }
        ImGui::PopStyleVar();
        // A click beside the rows selects nothing.
        if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(0) && !ImGui::IsAnyItemHovered())
            run_command(context, C::deselect);
    }

private:
    static void heading(EditorContext& context, const char* title, std::size_t count) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float height = context.px(21), width = ImGui::GetContentRegionAvail().x;
        draw_text_in(*ImGui::GetWindowDrawList(), {at, {at.x + width, at.y + height}},
                     context.theme.text_faint, title);
        draw_text_in(*ImGui::GetWindowDrawList(), {at, {at.x + width - context.px(6), at.y + height}},
                     context.theme.text_faint, count == 0 ? "none" : std::to_string(count), Align::right);
        ImGui::Dummy({width, height});
    }

    static void row(EditorContext& context, const Selection& object, ImU32 colour, int triangles,
                    bool moves) {
        const Theme& theme = context.theme;
        EditorState& state = context.state;
        const float height = context.px(24), width = ImGui::GetContentRegionAvail().x;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const bool visible = state.visible(object.name);
        const bool selected = state.selection == object;
        ImGui::PushID(object.name.c_str());

        const std::string eye = "tree/" + object.name + "/eye";
        if (icon_button(context, eye.c_str(), visible ? icons::eye : icons::eye_off, false, true,
                        visible ? "Visible; a click hides it." : "Hidden; a click shows it.", 24)) {
            if (visible)
                state.hidden.insert(object.name);
            else
                state.hidden.erase(object.name);
        }
        ImGui::SameLine();
        const ImVec2 row_at = ImGui::GetCursorScreenPos();
        const float row_width = at.x + width - row_at.x;
        ImGui::InvisibleButton("row", {std::max(1.0f, row_width), height});
        record_item("tree/" + object.name);
        const bool hovered = ImGui::IsItemHovered();
        if (ImGui::IsItemClicked(0) || ImGui::IsItemClicked(1))
            state.selection = object;
        if (hovered && ImGui::IsMouseDoubleClicked(0))
            run_command(context, C::frame_selection);
        context_menu(context);

        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (selected || hovered)
            list.AddRectFilled(row_at, {row_at.x + row_width, row_at.y + height},
                               selected ? theme.accent_dim : theme.field, context.px(4));
        const float swatch = context.px(10), middle = row_at.y + height / 2;
        const float x = row_at.x + context.px(6);
        list.AddRectFilled({x, middle - swatch / 2}, {x + swatch, middle + swatch / 2},
                           visible ? colour : with_alpha(colour, 0.3f), context.px(3));
        const std::string info = (moves ? "moves  " : "") + short_count(triangles);
        const float info_width = text_size(info).x;
        const float right = row_at.x + row_width - context.px(6);
        const Rect name{{x + swatch + context.px(7), row_at.y},
                        {right - info_width - context.px(6), row_at.y + height}};
        draw_text_in(list, name, visible ? theme.text : theme.text_faint, object.name);
        draw_text_in(list, {{right - info_width, row_at.y}, {right + 1, row_at.y + height}},
                     selected ? theme.text_dim : theme.text_faint, info);
        if (hovered && name.width() < text_size(object.name).x)
            item_tooltip(object.name);
        ImGui::PopID();
    }

    static void context_menu(EditorContext& context) {
        if (!ImGui::BeginPopupContextItem("menu"))
            return;
        for (const Command command : {C::frame_selection, C::hide_selected, C::hide_others, C::show_all})
            menu_item(context, command);
        ImGui::Separator();
        menu_item(context, C::repair_mesh);
        menu_item(context, C::remove_selected);
        ImGui::EndPopup();
    }
};

} // namespace

std::unique_ptr<Panel> make_scene_tree() {
    return std::make_unique<SceneTree>();
}

} // namespace fascicle::editor
