#include "editor/widgets/ruler.hpp"

#include "editor/frame_axis.hpp"
#include "editor/playback.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

namespace {

struct Scale {
    Rect rect;
    double last;
    float x(double frame) const {
        return rect.min.x + static_cast<float>(frame / std::max(1.0, last)) * rect.width();
    }
    double frame(float px) const {
        return double(px - rect.min.x) / double(std::max(1.0f, rect.width())) * last;
    }
};

void draw_ticks(const EditorContext& context, ImDrawList& list, const Scale& scale) {
    const Theme& theme = context.theme;
    const Scene& scene = context.document.scene();
    const float wide = std::max(context.px(64), text_size("00000").x * 1.6f);
    const Ticks ticks = nice_ticks(0, scale.last, std::max(1, static_cast<int>(scale.rect.width() / wide)));
    for (int i = 0; i < ticks.count; ++i) {
        const float x = std::round(scale.x(ticks.at(i)));
        list.AddLine({x, scale.rect.min.y + context.px(16)}, {x, scale.rect.max.y}, theme.line);
        const std::string text = frame_text(scene, context.state.ruler, ticks.at(i));
        const float width = text_size(text).x;
        const float left =
            std::clamp(x - width / 2, scale.rect.min.x, std::max(scale.rect.min.x, scale.rect.max.x - width));
        draw_text(list, {left, scale.rect.min.y - context.px(1)}, theme.text_faint, text);
    }
}

/// The joint angle over the frames, from the bottom (least) to the top.
void draw_motion(const EditorContext& context, ImDrawList& list, const Scale& scale, float top,
                 float bottom) {
    const Timeline& timeline = context.document.scene().timeline;
    if (timeline.angles.empty())
        return;
    double most = 0;
    for (const AngleKey& key : timeline.angles)
        most = std::max(most, std::abs(key.angle_rad));
    if (most == 0)
        return;
    const int pieces = std::clamp(static_cast<int>(scale.rect.width() / 4), 1, 400);
    const auto point = [&](int i) {
        const double frame = scale.last * i / pieces;
        const double share = std::abs(timeline.angle_rad(frame)) / most;
        return ImVec2(scale.x(frame), bottom - (bottom - top) * static_cast<float>(share));
    };
    const ImDrawListFlags flags = list.Flags;
    list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (int i = 0; i < pieces; ++i) {
        const ImVec2 a = point(i), b = point(i + 1);
        list.AddQuadFilled({a.x, bottom}, a, b, {b.x, bottom}, with_alpha(context.theme.text_faint, 0.22f));
    }
    list.Flags = flags;
}

void draw_cache(const EditorContext& context, ImDrawList& list, const Scale& scale, const Rect& bar) {
    const Theme& theme = context.theme;
    const RunManager& runs = context.runs;
    list.AddRectFilled(bar.min, bar.max, theme.missing);
    const auto span = [&](int from, int to) { // frames [from, to): from the first's place to the last's
        return Rect{{from == 0 ? bar.min.x : scale.x(from - 1), bar.min.y},
                    {std::min(bar.max.x, scale.x(to - 1)), bar.max.y}};
    };
    const int valid = runs.valid_count(),
              available = std::min(runs.available_count(), context.last_frame() + 1);
    if (available > valid) {
        const Rect rect = span(valid, available);
        list.AddRectFilled(rect.min, rect.max, with_alpha(theme.stale, 0.35f));
        draw_hatching(list, rect, theme.stale, context.px(6), context.px(1.6f));
    }
    if (valid > 0) {
        const Rect rect = span(0, std::min(valid, context.last_frame() + 1));
        list.AddRectFilled(rect.min, rect.max, theme.valid);
    }
}

/// What is not played is veiled; grips at both ends of what is.
void draw_range(const EditorContext& context, ImDrawList& list, const Scale& scale, const Rect& bar) {
    const Theme& theme = context.theme;
    const auto [low, high] = played_range(context.state.playback, context.last_frame());
    const ImU32 veil = with_alpha(theme.panel, 0.6f);
    if (low > 0)
        list.AddRectFilled({scale.rect.min.x, scale.rect.min.y + context.px(16)}, {scale.x(low), bar.max.y},
                           veil);
    if (high < context.last_frame())
        list.AddRectFilled({scale.x(high), scale.rect.min.y + context.px(16)}, {scale.rect.max.x, bar.max.y},
                           veil);
    const float half = std::max(1.5f, context.px(2));
    const ImU32 colour = context.state.playback.range ? theme.accent : theme.text_faint;
    const auto grip = [&](int frame, const char* name) {
        const float x = std::round(scale.x(frame));
        const Rect rect{{x - half, bar.min.y - context.px(4)}, {x + half, bar.max.y + context.px(3)}};
        list.AddRectFilled(rect.min, rect.max, colour, half);
        record_item(name, rect);
    };
    grip(low, "timeline/range/first");
    grip(high, "timeline/range/last");
}

float marker_middle(const EditorContext& context, const Rect& rect, const Rect& bar) {
    return (rect.min.y + context.px(16) + bar.min.y) / 2;
}

void draw_markers(const EditorContext& context, ImDrawList& list, const Scale& scale, const Rect& bar,
                  const RulerGrab& grab) {
    const std::vector<Marker>& markers = context.document.scene().markers;
    const float half = context.px(5), y = marker_middle(context, scale.rect, bar);
    for (std::size_t i = 0; i < markers.size(); ++i) {
        const bool held = grab.what == RulerGrab::What::marker && grab.marker == i;
        const int frame = held ? grab.frame : markers[i].frame;
        if (frame > context.last_frame())
            continue;
        const float x = std::round(scale.x(frame));
        list.AddLine({x, scale.rect.min.y + context.px(16)}, {x, bar.max.y},
                     with_alpha(context.theme.warning, 0.7f), context.scale());
        list.AddQuadFilled({x, y - half}, {x + half, y}, {x, y + half}, {x - half, y}, context.theme.warning);
        record_item("timeline/marker/" + markers[i].name, {{x - half, y - half}, {x + half, y + half}});
        // The name, where the next marker leaves room for it.
        const float next = i + 1 < markers.size() ? scale.x(markers[i + 1].frame) : scale.rect.max.x;
        const std::string shown = elided(markers[i].name, next - x - 3 * half);
        draw_text(list, {x + half + context.px(3), y - ImGui::GetFontSize() / 2}, context.theme.text_dim,
                  shown);
    }
}

const char* state_text(FrameState state) {
    switch (state) {
    case FrameState::valid:
        return "computed";
    case FrameState::stale:
        return "stale: made with other parameters";
    case FrameState::missing:
        return "not computed yet";
    }
    return "";
}

/// What is under the pointer, as a press would take it.
RulerGrab under_pointer(const EditorContext& context, const Scale& scale, const Rect& bar) {
    const ImVec2 p = ImGui::GetIO().MousePos;
    const auto [low, high] = played_range(context.state.playback, context.last_frame());
    const float reach = context.px(6);
    if (p.y >= bar.min.y - context.px(4)) {
        const float to_first = std::abs(p.x - scale.x(low)), to_last = std::abs(p.x - scale.x(high));
        // Where both are in reach, the one on whose side the pointer is.
        if (to_last <= reach && (to_last < to_first || p.x >= scale.x(high)))
            return {RulerGrab::What::last, 0, high};
        if (to_first <= reach)
            return {RulerGrab::What::first, 0, low};
    }
    const std::vector<Marker>& markers = context.document.scene().markers;
    const float y = marker_middle(context, scale.rect, bar);
    for (std::size_t i = 0; i < markers.size(); ++i)
        if (std::abs(p.x - scale.x(markers[i].frame)) <= reach && std::abs(p.y - y) <= reach)
            return {RulerGrab::What::marker, i, markers[i].frame};
    return {RulerGrab::What::playhead, 0, 0};
}

void hint(const EditorContext& context, const RulerGrab& grab, double pointer) {
    switch (grab.what) {
    case RulerGrab::What::first:
        return ImGui::SetTooltip("First frame that is played: %d\nDrag to change it.", grab.frame);
    case RulerGrab::What::last:
        return ImGui::SetTooltip("Last frame that is played: %d\nDrag to change it.", grab.frame);
    case RulerGrab::What::marker:
        return ImGui::SetTooltip("%s, frame %d\nDrag moves it, a right click shows its menu.",
                                 context.document.scene().markers[grab.marker].name.c_str(), grab.frame);
    default:
        ImGui::SetTooltip("%s %s\n%s\nDouble-click adds a marker.", axis_label(context.state.ruler),
                          frame_text(context.document.scene(), context.state.ruler, pointer).c_str(),
                          state_text(context.runs.at(static_cast<int>(pointer)).state));
    }
}

/// What a drag that is under way does.
void drag(const EditorContext& context, RulerGrab& grab, int pointer, RulerResult& result) {
    auto [low, high] = played_range(context.state.playback, context.last_frame());
    switch (grab.what) {
    case RulerGrab::What::playhead:
        result.moved_to = pointer;
        break;
    case RulerGrab::What::first:
        result.range = std::pair(std::min(pointer, high), high);
        break;
    case RulerGrab::What::last:
        result.range = std::pair(low, std::max(pointer, low));
        break;
    case RulerGrab::What::marker:
        grab.frame = pointer;
        break;
    case RulerGrab::What::none:
        break;
    }
}

} // namespace

