#include "editor/panels/panels.hpp"

#include "editor/features.hpp"
#include "editor/picking.hpp"
#include "editor/scene_view.hpp"
#include "editor/viewport_tool.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/orientation_cube.hpp"
#include "editor/widgets/tool_button.hpp"
#include "render/imgui_renderer.hpp"

namespace fascicle::editor {

namespace {

using C = Command;

ImU32 packed(const render::Rgba& c) {
    return ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], c[3]});
}

class Viewport : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        EditorState& state = context.state;
        const view::ViewSize size{double(area.width()), double(area.height())};
        state.view_aspect = size.aspect();
        state.scene_box = bounds(context);
        state.camera.set_scene_bounds(state.scene_box);
        if (state.frame_view_pending) {
            state.frame_view_pending = false;
            run_command(context, C::frame_all);
        }
        ImGui::SetCursorScreenPos(area.min);
        ImGui::InvisibleButton("viewport", {area.width(), area.height()},
                               ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                                   ImGuiButtonFlags_MouseButtonMiddle);
        record_item("viewport");
        const bool hovered = ImGui::IsItemHovered();
        handle_pointer(context, area, size, hovered);
        draw_picture(context, area);
        draw_overlays(context, area, hovered);
        context_menu(context);
    }

private:
    /// Everything that may come into view during the motion; the scene changes rarely.
    const BoundingBox& bounds(const EditorContext& context) {
        const ScenePtr head = context.document.head();
        if (head != bounds_for_) {
            bounds_ = view::motion_bounds(*head);
            bounds_for_ = head;
        }
        return bounds_;
    }

    void handle_pointer(EditorContext& context, const Rect& area, const view::ViewSize& size, bool hovered) {
        const ImGuiIO& io = ImGui::GetIO();
        PointerInput input;
        input.x = double(io.MousePos.x - area.min.x);
        input.y = double(io.MousePos.y - area.min.y);
        input.dx = double(io.MouseDelta.x);
        input.dy = double(io.MouseDelta.y);
        // Some systems turn Shift+wheel into a sideways wheel.
        input.wheel = double(io.MouseWheel != 0 ? io.MouseWheel : io.MouseWheelH);
        input.ctrl = io.KeyCtrl;
        input.shift = io.KeyShift;
        input.inside = hovered && !cube_hovered_;
        for (int button = 0; button < 3; ++button) {
            if (input.inside && ImGui::IsMouseClicked(button))
                input.pressed = button;
            if (ImGui::IsMouseReleased(button))
                input.released = button;
        }
        if (EditorState& state = context.state;
            input.inside && input.ctrl && input.wheel != 0 && state.section.on) {
            move_section(state.section, state.scene_box, input.wheel * 0.01);
            input.wheel = 0; // no zoom as well
        }
        if (input.inside && ImGui::IsMouseDoubleClicked(0) && !io.KeyCtrl && !io.KeyShift)
            if (const std::optional<Hit> hit = pick_at(context, input, size))
                context.state.camera.set_pivot(hit->point);
        if (ViewportTool* tool = active_tool(context);
            tool != nullptr && !pointer_.dragging() && tool->take_pointer(context, input, size))
            return;
        if (input.inside && context.state.tool == Tool::look && !pointer_.dragging())
            context.features.fibre_hover.point_at(context, {input.x, input.y}, size);
        const ViewportPointer::Result result =
            pointer_.update(input, size, double(context.scale()), context.state.camera);
        if (result.clicked && *result.clicked != 2) {
            select(context, pick_at(context, input, size));
            if (*result.clicked == 1)
                ImGui::OpenPopup("viewport menu");
        }
    }

    static std::optional<Hit> pick_at(const EditorContext& context, const PointerInput& input,
                                      const view::ViewSize& size) {
        const view::ViewSubject subject = view_subject(context);
        return pick(subject, view_options(context, *subject.scene),
                    context.state.camera.ray(input.x, input.y, size));
    }

    static void select(EditorContext& context, const std::optional<Hit>& hit) {
        const Scene& scene = context.shown_scene();
        Selection& selection = context.state.selection;
        if (!hit)
            selection = {};
        else if (hit->bone >= 0)
            selection = {Selection::Kind::bone, scene.bones[static_cast<std::size_t>(hit->bone)].name};
        else
            selection = {Selection::Kind::muscle, scene.muscles[static_cast<std::size_t>(hit->muscle)].name};
    }

    static void draw_picture(EditorContext& context, const Rect& area) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const Theme& theme = context.theme;
        const int width = static_cast<int>(area.width()), height = static_cast<int>(area.height());
        if (context.view == nullptr || width < 1 || height < 1) {
            const ImU32 top = packed(theme.view_top), bottom = packed(theme.view_bottom);
            list.AddRectFilledMultiColor(area.min, area.max, top, top, bottom, bottom);
            return;
        }
        const unsigned texture = context.view->texture(context, width, height);
        list.AddImage(render::texture_id(texture), area.min, area.max, {0, 1}, {1, 0});
    }

    void draw_overlays(EditorContext& context, const Rect& area, bool hovered) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        for (const OverlayRow& row : viewport_overlays())
            row.draw(context, list, area);
        const float pad = context.px(12), radius = context.px(34);
        if (area.height() > radius * 4 && area.width() > radius * 5) {
            const ImVec2 middle{area.min.x + pad + radius, area.max.y - pad - radius};
            const bool idle = hovered && !pointer_.dragging();
            const CubeResult cube =
                draw_orientation_cube(list, context.state.camera, middle, radius, ImGui::GetIO().MousePos,
                                      idle, ImGui::IsMouseClicked(0), context.theme);
            cube_hovered_ = cube.hovered;
            if (cube.clicked)
                context.state.camera.look_from(*cube.clicked);
        } else {
            cube_hovered_ = false;
        }
        if (ViewportTool* tool = active_tool(context))
            tool->draw(context, list, area);
    }

    static void context_menu(EditorContext& context) {
        if (!ImGui::BeginPopup("viewport menu"))
            return;
        const Selection& selection = context.state.selection;
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
        ImGui::TextUnformatted(selection.kind == Selection::Kind::none ? "Nothing selected"
                                                                       : selection.name.c_str());
        ImGui::PopStyleColor();
        ImGui::Separator();
        for (const Command command : {C::frame_selection, C::frame_all})
            menu_item(context, command);
        ImGui::Separator();
        for (const Command command : {C::hide_selected, C::hide_others, C::show_all})
            menu_item(context, command);
        ImGui::Separator();
        for (const Command command : {C::toggle_attachments, C::toggle_wireframe, C::toggle_rest_ghost,
                                      C::toggle_orthographic, C::toggle_see_through, C::toggle_section})
            menu_item(context, command);
        ImGui::Separator();
        menu_item(context, C::save_picture);
        ImGui::EndPopup();
    }

    ViewportPointer pointer_;
    BoundingBox bounds_;
    ScenePtr bounds_for_;
    bool cube_hovered_ = false;
};

} // namespace

std::unique_ptr<Panel> make_viewport() {
    return std::make_unique<Viewport>();
}

} // namespace fascicle::editor
