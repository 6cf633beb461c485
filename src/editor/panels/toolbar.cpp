#include "editor/panels/panels.hpp"

#include "editor/control_guard.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle::editor {

namespace {

using C = Command;

std::string duration_text(double seconds) {
    char buffer[40];
    if (seconds < 90)
        std::snprintf(buffer, sizeof buffer, "%.0f s", seconds);
    else
        std::snprintf(buffer, sizeof buffer, "%.0f min", seconds / 60);
    return buffer;
}

class Toolbar : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        const float side = context.px(30);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(2), 0});
        ImGui::SetCursorScreenPos({area.min.x + context.px(8), area.min.y + (area.height() - side) / 2});
        group(context, side,
              {{"toolbar/open", icons::open, C::open_file},
               {"toolbar/picture", icons::camera, C::save_picture}});
        group(context, side,
              {{"toolbar/undo", icons::undo, C::undo}, {"toolbar/redo", icons::redo, C::redo}});
        group(context, side,
              {{"toolbar/attachments", icons::tag, C::toggle_attachments},
               {"toolbar/wireframe", icons::grid, C::toggle_wireframe},
               {"toolbar/ghost", icons::ghost, C::toggle_rest_ghost},
               {"toolbar/see_through", icons::adjust, C::toggle_see_through},
               {"toolbar/section", icons::cut, C::toggle_section},
               {"toolbar/orthographic", icons::cube, C::toggle_orthographic},
               {"toolbar/frame_all", icons::expand, C::frame_all}});
        colouring(context, side);
        const float used = ImGui::GetItemRectMax().x;
        ImGui::PopStyleVar();
        const Rect rest{{used + context.px(16), area.min.y}, {area.max.x - context.px(10), area.max.y}};
        if (rest.width() > context.px(150))
            draw_run(context, rest, side);
    }

private:
    struct Entry {
        const char* name;
        Icon icon;
        Command command;
    };

    static void group(EditorContext& context, float side, std::initializer_list<Entry> entries) {
        for (const Entry& entry : entries) {
            tool_button(context, entry.name, entry.icon, entry.command);
            ImGui::SameLine();
        }
        toolbar_separator(context, side);
        ImGui::SameLine();
    }

    static void colouring(EditorContext& context, float side) {
        const float y = ImGui::GetCursorPosY();
        ImGui::SetCursorPosY(y + (side - ImGui::GetFrameHeight()) / 2);
        ImGui::SetNextItemWidth(context.px(150));
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImGui::GetStyle().ItemInnerSpacing);
        std::string tip = "Colours of muscles (" + shortcut(C::next_colouring) + ")";
        for (const view::ColouringRow& row : view::colourings())
            tip.append("\n").append(row.label).append(": ").append(row.help);
        {
            const LockScope lock("toolbar/colouring");
            tip = lock.tip(tip);
            if (ImGui::BeginCombo("##colouring", view::colouring_row(context.state.colouring).label,
                                  ImGuiComboFlags_HeightLarge)) {
                for (const view::ColouringRow& row : view::colourings()) {
                    if (ImGui::Selectable(row.label, row.colouring == context.state.colouring))
                        context.state.colouring = row.colouring;
                    item_tooltip(row.help);
                    record_item(std::string("toolbar/colouring/") + row.label);
                }
                ImGui::EndCombo();
            }
        }
        ImGui::PopStyleVar();
        record_item("toolbar/colouring");
        item_tooltip(tip);
        ImGui::SameLine();
        ImGui::SetCursorPosY(y);
        tool_button(context, "toolbar/display", icons::sliders, C::show_display);
    }

    /// What the solver is doing, with its button, at the right end.
    static void draw_run(EditorContext& context, const Rect& rest, float side) {
        const Theme& theme = context.theme;
        const float top = rest.min.y + (rest.height() - side) / 2;
        const bool running = context.runs.running();
        ImGui::SetCursorScreenPos({rest.max.x - side, top});
        if (running)
            tool_button(context, "toolbar/stop", icons::stop, C::cancel_run);
        else
            tool_button(context, "toolbar/run", icons::again, C::run_again);
        const Rect place{
            {std::max(rest.min.x, rest.max.x - side - context.px(8) - context.px(330)), rest.min.y},
            {rest.max.x - side - context.px(8), rest.max.y}};
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (!running) {
            const auto [text, colour] = idle_text(context);
            draw_text_in(list, place, colour, text, Align::right);
            return;
        }
        const auto [stage, fraction] = context.runs.progress();
        const float height = context.px(5), middle = place.min.y + place.height() / 2;
        const Rect bar{{place.min.x, middle + context.px(6)}, {place.max.x, middle + context.px(6) + height}};
        list.AddRectFilled(bar.min, bar.max, theme.field, height / 2);
        const float filled =
            std::max(height, bar.width() * static_cast<float>(std::clamp(fraction, 0.0, 1.0)));
        list.AddRectFilled(bar.min, {bar.min.x + filled, bar.max.y}, theme.accent, height / 2);
        const Rect line{{place.min.x, place.min.y}, {place.max.x, middle + context.px(5)}};
        draw_text_in(list, line, theme.text_dim, running_text(context, stage));
        const double elapsed = context.runs.elapsed(context.now);
        const bool solving = context.runs.valid_count() > 1;
        if (solving && fraction > 0.02 && elapsed > 1)
            draw_text_in(list, line, theme.text_faint, duration_text(elapsed / fraction - elapsed) + " left",
                         Align::right);
    }

    static std::string running_text(const EditorContext& context, const std::string& stage) {
        const int count = context.runs.recording()->frame_count();
        if (count > 1)
            return "Solving frame " + std::to_string(count) + " of " + std::to_string(context.last_frame());
        return stage.empty() || stage == "prepare" || stage == "solve" ? "Preparing the run"
                                                                       : "Preparing: " + stage;
    }

    static std::pair<std::string, ImU32> idle_text(const EditorContext& context) {
        const Theme& theme = context.theme;
        const RecordingPtr recording = context.runs.recording();
        if (recording == nullptr)
            return {context.document.scene().muscles.empty() ? "No muscle to simulate" : "Not computed",
                    theme.text_faint};
        if (context.runs.outdated())
            return {"Parameters changed", theme.warning};
        switch (recording->state()) {
        case RunState::failed:
            return {"Run failed, see messages", theme.bad};
        case RunState::cancelled:
            return {"Stopped at frame " + std::to_string(context.runs.valid_count() - 1), theme.warning};
        default:
            return {std::to_string(std::max(0, context.runs.valid_count() - 1)) + " frames computed",
                    theme.text_faint};
        }
    }
};

} // namespace

std::unique_ptr<Panel> make_toolbar() {
    return std::make_unique<Toolbar>();
}

} // namespace fascicle::editor
