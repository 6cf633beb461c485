#include "reproduce/charts.hpp"

#include "fascicle/solver/soft_body_solver.hpp"
#include "reproduce/arm_shares.hpp"
#include "reproduce/findings.hpp"
#include "reproduce/published.hpp"
#include "reproduce/sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace fascicle::reproduce {

namespace {

using view::Chart;
using view::ChartCurve;

const double none = std::numeric_limits<double>::quiet_NaN();

render::Rgba rgb(unsigned colour) {
    return {static_cast<float>(colour >> 16) / 255, static_cast<float>(colour >> 8 & 255) / 255,
            static_cast<float>(colour & 255) / 255, 1};
}

const unsigned mark_colour = 0x111111;
const unsigned band_colour = 0x5b6670;

bool is_main(const std::string& method) {
    return method == solver_methods().front().name || method == "classic";
}

/// Single dots, not joined: gaps between them.
ChartCurve dots(std::string name, const std::vector<double>& x, const std::vector<double>& y,
                unsigned colour) {
    ChartCurve curve;
    curve.name = std::move(name);
    curve.colour = rgb(colour);
    curve.width = 2.6;
    for (std::size_t i = 0; i < x.size(); ++i) {
        curve.x.push_back(x[i]);
        curve.y.push_back(y[i]);
        curve.x.push_back(x[i]);
        curve.y.push_back(none);
    }
    return curve;
}

Chart over_frames(const char* title, const char* unit) {
    Chart chart;
    chart.title = title;
    chart.unit = unit;
    chart.x_label = "frame";
    chart.x_range = view::ChartSpan{0, paper_frames + 4}; // the whole of a dot at the end
    return chart;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double& v : values)
        v *= factor;
    return values;
}

struct MetricPlot {
    const char* key;
    const char* title;
    const char* unit;
    const char* low; ///< key of the band's lower edge, null: none
    const char* high;
    double factor;
    std::optional<double> reference;
    double least_span;
    double PublishedFrame::*mark; ///< null: none
    int group;                    ///< of figures 11 to 19, -1: none
    const char* caption;
};

const MetricPlot metric_plots[] = {
    {"volume_ratio", "Volume ratio", "1", nullptr, nullptr, 1, 1.0, 0.004, &PublishedFrame::volume_ratio, 0,
     "Volume over volume at rest."},
    {"edge_extension_mean", "Edge extension, mean", "1", "edge_extension_p10", "edge_extension_p90", 1, 1.0,
     0.02, &PublishedFrame::edge_mean, 1,
     "Length over rest length of the edges; band from the 10th to the 90th percentile."},
    {"edge_extension_p99", "Edge extension, 99th percentile", "1", nullptr, nullptr, 1, 1.0, 0.02,
     &PublishedFrame::edge_p99, -1, "One edge in a hundred is stretched more than this."},
    {"dihedral_change_mean_rad", "Dihedral change, mean", "deg", "dihedral_change_p10_rad",
     "dihedral_change_p90_rad", 180 / std::numbers::pi, std::nullopt, 0.5, nullptr, 2,
     "Change of the signed dihedral angle; band from the 10th to the 90th percentile."},
    {"dihedral_change_unsigned_mean_deg", "Dihedral change, unsigned as in the paper", "deg", nullptr,
     nullptr, 1, std::nullopt, 0.5, &PublishedFrame::dihedral_deg, 2,
     "Change of the angle without its sign, which folds do not show in."},
    {"penetrating_vertices", "Vertices deeper than 0.1 mm inside bones", "1", nullptr, nullptr, 1,
     std::nullopt, 1, nullptr, -1, "Vertices that were not inside at rest."},
};

std::optional<Plot> metric_plot(const ExperimentResult& result, const MetricPlot& row) {
    Plot plot;
    plot.figures = plot_figure(*result.experiment, row.group);
    plot.about = row.key;
    plot.caption = row.caption;
    plot.chart = over_frames(row.title, row.unit);
    plot.chart.reference = row.reference;
    plot.chart.least_span = row.least_span;
    bool any = false;
    for (const MethodRun& run : result.runs) {
        if (!run.done())
            continue;
        ChartCurve curve;
        curve.name = run.method;
        curve.colour = method_colour(run.method);
        curve.x = run.run.frame;
        curve.y = scaled(run.run.metric(row.key), row.factor);
        if (row.low != nullptr && is_main(run.method)) {
            curve.low = scaled(run.run.metric(row.low), row.factor);
            curve.high = scaled(run.run.metric(row.high), row.factor);
        }
        curve.width = is_main(run.method) ? 2 : 1.2;
        any = any || std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return std::isfinite(y); });
        plot.chart.curves.push_back(std::move(curve));
    }
    if (!any)
        return std::nullopt;
    if (std::string(row.key) == "penetrating_vertices") { // a count: nothing below 0
        const double most = view::chart_y(plot.chart).high;
        plot.chart.y_range = view::ChartSpan{-0.02 * std::max(1.0, most), std::max(1.0, most)};
    }
    // Numbers of the real muscles say nothing about stand-ins; the box of the paper is the same made or read.
    const bool comparable = result.real || result.experiment->key == "squish-box";
    if (row.mark != nullptr && comparable) {
        std::vector<double> x, y;
        for (const PublishedFrame& mark : published_marks(result.experiment->published)) {
            x.push_back(mark.frame);
            y.push_back(mark.*row.mark);
        }
        if (!x.empty())
            plot.chart.curves.push_back(dots("published program", x, y, mark_colour));
    }
    return plot;
}

