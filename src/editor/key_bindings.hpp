#pragma once
// Every command of the editor and its keys in one table, whose rows are in commands/. Menus, tooltips and the shortcut sheet
// are made from it.

#include "editor/keys.hpp"

#include <array>
#include <string>
#include <vector>

namespace fascicle::editor {

enum class Command {
    new_project,
    open_project,
    save_project,
    save_project_as,
    show_start_page,
    open_file,
    save_picture,
    save_picture_as,
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
    toggle_full_screen,
    toggle_theme,
    larger_interface,
    smaller_interface,
    normal_interface,
    show_shortcuts,
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

/// "Ctrl+Shift+Z"; empty for no key.
std::string to_text(const KeyChord& chord);
/// First key of the command as text, for menus; empty when it has none.
std::string shortcut(Command command);
/// "Undo (Ctrl+Z)" and the help sentence on a second line.
std::string tooltip(Command command);

} // namespace fascicle::editor
