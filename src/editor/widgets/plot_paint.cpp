#include "editor/widgets/plot_axes.hpp"
#include "view/decimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::editor {

namespace {

/// More lines than this cannot be told apart; evenly chosen ones stand for all.
constexpr std::size_t most_lines = 300;

double curve_x(const PlotCurve& curve, std::size_t k) {
    return curve.x.empty() ? double(k) : k < curve.x.size() ? curve.x[k] : std::nan("");
}

void draw_grid(ImDrawList& list, const PlotAxes& axes, const PlotInput& input, const Theme& theme,
               float line_height) {
    const Rect& area = axes.area;
    if (!input.compact)
        list.AddRectFilled(area.min, area.max, theme.plot);
    const Ticks rows =
        scale_ticks(axes.y0, axes.y1, std::max(2, static_cast<int>(area.height() / (line_height * 1.9f))),
                    line_height / area.height());
    for (int i = 0; i < rows.count; ++i) {
        const float y = std::round(axes.y(rows.at(i)));
        list.AddLine({area.min.x, y}, {area.max.x, y}, theme.grid);
        draw_text_in(
            list,
            {{area.min.x - 200, y - line_height / 2}, {area.min.x - line_height * 0.4f, y + line_height / 2}},
            theme.text_faint, tick_text(rows.at(i), rows.step), Align::right);
    }
    const float wide = text_size("-0.000").x;
    const double unit = input.x_unit > 0 ? input.x_unit : 1;
    const Ticks columns =
        scale_ticks(axes.x0 * unit, axes.x1 * unit,
                    std::max(1, static_cast<int>(area.width() / (wide * 1.9f))), wide / area.width());
    for (int i = 0; i < columns.count; ++i) {
        const float x = std::round(axes.x(columns.at(i) / unit));
        list.AddLine({x, area.min.y}, {x, area.max.y}, theme.grid);
        const std::string text = tick_text(columns.at(i), columns.step);
        const float width = text_size(text).x;
        const float left = std::clamp(x - width / 2, area.min.x, std::max(area.min.x, area.max.x - width));
        draw_text(list, {left, area.max.y + line_height * 0.12f}, theme.text_faint, text);
    }
    if (input.reference) {
        const float y = std::round(axes.y(*input.reference));
        if (y >= area.min.y && y <= area.max.y)
            for (float x = area.min.x; x < area.max.x; x += line_height * 0.5f)
                list.AddLine({x, y}, {std::min(area.max.x, x + line_height * 0.25f), y}, theme.text_faint);
    }
}

void draw_band(ImDrawList& list, const PlotAxes& axes, const PlotCurve& curve) {
    const std::size_t count = std::min({curve.y.size(), curve.low.size(), curve.high.size()});
    const ImU32 colour = with_alpha(curve.colour, curve.band);
    // No anti-aliased fill here: the seams between neighbouring pieces would show.
    const ImDrawListFlags flags = list.Flags;
    list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (std::size_t k = 0; k + 1 < count; ++k) {
        const double values[] = {curve.low[k],  curve.low[k + 1],  curve.high[k + 1],
                                 curve.high[k], curve_x(curve, k), curve_x(curve, k + 1)};
        if (!std::all_of(std::begin(values), std::end(values), [](double v) { return std::isfinite(v); }))
            continue;
        const float left = axes.x(values[4]), right = axes.x(values[5]);
        if (std::max(left, right) < axes.area.min.x || std::min(left, right) > axes.area.max.x)
            continue;
        list.AddQuadFilled({left, axes.y(values[0])}, {right, axes.y(values[1])}, {right, axes.y(values[2])},
                           {left, axes.y(values[3])}, colour);
    }
    list.Flags = flags;
}

/// Dashes and gaps along the polyline, whatever its points are apart.
void draw_dashes(ImDrawList& list, const std::vector<ImVec2>& points, ImU32 colour, float thickness,
                 float dash_length, float gap_length) {
    float along = 0; // since the first point, modulo a dash and a gap
    const float period = dash_length + gap_length;
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const ImVec2 a = points[k], b = points[k + 1];
        const float whole = std::hypot(b.x - a.x, b.y - a.y);
        if (!(whole < 20000)) // far outside of the picture
            continue;
        for (float done = 0; done < whole;) {
            const bool dash = along < dash_length;
            const float piece =
                std::min(whole - done, std::max((dash ? dash_length : period) - along, 0.01f));
            const auto at = [&](float s) {
                return ImVec2(a.x + (b.x - a.x) * s / whole, a.y + (b.y - a.y) * s / whole);
            };
            if (dash)
                list.AddLine(at(done), at(done + piece), colour, thickness);
            done += piece;
            along = along + piece >= period - 0.01f ? 0 : along + piece;
        }
    }
}

