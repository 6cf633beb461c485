#include "editor/panels/panels.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/param_row.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"

#include <cctype>

namespace fascicle::editor {

namespace {

/// The part of a key before the dot, as a heading.
std::string group_of(const ParamRow& row) {
    std::string group = row.key.substr(0, row.key.find('.'));
    if (!group.empty())
        group[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(group[0])));
    return group;
}

class Parameters : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        const ParamSet& parameters = context.document.scene().parameters;
        const float label_width = std::min(context.px(142), ImGui::GetContentRegionAvail().x * 0.42f);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(5)});
        std::string group;
        for (const ParamRow& row : parameters.table().rows()) {
            if (group_of(row) != group) {
                heading(context, group_of(row), group.empty());
                group = group_of(row);
            }
            draw_param_row(context, row, label_width, disabled_reason(parameters, row));
        }
        ImGui::Dummy({1, context.px(6)});
        reset_all(context);
        ImGui::PopStyleVar();
    }

private:
    static void heading(const EditorContext& context, const std::string& title, bool first) {
        if (!first)
            ImGui::Dummy({1, context.px(4)});
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x, height = context.px(20);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        draw_text_in(list, {at, {at.x + width, at.y + height}}, context.theme.text_faint, title);
        const float x = at.x + text_size(title).x + context.px(8), y = std::round(at.y + height / 2);
        list.AddLine({x, y}, {at.x + width, y}, context.theme.line);
        ImGui::Dummy({width, height});
    }

    static std::string disabled_reason(const ParamSet& parameters, const ParamRow& row) {
        const std::string& method = parameters.get_choice("solver.method");
        if (row.key.rfind("classic.", 0) == 0 && method != "classic")
            return "only the method classic uses it";
        if (row.key == "solver.frame_time" && method == "classic")
            return "classic takes 1 ms an inner loop";
        return {};
    }

    static void reset_all(EditorContext& context) {
        const ParamSet& parameters = context.document.scene().parameters;
        bool edited = false;
        for (const ParamRow& row : parameters.table().rows())
            edited |= parameters.edited(row.key);
        ImGui::BeginDisabled(!edited);
        if (ImGui::Button("Reset all", {ImGui::GetContentRegionAvail().x, 0}))
            actions::reset_all_parameters(context.document);
        record_item("parameters/reset_all");
        ImGui::EndDisabled();
        item_tooltip(edited ? "Every parameter back to its default." : "Every parameter is at its default.");
    }
};

} // namespace

std::unique_ptr<Panel> make_parameters() {
    return std::make_unique<Parameters>();
}

} // namespace fascicle::editor
