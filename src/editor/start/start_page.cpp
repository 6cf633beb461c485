#include "editor/start/start_page.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/project/project_flow.hpp"
#include "editor/widgets/icons.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/base/build_info.hpp"
#include "fascicle/io/format_registry.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace fascicle::editor {

namespace {

/// "OBJ, VTK, VTP": what the readers know.
const std::string& readable_formats() {
    static const std::string text = [] {
        std::string all;
        for (const MeshFormat& format : mesh_formats())
            for (const char c : (all.empty() ? "" : ", ") + format.extensions.front().substr(1))
                all += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        return all;
    }();
    return text;
}

using C = Command;

constexpr float side_width = 252, margin = 36, card_width = 208, card_gap = 18, page_width = 1180;

bool in_use(const Scene& scene) {
    return !scene.bones.empty() || !scene.muscles.empty();
}

/// A wide button with an icon, its words at the left and its key at the right.
bool wide_button(const EditorContext& context, const char* name, const Icon& icon, const std::string& words,
                 const std::string& key, const std::string& tip, float width, bool primary = false) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = context.px(34);
    const Theme& theme = context.theme;
    ImGui::PushID(name);
    const bool clicked = ImGui::InvisibleButton("wide", {width, height});
    ImGui::PopID();
    record_item(name);
    item_tooltip(tip);
    const Rect rect{at, {at.x + width, at.y + height}};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 ground = ImGui::IsItemActive()    ? theme.field_active
                         : ImGui::IsItemHovered() ? theme.field_hovered
                         : primary                ? theme.accent_dim
                                                  : theme.field;
    list.AddRectFilled(rect.min, rect.max, ground, context.px(5));
    const float x = at.x + context.px(12);
    if (icons_available())
        draw_text_in(list, {{x, at.y}, {x + context.px(20), rect.max.y}}, primary ? theme.text : theme.accent,
                     text(icon));
    draw_text_in(list, {{x + context.px(28), at.y}, {rect.max.x - context.px(60), rect.max.y}}, theme.text,
                 words);
    draw_text_in(list, {{x, at.y}, {rect.max.x - context.px(12), rect.max.y}},
                 primary ? theme.text_dim : theme.text_faint, key, Align::right);
    return clicked;
}

} // namespace

void start_with_meshes(EditorContext& context, const std::vector<std::filesystem::path>& files) {
    const auto go = [files](EditorContext& c) {
        if (in_use(c.document.scene()))
            open_empty_scene(c, false);
        c.state.show_start = false;
        if (files.empty())
            c.dialogs.mesh.open();
        else
            c.dialogs.mesh.open_with(files);
    };
    if (in_use(context.document.scene()))
        unless_unsaved(context, "starting a new scene", go);
    else
        go(context);
}

void StartPage::collect(EditorContext& context) {
    sections_.clear();
    for (const StartSection& section : start_sections()) {
        Section one{&section, {}};
        for (StartCard& card : section.cards(context))
            one.cards.push_back({std::move(card), {}});
        sections_.push_back(std::move(one));
    }
    stale_ = false;
}

void StartPage::update(EditorContext& context) {
    const bool appears = context.state.show_start && !shown_;
    shown_ = context.state.show_start;
    if (!shown_)
        return;
    if (appears || stale_)
        collect(context);
    if (context.view != nullptr)
        pictures_.update(context);
}

std::optional<double> StartPage::redraw_after() const {
    return shown_ && pictures_.busy() ? std::optional<double>(0.1) : std::nullopt;
}

void StartPage::draw_drop_place(const EditorContext& context, float width, float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const Rect rect{at,
                    {at.x + width - 1, at.y + height}}; // the last pixel belongs to the border of the child
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 colour = context.theme.text_faint;
    const float dash = context.px(6);
    for (float x = rect.min.x; x < rect.max.x; x += 2 * dash)
        for (const float y : {rect.min.y, rect.max.y})
            list.AddLine({x, y}, {std::min(x + dash, rect.max.x), y}, colour);
    for (float y = rect.min.y; y < rect.max.y; y += 2 * dash)
        for (const float x : {rect.min.x, rect.max.x})
            list.AddLine({x, y}, {x, std::min(y + dash, rect.max.y)}, colour);
    const float middle = (rect.min.y + rect.max.y) / 2, line = ImGui::GetTextLineHeight();
    draw_text_in(list, {{rect.min.x, middle - line * 1.25f}, {rect.max.x, middle - line * 0.25f}},
                 context.theme.text_dim, "Drop a mesh or a project here", Align::centre);
    draw_text_in(list, {{rect.min.x, middle + line * 0.1f}, {rect.max.x, middle + line * 1.1f}},
                 context.theme.text_faint, readable_formats(), Align::centre);
    ImGui::Dummy({width, height});
    record_item("start/drop");
}

