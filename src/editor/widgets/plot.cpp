#include "editor/widgets/plot.hpp"

#include "editor/widgets/item_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::editor {

namespace {

struct Axes {
    Rect area;
    double x0, x1, y0, y1;
    float x(double frame) const {
        return area.min.x + static_cast<float>((frame - x0) / (x1 - x0)) * area.width();
    }
    float y(double value) const {
        return area.max.y - static_cast<float>((value - y0) / (y1 - y0)) * area.height();
    }
    double frame(float px) const { return x0 + double(px - area.min.x) / double(area.width()) * (x1 - x0); }
};

/// Range of y of what is visible, with some air.
void fit_y(Axes& axes, const PlotInput& input) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto take = [&](const std::vector<double>& values) {
        const auto first = static_cast<std::size_t>(std::max(0.0, std::floor(axes.x0)));
        const auto last = static_cast<std::size_t>(std::max(0.0, std::ceil(axes.x1)));
        for (std::size_t k = first; k < values.size() && k <= last; ++k)
            if (std::isfinite(values[k])) {
                low = std::min(low, values[k]);
                high = std::max(high, values[k]);
            }
    };
    for (const PlotCurve& curve : input.curves)
        if (!curve.hidden) {
            take(curve.y);
            take(curve.low);
            take(curve.high);
        }
    if (input.reference) {
        low = std::min(low, *input.reference);
        high = std::max(high, *input.reference);
    }
    if (!(low <= high)) {
        low = 0;
        high = 1;
    }
    const double lack = input.least_span - (high - low);
    if (lack > 0) {
        low -= lack / 2;
        high += lack / 2;
    }
    const double air = (high - low) * 0.08;
    axes.y0 = low - air;
    axes.y1 = high + air;
}

void draw_grid(ImDrawList& list, const Axes& axes, const PlotInput& input, const Theme& theme,
               float line_height) {
    const Rect& area = axes.area;
    list.AddRectFilled(area.min, area.max, theme.plot);
    const Ticks rows =
        nice_ticks(axes.y0, axes.y1, std::max(1, static_cast<int>(area.height() / (line_height * 1.9f))));
    for (int i = 0; i < rows.count; ++i) {
        const float y = std::round(axes.y(rows.at(i)));
        list.AddLine({area.min.x, y}, {area.max.x, y}, theme.grid);
        draw_text_in(
            list,
            {{area.min.x - 200, y - line_height / 2}, {area.min.x - line_height * 0.4f, y + line_height / 2}},
            theme.text_faint, tick_text(rows.at(i), rows.step), Align::right);
    }
    const float wide = text_size("-0.000").x;
    const Ticks columns =
        nice_ticks(axes.x0, axes.x1, std::max(1, static_cast<int>(area.width() / (wide * 1.9f))));
    for (int i = 0; i < columns.count; ++i) {
        const double frame = columns.at(i);
        const float x = std::round(axes.x(frame));
        list.AddLine({x, area.min.y}, {x, area.max.y}, theme.grid);
        const std::string text = input.x_text ? input.x_text(frame) : tick_text(frame, columns.step);
        const float width = text_size(text).x;
        const float left = std::clamp(x - width / 2, area.min.x, std::max(area.min.x, area.max.x - width));
        draw_text(list, {left, area.max.y + line_height * 0.12f}, theme.text_faint, text);
    }
    if (input.reference) {
        const float y = std::round(axes.y(*input.reference));
        for (float x = area.min.x; x < area.max.x; x += line_height * 0.5f)
            list.AddLine({x, y}, {std::min(area.max.x, x + line_height * 0.25f), y}, theme.text_faint);
    }
}

void draw_band(ImDrawList& list, const Axes& axes, const PlotCurve& curve) {
    const std::size_t count = std::min({curve.y.size(), curve.low.size(), curve.high.size()});
    const ImU32 colour = with_alpha(curve.colour, 0.16f);
    for (std::size_t k = 0; k + 1 < count; ++k) {
        const double values[] = {curve.low[k], curve.low[k + 1], curve.high[k + 1], curve.high[k]};
        if (!std::all_of(std::begin(values), std::end(values), [](double v) { return std::isfinite(v); }))
            continue;
        const float left = axes.x(double(k)), right = axes.x(double(k + 1));
        // No anti-aliased fill here: the seams between neighbouring pieces would show.
        const ImDrawListFlags flags = list.Flags;
        list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
        list.AddQuadFilled({left, axes.y(values[0])}, {right, axes.y(values[1])}, {right, axes.y(values[2])},
                           {left, axes.y(values[3])}, colour);
        list.Flags = flags;
    }
}

