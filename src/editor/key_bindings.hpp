#pragma once
// Every command of the editor and its keys in one table, whose rows are in commands/. Menus, tooltips and the shortcut sheet
// are made from it.

#include "editor/keys.hpp"
#include "editor/navigation.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle::editor {

enum class Command {
    new_project,
    open_project,
    open_model,
    save_project,
    save_project_as,
    show_start_page,
    open_file,
    load_lines,
    load_attachments,
    load_surface_fibres,
    load_fibre_template,
    show_motion,
    save_picture,
    save_picture_as,
    export_run,
    cancel_export,
    quit,
    undo,
    redo,
    remove_selected,
    deselect,
    play_pause,
    step_back,
    step_on,
    step_back_10,
    step_on_10,
    first_frame,
    last_frame,
    toggle_loop,
    toggle_ping_pong,
    toggle_every_frame,
    loop_from_here,
    loop_to_here,
    loop_everything,
    add_marker,
    previous_marker,
    next_marker,
    run_again,
    cancel_run,
    frame_selection,
    frame_all,
    fly_to_worst,
    view_anterior,
    view_posterior,
    view_left,
    view_right,
    view_superior,
    view_inferior,
    orbit_left,
    orbit_right,
    orbit_up,
    orbit_down,
    toggle_orthographic,
    store_camera_1,
    store_camera_2,
    store_camera_3,
    store_camera_4,
    recall_camera_1,
    recall_camera_2,
    recall_camera_3,
    recall_camera_4,
    hide_selected,
    hide_others,
    show_all,
    toggle_wireframe,
    toggle_attachments,
    toggle_rest_ghost,
    toggle_joint_axis,
    next_colouring,
    toggle_see_through,
    toggle_fibres,
    toggle_line_muscles,
    toggle_occlusion,
    toggle_section,
    flip_section,
    show_display,
    toggle_plots_over_view,
    export_plots,
    toggle_full_screen,
    toggle_theme,
    larger_interface,
    smaller_interface,
    normal_interface,
    search_commands,
    present,
    show_shortcuts,
    lesson_next,
    lesson_back,
    leave_lesson,
    paint_mode,
    paint_brush,
    paint_eraser,
    paint_smooth,
    paint_smart_fill,
    paint_bucket,
    paint_lasso,
    paint_line,
    paint_origin,
    paint_insertion,
    paint_toggle_eraser,
    paint_smaller_radius,
    paint_larger_radius,
    paint_shrink,
    paint_grow,
    paint_mirror,
    paint_finish_line,
    paint_line_back,
    paint_keep_largest,
    paint_fill_holes,
    paint_invert,
    paint_clear,
    paint_camera,
    toggle_compare,
    blink_runs,
    swap_runs,
    compare_side_by_side,
    compare_ghost,
    compare_blink,
    compare_difference,
    load_run,
    repair_mesh,
    escape,
};

struct EditorContext;
struct CommandState; // commands.hpp

/// Where a row's keys act: everywhere, only while painting (before other rows of the same chord), or only while not.
enum class KeysIn { anywhere, painting, looking };

struct KeyBinding {
    Command command;
    const char* group; ///< heading in the shortcut sheet
    const char* label; ///< in menus
    const char* help;  ///< one sentence for tooltips
    std::array<KeyChord, 2> chords{};
    bool repeats = false;                                  ///< acts again while the key is held
    CommandState (*state)(const EditorContext&) = nullptr; ///< null: always enabled
    void (*run)(EditorContext&) = nullptr;
    KeysIn where = KeysIn::anywhere;
};

const std::vector<KeyBinding>& key_bindings();
const KeyBinding& binding(Command command);
/// The row that a chord belongs to, or null.
const KeyBinding* find_binding(const KeyChord& chord, bool painting = false);

/// What a chord does under a mouse preset before the table is asked: the framing keys of the program that it follows.
/// Nothing: the table decides.
std::optional<Command> preset_binding(const KeyChord& chord, Navigation navigation);

/// Name of a row in the user's key file: its label in lower case with dashes, "one-frame-back".
std::string command_id(const KeyBinding& row);
/// Gives the row of that id other keys. Empty when done; otherwise why not: no such row, or a chord that another row has.
std::string set_user_keys(const std::string& id, const std::vector<KeyChord>& chords);
/// Every row has its own keys again.
void reset_user_keys();

/// "Ctrl+Shift+Z" as a chord, as to_text() writes it; nothing when it is none.
std::optional<KeyChord> parse_chord(std::string_view text);
/// "Ctrl+Shift+Z"; empty for no key.
std::string to_text(const KeyChord& chord);
/// First key of the command as text, for menus; empty when it has none.
std::string shortcut(Command command);
/// "Undo (Ctrl+Z)" and the help sentence on a second line.
std::string tooltip(Command command);

} // namespace fascicle::editor