void StartPage::draw_ways_in(EditorContext& context, float width) {
    const Theme& theme = context.theme;
    ImGui::PushFont(heading_);
    ImGui::PushStyleColor(ImGuiCol_Text, theme.accent);
    ImGui::TextUnformatted("fascicle");
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::PushStyleColor(ImGuiCol_Text, theme.text_dim);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted("See and measure how muscles deform when bones move.");
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::Dummy({1, context.px(10)});
    const Scene& scene = context.document.scene();
    if (in_use(scene) && wide_button(context, "start/back", icons::back,
                                     elided("Back to " + scene.name, width - context.px(90)), "Esc",
                                     "Shows the scene that is open", width, true))
        context.state.show_start = false;
    if (wide_button(context, "start/open", icons::open, "Open project", shortcut(C::open_project),
                    tooltip(C::open_project), width, !in_use(scene)))
        wish_ = choose_project;
    if (wide_button(context, "start/mesh", icons::plus, "Load meshes", shortcut(C::open_file),
                    "Bones and muscles from files, into a new scene", width))
        wish_ = [](EditorContext& c) { start_with_meshes(c, {}); };
    if (wide_button(context, "start/empty", icons::file, "Empty scene", in_use(scene) ? "" : "Esc",
                    "Begins with nothing", width))
        wish_ = [](EditorContext& c) {
            if (!in_use(c.document.scene())) {
                c.state.show_start = false;
                return;
            }
            unless_unsaved(c, "starting a new scene",
                           [](EditorContext& inner) { open_empty_scene(inner, false); });
        };
    ImGui::Dummy({1, context.px(6)});
    draw_drop_place(context, width, context.px(92));
    ImGui::Dummy({1, context.px(8)});
    draw_state(context, width);
    ImGui::PushStyleColor(ImGuiCol_Text, theme.text_faint);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(
        "F1 lists all keys. Every control says what it does when the pointer rests on it.");
    ImGui::TextUnformatted((std::string("Version ") + program_version()).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

/// What is being opened, or why something could not be.
void StartPage::draw_state(EditorContext& context, float width) {
    SceneOpener& opener = context.features.opener;
    if (opener.reading()) {
        ImGui::TextUnformatted(elided("Opening " + opener.what(), width).c_str());
        ImGui::ProgressBar(static_cast<float>(opener.progress()), {width - context.px(84), context.px(18)},
                           "");
        record_item("start/progress");
        ImGui::SameLine(0, context.px(8));
        if (ImGui::SmallButton("Cancel"))
            opener.cancel();
        record_item("start/cancel");
        item_tooltip("Gives up opening it");
    } else if (!opener.problem().empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.bad);
        ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
        ImGui::TextUnformatted(opener.problem().c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        record_item("start/problem");
    } else {
        return;
    }
    ImGui::Dummy({1, context.px(6)});
}

void StartPage::draw_card(EditorContext& context, Card& card, const Rect& area) {
    const StartCard& facts = card.card;
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool missing = !facts.missing.empty();
    const float picture = area.width() * 0.625f, pad = context.px(9), line = ImGui::GetTextLineHeight();
    ImGui::SetCursorScreenPos(area.min);
    ImGui::PushID(facts.id.c_str());
    const bool clicked = ImGui::InvisibleButton("card", {area.width(), area.height()});
    ImGui::SetItemAllowOverlap();
    const bool hovered = ImGui::IsItemHovered();
    record_item("start/" + facts.id);
    item_tooltip(facts.tip);
    list.AddRectFilled(area.min, area.max, theme.panel, context.px(5));
    const Rect top{area.min, {area.max.x, area.min.y + picture}};
    list.AddRectFilled(top.min, top.max, theme.plot, context.px(5), ImDrawFlags_RoundCornersTop);
    if (facts.embedded.empty()) {
        card.picture.load(context, facts.picture);
        card.picture.draw(context, top, missing ? 0.35f : 1);
    } else {
        pictures_.picture(facts.embedded).draw(context, top);
    }
    const float y = area.min.y + picture + context.px(7), right = area.max.x - pad;
    draw_text_in(list, {{area.min.x + pad, y}, {right, y + line}}, missing ? theme.text_faint : theme.text,
                 facts.title);
    const ImVec2 words{area.min.x + pad, y + line + context.px(2)};
    const ImVec4 clip{words.x, words.y, right, words.y + 2 * line + context.px(1)}; // two lines of it
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), words, missing ? theme.warning : theme.text_faint,
                 (missing ? facts.missing : facts.line).c_str(), nullptr, right - words.x, &clip);
    list.AddRect(area.min, area.max, hovered ? theme.accent : theme.line, context.px(5), 0,
                 hovered ? context.px(1.5f) : 1);
    if (facts.remove && (hovered || missing)) {
        const float size = context.px(24);
        ImGui::SetCursorScreenPos({area.max.x - size - context.px(4), area.min.y + context.px(4)});
        if (icon_button(context, ("start/" + facts.id + "/remove").c_str(), icons::close, false, true,
                        "Takes it from this list; the file stays", 24)) {
            wish_ = [this, remove = facts.remove](EditorContext& c) {
                remove(c);
                stale_ = true;
            };
            ImGui::PopID();
            return;
        }
    }
    if (clicked)
        wish_ = facts.open; // of a missing one the opener says what is wrong
    ImGui::PopID();
}

