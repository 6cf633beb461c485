#include "editor/dialogs/command_search.hpp"

#include "editor/commands.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <cctype>
#include <imgui_stdlib.h>

namespace fascicle::editor {

namespace {

constexpr const char* popup_name = "Command search";

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

struct Found {
    const KeyBinding* row;
    int quality;
};

std::vector<Found> find(const std::string& text) {
    std::vector<Found> found;
    for (const KeyBinding& row : key_bindings())
        if (const int quality = match_quality(text, std::string(row.label) + " " + row.group); quality > 0)
            found.push_back({&row, quality});
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& a, const Found& b) { return a.quality > b.quality; });
    return found;
}

} // namespace

int match_quality(std::string_view text, std::string_view name) {
    const std::string in = lower(name);
    int quality = 3;
    std::size_t at = 0;
    const std::string wanted = lower(text);
    while (at < wanted.size()) {
        const std::size_t end = std::min(wanted.find(' ', at), wanted.size());
        const std::string word = wanted.substr(at, end - at);
        at = end + 1;
        const std::size_t place = in.find(word);
        if (place == std::string::npos)
            return 0;
        if (in.rfind(word, 0) != 0)
            quality = std::min(quality, in.find(" " + word) != std::string::npos ? 2 : 1);
    }
    return quality;
}

void CommandSearch::open() {
    open_ = appears_ = true;
    text_.clear();
    is_new_ = true;
}

void CommandSearch::draw(EditorContext& context) {
    if (!open_)
        return;
    if (appears_)
        ImGui::OpenPopup(popup_name);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({window.x / 2, std::round(window.y * 0.12f)}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize(
        {std::min(window.x * 0.9f, context.px(520)), std::min(window.y * 0.7f, context.px(390))});
    if (!ImGui::BeginPopup(popup_name, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings)) {
        open_ = false;
        return;
    }
    if (appears_)
        ImGui::SetKeyboardFocusHere();
    appears_ = false;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::InputTextWithHint("##search", "What do you want to do?", &text_))
        is_new_ = true;
    record_item("search/text");
    draw_list(context);
    if (run_)
        open_ = false;
    if (!open_)
        ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    if (const std::optional<Command> command = std::exchange(run_, std::nullopt))
        run_command(context, *command);
}

void CommandSearch::draw_list(EditorContext& context) {
    const std::vector<Found> found = find(text_);
    const int count = static_cast<int>(found.size());
    if (count == 0) {
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
        ImGui::TextUnformatted("No command has these words.");
        ImGui::PopStyleColor();
        return;
    }
    const int before = chosen_;
    if (std::exchange(is_new_, false)) {
        // One that is named in full is meant, whether it can be run or not.
        const std::string text = lower(text_);
        const auto is_meant = [&](const Found& f) {
            return lower(f.row->label) == text || command_state(context, f.row->command).enabled;
        };
        const auto first = std::find_if(found.begin(), found.end(), is_meant);
        chosen_ = first == found.end() ? 0 : static_cast<int>(first - found.begin());
    }
    if (ImGui::IsKeyPressed(key_down))
        ++chosen_;
    if (ImGui::IsKeyPressed(key_up))
        --chosen_;
    chosen_ = (chosen_ % count + count) % count;
    const bool entered = ImGui::IsKeyPressed(key_enter) || ImGui::IsKeyPressed(key_pad_enter);
    ImGui::BeginChild("list", {0, 0});
    for (int i = 0; i < count; ++i) {
        const KeyBinding& row = *found[static_cast<std::size_t>(i)].row;
        const CommandState state = command_state(context, row.command);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x, height = context.px(26);
        ImGui::PushID(static_cast<int>(row.command));
        const bool clicked = ImGui::InvisibleButton("row", {std::max(1.0f, width), height});
        record_item(std::string("search/") + row.label);
        if (ImGui::IsItemHovered() && (ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0))
            chosen_ = i;
        item_tooltip(state.enabled ? row.help : std::string(row.help) + "\nNot now: " + state.reason);
        ImGui::PopID();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (i == chosen_) {
            list.AddRectFilled(at, {at.x + width, at.y + height}, context.theme.accent_dim, context.px(4));
            if (before != chosen_)
                ImGui::SetScrollHereY(0.5f);
        }
        const ImU32 colour = state.enabled ? context.theme.text : context.theme.text_faint;
        const float pad = context.px(8);
        draw_text_in(list, {{at.x + pad, at.y}, {at.x + width * 0.6f, at.y + height}}, colour, row.label);
        const std::string keys = shortcut(row.command);
        draw_text_in(list, {{at.x + width * 0.6f, at.y}, {at.x + width - pad, at.y + height}},
                     state.enabled ? context.theme.text_dim : context.theme.text_faint,
                     state.enabled ? (keys.empty() ? row.group : keys) : state.reason, Align::right);
        if (state.enabled && (clicked || (entered && i == chosen_)))
            run_ = row.command;
    }
    ImGui::EndChild();
}

} // namespace fascicle::editor
