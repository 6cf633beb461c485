#include "editor/panels/panels.hpp"

#include "editor/features.hpp"
#include "editor/frame_axis.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fascicle::editor {

namespace {

struct DifferenceRow {
    const char* id;
    const char* key; ///< of a metric; null: distance between the vertices
    const char* title;
    double least_span;
};

constexpr std::array<DifferenceRow, 7> difference_rows{{
    {"difference/distance", nullptr, "Distance, rms and largest", 0.02},
    {"difference/volume_ratio", "volume_ratio", "Volume ratio, B - A", 0.002},
    {"difference/edge_extension", "edge_extension_mean", "Edge extension, B - A", 0.005},
    {"difference/dihedral_change", "dihedral_change_mean_rad", "Dihedral change, B - A", 0.005},
    {"difference/fibre_length", "fibre_length_mean_mm", "Fibre length, B - A", 0.5},
    {"difference/moment_arm", "moment_arm_mean_mm", "Moment arm, B - A", 0.5},
    {"difference/penetration", "penetration_max_mm", "Penetration, B - A", 0.05},
}};

/// A value per frame number, NaN where there is none.
std::vector<double> gaps(int last_index) {
    return std::vector<double>(static_cast<std::size_t>(std::max(0, last_index) + 1),
                               std::numeric_limits<double>::quiet_NaN());
}

/// Straight lines over frames that only one of the runs has, so that a run written with --every has curves, not dots.
void bridge(std::vector<double>& curve, const std::vector<FramePair>& frames) {
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const int from = frames[i - 1].index, to = frames[i].index;
        const double low = curve[static_cast<std::size_t>(from)], high = curve[static_cast<std::size_t>(to)];
        for (int k = from + 1; k < to; ++k)
            curve[static_cast<std::size_t>(k)] = low + (high - low) * (k - from) / (to - from);
    }
}

class Differences : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        Compare& compare = context.features.compare;
        compare.want_distances();
        compare.want_metrics();
        if (!compare.reason().empty()) {
            const ImVec2 at = ImGui::GetCursorScreenPos();
            draw_text_in(*ImGui::GetWindowDrawList(),
                         {at, {at.x + area.width(), at.y + area.height() * 0.8f}}, context.theme.text_faint,
                         "Nothing to compare: " + compare.reason(), Align::centre);
            return;
        }
        follow_timeline(context);
        make_curves(context);
        std::vector<std::size_t> shown;
        for (std::size_t i = 0; i < difference_rows.size(); ++i)
            if (!of_fibres(difference_rows[i]) || has_values(curves_[i]))
                shown.push_back(i);
        const int columns =
            std::clamp(static_cast<int>(area.width() / context.px(225)), 1, static_cast<int>(shown.size()));
        const int lines = (static_cast<int>(shown.size()) + columns - 1) / columns;
        const float height = std::max(context.px(140), area.height() / static_cast<float>(lines));
        const float width = area.width() / static_cast<float>(columns);
        const ImVec2 origin = ImGui::GetCursorScreenPos();
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const auto column = static_cast<float>(static_cast<int>(i) % columns),
                       line = static_cast<float>(static_cast<int>(i) / columns);
            const Rect rect{{std::round(origin.x + column * width), origin.y + line * height},
                            {std::round(origin.x + (column + 1) * width), origin.y + (line + 1) * height}};
            if (column > 0)
                ImGui::GetWindowDrawList()->AddLine({rect.min.x, rect.min.y + context.px(8)},
                                                    {rect.min.x, rect.max.y - context.px(8)},
                                                    context.theme.line);
            draw_one(context, difference_rows[shown[i]], curves_[shown[i]], rect);
        }
        ImGui::SetCursorScreenPos(origin);
        ImGui::Dummy({1, height * static_cast<float>(lines) - 1});
    }