/// One connected piece, of as many points as pixels can show.
void draw_piece(ImDrawList& list, const std::vector<view::ScreenPoint>& all, LineStyle style, ImU32 colour,
                float thickness, float scale) {
    if (all.size() == 1)
        list.AddCircleFilled({float(all[0].x), float(all[0].y)}, thickness * 1.4f, colour);
    if (all.size() < 2)
        return;
    std::vector<ImVec2> points;
    for (const view::ScreenPoint& p : view::decimated(all))
        points.push_back({float(p.x), float(p.y)});
    if (style == LineStyle::dashed)
        draw_dashes(list, points, colour, thickness, 5 * scale, 4 * scale);
    else if (style == LineStyle::dotted)
        draw_dashes(list, points, colour, thickness, 2 * scale, 2.5f * scale);
    else
        list.AddPolyline(points.data(), static_cast<int>(points.size()), colour, 0, thickness);
}

void draw_line(ImDrawList& list, const PlotAxes& axes, const PlotCurve& curve, float scale) {
    if (curve.width <= 0 && !curve.ghost)
        return;
    const ImU32 colour = curve.ghost ? with_alpha(curve.colour, 0.4f) : curve.colour;
    const float thickness = (curve.ghost ? 1.0f : curve.width) * scale;
    std::vector<view::ScreenPoint> piece;
    bool back = false;
    const auto flush = [&] {
        draw_piece(list, piece, back ? LineStyle::dotted : curve.style, colour, thickness, scale);
        piece.clear();
    };
    std::size_t turn = 0;
    for (std::size_t k = 0; k < curve.y.size(); ++k) {
        const double x = curve_x(curve, k), y = curve.y[k];
        const bool there = std::isfinite(x) && std::isfinite(y);
        if (there) // a far point must not become an infinite pixel
            piece.push_back({double(axes.x(x)), std::clamp(double(axes.y(y)), -1e5, 1e5)});
        else
            flush();
        if (turn < curve.turns.size() && k == curve.turns[turn]) {
            flush();
            back = ++turn % 2 == 1;
            if (there)
                piece.push_back({double(axes.x(x)), std::clamp(double(axes.y(y)), -1e5, 1e5)});
        }
    }
    flush();
}

/// Points that lie on a straight line between their neighbours, to half a pixel, are left out.
std::vector<ImVec2> straightened(const std::vector<ImVec2>& points, float tolerance) {
    std::vector<ImVec2> kept;
    for (std::size_t first = 0; first < points.size();) {
        kept.push_back(points[first]);
        if (first + 1 >= points.size())
            break;
        // The cone of slopes from `first` that passes all points so far.
        float least = -1e9f, most = 1e9f;
        std::size_t last = first + 1;
        for (std::size_t k = first + 1; k < points.size(); ++k) {
            const float dx = points[k].x - points[first].x;
            if (!(std::abs(dx) > 1e-3f) || (points[last].x - points[first].x) * dx < 0)
                break;
            const float run = std::abs(dx);
            const float slope = (points[k].y - points[first].y) / run;
            if (slope < least || slope > most)
                break;
            least = std::max(least, slope - tolerance / run);
            most = std::min(most, slope + tolerance / run);
            last = k;
        }
        first = last;
    }
    return kept;
}

std::vector<std::vector<ImVec2>> bundle_lines(const PlotAxes& axes, const PlotBundle& bundle,
                                              std::size_t first, std::size_t step) {
    std::vector<std::vector<ImVec2>> lines;
    for (std::size_t i = first; i < bundle.count; i += step) {
        std::vector<ImVec2> points;
        const auto flush = [&] {
            if (points.size() > 1)
                lines.push_back(straightened(points, 0.4f));
            points.clear();
        };
        for (std::size_t k = 0; k < bundle.frames; ++k) {
            const double x = bundle.x.empty() ? double(k) : k < bundle.x.size() ? bundle.x[k] : std::nan("");
            const double y = bundle.values[k * bundle.count + i];
            if (std::isfinite(x) && std::isfinite(y))
                points.push_back({axes.x(x), std::clamp(axes.y(y), -1e5f, 1e5f)});
            else
                flush();
        }
        flush();
    }
    return lines;
}

