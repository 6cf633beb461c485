#include "editor/panels/panels.hpp"

#include "editor/control_guard.hpp"
#include "editor/param_effect.hpp"
#include "editor/presets/preset_bar.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/param_row.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"

#include <algorithm>
#include <cctype>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace {

/// The part of a key before the dot, as a heading.
std::string group_of(const ParamRow& row) {
    std::string group = row.key.substr(0, row.key.find('.'));
    if (!group.empty())
        group[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(group[0])));
    return group;
}

std::string lower(std::string text) {
    for (char& c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Every word of the search is somewhere in the row's texts.
bool matches(const ParamRow& row, const std::string& search) {
    const std::string all = lower(row.key + " " + row.label + " " + row.meaning + " " + row.source);
    const std::string words = lower(search);
    for (std::size_t at = 0; at < words.size();) {
        const std::size_t end = std::min(words.find(' ', at), words.size());
        if (end > at && all.find(words.substr(at, end - at)) == std::string::npos)
            return false;
        at = end + 1;
    }
    return true;
}

class Parameters : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        static_cast<void>(area);
        const ParamTable& table = context.document.scene().parameters.table();
        const float label_width = std::min(context.px(142), ImGui::GetContentRegionAvail().x * 0.42f);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {context.px(6), context.px(5)});
        presets_.draw(context);
        draw_filter(context);
        std::string group;
        bool open = true, any = false;
        for (const ParamRow& row : table.rows()) {
            if (!shown(context, row))
                continue;
            any = true;
            if (group_of(row) != group) {
                group = group_of(row);
                open = heading(context, group);
            }
            if (!open)
                continue;
            draw_param_row(context, row, label_width, no_effect_reason(context.document.scene(), row));
            follow_highlight("parameter/" + row.key);
        }
        if (!any)
            draw_none(context);
        ImGui::Dummy({1, context.px(6)});
        reset_all(context);
        ImGui::PopStyleVar();
    }

private:
    static bool highlighted(const std::string& name) {
        return control_guard() != nullptr && control_guard()->is_highlighted(name);
    }

    bool shown(const EditorContext& context, const ParamRow& row) const {
        if (highlighted("parameter/" + row.key))
            return true;
        if (only_changed_ && !context.document.scene().parameters.edited(row.key))
            return false;
        // What other methods have for themselves would be half of the panel; a search finds it.
        if (search_.empty() && of_another_method(context.document.scene(), row) &&
            !context.document.scene().parameters.edited(row.key))
            return false;
        return matches(row, search_);
    }

    /// What a lesson points at comes into sight once.
    void follow_highlight(const std::string& name) {
        if (!highlighted(name)) {
            if (followed_ == name)
                followed_.clear();
        } else if (followed_ != name) {
            followed_ = name;
            if (!ImGui::IsItemVisible())
                ImGui::SetScrollHereY(0.5f);
        }
    }

    void draw_filter(EditorContext& context) {
        const float height = ImGui::GetFrameHeight(), width = ImGui::GetContentRegionAvail().x;
        ImGui::SetNextItemWidth(std::max(20.0f, width - height - context.px(4)));
        ImGui::InputTextWithHint("##search", "Search name, meaning or source", &search_);
        record_item("parameters/search");
        item_tooltip("Search\nShows the parameters whose key, name, meaning or source has every word.");
        ImGui::SameLine(0, context.px(4));
        if (icon_button(context, "parameters/only_changed", icons::filter, only_changed_, true,
                        "Only changed\nShows the parameters that are not at their default.",
                        height / context.scale()))
            only_changed_ = !only_changed_;
    }

    void draw_none(EditorContext& context) {
        const bool searching = !search_.empty();
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(searching ? "No parameter has these words."
                                         : "Every parameter is at its default.");
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        if (ImGui::Button("Show all")) {
            search_.clear();
            only_changed_ = false;
        }
        record_item("parameters/show_all");
    }

    /// A line that folds the rows below it. Open while something in it is searched for or pointed at.
    bool heading(EditorContext& context, const std::string& group) {
        const Theme& theme = context.theme;
        const ParamSet& parameters = context.document.scene().parameters;
        int changed = 0;
        bool forced = !search_.empty() || only_changed_;
        for (const ParamRow& row : parameters.table().rows())
            if (group_of(row) == group) {
                changed += parameters.edited(row.key) ? 1 : 0;
                forced |= highlighted("parameter/" + row.key);
            }
        const float width = ImGui::GetContentRegionAvail().x, height = context.px(24);
        ImGui::PushID(group.c_str());
        if (ImGui::InvisibleButton("fold", {std::max(1.0f, width), height}) && !forced) {
            if (folded_.count(group) != 0)
                folded_.erase(group);
            else
                folded_.insert(group);
        }
        record_item("parameters/group/" + group);
        const bool open = forced || folded_.count(group) == 0;
        const ImVec2 at = ImGui::GetItemRectMin();
        const bool hovered = ImGui::IsItemHovered();
        item_tooltip(open ? "A click folds this group." : "A click opens this group.");
        ImGui::PopID();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImU32 colour = hovered ? theme.text : theme.text_dim;
        const float middle = std::round(at.y + height / 2), r = context.px(3.5f), x = at.x + context.px(5);
        if (open)
            list.AddTriangleFilled({x - r, middle - r / 2}, {x + r, middle - r / 2}, {x, middle + r}, colour);
        else
            list.AddTriangleFilled({x - r / 2, middle - r}, {x + r, middle}, {x - r / 2, middle + r}, colour);
        const float begin = at.x + context.px(16);
        draw_text_in(list, {{begin, at.y}, {at.x + width, at.y + height}}, colour, group);
        float right = at.x + width;
        if (changed > 0) {
            const std::string note = std::to_string(changed) + " changed";
            right -= text_size(note).x;
            draw_text_in(list, {{right, at.y}, {at.x + width + 1, at.y + height}}, theme.text_faint, note);
            right -= context.px(8);
        }
        list.AddLine({begin + text_size(group).x + context.px(8), middle}, {right, middle}, theme.line);
        return open;
    }

    static void reset_all(EditorContext& context) {
        const ParamSet& parameters = context.document.scene().parameters;
        bool edited = false;
        for (const ParamRow& row : parameters.table().rows())
            edited |= parameters.edited(row.key);
        const LockScope lock("parameters/reset_all");
        ImGui::BeginDisabled(!edited);
        if (ImGui::Button("Reset all", {ImGui::GetContentRegionAvail().x, 0}))
            actions::reset_all_parameters(context.document);
        record_item("parameters/reset_all");
        ImGui::EndDisabled();
        item_tooltip(
            lock.tip(edited ? "Every parameter back to its default." : "Every parameter is at its default."));
    }

    PresetBar presets_;
    std::string search_, followed_;
    bool only_changed_ = false;
    std::set<std::string> folded_;
};

} // namespace

std::unique_ptr<Panel> make_parameters() {
    return std::make_unique<Parameters>();
}

} // namespace fascicle::editor
