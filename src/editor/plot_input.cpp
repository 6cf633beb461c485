#include "editor/plot_input.hpp"

#include "editor/frame_axis.hpp"
#include "editor/widgets/plot_axes.hpp"

#include <algorithm>
#include <cstdio>

namespace fascicle::editor {

namespace {

/// Where the samples of a run lie.
void place(PlotCurve& curve, const std::shared_ptr<const AnglePath>& path, bool angles) {
    if (!angles || path == nullptr)
        return;
    curve.x = path->degrees;
    curve.turns = path->turns;
}

void add_series(const EditorContext& context, const PlotRow& row, const PlotContent& content, bool angles,
                const Theme& theme, PlotInput& input) {
    const EditorState& state = context.state;
    const bool lines_hidden = state.hidden_curves.count(all_lines) != 0;
    const auto at = static_cast<std::size_t>(std::max(0, context.playhead()));
    bool first_line = true;
    for (const std::shared_ptr<const PlotSeries>& series : content.series) {
        using Role = PlotSeries::Role;
        if ((series->ghost && !state.plots.ghosts) ||
            (series->role == Role::extreme && !state.plots.extremes))
            continue;
        if (series->role == Role::line && first_line) { // one entry of the legend stands for all
            first_line = false;
            PlotCurve entry;
            entry.name = all_lines;
            entry.colour = theme.text_faint;
            entry.hidden = lines_hidden;
            input.curves.push_back(entry);
            input.tooltip += "\nDashed: line muscles of the model.";
        }
        PlotCurve curve;
        curve.name = series->name;
        curve.colour = curve_colour(theme, series->colour);
        curve.y = series->y;
        curve.low = series->low;
        curve.high = series->high;
        curve.ghost = series->ghost;
        curve.run = series->run;
        curve.hidden = state.hidden_curves.count(series->name) != 0;
        place(curve, series->path, angles);
        if (series->ghost) {
            curve.low = curve.high = {};
        } else if (series->role == Role::extreme) {
            curve.in_legend = false;
            curve.width = 1.0f;
            curve.style = LineStyle::dashed;
        } else if (series->role == Role::stage) {
            curve.width = 0;
            curve.band = 0.75f;
        } else if (series->role == Role::line) {
            curve.colour = muted_curve_colour(theme, series->colour);
            curve.style = LineStyle::dashed;
            curve.width = 1.3f;
            curve.in_legend = false;
            curve.end_name = true;
            curve.hidden = lines_hidden;
            if (at < series->y.size())
                input.tooltip += '\n' + series->name + ": " + value_text(series->y[at]);
        }
        input.curves.push_back(std::move(curve));
    }
    if (row.of_fibres == nullptr || !state.plots.single_fibres)
        return;
    for (const PlotFibres& fibres : content.fibres) {
        if (state.hidden_curves.count(fibres.muscle) != 0)
            continue;
        PlotBundle bundle;
        bundle.name = fibres.muscle;
        bundle.colour = curve_colour(theme, fibres.colour);
        if (angles)
            bundle.x = fibres.path->degrees;
        bundle.values = fibres.values->data();
        bundle.count = fibres.count;
        bundle.frames = fibres.frames;
        bundle.least = fibres.least;
        bundle.most = fibres.most;
        bundle.version = content.version;
        if (state.hover_fibre && state.hover_fibre->muscle == fibres.muscle)
            bundle.highlighted = state.hover_fibre->fibre;
        input.bundles.push_back(bundle);
    }
}

void add_overlays(const EditorContext& context, const PlotData& data, const PlotRow& row, bool angles,
                  const Theme& theme, PlotInput& input) {
    int colour = 3;
    for (const PlotOverlay& overlay : data.overlays()) {
        if (overlay.plot != row.id)
            continue;
        const bool hidden = context.state.hidden_curves.count(overlay.name) != 0;
        PlotCurve entry;
        entry.name = overlay.name;
        entry.colour = curve_colour(theme, colour);
        entry.hidden = hidden;
        input.curves.push_back(entry);
        for (const OverlayCurve& values : overlay.curves) {
            PlotCurve curve;
            curve.name = values.name;
            curve.colour = curve_colour(theme, colour++);
            curve.x = angles ? values.degrees : values.frames;
            curve.y = values.y;
            curve.style = LineStyle::dashed;
            curve.width = 1.5f;
            curve.by_frame = false;
            curve.in_legend = false;
            curve.end_name = true;
            curve.hidden = hidden;
            input.curves.push_back(curve);
        }
    }
}

render::Rgba colour_of(ImU32 colour) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(colour);
    return {c.x, c.y, c.z, 1};
}

/// A curve with branches becomes one chart curve for each.
void add_chart_curves(const PlotCurve& curve, double x_unit, std::vector<view::ChartCurve>& curves) {
    std::vector<std::size_t> ends(curve.turns.begin(), curve.turns.end());
    ends.push_back(curve.y.empty() ? 0 : curve.y.size() - 1);
    std::size_t begin = 0;
    for (std::size_t branch = 0; branch < ends.size(); ++branch) {
        view::ChartCurve part;
        part.name = curve.name;
        part.colour = colour_of(curve.colour);
        part.ghost = curve.ghost;
        part.dashed = curve.style != LineStyle::solid || branch % 2 == 1;
        part.width = double(curve.width);
        part.band_opacity = double(curve.band);
        for (std::size_t k = begin; k <= ends[branch] && k < curve.y.size(); ++k) {
            if (!curve.x.empty() && k >= curve.x.size())
                break;
            part.x.push_back(curve.x.empty() ? double(k) * x_unit : curve.x[k] * x_unit);
            part.y.push_back(curve.y[k]);
            if (k < curve.low.size() && k < curve.high.size()) {
                part.low.push_back(curve.low[k]);
                part.high.push_back(curve.high[k]);
            }
        }
        begin = ends[branch];
        curves.push_back(std::move(part));
    }
}

} // namespace