void draw_bundle(ImDrawList& list, const char* id, const PlotAxes& axes, const PlotBundle& bundle,
                 PlotInk& store, float scale) {
    BundleInk& ink = store[std::string(id) + '/' + bundle.name];
    const std::array<double, 8> place{double(axes.area.min.x),
                                      double(axes.area.min.y),
                                      double(axes.area.max.x),
                                      double(axes.area.max.y),
                                      axes.x0,
                                      axes.x1,
                                      axes.y0,
                                      axes.y1};
    if (ink.version != bundle.version || ink.place != place) {
        ink.version = bundle.version;
        ink.place = place;
        ink.lines = bundle_lines(axes, bundle, 0, (bundle.count + most_lines - 1) / most_lines);
    }
    const float alpha = std::clamp(2.5f / std::sqrt(float(bundle.count)), 0.1f, 0.5f);
    for (const std::vector<ImVec2>& line : ink.lines)
        list.AddPolyline(line.data(), static_cast<int>(line.size()), with_alpha(bundle.colour, alpha), 0,
                         std::max(1.0f, 0.7f * scale));
}

void draw_highlight(ImDrawList& list, const PlotAxes& axes, const PlotBundle& bundle, const PlotInput& input,
                    const Theme& theme, float scale) {
    const auto i = static_cast<std::size_t>(bundle.highlighted);
    if (bundle.highlighted < 0 || i >= bundle.count)
        return;
    for (const std::vector<ImVec2>& line : bundle_lines(axes, bundle, i, bundle.count)) {
        list.AddPolyline(line.data(), static_cast<int>(line.size()), theme.plot, 0, 5 * scale);
        list.AddPolyline(line.data(), static_cast<int>(line.size()), theme.text, 0, 2.4f * scale);
    }
    const double frame = input.hover ? *input.hover : input.playhead;
    const auto k = static_cast<std::size_t>(std::max(0.0, std::round(frame)));
    if (k >= bundle.frames || !std::isfinite(bundle.values[k * bundle.count + i]))
        return;
    const std::string text = "Fibre " + std::to_string(i + 1) + ": " +
                             value_text(bundle.values[k * bundle.count + i]) +
                             (input.unit == "1" ? "" : " " + input.unit);
    const float x = axes.x(frame_position(input, frame)), half = text_size(text).x * 0.5f + 6 * scale;
    const float y = axes.y(bundle.values[k * bundle.count + i]);
    list.AddCircleFilled({x, y}, 3.6f * scale, theme.text);
    const float line = text_size(text).y;
    const float top = y - line * 2 < axes.area.min.y ? y + line * 0.6f : y - line * 1.9f;
    if (axes.area.width() > 2 * half)
        draw_badge(list, {std::clamp(x, axes.area.min.x + half, axes.area.max.x - half), top}, Align::centre,
                   text, theme.text, theme.badge);
}

/// Names over the right end of the plot, one below the other where they are close; none where there is no room.
void draw_end_names(ImDrawList& list, const PlotAxes& axes, const std::vector<PlotCurve>& curves,
                    const Theme& theme, float line_height, float scale) {
    struct Name {
        float y;
        const PlotCurve* curve;
    };
    std::vector<Name> names;
    for (const PlotCurve& curve : curves) {
        if (!curve.end_name || curve.hidden)
            continue;
        std::size_t last = curve.y.size(); // the last sample that is seen
        for (std::size_t k = 0; k < curve.y.size(); ++k)
            if (std::isfinite(curve.y[k]) && curve_x(curve, k) <= axes.x1 && curve_x(curve, k) >= axes.x0)
                last = k;
        if (last < curve.y.size())
            names.push_back({axes.y(curve.y[last]), &curve});
    }
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

} // namespace

