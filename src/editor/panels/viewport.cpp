#include "editor/panels/panels.hpp"

#include "editor/picking.hpp"
#include "editor/scene_view.hpp"
#include "editor/viewport_pointer.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/legend.hpp"
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
        state.camera.set_scene_bounds(bounds(context));
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
        if (input.inside && ImGui::IsMouseDoubleClicked(0) && !io.KeyCtrl && !io.KeyShift)
            if (const std::optional<Hit> hit = pick_at(context, input, size))
                context.state.camera.set_pivot(hit->point);
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
        const Theme& theme = context.theme;
        const float pad = context.px(12);
        draw_legends(context, list, {area.max.x - pad, area.min.y + pad}, area);
        draw_state(context, list, {area.min.x + area.width() / 2, area.min.y + pad});

        const float radius = context.px(34);
        if (area.height() > radius * 4 && area.width() > radius * 5) {
            const ImVec2 middle{area.min.x + pad + radius, area.max.y - pad - radius};
            const bool idle = hovered && !pointer_.dragging();
            const CubeResult cube =
                draw_orientation_cube(list, context.state.camera, middle, radius, ImGui::GetIO().MousePos,
                                      idle, ImGui::IsMouseClicked(0), theme);
            cube_hovered_ = cube.hovered;
            if (cube.clicked)
                context.state.camera.look_from(*cube.clicked);
        } else {
            cube_hovered_ = false;
        }
        const Scene& scene = context.document.scene();
        if (scene.bones.empty() && scene.muscles.empty())
            draw_empty(context, area);
    }

    static void draw_legends(const EditorContext& context, ImDrawList& list, ImVec2 corner,
                             const Rect& area) {
        if (area.height() < context.px(240))
            return;
        std::vector<LegendEntry> entries;
        switch (context.state.colouring) {
        case view::Colouring::strain:
        case view::Colouring::fibres:
        case view::Colouring::depth: {
            const view::ViewOptions options;
            const view::Colouring colouring = context.state.colouring;
            const view::ColourScale& scale = colouring == view::Colouring::strain   ? options.strain_scale
                                             : colouring == view::Colouring::fibres ? options.stretch_scale
                                                                                    : options.depth_scale;
            const Rect plate = draw_colour_bar(list, corner, view::colouring_row(colouring).legend, scale,
                                               context.theme, context.scale());
            record_item("viewport/legend", plate);
            return;
        }
        case view::Colouring::contact:
            for (const view::ContactRow& row : view::contact_rows())
                entries.push_back({row.label, packed(row.colour)});
            break;
        case view::Colouring::anatomy:
            if (context.state.attachments)
                entries = attachment_entries(context);
        }
        if (!entries.empty())
            record_item("viewport/legend",
                        draw_swatches(list, corner, entries, context.theme, context.scale()));
    }

    static std::vector<LegendEntry> attachment_entries(const EditorContext& context) {
        bool origin = false, insertion = false, unknown = false;
        const RecordingPtr recording = context.shown().recording;
        const Scene& scene = context.shown_scene();
        std::vector<std::vector<Attachment>> lists =
            recording != nullptr ? recording->attachments() : std::vector<std::vector<Attachment>>{};
        for (const Muscle& muscle : scene.muscles)
            lists.push_back(muscle.attachments);
        for (const auto& attachments : lists)
            for (const Attachment& attachment : attachments) {
                origin |= attachment.kind == AttachmentKind::origin;
                insertion |= attachment.kind == AttachmentKind::insertion;
                unknown |= attachment.kind == AttachmentKind::unknown;
            }
        std::vector<LegendEntry> entries;
        if (origin)
            entries.push_back({"Origin", packed(view::palette::origin)});
        if (insertion)
            entries.push_back({"Insertion", packed(view::palette::insertion)});
        if (unknown)
            entries.push_back({"Attachment", packed(view::palette::attachment)});
        return entries;
    }

    /// A sentence when what is seen is not the computed frame at the playhead.
    static void draw_state(const EditorContext& context, ImDrawList& list, ImVec2 at) {
        const Theme& theme = context.theme;
        const ShownFrame shown = context.shown();
        std::string text;
        ImU32 colour = theme.text;
        const RecordingPtr recording = context.runs.recording();
        const bool failed =
            recording != nullptr && recording->state() == RunState::failed && !context.runs.outdated();
        if (failed) {
            text = "The run failed: " + recording->failure();
            colour = theme.bad;
        } else if (shown.state == FrameState::stale) {
            text = context.runs.running() ? "Stale: made with other parameters, computing anew"
                                          : "Stale: made with other parameters";
            colour = theme.warning;
        } else if (shown.frame == nullptr && !context.document.scene().muscles.empty()) {
            text = context.runs.running() ? "At rest; preparing the run" : "At rest";
        } else if (shown.frame != nullptr && shown.frame->index < context.playhead()) {
            text = "Frame " + std::to_string(shown.frame->index) + "; frame " +
                   std::to_string(context.playhead()) + " is not computed yet";
        }
        if (!text.empty())
            record_item("viewport/badge", draw_badge(list, at, Align::centre, elided(text, context.px(520)),
                                                     colour, theme.badge));
    }

    static void draw_empty(EditorContext& context, const Rect& area) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const float middle = area.min.y + area.height() * 0.45f, line = ImGui::GetTextLineHeightWithSpacing();
        draw_text_in(list, {{area.min.x, middle - line * 1.5f}, {area.max.x, middle - line * 0.5f}},
                     context.theme.text, "Nothing here yet", Align::centre);
        draw_text_in(list, {{area.min.x, middle - line * 0.5f}, {area.max.x, middle + line * 0.5f}},
                     context.theme.text_dim,
                     "Drop a mesh of a bone or a muscle here, or press " + shortcut(C::open_file),
                     Align::centre);
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
        for (const Command command :
             {C::toggle_attachments, C::toggle_wireframe, C::toggle_rest_ghost, C::toggle_orthographic})
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
