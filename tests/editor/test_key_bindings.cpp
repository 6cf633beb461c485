#include "editor/key_bindings.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace fascicle::editor;

TEST_CASE("Every command has exactly one row and every chord one command", "[editor][keys]") {
    std::set<Command> commands;
    std::set<std::string> chords[3]; // where the row's keys act
    for (const KeyBinding& row : key_bindings()) {
        CHECK(commands.insert(row.command).second);
        CHECK(std::string(row.label).size() > 2);
        CHECK(std::string(row.help).size() > 4);
        for (const KeyChord& chord : row.chords)
            if (chord.key != key_none) {
                INFO(to_text(chord));
                CHECK(chords[static_cast<int>(row.where)].insert(to_text(chord)).second);
                const bool painting = row.where == KeysIn::painting;
                REQUIRE(find_binding(chord, painting) != nullptr);
                CHECK(find_binding(chord, painting)->command == row.command);
            }
    }
    for (int i = 0; i <= static_cast<int>(Command::escape); ++i)
        CHECK(commands.count(static_cast<Command>(i)) == 1);
}

TEST_CASE("A key with Ctrl is not the key alone", "[editor][keys]") {
    for (const KeyBinding& row : key_bindings())
        for (const KeyChord& chord : row.chords) {
            if (chord.key == key_none || chord.modifiers.ctrl)
                continue;
            KeyChord held = chord;
            held.modifiers.ctrl = true;
            const KeyBinding* other = find_binding(held);
            CHECK((other == nullptr || other->command != row.command));
        }
}

TEST_CASE("Chords read as people write them", "[editor][keys]") {
    CHECK(shortcut(Command::undo) == "Ctrl+Z");
    CHECK(shortcut(Command::redo) == "Ctrl+Shift+Z");
    CHECK(shortcut(Command::frame_all) == "Shift+F");
    CHECK(shortcut(Command::view_posterior) == "Shift+Num 1");
    CHECK(shortcut(Command::save_picture) == "F12");
    CHECK(shortcut(Command::deselect).empty());
    CHECK(to_text({key_slash, {.shift = true}}) == "?");
    CHECK(tooltip(Command::undo).rfind("Undo (Ctrl+Z)\n", 0) == 0);
}
