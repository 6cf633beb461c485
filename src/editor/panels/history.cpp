#include "editor/panels/panels.hpp"

#include "editor/widgets/item_recorder.hpp"

namespace fascicle::editor {

namespace {

/// Every change of the scene; a click goes back or forward to it.
class HistoryPanel : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        const History<Scene>& history = context.document.history();
        std::size_t wanted = history.position();
        for (std::size_t i = 0; i < history.steps().size(); ++i) {
            const bool undone = i > history.position();
            ImGui::PushID(static_cast<int>(i));
            ImGui::PushStyleColor(ImGuiCol_Text, undone ? context.theme.text_faint : context.theme.text);
            const std::string label = std::to_string(i) + "   " + history.steps()[i].name;
            if (ImGui::Selectable(label.c_str(), i == history.position()))
                wanted = i;
            record_item("history/" + std::to_string(i));
            ImGui::PopStyleColor();
            ImGui::PopID();
        }
        if (wanted != history.position())
            context.document.jump(wanted);
        if (shown_ != history.steps().size()) {
            ImGui::SetScrollHereY(1);
            shown_ = history.steps().size();
        }
    }

private:
    std::size_t shown_ = 0;
};

} // namespace

std::unique_ptr<Panel> make_history() {
    return std::make_unique<HistoryPanel>();
}

} // namespace fascicle::editor
