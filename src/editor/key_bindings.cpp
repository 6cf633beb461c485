#include "editor/key_bindings.hpp"

#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace {

constexpr Modifiers ctrl{.ctrl = true};
constexpr Modifiers shift{.shift = true};
constexpr Modifiers alt{.alt = true};
constexpr Modifiers ctrl_shift{.ctrl = true, .shift = true};

constexpr KeyChord pad(int digit, Modifiers modifiers = {}) {
    return {key_pad_0 + digit, modifiers};
}

std::vector<KeyBinding> make_bindings() {
    using C = Command;
    const char* const file = "File";
    const char* const edit = "Edit";
    const char* const time = "Timeline";
    const char* const view = "View";
    const char* const show = "Show";
    const char* const window = "Window";
    return {
        {C::open_file, file, "Open mesh...", "Loads a bone or a muscle from a mesh file.", {{{key_o, ctrl}}}},
        {C::save_picture,
         file,
         "Save picture",
         "Writes the view as a PNG into the current folder.",
         {{{key_f12}}}},
        {C::save_picture_as,
         file,
         "Save picture as...",
         "Writes the view as a PNG under a name you choose.",
         {{{key_f12, shift}}}},
        {C::quit, file, "Quit", "Closes the program.", {{{key_q, ctrl}}}},
        {C::undo,
         edit,
         "Undo",
         "Takes back the last change of the scene; the camera stays.",
         {{{key_z, ctrl}}},
         true},
        {C::redo,
         edit,
         "Redo",
         "Does again what was taken back.",
         {{{key_z, ctrl_shift}, {key_y, ctrl}}},
         true},
        {C::remove_selected,
         edit,
         "Remove",
         "Removes the selected bone or muscle from the scene.",
         {{{key_delete}}}},
        {C::deselect, edit, "Deselect", "Selects nothing.", {}},
        {C::play_pause,
         time,
         "Play / pause",
         "Plays the computed frames and waits for those to come.",
         {{{key_space}}}},
        {C::step_back, time, "One frame back", "Moves the playhead.", {{{key_left}}}, true},
        {C::step_on, time, "One frame on", "Moves the playhead.", {{{key_right}}}, true},
        {C::step_back_10, time, "Ten frames back", "Moves the playhead.", {{{key_left, shift}}}, true},
        {C::step_on_10, time, "Ten frames on", "Moves the playhead.", {{{key_right, shift}}}, true},
        {C::first_frame, time, "First frame", "Moves the playhead to rest.", {{{key_home}}}},
        {C::last_frame, time, "Last frame", "Moves the playhead to the last computed frame.", {{{key_end}}}},
        {C::toggle_loop, time, "Loop", "Starts again at the end.", {}},
        {C::run_again, time, "Compute again", "Starts the simulation from rest.", {{{key_f5}}}},
        {C::cancel_run, time, "Stop computing", "Ends the run; the frames so far stay.", {{{key_f5, shift}}}},
        {C::frame_selection, view, "Frame selection", "Fills the view with what is selected.", {{{key_f}}}},
        {C::frame_all, view, "Frame everything", "Fills the view with the whole scene.", {{{key_f, shift}}}},
        {C::fly_to_worst,
         view,
         "Fly to worst vertex",
         "Shows the deepest vertex inside a bone in this frame, or the free one nearest to a bone.",
         {{{key_x}}}},
        {C::view_anterior, view, "Anterior", "Looks at the front.", {{pad(1)}}},
        {C::view_posterior, view, "Posterior", "Looks at the back.", {{pad(1, shift)}}},
        {C::view_left, view, "Left", "Looks at the left side.", {{pad(3)}}},
        {C::view_right, view, "Right", "Looks at the right side.", {{pad(3, shift)}}},
        {C::view_superior, view, "Superior", "Looks from above.", {{pad(7)}}},
        {C::view_inferior, view, "Inferior", "Looks from below.", {{pad(7, shift)}}},
        {C::orbit_left, view, "Turn left", "Orbits by 15 degrees.", {{pad(4)}}, true},
        {C::orbit_right, view, "Turn right", "Orbits by 15 degrees.", {{pad(6)}}, true},
        {C::orbit_up, view, "Turn up", "Orbits by 15 degrees.", {{pad(8)}}, true},
        {C::orbit_down, view, "Turn down", "Orbits by 15 degrees.", {{pad(2)}}, true},
        {C::toggle_orthographic,
         view,
         "Orthographic",
         "Switches perspective off: parallels stay parallel.",
         {{{key_p}, pad(5)}}},
        {C::store_camera_1, view, "Store camera 1", "Keeps the present view.", {{{key_1, ctrl}}}},
        {C::store_camera_2, view, "Store camera 2", "Keeps the present view.", {{{key_1 + 1, ctrl}}}},
        {C::store_camera_3, view, "Store camera 3", "Keeps the present view.", {{{key_1 + 2, ctrl}}}},
        {C::store_camera_4, view, "Store camera 4", "Keeps the present view.", {{{key_1 + 3, ctrl}}}},
        {C::recall_camera_1, view, "Camera 1", "Goes back to the kept view.", {{{key_1}}}},
        {C::recall_camera_2, view, "Camera 2", "Goes back to the kept view.", {{{key_1 + 1}}}},
        {C::recall_camera_3, view, "Camera 3", "Goes back to the kept view.", {{{key_1 + 2}}}},
        {C::recall_camera_4, view, "Camera 4", "Goes back to the kept view.", {{{key_1 + 3}}}},
        {C::hide_selected, show, "Hide", "Hides what is selected.", {{{key_h}}}},
        {C::hide_others, show, "Hide the rest", "Hides everything but what is selected.", {{{key_h, shift}}}},
        {C::show_all, show, "Show all", "Makes everything visible again.", {{{key_h, alt}}}},
        {C::toggle_wireframe,
         show,
         "Wireframe",
         "Draws the triangles' edges over the surfaces.",
         {{{key_w}}}},
        {C::toggle_attachments,
         show,
         "Attachment areas",
         "Colours origins red and insertions blue.",
         {{{key_a}}}},
        {C::toggle_rest_ghost,
         show,
         "Rest shape",
         "Shows the muscles at rest as a faint ghost.",
         {{{key_r}}}},
        {C::toggle_joint_axis,
         show,
         "Joint axis",
         "Draws the axis that the moving bones turn about.",
         {{{key_j}}}},
        {C::next_colouring,
         show,
         "Next colouring",
         "Goes through the quantities that muscles are coloured by.",
         {{{key_c}}}},
        {C::toggle_full_screen,
         window,
         "Full screen",
         "Fills the screen, or goes back to a window.",
         {{{key_f11}}}},
        {C::toggle_theme, window, "Light theme", "Switches between dark and light.", {}},
        {C::larger_interface,
         window,
         "Larger interface",
         "Text and controls 25 % larger, up to 300 %.",
         {{{key_equal, ctrl}, {key_equal, ctrl_shift}}},
         true},
        {C::smaller_interface,
         window,
         "Smaller interface",
         "Text and controls 25 % smaller, down to 75 %.",
         {{{key_minus, ctrl}}},
         true},
        {C::normal_interface,
         window,
         "Normal interface size",
         "Back to the size the program started with.",
         {{{key_0, ctrl}}}},
        {C::show_shortcuts,
         window,
         "Keyboard shortcuts",
         "Shows or hides the list of keys.",
         {{{key_f1}, {key_slash, shift}}}},
        {C::escape,
         window,
         "Cancel",
         "Stops the run; without one, closes what is open; else selects nothing.",
         {{{key_escape}}}},
    };
}