double frame_position(const PlotInput& input, double frame) {
    if (input.frame_x.empty())
        return frame;
    const double last = double(input.frame_x.size()) - 1;
    return input.frame_x[static_cast<std::size_t>(std::clamp(std::round(frame), 0.0, last))];
}

PlotRange fitted_y(const PlotInput& input, const PlotRange& x) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto add = [&](double value) {
        if (std::isfinite(value)) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    };
    // A sample beside the border is seen half: its line comes in.
    const double margin = input.frame_x.empty() ? 1 : 0;
    const auto take = [&](std::span<const double> xs, std::span<const double> values) {
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double at = xs.empty() ? double(k) : k < xs.size() ? xs[k] : std::nan("");
            if (at > x.low - margin && at < x.high + margin)
                add(values[k]);
            else if (margin == 0 && at >= x.low && at <= x.high)
                add(values[k]);
        }
    };
    for (const PlotCurve& curve : input.curves)
        if (!curve.hidden) {
            if (curve.width > 0 || curve.ghost)
                take(curve.x, curve.y);
            take(curve.x, curve.low);
            take(curve.x, curve.high);
        }
    for (const PlotBundle& bundle : input.bundles) {
        take(bundle.x, bundle.least);
        take(bundle.x, bundle.most);
    }
    if (input.reference)
        add(*input.reference);
    if (!(low <= high)) {
        low = 0;
        high = 1;
    }
    const double size = std::max(std::abs(low), std::abs(high));
    const double lack = std::max(input.least_span, size * 1e-9) - (high - low);
    if (lack > 0) {
        low -= lack / 2;
        high += lack / 2;
    }
    const double air = (high - low) * 0.08;
    return {low - air, high + air};
}

void paint_plot(ImDrawList& list, const char* id, const PlotAxes& axes, const PlotInput& input, PlotInk& ink,
                const Theme& theme, float scale) {
    const float line = ImGui::GetTextLineHeight();
    draw_grid(list, axes, input, theme, line);
    list.PushClipRect(axes.area.min, axes.area.max, true);
    for (const PlotCurve& curve : input.curves)
        if (curve.ghost && !curve.hidden)
            draw_line(list, axes, curve, scale);
    for (const PlotBundle& bundle : input.bundles)
        draw_bundle(list, id, axes, bundle, ink, scale);
    for (const PlotCurve& curve : input.curves)
        if (!curve.ghost && !curve.hidden)
            draw_band(list, axes, curve);
    for (const PlotCurve& curve : input.curves)
        if (!curve.ghost && !curve.hidden) {
            if (!input.bundles.empty() && curve.style == LineStyle::solid && curve.width > 0) {
                PlotCurve halo = curve; // so that the mean stands out of its fibres
                halo.colour = theme.plot;
                halo.width = curve.width + 2.4f;
                draw_line(list, axes, halo, scale);
            }
            draw_line(list, axes, curve, scale);
        }
    draw_end_names(list, axes, input.curves, theme, line, scale);
    if (input.hover) {
        const float x = std::round(axes.x(frame_position(input, *input.hover)));
        list.AddLine({x, axes.area.min.y}, {x, axes.area.max.y}, theme.hover_line, scale);
    }
    const float head = std::round(axes.x(frame_position(input, input.playhead)));
    list.AddLine({head, axes.area.min.y}, {head, axes.area.max.y}, theme.playhead,
                 std::max(1.0f, 1.2f * scale));
    const double shown_at = input.hover ? *input.hover : input.playhead;
    for (const PlotCurve& curve : input.curves) {
        const auto k = static_cast<std::size_t>(std::max(0.0, std::round(shown_at)));
        if (!curve.ghost && !curve.hidden && curve.by_frame && curve.width > 0 && k < curve.y.size() &&
            std::isfinite(curve.y[k])) {
            const ImVec2 at{axes.x(curve_x(curve, k)), axes.y(curve.y[k])};
            list.AddCircleFilled(at, 4.5f * scale, theme.plot);
            list.AddCircleFilled(at, 3.2f * scale, curve.colour);
        }
    }
    for (const PlotBundle& bundle : input.bundles)
        draw_highlight(list, axes, bundle, input, theme, scale);
    list.PopClipRect();
    if (input.curves.empty() && !input.empty_text.empty())
        draw_text_in(list, axes.area, theme.text_faint, input.empty_text, Align::centre);
}

} // namespace fascicle::editor
