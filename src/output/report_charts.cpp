#include "output/report_charts.hpp"

#include "fascicle/io/run_writer.hpp"
#include "fascicle/metrics/metric_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace fascicle::output {

namespace {

/// After Okabe and Ito 2008, as the editor's plots.
constexpr std::array<unsigned, 7> on_light{0xc07f00, 0x0072b2, 0x008a64, 0xb04f88,
                                           0x8a7d00, 0xc44e00, 0x4350c0};
constexpr std::array<unsigned, 7> on_dark{0xe69f00, 0x56b4e9, 0x2fbf93, 0xcc79a7,
                                          0xf0e442, 0xe4713a, 0x7f9bff};

render::Rgba colour_of(std::size_t i, bool dark) {
    const unsigned rgb = (dark ? on_dark : on_light)[i % on_light.size()];
    return {static_cast<float>(rgb >> 16) / 255, static_cast<float>(rgb >> 8 & 255) / 255,
            static_cast<float>(rgb & 255) / 255, 1};
}

using Sentence = std::string (*)(const ReportInput& input, std::size_t muscle, const std::vector<double>& y);

int frame_number(const ReportInput& input, int place) {
    return input.recording->frame(place)->index;
}

std::string in_frame(const ReportInput& input, int place) {
    return " in frame " + std::to_string(frame_number(input, place));
}

/// Place of the value furthest from `from`; -1 when none is finite.
int furthest_from(const std::vector<double>& y, double from) {
    int best = -1;
    for (std::size_t k = 0; k < y.size(); ++k)
        if (std::isfinite(y[k]) &&
            (best < 0 || std::abs(y[k] - from) > std::abs(y[static_cast<std::size_t>(best)] - from)))
            best = static_cast<int>(k);
    return best;
}

std::string volume_sentence(const ReportInput& input, std::size_t, const std::vector<double>& y) {
    const int k = furthest_from(y, 1);
    const double change = 100 * (y[static_cast<std::size_t>(k)] - 1);
    if (std::abs(change) < 0.005)
        return "keeps its volume to within 0.005 % of rest";
    return "departs from its volume at rest by at most " + short_number(std::abs(change), 2) + " % (" +
           (change < 0 ? "less" : "more") + in_frame(input, k) + ")";
}

std::string extension_sentence(const ReportInput& input, std::size_t muscle, const std::vector<double>& y) {
    const int k = furthest_from(y, 1);
    const auto at = static_cast<std::size_t>(k);
    std::string text = "has edges of " + short_number(y[at]) +
                       " times their length at rest in the mean where that is furthest from 1," +
                       in_frame(input, k);
    const std::vector<double> low = metric_series(input, muscle, "edge_extension_p10"),
                              high = metric_series(input, muscle, "edge_extension_p90");
    if (std::isfinite(low[at]) && std::isfinite(high[at]))
        text += ", and eight edges in ten lie between " + short_number(low[at]) + " and " +
                short_number(high[at]) + " there";
    return text;
}

std::string dihedral_sentence(const ReportInput& input, std::size_t, const std::vector<double>& y) {
    const Extremes e = extremes(y);
    const double most = y[static_cast<std::size_t>(e.greatest)];
    return "is bent by at most " + short_number(most) + " rad (" + short_number(most * 57.29577951308232, 2) +
           "\xC2\xB0) an edge in the mean," + in_frame(input, e.greatest) + ", and by " +
           short_number(y.back()) + " rad at the end";
}

std::string length_sentence(const ReportInput& input, std::size_t, const std::vector<double>& y) {
    const Extremes e = extremes(y);
    return "has fibres of " + short_number(y[static_cast<std::size_t>(e.least)]) + " mm (" +
           in_frame(input, e.least).substr(1) + ") to " +
           short_number(y[static_cast<std::size_t>(e.greatest)]) + " mm (" +
           in_frame(input, e.greatest).substr(1) + ") in the mean";
}

std::string arm_sentence(const ReportInput& input, std::size_t, const std::vector<double>& y) {
    const Extremes e = extremes(y);
    const double low = y[static_cast<std::size_t>(e.least)], high = y[static_cast<std::size_t>(e.greatest)];
    std::string text = "pulls with a mean moment arm of " + short_number(low) + " mm (" +
                       in_frame(input, e.least).substr(1) + ") to " + short_number(high) + " mm (" +
                       in_frame(input, e.greatest).substr(1) + ")";
    if (low < 0 && high > 0)
        text += ", so its sense changes on the way";
    return text;
}

std::string penetration_sentence(const ReportInput& input, std::size_t muscle, const std::vector<double>& y) {
    const Extremes e = extremes(y);
    const double most = y[static_cast<std::size_t>(e.greatest)];
    const std::vector<double> counts = metric_series(input, muscle, "penetrating_vertices");
    const Extremes c = extremes(counts);
    const double number = c.greatest < 0 ? 0 : counts[static_cast<std::size_t>(c.greatest)];
    if (number <= 0)
        return most <= 0 ? "never enters a bone"
                         : "enters bones by no more than " + short_number(most, 2) +
                               " mm, less than what counts as inside (0.1 mm)";
    return "is inside a bone by up to " + short_number(most, 2) + " mm" + in_frame(input, e.greatest) +
           "; at most " + std::to_string(std::lround(number)) +
           (number == 1 ? " vertex is" : " vertices are") + " deeper than 0.1 mm" +
           in_frame(input, c.greatest);
}

struct ChartRow {
    const char* key;
    const char* title;
    const char* unit;
    const char* low_key; ///< null: no band
    const char* high_key;
    std::optional<double> reference;
    double least_span;
    Sentence sentence;
    double neutral; ///< the muscle furthest from it is spoken of
};

const std::vector<ChartRow>& chart_rows() {
    static const std::vector<ChartRow> rows{
        {"volume_ratio", "Volume ratio", "1", nullptr, nullptr, 1.0, 0.002, volume_sentence, 1},
        {"edge_extension_mean", "Mean edge extension, band from 10th to 90th percentile", "1",
         "edge_extension_p10", "edge_extension_p90", 1.0, 0.01, extension_sentence, 1},
        {"dihedral_change_mean_rad", "Mean dihedral change", "rad", nullptr, nullptr, std::nullopt, 0.01,
         dihedral_sentence, 0},
        {"fibre_length_mean_mm", "Mean fibre length, band from 5th to 95th percentile", "mm",
         "fibre_length_p5_mm", "fibre_length_p95_mm", std::nullopt, 1.0, length_sentence, 0},
        {"moment_arm_mean_mm", "Mean moment arm, band from 5th to 95th percentile", "mm", "moment_arm_p5_mm",
         "moment_arm_p95_mm", 0.0, 1.0, arm_sentence, 0},
        {"penetration_max_mm", "Greatest depth in a bone", "mm", nullptr, nullptr, std::nullopt, 0.1,
         penetration_sentence, 0},
    };
    return rows;
}

std::vector<double> frame_axis(const ReportInput& input) {
    std::vector<double> x;
    for (std::size_t k = 0; k < input.rows.size(); ++k)
        x.push_back(frame_number(input, static_cast<int>(k)));
    return x;
}

view::Chart empty_chart(const ReportInput& input, const std::string& title, const std::string& unit) {
    view::Chart chart;
    chart.title = title;
    chart.unit = unit;
    chart.x_label = "frame";
    if (input.furthest > 0)
        chart.playhead = frame_number(input, input.furthest);
    return chart;
}

view::Chart metric_chart(const ReportInput& input, const ChartRow& row, bool dark) {
    view::Chart chart = empty_chart(input, row.title, row.unit);
    chart.reference = row.reference;
    chart.least_span = row.least_span;
    const auto& muscles = input.recording->scene().muscles;
    for (std::size_t m = 0; m < muscles.size(); ++m) {
        view::ChartCurve curve;
        curve.name = muscles.size() > 1 ? muscles[m].name : "";
        curve.colour = colour_of(m, dark);
        curve.x = frame_axis(input);
        curve.y = metric_series(input, m, row.key);
        if (row.low_key != nullptr) {
            curve.low = metric_series(input, m, row.low_key);
            curve.high = metric_series(input, m, row.high_key);
        }
        if (extremes(curve.y).least >= 0)
            chart.curves.push_back(std::move(curve));
    }
    return chart;
}

std::string metric_sentence(const ReportInput& input, const ChartRow& row) {
    const auto& muscles = input.recording->scene().muscles;
    std::size_t spoken = 0, with = 0;
    double most = -1;
    for (std::size_t m = 0; m < muscles.size(); ++m) {
        const std::vector<double> y = metric_series(input, m, row.key);
        const int k = furthest_from(y, row.neutral);
        if (k < 0)
            continue;
        ++with;
        if (const double far = std::abs(y[static_cast<std::size_t>(k)] - row.neutral); far > most) {
            most = far;
            spoken = m;
        }
    }
    const std::string start =
        with > 1 ? "Of " + std::to_string(with) + " muscles the one furthest off, " : "The muscle ";
    return start + muscles[spoken].name + (with > 1 ? ", " : " ") +
           row.sentence(input, spoken, metric_series(input, spoken, row.key)) + ".";
}

/// Milliseconds of every stage of solving, and of all.
std::optional<ReportChart> time_chart(const ReportInput& input) {
    const Recording& recording = *input.recording;
    const int count = static_cast<int>(input.rows.size());
    std::map<std::string, std::vector<double>> stages;
    std::map<std::string, double> sums;
    std::vector<double> whole;
    for (int k = 0; k < count; ++k) {
        const FrameReport& report = recording.frame(k)->report;
        whole.push_back(k == 0 ? std::nan("") : report.solve_seconds * 1000);
        for (const auto& [stage, seconds] : report.stage_seconds) {
            std::vector<double>& y = stages[stage];
            y.resize(static_cast<std::size_t>(count), std::nan(""));
            if (k > 0) {
                y[static_cast<std::size_t>(k)] = seconds * 1000;
                sums[stage] += seconds;
            }
        }
    }
    const RunSpeed speed = run_speed(recording);
    if (speed.solve_seconds <= 0)
        return std::nullopt;
    const auto draw = [&](bool dark) {
        view::Chart chart = empty_chart(input, "Time of solving a frame", "ms");
        chart.least_span = 1;
        chart.y_range.reset();
        std::size_t i = 0;
        const auto add = [&](const std::string& name, const std::vector<double>& y, double width) {
            view::ChartCurve curve;
            curve.name = name;
            curve.colour = colour_of(i++, dark);
            curve.x = frame_axis(input);
            curve.y = y;
            curve.width = width;
            chart.curves.push_back(std::move(curve));
        };
        add("all", whole, 1.5);
        for (const auto& [stage, y] : stages)
            add(stage, y, 1);
        return chart;
    };
    std::string text = "Solving " + std::to_string(count - 1) +
                       (count == 2 ? " frame took " : " frames took ") + short_number(speed.solve_seconds) +
                       " s: " + short_number(speed.fps_median) + " frames a second in the median";
    if (!sums.empty()) {
        const auto most = std::max_element(sums.begin(), sums.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        double all = 0;
        for (const auto& [stage, seconds] : sums)
            all += seconds;
        if (all > 0)
            text += "; " + most->first + " took most of it, " + short_number(100 * most->second / all, 2) +
                    " % of the time that stages count (on the first thread)";
    }
    return ReportChart{draw(false), draw(true), text + "."};
}

} // namespace

std::string short_number(double value, int digits) {
    if (!std::isfinite(value))
        return "\xE2\x80\x93";
    char text[48];
    // Fixed where that is short: 0.0012, 12.3, 12345.
    const double size = std::abs(value);
    const int before = size > 0 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
    const int decimals = std::clamp(digits - before, 0, 6);
    const bool tiny = size > 0 && size < 1e-4;
    const auto end =
        tiny ? std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1)
             : std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals);
    std::string result(text, end.ptr);
    if (!tiny && result.find('.') != std::string::npos) {
        result.erase(result.find_last_not_of('0') + 1);
        if (result.back() == '.')
            result.pop_back();
    }
    return result == "-0" ? "0" : result;
}

Extremes extremes(const std::vector<double>& values) {
    Extremes e;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isfinite(values[k]))
            continue;
        const int here = static_cast<int>(k);
        if (e.least < 0 || values[k] < values[static_cast<std::size_t>(e.least)])
            e.least = here;
        if (e.greatest < 0 || values[k] > values[static_cast<std::size_t>(e.greatest)])
            e.greatest = here;
    }
    return e;
}

std::vector<double> metric_series(const ReportInput& input, std::size_t muscle, const char* key) {
    std::vector<double> y;
    const int row = metric_index(key);
    if (row < 0)
        return y;
    for (const auto& frame : input.rows)
        y.push_back(frame.at(muscle).at(static_cast<std::size_t>(row)));
    return y;
}

std::vector<ReportChart> report_charts(const ReportInput& input) {
    std::vector<ReportChart> charts;
    for (const ChartRow& row : chart_rows()) {
        view::Chart light = metric_chart(input, row, false);
        if (light.curves.empty())
            continue;
        charts.push_back({std::move(light), metric_chart(input, row, true), metric_sentence(input, row)});
    }
    if (std::optional<ReportChart> time = time_chart(input))
        charts.push_back(std::move(*time));
    return charts;
}

} // namespace fascicle::output
