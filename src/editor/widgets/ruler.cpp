#include "editor/widgets/ruler.hpp"

#include "editor/frame_axis.hpp"
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

} // namespace

RulerResult draw_ruler(const EditorContext& context, const Rect& rect) {
    RulerResult result;
    const Theme& theme = context.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Scale scale{rect, double(context.last_frame())};
    const float bar_height = context.px(7);
    const Rect bar{{rect.min.x, rect.max.y - bar_height}, rect.max};
    draw_motion(context, list, scale, rect.min.y + context.px(16), bar.min.y);
    draw_ticks(context, list, scale);
    draw_cache(context, list, scale, bar);

    const float reach = context.px(6); // the ends are easy to hit
    ImGui::SetCursorScreenPos({rect.min.x - reach, rect.min.y});
    ImGui::InvisibleButton("timeline/ruler", {rect.width() + 2 * reach, rect.height()});
    record_item("timeline/ruler", rect);
    record_item("timeline/cache", bar);
    const double pointer = std::clamp(std::round(scale.frame(ImGui::GetIO().MousePos.x)), 0.0, scale.last);
    if (ImGui::IsItemActive())
        result.moved_to = static_cast<int>(pointer);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        result.hovered = pointer;
        if (!ImGui::IsItemActive())
            ImGui::SetTooltip("%s %s\n%s", axis_label(context.state.ruler),
                              frame_text(context.document.scene(), context.state.ruler, pointer).c_str(),
                              state_text(context.runs.at(static_cast<int>(pointer)).state));
    }

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
