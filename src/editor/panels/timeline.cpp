#include "editor/panels/panels.hpp"

#include "editor/frame_axis.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/ruler.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/document/actions/marker_actions.hpp"

#include <array>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace {

using C = Command;

class TimelinePanel : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        const float side = context.px(28), pad = context.px(10);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(2), 0});
        ImGui::SetCursorScreenPos({area.min.x + pad - context.px(4), area.min.y + context.px(5)});
        transport(context, 28);
        frame_field(context, side);
        if (area.width() > context.px(560))
            options(context, area, side);
        ImGui::PopStyleVar();

        const float inset = context.px(8); // the first and the last label stay inside
        const RulerResult ruler = draw_ruler(context,
                                             {{area.min.x + pad + inset, area.min.y + context.px(40)},
                                              {area.max.x - pad - inset, area.max.y - context.px(9)}},
                                             grab_);
        follow(context, ruler);
        marker_popup(context);
        menu(context);
        empty_hint(context, area);
    }

private:
    void follow(EditorContext& context, const RulerResult& ruler) {
        Playback& playback = context.state.playback;
        if (ruler.moved_to) {
            playback.playing = false;
            context.move_playhead(*ruler.moved_to);
            if (*ruler.moved_to >= context.runs.valid_count())
                context.runs.compute_on(); // what a stop left out is wanted after all
        }
        if (ruler.hovered)
            context.state.next_hover_frame = ruler.hovered;
        if (ruler.range) {
            playback.range = ruler.range;
            if (*ruler.range == std::pair(0, context.last_frame()))
                playback.range.reset();
        }
        if (ruler.moved_marker)
            actions::move_marker(context.document, ruler.moved_marker->first, ruler.moved_marker->second);
        if (ruler.double_clicked) {
            actions::add_marker(context.document, *ruler.double_clicked);
            name_marker(context, *ruler.double_clicked);
        }
        if (ruler.menu_at) {
            context.move_playhead(*ruler.menu_at);
            menu_frame_ = ruler.menu_marker ? context.document.scene().markers[*ruler.menu_marker].frame
                                            : *ruler.menu_at;
            ImGui::OpenPopup("timeline menu");
        }
    }

    /// Opens the field for the name of the marker at the frame.
    void name_marker(const EditorContext& context, int frame) {
        const int index = actions::marker_at(context.document.scene(), frame);
        if (index < 0)
            return;
        named_frame_ = frame;
        name_ = context.document.scene().markers[static_cast<std::size_t>(index)].name;
        name_appears_ = true;
    }

    void marker_popup(EditorContext& context) {
        if (name_appears_)
            ImGui::OpenPopup("marker name");
        if (!ImGui::BeginPopup("marker name"))
            return;
        if (name_appears_)
            ImGui::SetKeyboardFocusHere();
        name_appears_ = false;
        ImGui::SetNextItemWidth(context.px(180));
        const bool entered = ImGui::InputText(
            "##name", &name_, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
        record_item("timeline/marker_name");
        item_tooltip("Name of the marker\nEnter keeps it.");
        if (entered) {
            if (const int index = actions::marker_at(context.document.scene(), named_frame_); index >= 0)
                actions::rename_marker(context.document, static_cast<std::size_t>(index), name_);
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }

    void menu(EditorContext& context) {
        if (!ImGui::BeginPopup("timeline menu"))
            return;
        const int marker = actions::marker_at(context.document.scene(), menu_frame_);
        if (marker >= 0) {
            const auto index = static_cast<std::size_t>(marker);
            const std::string name = context.document.scene().markers[index].name;
            if (ImGui::MenuItem(("Rename " + name + "...").c_str()))
                name_marker(context, menu_frame_);
            record_item("timeline/menu/rename");
            if (ImGui::MenuItem(("Remove " + name).c_str()))
                actions::remove_marker(context.document, index);
            record_item("timeline/menu/remove");
        } else {
            menu_item(context, C::add_marker);
        }
        ImGui::Separator();
        for (const C command : {C::loop_from_here, C::loop_to_here, C::loop_everything})
            menu_item(context, command);
        ImGui::Separator();
        for (const C command : {C::toggle_loop, C::toggle_ping_pong, C::toggle_every_frame})
            menu_item(context, command);
        ImGui::Separator();
        for (const C command : {C::run_again, C::cancel_run})
            menu_item(context, command);
        ImGui::EndPopup();
    }

    static void transport(EditorContext& context, float side) {
        const bool playing = context.state.playback.playing;
        tool_button(context, "timeline/first", icons::first, C::first_frame, side);
        ImGui::SameLine();
        tool_button(context, "timeline/back", icons::back, C::step_back, side);
        ImGui::SameLine();
        tool_button(context, "timeline/play", playing ? icons::pause : icons::play, C::play_pause, side);
        ImGui::SameLine();
        tool_button(context, "timeline/on", icons::on, C::step_on, side);
        ImGui::SameLine();
        tool_button(context, "timeline/last", icons::last, C::last_frame, side);
        ImGui::SameLine();
        tool_button(context, "timeline/loop", icons::loop, C::toggle_loop, side);
        ImGui::SameLine();
        tool_button(context, "timeline/ping_pong", icons::ping_pong, C::toggle_ping_pong, side);
        ImGui::SameLine(0, context.px(12));
    }

    static void frame_field(EditorContext& context, float side) {
        const float drop = (side - ImGui::GetFrameHeight()) / 2;
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() + drop);
        int frame = context.playhead();
        ImGui::SetNextItemWidth(context.px(58));
        if (ImGui::DragInt("##frame", &frame, 0.5f, 0, context.last_frame(), "%d",
                           ImGuiSliderFlags_AlwaysClamp)) {
            context.state.playback.playing = false;
            context.move_playhead(frame);
        }
        record_item("timeline/frame");
        item_tooltip("Shown frame\nDrag, or double-click and type.");
        ImGui::SameLine(0, context.px(6));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const std::string of = "of " + std::to_string(context.last_frame());
        draw_text(*ImGui::GetWindowDrawList(), {at.x, at.y + ImGui::GetStyle().FramePadding.y},
                  context.theme.text_faint, of);
        ImGui::Dummy({text_size(of).x, side});
    }

    /// A way out where nothing moves yet.
    void empty_hint(EditorContext& context, const Rect& area) {
        if (version_ != context.document.version()) {
            version_ = context.document.version();
            const Scene& scene = context.document.scene();
            moves_ = scene.bones.empty();
            for (int b = 0; b < static_cast<int>(scene.bones.size()); ++b)
                moves_ |= scene.timeline.moves(b);
        }
        if (moves_)
            return;
        if (area.width() < context.px(820))
            return; // no room beside the buttons
        const char* const text = "Nothing moves yet: set a motion";
        const float width = text_size(text).x + context.px(24), height = context.px(26);
        ImGui::SetCursorScreenPos({(area.min.x + area.max.x - width) / 2, area.min.y + context.px(6)});
        ImGui::PushStyleColor(ImGuiCol_Button, context.theme.accent_dim);
        if (ImGui::Button(text, {width, height}))
            run_command(context, C::show_motion);
        ImGui::PopStyleColor();
        record_item("timeline/motion");
        item_tooltip(tooltip(C::show_motion));
    }

    std::uint64_t version_ = 0;
    bool moves_ = true;

    /// Speed and unit, at the right end.
    static void options(EditorContext& context, const Rect& area, float side) {
        const float drop = (side - ImGui::GetFrameHeight()) / 2;
        const float speed_width = context.px(76), unit_width = context.px(106);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImGui::GetStyle().ItemInnerSpacing);
        ImGui::SetCursorScreenPos({area.max.x - context.px(10) - unit_width - speed_width - context.px(6),
                                   area.min.y + context.px(5) + drop});
        ImGui::SetNextItemWidth(speed_width);
        constexpr std::array<double, 10> speeds{-4, -2, -1, -0.25, 0.1, 0.25, 0.5, 1, 2, 4};
        const auto label = [](double speed) { return number_text(speed) + "x"; };
        if (ImGui::BeginCombo("##speed", label(context.state.playback.speed).c_str())) {
            for (const double speed : speeds) {
                if (ImGui::Selectable(label(speed).c_str(), speed == context.state.playback.speed))
                    context.state.playback.speed = speed;
                record_item("timeline/speed/" + label(speed));
            }
            ImGui::Separator();
            menu_item(context, C::toggle_every_frame);
            ImGui::EndCombo();
        }
        record_item("timeline/speed");
        item_tooltip("Playing speed, times real time; negative plays backwards\nDefault: 1x, in real time: "
                     "frames are left out when "
                     "the machine is slow.");
        ImGui::SameLine(0, context.px(6));
        ImGui::SetNextItemWidth(unit_width);
        if (ImGui::BeginCombo("##unit", axis_label(context.state.ruler))) {
            for (const RulerUnit unit : {RulerUnit::frame, RulerUnit::seconds, RulerUnit::angle}) {
                const bool possible =
                    unit != RulerUnit::angle || context.document.scene().timeline.hinge.has_value();
                if (possible && ImGui::Selectable(axis_label(unit), unit == context.state.ruler))
                    context.state.ruler = unit;
                record_item(std::string("timeline/unit/") + axis_label(unit));
            }
            ImGui::EndCombo();
        }
        record_item("timeline/unit");
        item_tooltip("What the ruler and the plots' axes show");
        ImGui::PopStyleVar();
    }

    RulerGrab grab_;
    std::string name_; ///< of the marker being named
    int named_frame_ = 0, menu_frame_ = 0;
    bool name_appears_ = false;
};

} // namespace

std::unique_ptr<Panel> make_timeline() {
    return std::make_unique<TimelinePanel>();
}

} // namespace fascicle::editor