/// Dashes and gaps of one length along the polyline, whatever its points are apart.
void draw_dashes(ImDrawList& list, const std::vector<ImVec2>& points, ImU32 colour, float thickness,
                 float length) {
    float along = 0; // since the first point, modulo a dash and a gap
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const ImVec2 a = points[k], b = points[k + 1];
        const float whole = std::hypot(b.x - a.x, b.y - a.y);
        for (float done = 0; done < whole;) {
            const bool dash = along < length;
            const float piece = std::min(whole - done, std::max((dash ? length : 2 * length) - along, 0.01f));
            const auto at = [&](float s) {
                return ImVec2(a.x + (b.x - a.x) * s / whole, a.y + (b.y - a.y) * s / whole);
            };
            if (dash)
                list.AddLine(at(done), at(done + piece), colour, thickness);
            done += piece;
            along = along + piece >= 2 * length - 0.01f ? 0 : along + piece;
        }
    }
}

void draw_line(ImDrawList& list, const Axes& axes, const PlotCurve& curve, float scale) {
    const ImU32 colour = curve.ghost ? with_alpha(curve.colour, 0.35f) : curve.colour;
    const float thickness = (curve.ghost ? 1.0f : curve.dashed ? 1.3f : 1.8f) * scale;
    std::vector<ImVec2> points;
    const auto flush = [&] {
        if (points.size() > 1 && curve.dashed)
            draw_dashes(list, points, colour, thickness, 5 * scale);
        else if (points.size() > 1)
            list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, thickness);
        else if (points.size() == 1)
            list.AddCircleFilled(points[0], thickness * 1.4f, colour);
        points.clear();
    };
    for (std::size_t k = 0; k < curve.y.size(); ++k) {
        if (std::isfinite(curve.y[k]))
            points.push_back({axes.x(double(k)), axes.y(curve.y[k])});
        else
            flush();
    }
    flush();
}

/// Names of dashed curves over the right end of the plot, one below the other where they are close; none where there is no
/// room.
void draw_end_names(ImDrawList& list, const Axes& axes, const std::vector<PlotCurve>& curves,
                    const Theme& theme, float line_height, float scale) {
    struct Name {
        float y;
        const PlotCurve* curve;
    };
    std::vector<Name> names;
    const auto k = static_cast<std::size_t>(std::max(0.0, std::floor(axes.x1)));
    for (const PlotCurve& curve : curves)
        if (curve.dashed && !curve.hidden && k < curve.y.size() && std::isfinite(curve.y[k]))
            names.push_back({axes.y(curve.y[k]), &curve});
    const float step = line_height * 0.95f;
    float widest = 0;
    for (const Name& name : names)
        widest = std::max(widest, text_size(name.curve->name).x);
    if (widest > 0.4f * axes.area.width() || step * static_cast<float>(names.size()) > axes.area.height())
        return;
    std::stable_sort(names.begin(), names.end(), [](const Name& a, const Name& b) { return a.y < b.y; });
    float below = axes.area.min.y + step / 2;
    for (Name& name : names) {
        name.y = std::max(name.y, below);
        below = name.y + step;
    }
    float above = axes.area.max.y - step / 2;
    for (auto name = names.rbegin(); name != names.rend(); ++name) {
        name->y = std::min(name->y, above);
        above = name->y - step;
    }
    for (const Name& name : names) {
        const ImVec2 size = text_size(name.curve->name);
        const ImVec2 at{axes.area.max.x - size.x - 4 * scale, std::round(name.y - size.y / 2)};
        list.AddRectFilled({at.x - 2 * scale, at.y}, {at.x + size.x + 2 * scale, at.y + size.y},
                           with_alpha(theme.plot, 0.5f));
        draw_text(list, at, name.curve->colour, name.curve->name);
    }
}

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
        if (curve.ghost || curve.dashed)
            continue;
        const auto k = static_cast<std::size_t>(std::max(0.0, std::round(frame)));
        items.push_back(
            {i, curve.name, k < curve.y.size() && !curve.hidden ? value_text(curve.y[k]) : std::string()});
        values += fixed_width + (items.back().value.empty() ? 0 : gap + text_size(items.back().value).x);
        longest = std::max(longest, text_size(curve.name).x);
    }
    const float room = width - values;
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
}

/// Pan, zoom, fit; returns what the pointer does to the playhead.
void handle_pointer(const char* id, const Axes& axes, const PlotInput& input, PlotRange& range,
                    PlotResult& result) {
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetCursorScreenPos(axes.area.min);
    ImGui::InvisibleButton(id, {axes.area.width(), axes.area.height()},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    record_item(std::string(id) + "/area");
    const double frame = std::clamp(std::round(axes.frame(io.MousePos.x)), 0.0, input.last_frame);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered || ImGui::IsItemActive())
        result.hovered = frame;
    const double span = range.high - range.low;
    if (ImGui::IsItemActive()) {
        const bool pan = ImGui::IsMouseDown(ImGuiMouseButton_Middle) || io.KeyCtrl;
        if (pan) {
            const double shift = -double(io.MouseDelta.x) / double(axes.area.width()) * span;
            const double kept = std::clamp(shift, -range.low, std::max(0.0, input.last_frame - range.high));
            range.low += kept;
            range.high += kept;
        } else {
            result.moved_to = frame;
        }
    }
    if (hovered && io.MouseWheel != 0) {
        const double factor = std::pow(0.8, double(io.MouseWheel));
        const double wanted = std::clamp(span * factor, std::min(5.0, input.last_frame), input.last_frame);
        const double anchor = std::clamp(axes.frame(io.MousePos.x), range.low, range.high);
        range.low = std::clamp(anchor - (anchor - range.low) / span * wanted, 0.0, input.last_frame - wanted);
        range.high = range.low + wanted;
    }
    if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        range = {0, input.last_frame};
}

} // namespace