void StartPage::draw_section(EditorContext& context, Section& section, float width) {
    if (section.cards.empty() && section.section->empty == nullptr)
        return;
    ImGui::PushFont(heading_);
    ImGui::TextUnformatted(section.section->title);
    ImGui::PopFont();
    ImGui::Dummy({1, context.px(2)});
    if (section.cards.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_faint);
        ImGui::TextUnformatted(section.section->empty);
        ImGui::PopStyleColor();
        ImGui::Dummy({1, context.px(18)});
        return;
    }
    const float gap = context.px(card_gap);
    const int columns = std::max(1, static_cast<int>((width + gap) / (context.px(card_width) + gap)));
    const float card =
        std::floor((width - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
    const float height = card * 0.625f + 3 * ImGui::GetTextLineHeight() + context.px(18);
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const auto count = static_cast<int>(section.cards.size());
    for (int i = 0; i < count; ++i) {
        const ImVec2 at{start.x + static_cast<float>(i % columns) * (card + gap),
                        start.y + static_cast<float>(i / columns) * (height + gap)};
        draw_card(context, section.cards[static_cast<std::size_t>(i)], {at, {at.x + card, at.y + height}});
    }
    const auto rows = static_cast<float>((count + columns - 1) / columns);
    ImGui::SetCursorScreenPos(start);
    ImGui::Dummy({width, rows * (height + gap) + context.px(8)});
}

void StartPage::draw(EditorContext& context, const Rect& area, ImFont* heading) {
    heading_ = heading;
    ImGui::SetNextWindowPos(area.min);
    ImGui::SetNextWindowSize({area.width(), area.height()});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, context.theme.bar);
    const bool open = ImGui::Begin("start page", nullptr,
                                   ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    if (open) {
        const float width = std::min(area.width() - 2 * context.px(margin), context.px(page_width));
        const float left = area.min.x + std::floor((area.width() - width) / 2),
                    top = area.min.y + context.px(margin);
        const float side = std::min(context.px(side_width), width * 0.4f), gap = context.px(margin);
        ImGui::SetCursorScreenPos({left, top});
        if (ImGui::BeginChild("ways in", {side, area.max.y - top}, false, ImGuiWindowFlags_NoBackground))
            draw_ways_in(context, side);
        ImGui::EndChild();
        ImGui::SetCursorScreenPos({left + side + gap, top});
        const float bar = ImGui::GetStyle().ScrollbarSize, room = width - side - gap;
        if (ImGui::BeginChild("cards", {room + bar + context.px(4), area.max.y - top}, false,
                              ImGuiWindowFlags_NoBackground))
            for (Section& section : sections_)
                draw_section(context, section, room);
        ImGui::EndChild();
    }
    ImGui::End();
    if (const auto wish = std::exchange(wish_, nullptr))
        wish(context);
}

} // namespace fascicle::editor
