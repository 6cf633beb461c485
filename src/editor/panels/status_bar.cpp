#include "editor/panels/panels.hpp"

#include "editor/widgets/icons.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace fascicle::editor {

namespace {

template <class... Args>
std::string print(const char* format, Args... args) {
    char buffer[120];
    std::snprintf(buffer, sizeof buffer, format, args...);
    return buffer;
}

class StatusBar : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        const Theme& theme = context.theme;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        float right = area.max.x - context.px(12);
        const auto item = [&](const std::string& text, const char* tip, ImU32 colour) {
            const float width = text_size(text).x;
            if (text.empty() || right - width < area.min.x + area.width() * 0.35f)
                return; // the message keeps a third
            const Rect rect{{right - width, area.min.y}, {right + 1, area.max.y}};
            draw_text_in(list, rect, colour, text);
            if (ImGui::IsMouseHoveringRect(rect.min, rect.max))
                ImGui::SetTooltip("%s", tip);
            right -= width + context.px(11);
            list.AddLine({right, area.min.y + area.height() * 0.28f},
                         {right, area.max.y - area.height() * 0.28f}, theme.line);
            right -= context.px(11);
        };
        const Scene& scene = context.document.scene();
        item(to_text(scene.unit), "Unit of lengths in this scene", theme.text_dim);
        item(context.ui_fps > 0 ? print("%.0f pictures/s", double(context.ui_fps)) : std::string(),
             "Pictures that the window draws a second; it rests when nothing changes", theme.text_faint);
        item(solver_text(context), "Frames the solver makes a second, median over the latest",
             theme.text_dim);
        item(angle_text(context), "Joint angle at the shown frame", theme.text_dim);
        item(print("frame %d / %d", context.playhead(), context.last_frame()), "Playhead and last frame",
             theme.text_dim);
        draw_message(context,
                     {{area.min.x + context.px(12), area.min.y}, {right - context.px(6), area.max.y}});
    }

private:
    static std::string angle_text(const EditorContext& context) {
        const ShownFrame shown = context.shown();
        if (shown.frame == nullptr || !shown.recording->scene().timeline.hinge)
            return {};
        return print("%.1f\xC2\xB0", shown.frame->angle_rad * 180 / std::numbers::pi);
    }

    /// Median over the newest frames of the newest run.
    static std::string solver_text(const EditorContext& context) {
        const RecordingPtr recording = context.runs.recording();
        const int count = recording == nullptr ? 0 : recording->frame_count();
        std::vector<double> seconds;
        for (int k = std::max(1, count - 31); k < count; ++k)
            seconds.push_back(recording->frame(k)->report.solve_seconds);
        if (seconds.empty())
            return {};
        std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                         seconds.end());
        const double median = seconds[seconds.size() / 2];
        return median > 0 ? print(median < 0.01 ? "solver %.0f frames/s" : "solver %.3g frames/s", 1 / median)
                          : std::string();
    }

    static void draw_message(EditorContext& context, const Rect& rect) {
        const Message* message = context.log.latest();
        if (message == nullptr || rect.width() < context.px(60))
            return;
        const Theme& theme = context.theme;
        const bool error = message->severity == Severity::error,
                   warning = message->severity == Severity::warning;
        const ImU32 colour = error ? theme.bad : warning ? theme.warning : theme.text_faint;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const char* icon = text(error ? icons::error : warning ? icons::warning : icons::note);
        draw_text_in(list, rect, colour, icon);
        const float after = text_size(icon).x + context.px(7);
        draw_text_in(list, {{rect.min.x + after, rect.min.y}, rect.max},
                     error || warning ? colour : theme.text_dim, message->text);
        ImGui::SetCursorScreenPos(rect.min);
        if (ImGui::InvisibleButton("message", {rect.width(), rect.height()}))
            context.state.bottom_panel = "messages";
        record_item("status/message");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", message->text.c_str());
    }
};

} // namespace

std::unique_ptr<Panel> make_status_bar() {
    return std::make_unique<StatusBar>();
}

} // namespace fascicle::editor
