#include "editor/widgets/plot.hpp"

#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/plot_axes.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

namespace {

struct LegendItem {
    std::size_t curve;
    std::string name, value;
};

/// Names with the value at `frame`, cut so that all entries fit: the longest names give way first.
std::vector<LegendItem> legend_items(const PlotInput& input, double frame, float width, float fixed_width,
                                     float gap) {
    std::vector<LegendItem> items;
    float values = 0, longest = 0;
    for (std::size_t i = 0; i < input.curves.size(); ++i) {
        const PlotCurve& curve = input.curves[i];
        if (curve.ghost || !curve.in_legend)
            continue;
        const auto k = static_cast<std::size_t>(std::max(0.0, std::round(frame)));
        items.push_back(
            {i, curve.name,
             k < curve.y.size() && !curve.hidden && curve.by_frame ? value_text(curve.y[k]) : std::string()});
        values += fixed_width + (items.back().value.empty() ? 0 : gap + text_size(items.back().value).x);
        longest = std::max(longest, text_size(curve.name).x);
    }
    float room = width - values;
    if (room < 2 * fixed_width * static_cast<float>(items.size())) { // many curves: names before numbers
        room = width - fixed_width * static_cast<float>(items.size());
        for (LegendItem& item : items)
            if (items.size() > 2)
                item.value.clear();
        if (items.size() <= 2)
            room = width - values;
    }
    for (float limit = longest; limit > 0; limit -= 4) {
        float sum = 0;
        for (const LegendItem& item : items)
            sum += std::min(limit, text_size(item.name).x);
        if (sum <= room || limit <= 4) {
            for (LegendItem& item : items)
                item.name = elided(item.name, limit);
            break;
        }
    }
    return items;
}

/// A click hides the curve.
void draw_legend(const char* id, const Rect& row, const PlotInput& input, double frame, const Theme& theme,
                 float scale, PlotResult& result) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float swatch = std::round(9 * scale), gap = 6 * scale, between = 12 * scale;
    float x = row.min.x;
    list.PushClipRect(row.min, row.max, true);
    for (const LegendItem& item : legend_items(input, frame, row.width(), swatch + gap + between, gap)) {
        const PlotCurve& curve = input.curves[item.curve];
        const float name_width = text_size(item.name).x, value_width = text_size(item.value).x;
        const float middle = (row.min.y + row.max.y) / 2, left = x;
        list.AddRectFilled({x, middle - swatch / 2}, {x + swatch, middle + swatch / 2},
                           curve.hidden ? with_alpha(theme.text_faint, 0.35f) : curve.colour, 2 * scale);
        x += swatch + gap;
        draw_text_in(list, {{x, row.min.y}, {x + name_width + 1, row.max.y}},
                     curve.hidden ? theme.text_faint : theme.text_dim, item.name);
        x += name_width;
        if (!item.value.empty()) {
            draw_text_in(list, {{x + gap, row.min.y}, {x + gap + value_width + 1, row.max.y}}, theme.text,
                         item.value);
            x += gap + value_width;
        }
        if (input.compact) {
            x += between;
            continue;
        }
        ImGui::SetCursorScreenPos({left, row.min.y});
        ImGui::PushID(static_cast<int>(item.curve));
        ImGui::InvisibleButton("legend", {std::max(1.0f, x - left), std::max(1.0f, row.height())});
        record_item(std::string(id) + "/legend/" + curve.name);
        if (ImGui::IsItemHovered()) {
            if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
                result.isolated = static_cast<int>(item.curve);
            else if (ImGui::IsMouseClicked(ImGuiMouseButton_Left))
                result.toggled = static_cast<int>(item.curve);
            ImGui::SetTooltip("%s\nClick hides the curve, double-click shows it alone.", curve.name.c_str());
        }
        ImGui::PopID();
        x += between;
    }
    list.PopClipRect();
}

struct Header {
    float end;    ///< of the title, pixels
    float bottom; ///< of its row
};

