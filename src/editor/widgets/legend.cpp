#include "editor/widgets/legend.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

namespace {

ImU32 packed(const render::Rgba& c) {
    return ImGui::ColorConvertFloat4ToU32({c[0], c[1], c[2], c[3]});
}

} // namespace

Rect draw_colour_bar(ImDrawList& list, ImVec2 corner, const std::string& title,
                     const view::ColourScale& scale, const Theme& theme, float ui_scale) {
    const float line = ImGui::GetTextLineHeight(), pad = std::round(9 * ui_scale);
    const float bar_width = std::round(12 * ui_scale), bar_height = std::round(130 * ui_scale);
    const std::vector<view::LegendTick> ticks = view::legend_ticks(scale, 7);
    float labels = 0;
    for (const view::LegendTick& tick : ticks)
        labels = std::max(labels, text_size(tick.label).x);
    const float width = std::max(text_size(title).x, bar_width + 8 * ui_scale + labels) + 2 * pad;
    const Rect plate{{std::round(corner.x - width), corner.y},
                     {corner.x, corner.y + bar_height + line * 1.9f + 2 * pad}};
    list.AddRectFilled(plate.min, plate.max, theme.badge, 6 * ui_scale);
    draw_text(list, {plate.min.x + pad, plate.min.y + pad * 0.8f}, theme.text, title);
    const Rect bar{{plate.min.x + pad, plate.min.y + pad + line * 1.5f},
                   {plate.min.x + pad + bar_width, plate.min.y + pad + line * 1.5f + bar_height}};
    constexpr int pieces = 32;
    const auto y_of = [&](double t) { return bar.max.y - static_cast<float>(t) * bar.height(); };
    for (int i = 0; i < pieces; ++i) {
        const double a = double(i) / pieces, b = double(i + 1) / pieces;
        const ImU32 low = packed(scale.colour(scale.low + a * (scale.high - scale.low))),
                    high = packed(scale.colour(scale.low + b * (scale.high - scale.low)));
        list.AddRectFilledMultiColor({bar.min.x, y_of(b)}, {bar.max.x, y_of(a)}, high, high, low, low);
    }
    for (const view::LegendTick& tick : ticks) {
        const float y = std::round(y_of(tick.position));
        list.AddLine({bar.max.x, y}, {bar.max.x + 4 * ui_scale, y}, theme.text_dim);
        draw_text(list, {bar.max.x + 8 * ui_scale, y - line / 2}, theme.text_dim, tick.label);
    }
    return plate;
}

Rect draw_swatches(ImDrawList& list, ImVec2 corner, std::span<const LegendEntry> entries, const Theme& theme,
                   float ui_scale) {
    const float line = ImGui::GetTextLineHeight(), pad = std::round(8 * ui_scale),
                swatch = std::round(10 * ui_scale);
    float names = 0;
    for (const LegendEntry& entry : entries)
        names = std::max(names, text_size(entry.name).x);
    const float step = std::round(line * 1.35f);
    const float width = names + swatch + 8 * ui_scale + 2 * pad;
    const Rect plate{{std::round(corner.x - width), corner.y},
                     {corner.x, corner.y + step * static_cast<float>(entries.size()) + pad}};
    list.AddRectFilled(plate.min, plate.max, theme.badge, 6 * ui_scale);
    float y = plate.min.y + pad / 2;
    for (const LegendEntry& entry : entries) {
        const float middle = y + step / 2;
        list.AddRectFilled({plate.min.x + pad, middle - swatch / 2},
                           {plate.min.x + pad + swatch, middle + swatch / 2}, entry.colour, 3 * ui_scale);
        draw_text_in(list, {{plate.min.x + pad + swatch + 8 * ui_scale, y}, {plate.max.x, y + step}},
                     theme.text_dim, entry.name);
        y += step;
    }
    return plate;
}

} // namespace fascicle::editor