std::string key_name(int key) {
    if (key >= key_pad_0 && key < key_pad_0 + 10)
        return std::string("Num ").append(std::to_string(key - key_pad_0));
    if (key >= key_f1 && key <= key_f12)
        return std::string("F").append(std::to_string(key - key_f1 + 1));
    switch (key) {
    case key_space:
        return "Space";
    case key_escape:
        return "Esc";
    case key_delete:
        return "Del";
    case key_left:
        return "Left";
    case key_right:
        return "Right";
    case key_home:
        return "Home";
    case key_end:
        return "End";
    case key_equal:
        return "+";
    default:
        return std::string(1, static_cast<char>(key));
    }
}

} // namespace

const std::vector<KeyBinding>& key_bindings() {
    static const std::vector<KeyBinding> rows = make_bindings();
    return rows;
}

const KeyBinding& binding(Command command) {
    const auto& rows = key_bindings();
    const auto it =
        std::find_if(rows.begin(), rows.end(), [&](const KeyBinding& row) { return row.command == command; });
    FASCICLE_ASSERT(it != rows.end());
    return *it;
}

const KeyBinding* find_binding(const KeyChord& chord) {
    for (const KeyBinding& row : key_bindings())
        for (const KeyChord& own : row.chords)
            if (own.key != key_none && own == chord)
                return &row;
    return nullptr;
}

std::string to_text(const KeyChord& chord) {
    if (chord.key == key_none)
        return {};
    if (chord == KeyChord{key_slash, shift})
        return "?";
    std::string text = chord.modifiers.ctrl ? "Ctrl+" : "";
    if (chord.modifiers.shift)
        text += "Shift+";
    if (chord.modifiers.alt)
        text += "Alt+";
    text += key_name(chord.key);
    return text;
}

std::string shortcut(Command command) {
    return to_text(binding(command).chords[0]);
}

std::string tooltip(Command command) {
    const KeyBinding& row = binding(command);
    const std::string keys = shortcut(command);
    std::string text = row.label;
    if (!keys.empty())
        text.append(" (").append(keys).append(")");
    return text.append("\n").append(row.help);
}

} // namespace fascicle::editor
