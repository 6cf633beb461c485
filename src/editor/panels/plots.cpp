#include "editor/panels/panels.hpp"

#include "editor/features.hpp"
#include "editor/panels/plot_controls.hpp"
#include "editor/widgets/tool_button.hpp"

#include <algorithm>
#include <cmath>

namespace fascicle::editor {

namespace {

/// Columns in which `count` plots have the most room for their curves, each about twice as wide as high.
int best_columns(int count, float width, float height, float scale) {
    int best = 1;
    float score = -1e9f;
    for (int columns = 1; columns <= count; ++columns) {
        const int lines = (count + columns - 1) / columns;
        const float w = width / static_cast<float>(columns) / scale,
                    h = std::max(96.0f, height / static_cast<float>(lines) / scale);
        const float header = h < 150 && w > 260 ? 21.0f : 40.0f;
        float room = std::min(w - 66, 2 * (h - header - 24));
        if (static_cast<float>(lines) * h > height / scale + 1)
            room *= 0.5f; // it would have to be scrolled
        if (room > score + 0.5f) {
            score = room;
            best = columns;
        }
    }
    return best;
}

class Plots : public Panel {
public:
    void draw_strip(EditorContext& context, const Rect& strip) override { draw_plot_strip(context, strip); }

    void draw(EditorContext& context, const Rect& area) override {
        follow_timeline(context);
        PlotsState& plots = context.state.plots;
        std::vector<const PlotRow*> rows = context.features.plots.rows(context);
        if (std::none_of(rows.begin(), rows.end(),
                         [&](const PlotRow* row) { return plots.maximised == row->id; }))
            plots.maximised.clear();
        std::erase_if(rows, [&](const PlotRow* row) {
            return plots.maximised.empty() ? plots.hidden.count(row->id) != 0 : plots.maximised != row->id;
        });
        const ImVec2 origin = ImGui::GetCursorScreenPos(); // moves with scrolling
        if (rows.empty()) {
            draw_text_in(*ImGui::GetWindowDrawList(), area, context.theme.text_faint,
                         "All plots are hidden; choose some with the button above", Align::centre);
            return;
        }
        const int count = static_cast<int>(rows.size());
        const int columns = best_columns(count, area.width(), area.height(), context.scale());
        const int lines = (count + columns - 1) / columns;
        const float height = std::max(context.px(96), area.height() / static_cast<float>(lines));
        const float width = area.width() / static_cast<float>(columns);
        for (int i = 0; i < count; ++i) {
            const auto column = static_cast<float>(i % columns), row = static_cast<float>(i / columns);
            const Rect rect{
                {std::round(origin.x + column * width), std::round(origin.y + row * height)},
                {std::round(origin.x + (column + 1) * width), std::round(origin.y + (row + 1) * height)}};
            ImDrawList& list = *ImGui::GetWindowDrawList();
            if (column > 0)
                list.AddLine({rect.min.x, rect.min.y + context.px(8)},
                             {rect.min.x, rect.max.y - context.px(8)}, context.theme.line);
            if (row > 0 && column == 0)
                list.AddLine({rect.min.x + context.px(8), rect.min.y},
                             {origin.x + area.width() - context.px(8), rect.min.y}, context.theme.line);
            draw_one(context, *rows[static_cast<std::size_t>(i)], rect);
        }
        draw_menu(context);
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
            state.plots.angles.reset();
        }
    }

    void draw_one(EditorContext& context, const PlotRow& row, const Rect& rect) {
        EditorState& state = context.state;
        PlotData& data = context.features.plots;
        PlotInput input = plot_input(context, data, row);
        input.maximised = state.plots.maximised == row.id;
        const PlotResult result = draw_shared_plot(context, data, row.id, rect, input);
        if (result.maximise)
            state.plots.maximised = input.maximised ? "" : row.id;
        if (result.toggled >= 0)
            toggle(state, input.curves[static_cast<std::size_t>(result.toggled)].name);
        if (result.isolated >= 0)
            isolate(state, input, input.curves[static_cast<std::size_t>(result.isolated)].name);
        if (result.hovered_bundle >= 0)
            state.next_hover_fibre = {input.bundles[static_cast<std::size_t>(result.hovered_bundle)].name,
                                      result.hovered_line};
        const std::uint64_t run =
            result.hovered_curve < 0 ? 0 : input.curves[static_cast<std::size_t>(result.hovered_curve)].run;
        if (const MetricValues* kept = run == 0 ? nullptr : context.metrics.find(run);
            kept != nullptr && !result.menu)
            ImGui::SetTooltip("%s\nRight click restores these parameters.",
                              kept_run_text(context, *kept).c_str());
        if (result.menu) {
            menu_of_ = &row;
            menu_run_ = run;
            menu_opens_ = true;
        }
    }

    void draw_menu(EditorContext& context) {
        if (std::exchange(menu_opens_, false))
            ImGui::OpenPopup("plot menu");
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(8), context.px(6)});
        if (ImGui::BeginPopup("plot menu")) {
            draw_plot_menu(context, *menu_of_, menu_run_);
            ImGui::EndPopup();
        }
        ImGui::PopStyleVar();
    }

    static void toggle(EditorState& state, const std::string& name) {
        if (state.hidden_curves.erase(name) == 0)
            state.hidden_curves.insert(name);
    }

    /// The curve alone; when it is that already, all.
    static void isolate(EditorState& state, const PlotInput& input, const std::string& name) {
        std::set<std::string> others;
        for (const PlotCurve& curve : input.curves)
            if (curve.in_legend && !curve.ghost && curve.name != name)
                others.insert(curve.name);
        std::set<std::string> before = state.hidden_curves; // the double-click's first click hid or showed it
        before.erase(name);
        state.hidden_curves.erase(name);
        const bool alone =
            !others.empty() && std::includes(before.begin(), before.end(), others.begin(), others.end());
        for (const std::string& other : others) {
            if (alone)
                state.hidden_curves.erase(other);
            else
                state.hidden_curves.insert(other);
        }
    }

    const PlotRow* menu_of_ = nullptr;
    std::uint64_t menu_run_ = 0;
    bool menu_opens_ = false;
};

} // namespace

std::unique_ptr<Panel> make_plots() {
    return std::make_unique<Plots>();
}

} // namespace fascicle::editor
