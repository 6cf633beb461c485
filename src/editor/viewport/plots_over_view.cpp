#include "editor/viewport/plots_over_view.hpp"

#include "editor/features.hpp"
#include "editor/plot_input.hpp"
#include "editor/widgets/item_recorder.hpp"

namespace fascicle::editor {

void draw_plots_over_view(EditorContext& context, ImDrawList& list, const Rect& area) {
    PlotsState& plots = context.state.plots;
    if (!plots.over_view)
        return;
    const float width = std::min(context.px(260), area.width() * 0.45f);
    const float height = std::min(context.px(136), area.height() * 0.4f);
    if (width < context.px(150) || height < context.px(80))
        return; // the view itself comes first
    PlotData& data = context.features.plots;
    const std::vector<const PlotRow*> rows = data.rows(context);
    float bottom = area.max.y - context.px(12);
    for (const std::string& id : plots.chosen) {
        const PlotRow* row = find_plot_row(id);
        if (row == nullptr || std::find(rows.begin(), rows.end(), row) == rows.end() ||
            bottom - height < area.min.y + context.px(40))
            continue;
        const Rect rect{{area.max.x - context.px(12) - width, bottom - height},
                        {area.max.x - context.px(12), bottom}};
        list.AddRectFilled(rect.min, rect.max, context.theme.badge, context.px(6));
        PlotInput input = plot_input(context, data, *row);
        input.compact = true;
        const auto y = plots.y.find(row->id);
        PlotGesture none;
        draw_plot(("viewport/" + id).c_str(), rect, input, plot_x(context, input),
                  y == plots.y.end() ? nullptr : &y->second, none, data.ink(), context.theme,
                  context.scale());
        bottom = rect.min.y - context.px(8);
    }
}

} // namespace fascicle::editor
