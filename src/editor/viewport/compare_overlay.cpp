#include "editor/viewport/compare_overlay.hpp"

#include "editor/features.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/legend.hpp"
#include "editor/widgets/paint.hpp"

#include <cmath>

namespace fascicle::editor {

namespace {

/// "A  Run 3", with what is missing of it.
std::string label(const EditorContext& context, const char* letter, const ComparedRun& run, float room) {
    std::string text = std::string(letter) + "  " + run.name;
    if (run.ended) {
        const bool computing = run.recording->state() == RunState::running;
        text +=
            (computing ? ", computed up to frame " : ", ends at frame ") + std::to_string(run.frame->index);
    }
    return elided(text, std::max(context.px(40), room));
}

void badge(EditorContext& context, ImDrawList& list, const Rect& part, const char* name, const char* letter,
           const ComparedRun& run, float below = 0, const render::Rgba* colour = nullptr) {
    const Theme& theme = context.theme;
    const float pad = context.px(12);
    const std::string text = label(context, letter, run, part.width() - 4 * pad);
    const Rect plate = draw_badge(list, {part.min.x + pad, part.min.y + pad + below}, Align::left, text,
                                  run.ended ? theme.warning : theme.text, theme.badge);
    if (colour != nullptr) // that the run's muscles have
        list.AddRectFilled(plate.min, {plate.min.x + context.px(4), plate.max.y},
                           ImGui::ColorConvertFloat4ToU32({(*colour)[0], (*colour)[1], (*colour)[2], 1.0f}),
                           context.px(4), ImDrawFlags_RoundCornersLeft);
    record_item(name, plate);
}

} // namespace

Rect compare_part(const EditorContext& context, const Rect& area, bool second) {
    if (!context.features.compare.active(CompareMode::side_by_side))
        return area;
    const float width = std::floor((area.width() - context.px(2)) / 2); // the same for both
    return second ? Rect{{area.max.x - width, area.min.y}, area.max}
                  : Rect{area.min, {area.min.x + width, area.max.y}};
}

void draw_compare_overlay(EditorContext& context, ImDrawList& list, const Rect& area) {
    const Compare& compare = context.features.compare;
    if (!compare.active())
        return;
    const Theme& theme = context.theme;
    const float below = context.px(30);
    switch (compare.choice.mode) {
    case CompareMode::side_by_side: {
        const Rect left = compare_part(context, area, false), right = compare_part(context, area, true);
        list.AddRectFilled({left.max.x, area.min.y}, {right.min.x, area.max.y}, theme.gap);
        badge(context, list, left, "viewport/a", "A", compare.a());
        badge(context, list, right, "viewport/b", "B", compare.b());
        break;
    }
    case CompareMode::blink:
        if (compare.choice.shows_b)
            badge(context, list, area, "viewport/b", "B", compare.b());
        else
            badge(context, list, area, "viewport/a", "A", compare.a());
        break;
    case CompareMode::difference: {
        badge(context, list, area, "viewport/a", "A", compare.a());
        badge(context, list, area, "viewport/b", "B", compare.b(), below);
        if (area.height() < context.px(240))
            break;
        const ImVec2 corner{area.max.x - context.px(12), area.min.y + context.px(12)};
        record_item("viewport/legend", draw_colour_bar(list, corner, "Distance A to B [mm]",
                                                       compare.difference_scale(), theme, context.scale()));
        break;
    }
    case CompareMode::ghost: {
        badge(context, list, area, "viewport/a", "A", compare.a(), 0, &view::palette::muscle);
        badge(context, list, area, "viewport/b", "B", compare.b(), below, &view::palette::compared);
        break;
    }
    case CompareMode::off:
        break;
    }
}

} // namespace fascicle::editor
