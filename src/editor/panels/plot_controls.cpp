#include "editor/panels/plot_controls.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "editor/features.hpp"
#include "editor/plot_table.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/tool_button.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"

namespace fascicle::editor {

namespace {

/// A line of a menu, named for tests.
bool line(const std::string& label, bool checked = false, bool enabled = true, const std::string& tip = {}) {
    const bool clicked = ImGui::MenuItem(label.c_str(), nullptr, checked, enabled);
    record_item("plots/menu/" + label);
    item_tooltip(tip);
    return clicked;
}

bool box(const char* name, const char* label, bool& on, const std::string& tip, bool enabled = true) {
    ImGui::BeginDisabled(!enabled);
    const bool changed = ImGui::Checkbox(label, &on);
    ImGui::EndDisabled();
    record_item(name);
    item_tooltip(tip);
    return changed;
}

void draw_choice(EditorContext& context) {
    PlotsState& plots = context.state.plots;
    const std::vector<const PlotRow*> there = context.features.plots.rows(context);
    ImGui::TextDisabled("Shown plots");
    for (const PlotRow& row : plot_rows()) {
        const bool possible = std::find(there.begin(), there.end(), &row) != there.end();
        bool on = possible && plots.hidden.count(row.id) == 0;
        const std::string tip =
            possible ? std::string(row.stages ? "Time of solving a frame, by stage." : metric_of(row).meaning)
                     : "Not now: the scene has neither fibres nor line muscles.";
        if (box((std::string("plots/show/") + row.id).c_str(), row.title, on, tip, possible)) {
            if (on)
                plots.hidden.erase(row.id);
            else
                plots.hidden.insert(row.id);
            plots.maximised.clear();
        }
    }
    ImGui::Separator();
    ImGui::TextDisabled("In the plots");
    box("plots/single_fibres", "Single fibres", plots.single_fibres,
        "A thin line for every fibre, in the plots of fibres.");
    box("plots/ghosts", "Earlier runs", plots.ghosts, "Curves of the last five runs, thin and pale.");
    box("plots/extremes", "99th percentile", plots.extremes,
        "Of the edge extension, dashed: one edge in a hundred is stretched more.");
    ImGui::Separator();
    if (line("Show all of every axis", false, true, "As a double-click in each plot.")) {
        plots.y.clear();
        plots.angles.reset();
        context.state.plot_range = {0, double(std::max(1, context.last_frame()))};
    }
}

void draw_kept(EditorContext& context) {
    const auto& earlier = context.metrics.earlier();
    ImGui::TextDisabled("Curves of earlier runs");
    if (earlier.empty())
        ImGui::TextUnformatted("None yet: the curves of a run stay when the next one starts.");
    std::uint64_t removed = 0;
    for (std::size_t i = 0; i < earlier.size(); ++i) {
        const MetricValues& run = earlier[i];
        const std::string name = "plots/kept/" + std::to_string(i);
        ImGui::PushID(static_cast<int>(run.id));
        const float side = ImGui::GetFrameHeight() / context.scale();
        if (icon_button(context, (name + "/lock").c_str(), run.pinned ? icons::lock : icons::unlock,
                        run.pinned, true,
                        run.pinned ? "Kept until it is unlocked.\nClick lets it go after five more runs."
                                   : "Goes after five more runs.\nClick keeps it.",
                        side))
            context.metrics.set_pinned(run.id, !run.pinned);
        ImGui::SameLine(0, context.px(6));
        ImGui::AlignTextToFramePadding();
        ImGui::Text("%s", run.name.c_str());
        ImGui::SameLine(context.px(110));
        ImGui::TextDisabled("%d frames", run.frame_count());
        ImGui::SameLine(context.px(200));
        if (ImGui::Button("Restore parameters"))
            restore_parameters(context, run);
        record_item(name + "/restore");
        item_tooltip("Sets the parameters that made this curve, as one undo step.\n\n" +
                     kept_run_text(context, run));
        ImGui::SameLine(0, context.px(4));
        if (icon_button(context, (name + "/remove").c_str(), icons::close, false, true, "Removes the curve.",
                        side))
            removed = run.id;
        const std::string differs =
            differing_parameters(run.scene->parameters, context.document.scene().parameters, 2);
        ImGui::Indent(context.px(34));
        ImGui::TextDisabled("%s", differs.empty() ? "the same parameters as now" : differs.c_str());
        ImGui::Unindent(context.px(34));
        ImGui::PopID();
    }
    if (removed != 0)
        context.metrics.remove(removed);
}

void draw_over_view(EditorContext& context) {
    PlotsState& plots = context.state.plots;
    ImGui::TextDisabled("Plots over the view");
    box("plots/over_view/on", "Show", plots.over_view,
        "One or two plots in the lower right corner of the view.");
    for (std::size_t i = 0; i < plots.chosen.size(); ++i) {
        const PlotRow* chosen = find_plot_row(plots.chosen[i]);
        const std::string name = "plots/over_view/" + std::to_string(i);
        ImGui::SetNextItemWidth(context.px(210));
        const bool open =
            ImGui::BeginCombo(("##" + name).c_str(), chosen == nullptr ? "none" : chosen->title);
        const Rect frame{ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
        if (open) {
            if (ImGui::Selectable("none", chosen == nullptr))
                plots.chosen[i].clear();
            record_item(name + "/none");
            for (const PlotRow* row : context.features.plots.rows(context)) {
                if (ImGui::Selectable(row->title, row == chosen)) {
                    plots.chosen[i] = row->id;
                    plots.over_view = true;
                }
                record_item(name + "/" + row->id);
            }
            ImGui::EndCombo();
        }
        record_item(name, frame);
        item_tooltip(i == 0 ? "The first plot over the view" : "The second, above it");
    }
}

/// A button of the strip and the popup that it opens.
void popup_button(EditorContext& context, const char* name, const Icon& icon, const char* tip, bool on,
                  void (*draw)(EditorContext&)) {
    if (icon_button(context, name, icon, on, true, tip, 24))
        ImGui::OpenPopup(name);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(10), context.px(8)});
    if (ImGui::BeginPopup(name)) {
        draw(context);
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
    ImGui::SameLine(0, context.px(2));
}

} // namespace

std::vector<std::string> shown_plots(const EditorContext& context) {
    std::vector<std::string> ids;
    for (const PlotRow* row : context.features.plots.rows(context))
        if (context.state.plots.hidden.count(row->id) == 0)
            ids.emplace_back(row->id);
    return ids;
}

std::string kept_run_text(const EditorContext& context, const MetricValues& run) {
    const std::string differs =
        differing_parameters(run.scene->parameters, context.document.scene().parameters);
    return run.name + (run.pinned ? " (kept)" : "") + "\n" +
           (differs.empty() ? "Made with the parameters of now." : differs);
}

void restore_parameters(EditorContext& context, const MetricValues& run) {
    const std::string name = run.name;
    if (!actions::use_parameters(context.document, run.scene->parameters, "Restore parameters of " + name))
        context.log.add(Severity::note, name + " was made with the parameters of now.");
}

void draw_plot_strip(EditorContext& context, const Rect& strip) {
    const float width = icons_available() ? context.px(4 * 26 + 10) : context.px(240);
    if (strip.width() < width)
        return;
    ImGui::SetCursorScreenPos({strip.max.x - width, strip.min.y + context.px(2)});
    popup_button(context, "plots/choose", icons::line_chart, "Which plots are shown", false, draw_choice);
    const std::size_t kept = context.metrics.earlier().size();
    popup_button(
        context, "plots/kept", icons::history,
        ("Curves of earlier runs (" + std::to_string(kept) + "): keep, restore their parameters, remove")
            .c_str(),
        false, draw_kept);
    popup_button(context, "plots/over_view", icons::over, "Plots over the view",
                 context.state.plots.over_view, draw_over_view);
    if (icon_button(context, "plots/export", icons::download, false, true, "Export plots as CSV, SVG or PNG",
                    24))
        context.dialogs.plot_export.open(context, shown_plots(context), PlotFile::csv, false);
}

void draw_plot_menu(EditorContext& context, const PlotRow& row, std::uint64_t run) {
    PlotsState& plots = context.state.plots;
    PlotExportDialog& dialog = context.dialogs.plot_export;
    if (const MetricValues* kept = run == 0 ? nullptr : context.metrics.find(run)) {
        ImGui::TextDisabled("%s", kept->name.c_str());
        if (line("Restore its parameters", false, true,
                 "As one undo step.\n\n" + kept_run_text(context, *kept)))
            restore_parameters(context, *kept);
        if (line("Keep this curve", kept->pinned, true, "However many runs come."))
            context.metrics.set_pinned(run, !kept->pinned);
        ImGui::Separator();
    }
    if (line("CSV of this plot...", false, true, "The numbers of its curves, a row a frame."))
        dialog.open(context, {row.id}, PlotFile::csv, false);
    if (line("CSV of all plots...", false, true, "All shown plots in one table."))
        dialog.open(context, shown_plots(context), PlotFile::csv, false);
    if (line("CSV of the visible range...", false, true, "Only the frames that are in view."))
        dialog.open(context, {row.id}, PlotFile::csv, true);
    if (line("Image...", false, true, "As SVG or PNG."))
        dialog.open(context, {row.id}, PlotFile::svg, false);
    if (line("Copy", false, true, "The numbers of this plot to the clipboard, as CSV."))
        ImGui::SetClipboardText(to_csv(plot_table(context, context.features.plots, {&row}, false)).c_str());
    ImGui::Separator();
    if (line("Overlay a CSV...", false, true,
             "Draws measured values dashed over this plot. First column: frame, time_s or angle_deg."))
        context.dialogs.plot_overlay.open(row.id);
    bool any = false;
    for (const PlotOverlay& overlay : context.features.plots.overlays())
        any |= overlay.plot == row.id;
    if (line("Remove overlays", false, any, any ? "" : "Not now: nothing is overlaid."))
        context.features.plots.remove_overlays(row.id);
    ImGui::Separator();
    if (line("Show all", false, true, "Fits both axes. As a double-click.")) {
        plots.y.erase(row.id);
        plots.angles.reset();
        context.state.plot_range = {0, double(std::max(1, context.last_frame()))};
    }
    const bool alone = plots.maximised == row.id;
    if (line(alone ? "Show all plots" : "Show this plot alone"))
        plots.maximised = alone ? "" : row.id;
    const bool over = plots.over_view && (plots.chosen[0] == row.id || plots.chosen[1] == row.id);
    if (line("Over the view", over, true, "Lies over the lower right corner of the view.")) {
        for (std::string& chosen : plots.chosen)
            if (chosen == row.id)
                chosen.clear();
        if (!over) {
            plots.chosen[plots.chosen[0].empty() ? 0 : 1] = row.id;
            plots.over_view = true;
        } else {
            plots.over_view = !plots.chosen[0].empty() || !plots.chosen[1].empty();
        }
    }
}

} // namespace fascicle::editor