/// Every fibre of one run, and the mean.
Plot fibre_plot(const ExperimentResult& result, const MethodRun& run) {
    Plot plot;
    plot.figures = fibre_figure(*result.experiment);
    plot.about = fibre_lengths_about(run.method);
    plot.caption = "Length of every fibre (" + std::to_string(run.run.fibres.count()) + ", by " +
                   fibre_method(*result.experiment) + ") with " + run.method + "; bold: their mean.";
    plot.chart = over_frames(("Fibre lengths, " + run.method).c_str(), "mm");
    const std::size_t frames = run.run.frame.size(), step = std::max<std::size_t>(1, frames / 60);
    const auto add = [&](const std::string& name, const auto& value, double width, float opacity) {
        ChartCurve curve;
        curve.name = name;
        curve.colour = method_colour(run.method);
        curve.colour[3] = opacity;
        curve.width = width;
        for (std::size_t k = 0; k < frames; k += step) {
            curve.x.push_back(run.run.frame[k]);
            curve.y.push_back(value(k));
        }
        plot.chart.curves.push_back(std::move(curve));
    };
    for (std::size_t f = 0; f < run.run.fibres.count(); ++f)
        add(
            "", [&](std::size_t k) { return run.run.fibres.length(k, f); }, 0.7, 0.45f);
    const std::vector<double> mean = run.run.metric("fibre_length_mean_mm");
    add(
        "", [&](std::size_t k) { return mean[k]; }, 2.6, 1.0f);
    return plot;
}

/// One scale, so that plots side by side can be compared.
void share_y(std::span<Plot> plots) {
    if (plots.empty())
        return;
    view::ChartSpan all = view::chart_y(plots.front().chart);
    for (const Plot& plot : plots) {
        const view::ChartSpan own = view::chart_y(plot.chart);
        all = {std::min(all.low, own.low), std::max(all.high, own.high)};
    }
    for (Plot& plot : plots)
        plot.chart.y_range = all;
}

/// Mean arms of all methods over the angle, with what is published.
std::optional<Plot> arm_plot(const ExperimentResult& result) {
    const Experiment& e = *result.experiment;
    const bool sweeps = is_sweep(e.motion);
    Plot plot;
    plot.figures = sweeps ? "" : "22";
    plot.about = "moment_arm_mm";
    plot.caption = std::string("Mean moment arm of the fibres ") +
                   (sweeps ? "on the way from one side to the other" : "on the way out") + ", about " +
                   to_text(e.motion) +
                   ", positive for what moves the thigh that way; coloured band: all fibres of " +
                   solver_methods().front().name + ".";
    plot.chart.title = "Moment arm";
    plot.chart.unit = "mm";
    plot.chart.x_label = std::string(to_text(e.motion)) + " [deg]";
    const double high = sweeps ? sweep_turn(e.motion).to_deg : 60, low = sweeps ? -high : 0;
    const double air = 0.015 * (high - low); // the whole of a dot at either end
    plot.chart.x_range = view::ChartSpan{low - air, high + air};
    std::vector<BandPoint> band = arm_band(e.muscle);
    std::string band_name = "Blemker & Delp 2005, digitised";
    if (sweeps) {
        band.clear();
        for (const PublishedArm& row : published_arms())
            if (band.empty() && row.motion == e.motion && e.muscle == row.muscle) {
                band = {{low, row.least, row.greatest}, {high, row.least, row.greatest}};
                band_name = std::string(row.model) + ", Modenese & Kohout 2020";
            }
    }
    if (result.real && !band.empty()) {
        ChartCurve curve;
        curve.name = band_name;
        curve.colour = rgb(band_colour);
        curve.width = 0;
        curve.band_opacity = 0.2;
        for (const BandPoint& point : band) {
            curve.x.push_back(point.x);
            curve.y.push_back(none);
            curve.low.push_back(point.low);
            curve.high.push_back(point.high);
        }
        plot.chart.curves.push_back(std::move(curve));
    }
    bool any = false, with_lines = false;
    for (const MethodRun& run : result.runs) {
        if (!run.done())
            continue;
        const WayOut poses = arm_poses(e, run.run);
        if (poses.places.empty())
            continue;
        if (!with_lines)
            for (const std::size_t f : lines_of(e.muscle, run.run.lines)) {
                ChartCurve curve;
                curve.name = "line muscles";
                curve.colour = rgb(mark_colour);
                curve.dashed = true;
                curve.width = 1;
                curve.x = poses.flexion_deg;
                for (const std::size_t k : poses.places)
                    curve.y.push_back(run.run.lines.arm(k, f));
                plot.chart.curves.push_back(std::move(curve));
                with_lines = true;
            }
        if (run.run.fibres.count() == 0)
            continue;
        ChartCurve curve;
        curve.name = run.method;
        curve.colour = method_colour(run.method);
        curve.width = is_main(run.method) ? 2 : 1.2;
        curve.x = poses.flexion_deg;
        for (const Span3& span : arm_spans(run.run.fibres, poses)) {
            curve.y.push_back(span.mean);
            if (run.method == solver_methods().front().name) {
                curve.low.push_back(span.least);
                curve.high.push_back(span.greatest);
            }
        }
        plot.chart.curves.push_back(std::move(curve));
        any = true;
    }
    if (!any)
        return std::nullopt;
    for (const MeasuredArms& measured : measured_arms())
        if (result.real && !sweeps && e.muscle == measured.muscle)
            plot.chart.curves.push_back(
                dots(measured.source, measured.angle_deg, measured.arm_mm, mark_colour));
    return plot;
}

} // namespace

