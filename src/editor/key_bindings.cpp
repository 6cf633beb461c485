#include "editor/key_bindings.hpp"

#include "editor/commands/command_groups.hpp"
#include "fascicle/base/assert.hpp"

#include <algorithm>
#include <cctype>

namespace fascicle::editor {

namespace {

constexpr Modifiers shift{.shift = true};

std::vector<KeyBinding> make_bindings() {
    std::vector<KeyBinding> rows;
    for (const auto& group :
         {file_commands, edit_commands, timeline_commands, view_commands, show_commands, paint_commands,
          window_commands, compare_commands, export_commands, display_commands, load_commands,
          lesson_commands, plot_commands, project_commands}) {
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
    case key_pad_enter:
        return "Num Enter";
    case key_tab:
        return "Tab";
    case key_enter:
        return "Enter";
    case key_backspace:
        return "Backspace";
    case key_insert:
        return "Ins";
    case key_up:
        return "Up";
    case key_down:
        return "Down";
    case key_page_up:
        return "Page up";
    case key_page_down:
        return "Page down";
    default:
        return key > key_space && key < 127 ? std::string(1, static_cast<char>(key)) : std::string();
    }
}

} // namespace

namespace {

std::vector<KeyBinding>& rows_in_force() {
    static std::vector<KeyBinding> rows = make_bindings();
    return rows;
}

bool act_together(KeysIn a, KeysIn b) {
    return a == b || a == KeysIn::anywhere || b == KeysIn::anywhere;
}

} // namespace

const std::vector<KeyBinding>& key_bindings() {
    return rows_in_force();
}

std::string command_id(const KeyBinding& row) {
    std::string id;
    for (const char* c = row.label; *c != '\0'; ++c)
        if (std::isalnum(static_cast<unsigned char>(*c)) != 0)
            id += static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
        else if (!id.empty() && id.back() != '-')
            id += '-';
    while (!id.empty() && id.back() == '-')
        id.pop_back();
    return id;
}

std::string set_user_keys(const std::string& id, const std::vector<KeyChord>& chords) {
    std::vector<KeyBinding>& rows = rows_in_force();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const KeyBinding& r) { return command_id(r) == id; });
    if (row == rows.end())
        return "there is no command '" + id + "'";
    for (const KeyBinding& other : rows)
        for (const KeyChord& theirs : other.chords)
            if (&other != &*row && act_together(other.where, row->where) && theirs.key != key_none &&
                std::find(chords.begin(), chords.end(), theirs) != chords.end())
                return "'" + id + "' cannot have " + to_text(theirs) + ", the key of '" + command_id(other) +
                       "'";
    row->chords = {};
    std::copy_n(chords.begin(), std::min(chords.size(), row->chords.size()), row->chords.begin());
    return {};
}

void reset_user_keys() {
    const std::vector<KeyBinding> own = make_bindings(); // rows stay where they are: others point at them
    for (std::size_t i = 0; i < own.size(); ++i)
        rows_in_force()[i].chords = own[i].chords;
}

std::optional<KeyChord> parse_chord(std::string_view text) {
    KeyChord chord;
    const auto take = [&](std::string_view prefix) {
        const bool there = text.rfind(prefix, 0) == 0 && text.size() > prefix.size();
        if (there)
            text.remove_prefix(prefix.size());
        return there;
    };
    if (text == "?")
        return KeyChord{key_slash, shift};
    for (bool more = true; more;) {
        more = false;
        for (const auto& [prefix, held] :
             {std::pair("Ctrl+", &chord.modifiers.ctrl), std::pair("Shift+", &chord.modifiers.shift),
              std::pair("Alt+", &chord.modifiers.alt)})
            if (take(prefix))
                *held = more = true;
    }
    if (text.empty())
        return std::nullopt;
    for (int key = 1; key < 350; ++key) {
        const bool printable =
            key > 32 && key < 127 && std::islower(key) == 0 && key != '+'; // the key is "="
        if ((printable || key == key_space || key >= key_escape) && key_name(key) == text) {
            chord.key = key;
            return chord;
        }
    }
    return std::nullopt;
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

std::optional<Command> preset_binding(const KeyChord& chord, Navigation navigation) {
    if (navigation == Navigation::paraview && chord == KeyChord{key_r})
        return Command::frame_selection;
    if (navigation == Navigation::blender && chord == KeyChord{key_pad_period})
        return Command::frame_selection;
    if (navigation == Navigation::blender && chord == KeyChord{key_home})
        return Command::frame_all;
    return std::nullopt;
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