PlotResult draw_plot(const char* id, const Rect& rect, const PlotInput& input, PlotRange& range,
                     const Theme& theme, float scale) {
    PlotResult result;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    record_item(id, rect);
    const float line = ImGui::GetTextLineHeight();
    const float pad = std::round(8 * scale);
    float top = rect.min.y + pad * 0.5f;

    const Rect title{{rect.min.x + pad, top}, {rect.max.x - pad, top + line * 1.15f}};
    const std::string name = input.title + " [" + input.unit + "]";
    draw_text_in(list, title, theme.text, input.title);
    const float after = text_size(input.title).x + 5 * scale;
    draw_text_in(list, {{title.min.x + after, title.min.y}, title.max}, theme.text_faint,
                 "[" + input.unit + "]");
    ImGui::SetCursorScreenPos(title.min);
    ImGui::PushID(id);
    ImGui::Dummy({std::max(1.0f, std::min(title.width(), text_size(name).x)), line});
    if (ImGui::IsItemHovered() && !input.tooltip.empty())
        ImGui::SetTooltip("%s", input.tooltip.c_str());
    top = title.max.y;

    const double shown_at = input.hover ? *input.hover : input.playhead;
    if (!input.curves.empty()) {
        draw_legend(id, {{rect.min.x + pad, top}, {rect.max.x - pad, top + line * 1.15f}}, input, shown_at,
                    theme, scale, result);
        top += line * 1.15f;
    }
    top += pad * 0.5f;
    ImGui::PopID();

    range.high = std::min(range.high, std::max(1.0, input.last_frame));
    range.low = std::clamp(range.low, 0.0, range.high - 1e-9);
    Axes axes{};
    axes.x0 = range.low;
    axes.x1 = range.high;
    fit_y(axes, input);
    const float y_labels = std::max(text_size("0.0000").x, text_size("-0.00").x) + line * 0.5f;
    axes.area = {{rect.min.x + pad + y_labels, top},
                 {rect.max.x - pad, rect.max.y - pad * 0.4f - line * 1.2f}};
    if (axes.area.width() < 30 * scale || axes.area.height() < 20 * scale)
        return result;

    draw_grid(list, axes, input, theme, line);
    draw_text_in(
        list, {{rect.min.x + pad, axes.area.max.y}, {axes.area.min.x - line * 0.4f, rect.max.y - pad * 0.4f}},
        theme.text_faint, input.x_label, Align::right);
    list.PushClipRect(axes.area.min, axes.area.max, true);
    for (const PlotCurve& curve : input.curves)
        if (curve.ghost && !curve.hidden)
            draw_line(list, axes, curve, scale);
    for (const PlotCurve& curve : input.curves)
        if (!curve.ghost && !curve.hidden)
            draw_band(list, axes, curve);
    for (const PlotCurve& curve : input.curves)
        if (!curve.ghost && !curve.hidden)
            draw_line(list, axes, curve, scale);
    draw_end_names(list, axes, input.curves, theme, line, scale);
    if (input.hover) {
        const float x = std::round(axes.x(*input.hover));
        list.AddLine({x, axes.area.min.y}, {x, axes.area.max.y}, theme.hover_line, scale);
    }
    const float head = std::round(axes.x(input.playhead));
    list.AddLine({head, axes.area.min.y}, {head, axes.area.max.y}, theme.playhead,
                 std::max(1.0f, 1.2f * scale));
    for (const PlotCurve& curve : input.curves) {
        const auto k = static_cast<std::size_t>(std::max(0.0, std::round(shown_at)));
        if (!curve.ghost && !curve.hidden && k < curve.y.size() && std::isfinite(curve.y[k])) {
            const ImVec2 at{axes.x(double(k)), axes.y(curve.y[k])};
            list.AddCircleFilled(at, 4.5f * scale, theme.plot);
            list.AddCircleFilled(at, 3.2f * scale, curve.colour);
        }
    }
    list.PopClipRect();
    if (input.curves.empty() && !input.empty_text.empty())
        draw_text_in(list, axes.area, theme.text_faint, input.empty_text, Align::centre);
    handle_pointer(id, axes, input, range, result);
    return result;
}

} // namespace fascicle::editor
