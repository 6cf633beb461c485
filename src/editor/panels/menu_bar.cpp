#include "editor/panels/panels.hpp"

#include "editor/teach/lesson_menu.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "editor/widgets/paint.hpp"
#include "editor/widgets/tool_button.hpp"

#include <initializer_list>

namespace fascicle::editor {

namespace {

using C = Command;

class MenuBar : public Panel {
public:
    void draw(EditorContext& context, const Rect& area) override {
        if (!ImGui::BeginMenuBar())
            return;
        file_menu(context);
        menu(context, "Edit", {C::undo, C::redo},
             {C::paint_mode, C::repair_mesh, C::remove_selected, C::deselect});
        menu(context, "Scene",
             {C::open_file, C::load_attachments, C::load_surface_fibres, C::load_fibre_template,
              C::load_lines},
             {C::show_motion});
        view_menu(context);
        menu(context, "Run", {C::run_again, C::cancel_run},
             {C::play_pause, C::step_back, C::step_on, C::first_frame, C::last_frame, C::toggle_loop,
              C::toggle_ping_pong, C::toggle_every_frame, C::add_marker, C::previous_marker, C::next_marker});
        menu(context, "Compare",
             {C::toggle_compare, C::compare_side_by_side, C::compare_ghost, C::compare_blink,
              C::compare_difference},
             {C::blink_runs, C::swap_runs, C::load_run});
        draw_lesson_menu(context);
        window_menu(context);
        draw_title(context, area);
        ImGui::EndMenuBar();
    }

private:
    static void items(EditorContext& context, std::initializer_list<Command> commands) {
        for (const Command command : commands)
            menu_item(context, command);
    }

    static bool begin(const char* title) {
        const bool open = ImGui::BeginMenu(title);
        record_item(std::string("menu/") + title);
        return open;
    }

    static void menu(EditorContext& context, const char* title, std::initializer_list<Command> first,
                     std::initializer_list<Command> second) {
        if (!begin(title))
            return;
        items(context, first);
        ImGui::Separator();
        items(context, second);
        ImGui::EndMenu();
    }

    static void file_menu(EditorContext& context) {
        if (!begin("File"))
            return;
        items(context, {C::new_project, C::open_project, C::open_model, C::show_start_page});
        ImGui::Separator();
        items(context, {C::save_project, C::save_project_as});
        ImGui::Separator();
        items(context, {C::open_file, C::save_picture, C::save_picture_as, C::export_run, C::export_plots});
        ImGui::Separator();
        items(context, {C::quit});
        ImGui::EndMenu();
    }

    static void view_menu(EditorContext& context) {
        if (!begin("View"))
            return;
        items(context, {C::frame_selection, C::frame_all, C::fly_to_worst});
        ImGui::Separator();
        items(context, {C::view_anterior, C::view_posterior, C::view_left, C::view_right, C::view_superior,
                        C::view_inferior, C::toggle_orthographic});
        ImGui::Separator();
        if (ImGui::BeginMenu("Kept cameras")) {
            items(context, {C::store_camera_1, C::store_camera_2, C::store_camera_3, C::store_camera_4});
            ImGui::Separator();
            items(context, {C::recall_camera_1, C::recall_camera_2, C::recall_camera_3, C::recall_camera_4});
            ImGui::EndMenu();
        }
        ImGui::Separator();
        items(context, {C::hide_selected, C::hide_others, C::show_all});
        ImGui::Separator();
        items(context,
              {C::toggle_attachments, C::toggle_wireframe, C::toggle_rest_ghost, C::toggle_joint_axis,
               C::toggle_fibres, C::toggle_line_muscles, C::toggle_plots_over_view, C::next_colouring});
        ImGui::Separator();
        items(context, {C::toggle_see_through, C::toggle_occlusion, C::toggle_section, C::flip_section,
                        C::show_display});
        ImGui::EndMenu();
    }

    static void window_menu(EditorContext& context) {
        if (!begin("Window"))
            return;
        LayoutSizes& sizes = context.state.layout;
        ImGui::MenuItem("Scene and selection", nullptr, &sizes.show_left);
        ImGui::MenuItem("Parameters", nullptr, &sizes.show_right);
        ImGui::MenuItem("Plots and messages", nullptr, &sizes.show_bottom);
        ImGui::Separator();
        items(context, {C::toggle_theme, C::larger_interface, C::smaller_interface, C::normal_interface,
                        C::toggle_full_screen, C::present});
        ImGui::Separator();
        for (const NavigationRow& row : navigations) {
            if (ImGui::MenuItem(row.label, nullptr, context.state.navigation == row.navigation))
                context.state.navigation = row.navigation;
            record_item(std::string("menu/mouse/") + row.key);
            item_tooltip(row.help);
        }
        ImGui::Separator();
        items(context, {C::search_commands, C::show_shortcuts});
        ImGui::EndMenu();
    }

    /// The project's file (or the scene's name) at the right end, with a mark while the two differ.
    static void draw_title(const EditorContext& context, const Rect& area) {
        const std::filesystem::path& path = context.document.path();
        const std::string name = (path.empty() ? context.document.scene().name : path.filename().string()) +
                                 (context.document.dirty() ? " *" : "");
        const float right = area.max.x - context.px(12),
                    room = right - ImGui::GetCursorScreenPos().x - context.px(12);
        const std::string shown = elided(name, room);
        if (shown.empty())
            return;
        ImGui::SetCursorScreenPos({right - text_size(shown).x, ImGui::GetCursorScreenPos().y});
        ImGui::PushStyleColor(ImGuiCol_Text, context.theme.text_dim);
        ImGui::TextUnformatted(shown.c_str());
        ImGui::PopStyleColor();
        record_item("menu/title");
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s%s", path.empty() ? "In no file yet" : path.string().c_str(),
                              context.document.dirty() ? "\nWith changes that are not saved" : "");
    }
};

} // namespace

std::unique_ptr<Panel> make_menu_bar() {
    return std::make_unique<MenuBar>();
}

} // namespace fascicle::editor
