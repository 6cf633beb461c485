#include "editor/panels/panels.hpp"

#include "editor/frame_axis.hpp"
#include "editor/widgets/plot.hpp"
#include "fascicle/metrics/line_series.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace fascicle::editor {

namespace {

/// In the legend, and in EditorState::hidden_curves.
constexpr const char* all_lines = "line muscles";

/// A plot: a metric, and the metrics that make its band.
struct PlotRow {
    const char* id;
    const char* key;
    const char* title;
    const char* low_key; ///< null: no band
    const char* high_key;
    std::optional<double> reference;
    double least_span;
    bool of_fibres = false; ///< shown where a run has fibres, or the scene line muscles
    std::vector<double> LineSeries::*of_lines = nullptr; ///< what line muscles have of it
};

const std::vector<PlotRow>& plot_rows() {
    static const std::vector<PlotRow> rows{
        {"plot/volume_ratio", "volume_ratio", "Volume ratio", nullptr, nullptr, 1.0, 0.002},
        {"plot/edge_extension", "edge_extension_mean", "Mean edge extension", "edge_extension_p10",
         "edge_extension_p90", 1.0, 0.01},
        {"plot/dihedral_change", "dihedral_change_mean_rad", "Mean dihedral change", nullptr, nullptr,
         std::nullopt, 0.01},
        {"plot/fibre_length", "fibre_length_mean_mm", "Fibre length", "fibre_length_p5_mm",
         "fibre_length_p95_mm", std::nullopt, 1.0, true, &LineSeries::lengths_mm},
        {"plot/moment_arm", "moment_arm_mean_mm", "Moment arm", "moment_arm_p5_mm", "moment_arm_p95_mm", 0.0,
         1.0, true, &LineSeries::moment_arms_mm},
    };
    return rows;
}

/// One value per frame of one muscle.
std::vector<double> series(const MetricValues& values, std::size_t muscle, const char* key) {
    std::vector<double> result;
    const int row = key == nullptr ? -1 : metric_index(key);
    if (row < 0)
        return result;
    for (const auto& frame : values.rows)
        result.push_back(muscle < frame.size() ? frame[muscle][static_cast<std::size_t>(row)]
                                               : std::numeric_limits<double>::quiet_NaN());
    return result;
}

/// Whether the values shown, or those of an earlier run, are of fibres.
bool has_fibres(const EditorContext& context) {
    const int row = metric_index("fibre_length_mean_mm");
    const auto any = [&](const MetricValues& values) {
        return !values.rows.empty() &&
               std::any_of(values.rows[0].begin(), values.rows[0].end(),
                           [&](const std::vector<double>& muscle) {
                               return std::isfinite(muscle[static_cast<std::size_t>(row)]);
                           });
    };
    return any(context.metrics.current()) ||
           std::any_of(context.metrics.earlier().begin(), context.metrics.earlier().end(), any);
}

class Plots : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        std::vector<PlotRow> rows = plot_rows();
        follow_lines(context.document.head());
        if (!has_fibres(context) && lines_.muscles.empty())
            std::erase_if(rows, [](const PlotRow& row) { return row.of_fibres; });
        follow_timeline(context);
        const int columns =
            std::clamp(static_cast<int>(area.width() / context.px(225)), 1, static_cast<int>(rows.size()));
        const int lines = (static_cast<int>(rows.size()) + columns - 1) / columns;
        const float height = std::max(context.px(140), area.height() / static_cast<float>(lines));
        const float width = area.width() / static_cast<float>(columns);
        const ImVec2 origin = ImGui::GetCursorScreenPos(); // moves with scrolling
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto column = static_cast<float>(static_cast<int>(i) % columns),
                       line = static_cast<float>(static_cast<int>(i) / columns);
            const Rect rect{{std::round(origin.x + column * width), origin.y + line * height},
                            {std::round(origin.x + (column + 1) * width), origin.y + (line + 1) * height}};
            if (column > 0)
                ImGui::GetWindowDrawList()->AddLine({rect.min.x, rect.min.y + context.px(8)},
                                                    {rect.min.x, rect.max.y - context.px(8)},
                                                    context.theme.line);
            draw_one(context, rows[i], rect);
        }
        ImGui::SetCursorScreenPos(origin);
        ImGui::Dummy({1, height * static_cast<float>(lines) - 1});
    }

