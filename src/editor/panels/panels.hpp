#pragma once
// Makers of all panels; each panel is one source file here.

#include "editor/panel.hpp"

namespace fascicle::editor {

std::unique_ptr<Panel> make_menu_bar();
std::unique_ptr<Panel> make_toolbar();
std::unique_ptr<Panel> make_scene_tree();
std::unique_ptr<Panel> make_inspector();
std::unique_ptr<Panel> make_viewport();
std::unique_ptr<Panel> make_parameters();
std::unique_ptr<Panel> make_fibres();
std::unique_ptr<Panel> make_lesson();
std::unique_ptr<Panel> make_paint_panel();
std::unique_ptr<Panel> make_display();
std::unique_ptr<Panel> make_motion();
std::unique_ptr<Panel> make_timeline();
std::unique_ptr<Panel> make_plots();
std::unique_ptr<Panel> make_messages();
std::unique_ptr<Panel> make_history();
std::unique_ptr<Panel> make_status_bar();
std::unique_ptr<Panel> make_compare();
std::unique_ptr<Panel> make_differences();

} // namespace fascicle::editor