private:
    using Curves = std::vector<std::vector<double>>; ///< one a matched muscle; distances: rms and max in turn

    static bool of_fibres(const DifferenceRow& row) {
        const int index = row.key == nullptr ? -1 : metric_index(row.key);
        return index >= 0 && metric_table()[static_cast<std::size_t>(index)].of_fibres;
    }
    static bool has_values(const Curves& curves) {
        return std::any_of(curves.begin(), curves.end(), [](const std::vector<double>& curve) {
            return std::any_of(curve.begin(), curve.end(), [](double y) { return std::isfinite(y); });
        });
    }

    /// The range of x that the plots share belongs to a timeline of one length.
    static void follow_timeline(EditorContext& context) {
        EditorState& state = context.state;
        if (state.plot_range_for != context.last_frame()) {
            state.plot_range_for = context.last_frame();
            state.plot_range = {0, double(std::max(1, context.last_frame()))};
        }
    }

    void make_curves(const EditorContext& context) {
        const Compare& compare = context.features.compare;
        const std::vector<MatchedMuscle>& muscles = compare.match().muscles;
        const int last = compare.frames().empty() ? 0 : compare.frames().back().index;
        const MetricRows* a = compare.metrics_a();
        const MetricRows* b = compare.metrics_b();
        for (std::size_t i = 0; i < difference_rows.size(); ++i) {
            Curves& curves = curves_[i];
            const DifferenceRow& row = difference_rows[i];
            curves.assign(row.key == nullptr ? 2 * muscles.size() : muscles.size(), gaps(last));
            if (row.key == nullptr) {
                for (const FrameDifference& frame : compare.differences())
                    for (std::size_t m = 0; m < frame.muscles.size(); ++m) {
                        const auto k = static_cast<std::size_t>(frame.index);
                        curves[2 * m].at(k) = frame.muscles[m].rms_mm;
                        curves[2 * m + 1].at(k) = frame.muscles[m].max_mm;
                    }
                for (std::vector<double>& curve : curves)
                    bridge(curve, compare.frames());
                continue;
            }
            const int metric = metric_index(row.key);
            if (a == nullptr || b == nullptr)
                continue;
            for (const FramePair& pair : compare.frames())
                for (std::size_t m = 0; m < muscles.size(); ++m)
                    curves[m][static_cast<std::size_t>(pair.index)] =
                        metric_difference(*a, *b, pair, muscles[m], metric);
            for (std::vector<double>& curve : curves)
                bridge(curve, compare.frames());
        }
    }

    static void draw_one(EditorContext& context, const DifferenceRow& row, const Curves& curves,
                         const Rect& rect) {
        EditorState& state = context.state;
        const Compare& compare = context.features.compare;
        const Scene& scene = context.document.scene();
        const int metric = row.key == nullptr ? -1 : metric_index(row.key);
        PlotInput input;
        input.title = row.title;
        input.unit = metric < 0 ? "mm" : metric_table()[static_cast<std::size_t>(metric)].unit;
        input.tooltip = metric < 0
                            ? "Distances between the same vertices of A and B.\nLine: root mean square; "
                              "dashed: the largest."
                            : metric_table()[static_cast<std::size_t>(metric)].meaning + "\nRun B, " +
                                  compare.b().name + ", minus run A, " + compare.a().name + ".";
        input.tooltip += "\nClick moves the playhead, wheel zooms, Ctrl+drag pans, double-click shows all.";
        input.x_label = axis_label(state.ruler);
        input.x_text = [&](double frame) { return frame_text(scene, state.ruler, frame); };
        input.playhead = context.playhead();
        input.hover = state.hover_frame;
        input.last_frame = std::max(1, context.last_frame());
        if (metric >= 0)
            input.reference = 0.0;
        input.least_span = row.least_span;
        const std::vector<MatchedMuscle>& muscles = compare.match().muscles;
        const std::size_t per_muscle = metric < 0 ? 2 : 1;
        if (has_values(curves))
            for (std::size_t i = 0; i < curves.size(); ++i) {
                const MatchedMuscle& muscle = muscles[i / per_muscle];
                PlotCurve curve;
                curve.name = muscle.name;
                curve.colour = curve_colour(context.theme, muscle.a);
                curve.y = curves[i];
                curve.hidden = state.hidden_curves.count(muscle.name) != 0;
                curve.dashed = i % per_muscle == 1;
                if (curve.dashed)
                    curve.name.clear(); // the line of the muscle has it
                input.curves.push_back(std::move(curve));
            }
        const auto [name, share] = compare.measuring();
        char text[100];
        std::snprintf(text, sizeof text, "Measuring %s, %.0f %%", name.c_str(), 100 * share);
        input.empty_text = metric >= 0 && !name.empty() ? text : "No common frames yet";

        const PlotResult result =
            draw_plot(row.id, rect, input, state.plot_range, context.theme, context.scale());
        if (result.moved_to) {
            state.playback.playing = false;
            context.move_playhead(static_cast<int>(*result.moved_to));
        }
        if (result.hovered)
            state.next_hover_frame = result.hovered;
        const auto name_of = [&](int curve) {
            return muscles[static_cast<std::size_t>(curve) / per_muscle].name;
        };
        if (result.toggled >= 0 && state.hidden_curves.erase(name_of(result.toggled)) == 0)
            state.hidden_curves.insert(name_of(result.toggled));
        if (result.isolated >= 0) {
            state.hidden_curves.clear();
            for (const MatchedMuscle& muscle : muscles)
                if (muscle.name != name_of(result.isolated))
                    state.hidden_curves.insert(muscle.name);
        }
    }

    std::array<Curves, difference_rows.size()> curves_;
};

} // namespace

std::unique_ptr<Panel> make_differences() {
    return std::make_unique<Differences>();
}

} // namespace fascicle::editor