private:
    /// The range belongs to a timeline of one length.
    static void follow_timeline(EditorContext& context) {
        EditorState& state = context.state;
        if (state.plot_range_for != context.last_frame()) {
            state.plot_range_for = context.last_frame();
            state.plot_range = {0, double(std::max(1, context.last_frame()))};
        }
    }

    /// Line muscles go as the motion is planned, so their curves are there before any run.
    void follow_lines(const ScenePtr& scene) {
        if (scene == lines_scene_)
            return;
        lines_scene_ = scene;
        lines_ = line_series(*scene);
    }

    /// One entry of the legend stands for all of them.
    void add_line_curves(const EditorContext& context, const PlotRow& row, PlotInput& input) const {
        const std::size_t muscles = lines_.muscles.size();
        if (row.of_lines == nullptr || muscles == 0)
            return;
        const auto at = static_cast<std::size_t>(std::max(0.0, std::round(context.playhead())));
        const bool hidden = context.state.hidden_curves.count(all_lines) != 0;
        PlotCurve entry;
        entry.name = all_lines;
        entry.colour = context.theme.text_faint;
        entry.hidden = hidden;
        input.curves.push_back(entry);
        input.tooltip += "\nDashed: line muscles of the model.";
        for (std::size_t m = 0; m < muscles; ++m) {
            PlotCurve curve;
            curve.name = lines_.muscles[m];
            curve.colour = muted_curve_colour(context.theme, static_cast<int>(m));
            curve.dashed = true;
            curve.hidden = hidden;
            for (std::size_t k = 0; k < lines_.frames.size(); ++k)
                curve.y.push_back((lines_.*row.of_lines)[k * muscles + m]);
            if (at < curve.y.size()) {
                char value[32];
                std::snprintf(value, sizeof value, ": %.2f", curve.y[at]);
                input.tooltip += '\n' + curve.name + value;
            }
            input.curves.push_back(std::move(curve));
        }
    }

    static void add_curves(const EditorContext& context, const PlotRow& row, PlotInput& input) {
        const MetricValues& now = context.metrics.current();
        const auto& earlier = context.metrics.earlier();
        const EditorState& state = context.state;
        const std::vector<Muscle>& muscles = context.document.scene().muscles;
        for (std::size_t m = 0; m < muscles.size(); ++m) {
            const ImU32 colour = curve_colour(context.theme, static_cast<int>(m));
            const bool hidden = state.hidden_curves.count(muscles[m].name) != 0;
            for (auto ghost = earlier.rbegin(); ghost != earlier.rend(); ++ghost) {
                const int same = ghost->scene->muscle_index(muscles[m].name);
                if (same >= 0 && !hidden)
                    input.curves.push_back({muscles[m].name,
                                            colour,
                                            series(*ghost, static_cast<std::size_t>(same), row.key),
                                            {},
                                            {},
                                            true,
                                            false});
            }
            const int index = now.scene == nullptr ? -1 : now.scene->muscle_index(muscles[m].name);
            if (index < 0)
                continue;
            const auto k = static_cast<std::size_t>(index);
            input.curves.push_back({muscles[m].name, colour, series(now, k, row.key),
                                    series(now, k, row.low_key), series(now, k, row.high_key), false,
                                    hidden});
        }
    }

    void draw_one(EditorContext& context, const PlotRow& row, const Rect& rect) {
        EditorState& state = context.state;
        const Scene& scene = context.document.scene();
        const int index = metric_index(row.key);
        if (index < 0)
            return;
        const MetricRow& metric = metric_table()[static_cast<std::size_t>(index)];
        PlotInput input;
        input.title = row.title;
        input.unit = metric.unit;
        input.tooltip =
            metric.meaning +
            (row.low_key != nullptr ? (row.of_fibres ? "\nBand: 5th to 95th percentile of the fibres."
                                                     : "\nBand: 10th to 90th percentile.")
                                    : "") +
            "\nClick moves the playhead, wheel zooms, Ctrl+drag pans, double-click shows all.";
        input.x_label = axis_label(state.ruler);
        input.x_text = [&](double frame) { return frame_text(scene, state.ruler, frame); };
        input.playhead = context.playhead();
        input.hover = state.hover_frame;
        input.last_frame = std::max(1, context.last_frame());
        input.reference = row.reference;
        input.least_span = row.least_span;
        input.empty_text = scene.muscles.empty() ? "No muscle" : "No frames yet";
        add_curves(context, row, input);
        add_line_curves(context, row, input);

        const PlotResult result =
            draw_plot(row.id, rect, input, state.plot_range, context.theme, context.scale());
        if (result.moved_to) {
            state.playback.playing = false;
            context.move_playhead(static_cast<int>(*result.moved_to));
        }
        if (result.hovered)
            state.next_hover_frame = result.hovered;
        if (result.toggled >= 0)
            toggle(state, input.curves[static_cast<std::size_t>(result.toggled)].name);
        if (result.isolated >= 0)
            isolate(state, scene, input.curves[static_cast<std::size_t>(result.isolated)].name);
    }

    static void toggle(EditorState& state, const std::string& name) {
        if (state.hidden_curves.erase(name) == 0)
            state.hidden_curves.insert(name);
    }

    static void isolate(EditorState& state, const Scene& scene, const std::string& name) {
        state.hidden_curves.clear();
        for (const Muscle& muscle : scene.muscles)
            if (muscle.name != name)
                state.hidden_curves.insert(muscle.name);
        if (name != all_lines)
            state.hidden_curves.insert(all_lines);
    }

    ScenePtr lines_scene_;
    LineSeries lines_; ///< of lines_scene_
};

} // namespace

std::unique_ptr<Panel> make_plots() {
    return std::make_unique<Plots>();
}

} // namespace fascicle::editor
