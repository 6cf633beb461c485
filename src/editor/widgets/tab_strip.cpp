#include "editor/widgets/tab_strip.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace {

/// What a tab without room for its title shows.
std::string short_title(const Tab& tab) {
    if (icons_available() && tab.icon.glyph != nullptr && tab.icon.glyph[0] != '\0')
        return tab.icon.glyph;
    return tab.title.substr(0, 2);
}

} // namespace

int draw_tab_strip(const EditorContext& context, ImFont* heading, const std::vector<Tab>& tabs,
                   std::size_t front, const Rect& strip, float& end) {
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(strip.min, strip.max, theme.header);
    ImGui::PushFont(heading);
    const float pad = context.px(11);
    std::vector<float> widths;
    float sum = 0;
    for (const Tab& tab : tabs) {
        widths.push_back(text_size(tab.title).x + 2 * pad);
        sum += widths.back();
    }
    const bool compact = sum > strip.width() && tabs.size() > 1;
    if (compact) {
        const float room = strip.width() - widths[front];
        const float each =
            std::clamp(room / static_cast<float>(tabs.size() - 1), context.px(18), context.px(34));
        for (std::size_t i = 0; i < tabs.size(); ++i)
            if (i != front)
                widths[i] = std::floor(each);
    }
    int clicked = -1;
    float x = strip.min.x;
    for (std::size_t i = 0; i < tabs.size(); ++i) {
        const Tab& tab = tabs[i];
        const bool active = i == front, small = compact && !active;
        const Rect rect{{x, strip.min.y}, {std::min(x + widths[i], strip.max.x), strip.max.y}};
        x = rect.max.x;
        if (tabs.size() > 1 && rect.width() >= 1) {
            ImGui::SetCursorScreenPos(rect.min);
            ImGui::PushID(tab.id);
            if (ImGui::InvisibleButton("tab", {rect.width(), rect.height()}))
                clicked = static_cast<int>(i);
            record_item(std::string("tab/") + tab.id);
            if (active)
                list.AddRectFilled({rect.min.x, rect.max.y - context.px(2)}, rect.max, theme.accent);
            else if (ImGui::IsItemHovered())
                list.AddRectFilled(rect.min, rect.max, theme.field);
            if (small) {
                ImGui::PopFont();
                item_tooltip(tab.title);
                ImGui::PushFont(heading);
            }
            ImGui::PopID();
        }
        const ImU32 colour = tab.alarm ? theme.bad : active ? theme.text : theme.text_dim;
        if (small) { // icons are in the text font alone
            ImGui::PopFont();
            draw_text_in(list, rect, colour, short_title(tab), Align::centre);
            ImGui::PushFont(heading);
        } else
            draw_text_in(list, {{rect.min.x + pad, rect.min.y}, rect.max}, colour, tab.title);
    }
    ImGui::PopFont();
    end = x;
    return clicked;
}

} // namespace fascicle::editor