RulerResult draw_ruler(const EditorContext& context, const Rect& rect, RulerGrab& grab) {
    RulerResult result;
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Scale scale{rect, double(context.last_frame())};
    const float bar_height = context.px(7);
    const Rect bar{{rect.min.x, rect.max.y - bar_height}, rect.max};
    draw_motion(context, list, scale, rect.min.y + context.px(16), bar.min.y);
    draw_ticks(context, list, scale);
    draw_cache(context, list, scale, bar);
    draw_range(context, list, scale, bar);
    draw_markers(context, list, scale, bar, grab);

    const float reach = context.px(6); // the ends are easy to hit
    ImGui::SetCursorScreenPos({rect.min.x - reach, rect.min.y});
    ImGui::InvisibleButton("timeline/ruler", {rect.width() + 2 * reach, rect.height() + context.px(4)},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    record_item("timeline/ruler", rect);
    record_item("timeline/cache", bar);
    const double pointer = std::clamp(std::round(scale.frame(ImGui::GetIO().MousePos.x)), 0.0, scale.last);
    const int frame = static_cast<int>(pointer);
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    const RulerGrab under = under_pointer(context, scale, bar);
    if (hovered && ImGui::IsMouseClicked(0))
        grab = under;
    if (active && ImGui::IsMouseDown(0))
        drag(context, grab, frame, result);
    if (!ImGui::IsMouseDown(0) && grab.what != RulerGrab::What::none) {
        if (grab.what == RulerGrab::What::marker)
            result.moved_marker = std::pair(grab.marker, grab.frame);
        grab = {};
    }
    if (hovered && ImGui::IsMouseDoubleClicked(0) && under.what == RulerGrab::What::playhead)
        result.double_clicked = frame;
    if (hovered && ImGui::IsMouseReleased(1)) {
        result.menu_at = frame;
        if (under.what == RulerGrab::What::marker)
            result.menu_marker = under.marker;
    }
    if (hovered || active)
        result.hovered = pointer;
    if (hovered && !active)
        hint(context, under, pointer);

    if (context.state.hover_frame) {
        const float x = std::round(scale.x(*context.state.hover_frame));
        list.AddLine({x, rect.min.y + context.px(15)}, {x, rect.max.y}, theme.hover_line, context.scale());
    }
    const float head = std::round(scale.x(context.playhead()));
    const float half = context.px(5);
    const float top = rect.min.y + context.px(13);
    list.AddLine({head, top}, {head, rect.max.y}, theme.playhead, std::max(1.0f, context.px(1.5f)));
    const ImVec2 handle[] = {{head - half, top},
                             {head + half, top},
                             {head + half, top + half},
                             {head, top + 2 * half},
                             {head - half, top + half}};
    list.AddConvexPolyFilled(handle, 5, theme.playhead);
    return result;
}

} // namespace fascicle::editor
