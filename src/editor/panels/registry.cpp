#include "editor/panels/panels.hpp"

namespace fascicle::editor {

const std::vector<PanelRow>& panel_registry() {
    static const std::vector<PanelRow> rows{
        {"menu", nullptr, Place::menu, false, false, make_menu_bar},
        {"toolbar", nullptr, Place::toolbar, true, false, make_toolbar},
        {"scene", "Scene", Place::tree, true, true, make_scene_tree},
        {"selection", "Selection", Place::inspector, true, true, make_inspector},
        {"viewport", nullptr, Place::viewport, false, false, make_viewport},
        {"parameters", "Parameters", Place::parameters, true, true, make_parameters, icons::sliders},
        {"fibres", "Fibres", Place::parameters, true, true, make_fibres, icons::fibres},
        {"paint", "Paint", Place::parameters, true, true, make_paint_panel, icons::brush},
        {"compare", "Compare", Place::parameters, true, true, make_compare, icons::exchange},
        {"display", "Display", Place::parameters, true, true, make_display, icons::eye},
        {"motion", "Motion", Place::parameters, true, true, make_motion, icons::play},
        {"lesson", "Lesson", Place::lesson, true, true, make_lesson},
        {"timeline", nullptr, Place::timeline, true, false, make_timeline},
        {"plots", "Plots", Place::bottom, false, true, make_plots},
        {"differences", "Differences", Place::bottom, false, true, make_differences},
        {"messages", "Messages", Place::bottom, true, true, make_messages},
        {"history", "History", Place::bottom, true, true, make_history},
        {"status", nullptr, Place::status, true, false, make_status_bar},
    };
    return rows;
}

} // namespace fascicle::editor
