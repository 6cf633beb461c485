#include "editor/panels/panels.hpp"

#include "editor/widgets/icons.hpp"
#include "editor/widgets/item_recorder.hpp"

namespace fascicle::editor {

namespace {

class Messages : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        const Theme& theme = context.theme;
        context.log.mark_seen();
        if (context.log.messages().empty()) {
            ImGui::PushStyleColor(ImGuiCol_Text, theme.text_faint);
            ImGui::TextUnformatted("Nothing to report.");
            ImGui::PopStyleColor();
            return;
        }
        for (const Message& message : context.log.messages()) {
            const bool error = message.severity == Severity::error,
                       warning = message.severity == Severity::warning;
            ImGui::PushStyleColor(ImGuiCol_Text, error     ? theme.bad
                                                 : warning ? theme.warning
                                                           : theme.text_faint);
            ImGui::TextUnformatted(text(error ? icons::error : warning ? icons::warning : icons::note));
            ImGui::PopStyleColor();
            ImGui::SameLine(0, context.px(8));
            ImGui::PushStyleColor(ImGuiCol_Text, error ? theme.bad : theme.text);
            ImGui::PushTextWrapPos(0);
            const std::string times =
                message.repeats > 1 ? " (" + std::to_string(message.repeats) + " times)" : "";
            ImGui::TextUnformatted((message.text + times).c_str());
            ImGui::PopTextWrapPos();
            ImGui::PopStyleColor();
        }
        if (shown_ != context.log.version()) { // new lines scroll into view
            ImGui::SetScrollHereY(1);
            shown_ = context.log.version();
        }
    }

private:
    std::uint64_t shown_ = 0;
};

} // namespace

std::unique_ptr<Panel> make_messages() {
    return std::make_unique<Messages>();
}

} // namespace fascicle::editor