bool axis_of_angles(const EditorContext& context) {
    return context.state.ruler == RulerUnit::angle && context.document.scene().timeline.hinge.has_value();
}

void set_plot_axis(const EditorContext& context, const PlotData& data, PlotInput& input) {
    const bool angles = axis_of_angles(context);
    input.x_label = axis_label(angles                                    ? RulerUnit::angle
                               : context.state.ruler == RulerUnit::angle ? RulerUnit::frame
                                                                         : context.state.ruler);
    input.x_unit = context.state.ruler == RulerUnit::seconds ? frame_seconds(context.document.scene()) : 1;
    input.playhead = context.playhead();
    input.hover = context.state.hover_frame;
    input.last_frame = std::max(1, context.last_frame());
    input.x_limits = {0, input.last_frame};
    const std::vector<double>& degrees = data.planned().degrees;
    if (angles && !degrees.empty()) {
        const auto [low, high] = std::minmax_element(degrees.begin(), degrees.end());
        input.x_limits = {*low, std::max(*high, *low + 1)};
        input.least_x_span = 1;
        input.frame_x = degrees;
        input.frame_turns = data.planned().turns;
        if (!data.planned().turns.empty())
            input.tooltip += "\nDotted: the way back.";
    }
}

PlotResult draw_shared_plot(EditorContext& context, PlotData& data, const char* id, const Rect& rect,
                            const PlotInput& input) {
    EditorState& state = context.state;
    const auto y = state.plots.y.find(id);
    const PlotResult result =
        draw_plot(id, rect, input, plot_x(context, input), y == state.plots.y.end() ? nullptr : &y->second,
                  state.plots.gesture, data.ink(), context.theme, context.scale());
    if (result.moved_to) {
        state.playback.playing = false;
        context.move_playhead(static_cast<int>(*result.moved_to));
    }
    if (result.hovered)
        state.next_hover_frame = result.hovered;
    if (result.x)
        set_plot_x(context, *result.x);
    if (result.y)
        state.plots.y[id] = *result.y;
    if (result.fit) {
        set_plot_x(context, input.x_limits);
        state.plots.y.erase(id);
    }
    return result;
}