/// Title with its unit.
Header draw_title(ImDrawList& list, const Rect& rect, const PlotInput& input, const Theme& theme,
                  float scale) {
    const float line = ImGui::GetTextLineHeight(), pad = std::round(8 * scale);
    const float top = rect.min.y + std::round(pad * 0.5f);
    const Rect title{{rect.min.x + pad, top}, {rect.max.x - pad, top + std::round(line * 1.15f)}};
    draw_text_in(list, title, theme.text, input.title);
    const float after = text_size(input.title).x + 5 * scale;
    const std::string unit = "[" + input.unit + "]";
    if (after < title.width())
        draw_text_in(list, {{title.min.x + after, title.min.y}, title.max}, theme.text_faint, unit);
    const float width = std::min(title.width(), after + text_size(unit).x);
    if (!input.compact) {
        ImGui::SetCursorScreenPos(title.min);
        ImGui::InvisibleButton("title", {std::max(1.0f, width), line});
        item_tooltip(input.tooltip);
    }
    return {title.min.x + width, title.max.y};
}

void draw_maximise(ImDrawList& list, const char* id, const Rect& rect, const PlotInput& input,
                   const Theme& theme, PlotResult& result) {
    ImGui::SetCursorScreenPos(rect.min);
    result.maximise = ImGui::InvisibleButton("maximise", {rect.width(), rect.height()});
    record_item(std::string(id) + "/maximise");
    const bool hovered = ImGui::IsItemHovered();
    if (icons_available())
        draw_text_in(list, {{rect.min.x - 3, rect.min.y}, {rect.max.x + 3, rect.max.y}},
                     hovered ? theme.text : with_alpha(theme.text_faint, 0.7f),
                     input.maximised ? icons::shrink.glyph : icons::grow.glyph, Align::centre);
    else
        draw_text_in(list, rect, hovered ? theme.text : theme.text_faint, input.maximised ? "-" : "+",
                     Align::centre);
    item_tooltip(input.maximised ? "Show all plots again" : "Show this plot alone");
}

} // namespace

PlotResult draw_plot(const char* id, const Rect& rect, const PlotInput& input, const PlotRange& x,
                     const PlotRange* y, PlotGesture& gesture, PlotInk& ink, const Theme& theme,
                     float scale) {
    PlotResult result;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    record_item(id, rect);
    const float line = ImGui::GetTextLineHeight(), row = std::round(line * 1.15f);
    const float pad = std::round(8 * scale);
    ImGui::PushID(id);
    const Header header = draw_title(list, rect, input, theme, scale);
    float top = header.bottom, right = rect.max.x - pad;
    if (!input.compact && input.maximisable) {
        draw_maximise(list, id, {{right - row, top - row}, {right, top}}, input, theme, result);
        right -= row + pad;
    }
    const double shown_at = input.hover ? *input.hover : input.playhead;
    const bool any = std::any_of(input.curves.begin(), input.curves.end(),
                                 [](const PlotCurve& curve) { return curve.in_legend && !curve.ghost; });
    if (any) {
        // Where height is scarce and width is not, the legend shares the title's row.
        const bool beside = rect.height() < 150 * scale && right - header.end > 140 * scale;
        const Rect place = beside ? Rect{{header.end + 12 * scale, top - row}, {right, top}}
                                  : Rect{{rect.min.x + pad, top}, {rect.max.x - pad, top + row}};
        draw_legend(id, place, input, shown_at, theme, scale, result);
        top += beside ? 0 : row;
    }
    top += std::round(pad * 0.5f);
    ImGui::PopID();

    PlotAxes axes;
    axes.x0 = x.low;
    axes.x1 = std::max(x.high, x.low + 1e-9);
    const PlotRange shown = y != nullptr ? *y : fitted_y(input, {axes.x0, axes.x1});
    axes.y0 = shown.low;
    axes.y1 = shown.high;
    const float y_labels =
        std::round(std::max(text_size("0.0000").x, text_size(input.x_label).x) + line * 0.4f);
    axes.area = {{rect.min.x + pad + y_labels, top},
                 {rect.max.x - pad, rect.max.y - std::round(pad * 0.4f + line * 1.2f)}};
    if (axes.area.width() < 30 * scale || axes.area.height() < 20 * scale)
        return result;
    draw_text_in(
        list, {{rect.min.x + pad, axes.area.max.y}, {axes.area.min.x - line * 0.4f, rect.max.y - pad * 0.4f}},
        theme.text_faint, input.x_label, Align::right);
    paint_plot(list, id, axes, input, ink, theme, scale);
    if (!input.compact)
        handle_plot_pointer(id, axes, input, gesture, theme, scale, result);
    return result;
}

} // namespace fascicle::editor
