#include "editor/panels/panels.hpp"

#include "editor/features.hpp"
#include "editor/picking.hpp"
#include "editor/pointer_input.hpp"
#include "editor/scene_view.hpp"
#include "editor/viewport/compare_overlay.hpp"
#include "editor/viewport_tool.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/orientation_cube.hpp"
#include "editor/widgets/tool_button.hpp"
#include "render/imgui_renderer.hpp"

#include <algorithm>

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
        const Rect left = compare_part(context, area, false), right = compare_part(context, area, true);
        const bool two = right.min.x > left.min.x;
        // A drag stays with the picture that it began in; both have the same size and camera.
        if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2))
            in_second_ = two && ImGui::GetIO().MousePos.x >= left.max.x;
        in_second_ = in_second_ && two;
        const Rect part = in_second_ ? right : left;
        const view::ViewSize size{double(part.width()), double(part.height())};
        state.view_aspect = size.aspect();
        state.view_width = std::max(1, static_cast<int>(area.width()));
        state.view_height = std::max(1, static_cast<int>(area.height()));
        state.scene_box = bounds(context);
        state.camera.set_scene_bounds(state.scene_box);
        if (two && !two_before_ && cut_off(context, {double(area.width()), double(area.height())}, size))
            state.frame_view_pending = true;
        two_before_ = two;
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
        handle_pointer(context, part, size, hovered);
        draw_picture(context, left, false);
        if (two)
            draw_picture(context, right, true);
        draw_overlays(context, area, part, hovered);
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

    /// Whether all that is visible fits into a picture of the one size, and not into the other.
    static bool cut_off(const EditorContext& context, const view::ViewSize& full,
                        const view::ViewSize& part) {
        const view::ViewSubject subject = view_subject(context);
        const Points points = view::visible_points(subject, view_options(context, *subject.scene));
        const auto fits = [&](const view::ViewSize& size) {
            return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
                const std::optional<Vec2> at = context.state.camera.project(p, size);
                return at && at->x() >= 0 && at->x() <= size.width && at->y() >= 0 && at->y() <= size.height;
            });
        };
        return fits(full) && !fits(part);
    }

    void handle_pointer(EditorContext& context, const Rect& area, const view::ViewSize& size, bool hovered) {
        const ImGuiIO& io = ImGui::GetIO();
        PointerInput input = pointer_input(context, area, hovered && !cube_hovered_);
        if (EditorState& state = context.state;
            input.inside && input.ctrl && input.wheel != 0 && state.section.on) {
            move_section(state.section, state.scene_box, input.wheel * 0.01);
            input.wheel = 0; // no zoom as well
        }
        if (input.inside && ImGui::IsMouseDoubleClicked(0) && !io.KeyCtrl && !io.KeyShift &&
            (active_tool(context) == nullptr || input.alt || input.camera_held))
            if (const std::optional<Hit> hit = pick_at(context, input, size, in_second_))
                context.state.camera.set_pivot(hit->point);
        if (ViewportTool* tool = active_tool(context);
            tool != nullptr && !pointer_.dragging() && tool->take_pointer(context, input, size))
            return;
        if (input.inside && context.state.tool == Tool::look && !pointer_.dragging())
            context.features.fibre_hover.point_at(context, {input.x, input.y}, size);
        const ViewportPointer::Result result =
            pointer_.update(input, size, double(context.scale()), context.state.camera);
        if (result.clicked && *result.clicked != 2) {
            if (active_tool(context) == nullptr) // a tool keeps what it works on
                select(context, pick_at(context, input, size, in_second_), in_second_);
            if (*result.clicked == 1)
                ImGui::OpenPopup("viewport menu");
        }
    }

    static std::optional<Hit> pick_at(const EditorContext& context, const PointerInput& input,
                                      const view::ViewSize& size, bool second) {
        const view::ViewSubject subject =
            second ? context.features.compare.subject(true) : view_subject(context);
        return pick(subject, view_options(context, *subject.scene),
                    context.state.camera.ray(input.x, input.y, size));
    }

    static void select(EditorContext& context, const std::optional<Hit>& hit, bool second) {
        const Scene& scene = second ? context.features.compare.b().recording->scene() : context.shown_scene();
        Selection& selection = context.state.selection;
        if (!hit)
            selection = {};
        else if (hit->bone >= 0)
            selection = {Selection::Kind::bone, scene.bones[static_cast<std::size_t>(hit->bone)].name};
        else
            selection = {Selection::Kind::muscle, scene.muscles[static_cast<std::size_t>(hit->muscle)].name};
    }

    static void draw_picture(EditorContext& context, const Rect& area, bool second) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const Theme& theme = context.theme;
        const int width = static_cast<int>(area.width()), height = static_cast<int>(area.height());
        if (context.view == nullptr || width < 1 || height < 1) {
            const ImU32 top = packed(theme.view_top), bottom = packed(theme.view_bottom);
            list.AddRectFilledMultiColor(area.min, area.max, top, top, bottom, bottom);
            return;
        }
        Compare& compare = context.features.compare;
        const unsigned texture =
            second ? compare.second_view(context).texture(context, compare.subject(true), width, height)
                   : context.view->texture(context, width, height);
        list.AddImage(render::texture_id(texture), area.min, area.max, {0, 1}, {1, 0});
    }

    /// part: the picture under the pointer, of one or two.
    void draw_overlays(EditorContext& context, const Rect& area, const Rect& part, bool hovered) {
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
            tool->draw(context, list, part);
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
    bool two_before_ = false; ///< two pictures in the frame before
    bool in_second_ = false;  ///< the pointer belongs to the right one of two pictures
};

} // namespace

std::unique_ptr<Panel> make_viewport() {
    return std::make_unique<Viewport>();
}

} // namespace fascicle::editor