PlotInput plot_input(const EditorContext& context, PlotData& data, const PlotRow& row, const Theme* theme) {
    const Scene& scene = context.document.scene();
    const bool angles = axis_of_angles(context);
    const MetricRow& metric = metric_of(row);
    PlotInput input;
    input.title = row.title;
    input.unit = metric.unit;
    input.tooltip =
        std::string(row.stages ? "Time of solving the frame, all muscles." : metric.meaning) +
        (row.band[0] != 0 ? "\n" : "") + row.band +
        "\nClick or drag moves the playhead, the wheel zooms x (Shift: y), a right drag zooms to a box, "
        "Ctrl+drag or the middle button pans, double-click shows all, right click opens the menu.";
    set_plot_axis(context, data, input);
    input.reference = row.reference;
    input.least_span = row.least_span;
    const bool failed = context.runs.recording() != nullptr &&
                        context.runs.recording()->state() == RunState::failed && !context.runs.outdated();
    input.empty_text = scene.muscles.empty()    ? "No muscle"
                       : failed                 ? "The run failed"
                       : context.runs.running() ? "Waiting for the first frames"
                                                : "No frames yet";
    const Theme& colours = theme != nullptr ? *theme : context.theme;
    add_series(context, row, data.content(context, row), angles, colours, input);
    add_overlays(context, data, row, angles, colours, input);
    return input;
}

PlotRange plot_x(const EditorContext& context, const PlotInput& input) {
    PlotRange range = context.state.plot_range;
    if (!input.frame_x.empty())
        range = context.state.plots.angles.value_or(input.x_limits);
    range.high = std::min(range.high, input.x_limits.high);
    range.low = std::clamp(range.low, input.x_limits.low, range.high - 1e-9);
    return range;
}

void set_plot_x(EditorContext& context, const PlotRange& range) {
    if (axis_of_angles(context))
        context.state.plots.angles = range;
    else
        context.state.plot_range = range;
}

view::Chart plot_chart(const EditorContext& context, PlotData& data, const PlotRow& row, bool dark) {
    const PlotInput input = plot_input(context, data, row, dark ? &dark_theme() : &light_theme());
    view::Chart chart;
    chart.title = input.title;
    chart.unit = input.unit;
    chart.x_label = input.x_label;
    chart.reference = input.reference;
    chart.least_span = input.least_span;
    const PlotRange x = plot_x(context, input);
    chart.x_range = {{x.low * input.x_unit, x.high * input.x_unit}};
    const auto y = context.state.plots.y.find(row.id);
    const PlotRange shown = y != context.state.plots.y.end() ? y->second : fitted_y(input, x);
    chart.y_range = {{shown.low, shown.high}};
    for (const PlotBundle& bundle : input.bundles)
        for (std::size_t i = 0; i < bundle.count; ++i) {
            view::ChartCurve line;
            line.colour = colour_of(bundle.colour);
            line.colour[3] = 0.3f;
            line.width = 0.6;
            for (std::size_t k = 0; k < bundle.frames; ++k) {
                line.x.push_back((bundle.x.empty() ? double(k) : bundle.x[k]) * input.x_unit);
                line.y.push_back(bundle.values[k * bundle.count + i]);
            }
            chart.curves.push_back(std::move(line));
        }
    for (const PlotCurve& curve : input.curves)
        if (!curve.hidden && !curve.y.empty())
            add_chart_curves(curve, input.x_unit, chart.curves);
    return chart;
}

std::string differing_parameters(const ParamSet& kept, const ParamSet& now, std::size_t most) {
    std::string text;
    std::size_t count = 0;
    for (const ParamRow& row : kept.table().rows()) {
        if (kept.get(row.key) == now.get(row.key))
            continue;
        if (++count > most)
            continue;
        const std::string unit = row.unit == "1" ? "" : " " + row.unit;
        text += (text.empty() ? "" : "\n") + row.label + " " + kept.text(row.key) + unit + ", now " +
                now.text(row.key) + unit;
    }
    if (count > most)
        text += "\nand " + std::to_string(count - most) + " more";
    return text;
}

} // namespace fascicle::editor
