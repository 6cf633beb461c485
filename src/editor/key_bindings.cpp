#include "editor/key_bindings.hpp"

#include "editor/commands/command_groups.hpp"
#include "fascicle/base/assert.hpp"

#include <algorithm>

namespace fascicle::editor {

namespace {

constexpr Modifiers shift{.shift = true};

std::vector<KeyBinding> make_bindings() {
    std::vector<KeyBinding> rows;
    for (const auto& group :
         {project_commands, file_commands, edit_commands, timeline_commands, view_commands, show_commands, window_commands}) {
        const std::vector<KeyBinding> more = group();
        rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
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

const KeyBinding* find_binding(const KeyChord& chord, bool painting) {
    const KeyBinding* found = nullptr;
    for (const KeyBinding& row : key_bindings()) {
        if (row.where == (painting ? KeysIn::looking : KeysIn::painting))
            continue;
        for (const KeyChord& own : row.chords)
            if (own.key != key_none && own == chord && (found == nullptr || row.where == KeysIn::painting))
                found = &row;
    }
    return found;
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