render::Rgba method_colour(const std::string& method) {
    // After Okabe and Ito 2008, as the editor's plots.
    static constexpr std::array<unsigned, 8> colours{0x0072b2, 0xc44e00, 0x008a64, 0xb04f88,
                                                     0x8a7d00, 0x4350c0, 0x56a4d9, 0x7a5230};
    std::size_t i = 0;
    for (const SolverMethod& row : solver_methods()) {
        if (row.name == method)
            break;
        ++i;
    }
    return rgb(colours[i % colours.size()]);
}

std::vector<Plot> experiment_plots(const ExperimentResult& result) {
    std::vector<Plot> plots;
    const Experiment& e = *result.experiment;
    // With other fibres, or another axis, these would show again what the experiment before has shown.
    if (e.methods != MethodChoice::first)
        for (const MetricPlot& row : metric_plots)
            if (std::optional<Plot> plot = metric_plot(result, row))
                plots.push_back(std::move(*plot));
    const std::size_t first_of_fibres = plots.size();
    if (!is_sweep(e.motion))
        for (const MethodRun& run : result.runs)
            if (run.done() && run.run.fibres.count() > 0 && is_main(run.method))
                plots.push_back(fibre_plot(result, run));
    share_y(std::span(plots).subspan(first_of_fibres));
    if (std::optional<Plot> plot = arm_plot(result))
        plots.push_back(std::move(*plot));
    return plots;
}

std::vector<Plot> speed_plots(const SpeedResult& speed) {
    if (speed.rows.empty())
        return {};
    Plot plot;
    plot.about = "speed";
    plot.caption =
        "Table 1: frames a second of solving alone; black: the paper's (another machine, one thread).";
    plot.chart.title = "Speed";
    plot.chart.unit = "frames/s";
    plot.chart.x_label = "triangles";
    for (const SpeedResult::Correlation& group : speed.correlations) {
        std::vector<std::pair<double, double>> points;
        for (const SpeedRow& row : speed.rows)
            if (row.method == group.method && row.threads == group.threads)
                points.emplace_back(static_cast<double>(row.triangles), row.frames_per_second);
        std::sort(points.begin(), points.end());
        ChartCurve curve;
        curve.name = group.method + ", " + std::to_string(group.threads) +
                     (group.threads == 1 ? " thread" : " threads");
        curve.colour = method_colour(group.method);
        curve.dashed = group.threads == 1;
        for (const auto& [x, y] : points) {
            curve.x.push_back(x);
            curve.y.push_back(y);
        }
        plot.chart.curves.push_back(std::move(curve));
    }
    std::vector<double> x, y;
    for (const PublishedSpeed& row : published_speeds()) {
        x.push_back(row.triangles);
        y.push_back(row.frames_per_second);
    }
    plot.chart.curves.push_back(dots("paper", x, y, mark_colour));
    const view::ChartSpan shown = view::chart_x(plot.chart), speeds = view::chart_y(plot.chart);
    plot.chart.x_range = view::ChartSpan{shown.low - 500, shown.high + 500};
    plot.chart.y_range = view::ChartSpan{0, speeds.high};
    return {plot};
}

} // namespace fascicle::reproduce
