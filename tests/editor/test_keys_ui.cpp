#include "editor/dialogs/command_search.hpp"
#include "editor/driver.hpp"
#include "fascicle/io/files.hpp"
#include "support/temp_dir.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

TEST_CASE("Every key of the table runs its command", "[editor][ui][keys]") {
    for (const KeyBinding& row : key_bindings())
        for (const KeyChord& chord : row.chords) {
            if (chord.key == key_none)
                continue;
            INFO(row.label << ": " << to_text(chord));
            Driver d;
            d.frame(2);
            if (row.where == KeysIn::painting) {
                d.click("tree/fixed");
                d.key(key_tab);
                REQUIRE(d.state().tool == Tool::paint);
            }
            d.state().last_command = -1;
            d.key(chord.key, chord.modifiers);
            CHECK(d.state().last_command == static_cast<int>(row.command));
            d.frame(2); // whatever opened is drawn
        }
}

TEST_CASE("A chord is read as it is written", "[editor][keys]") {
    for (const KeyBinding& row : key_bindings())
        for (const KeyChord& chord : row.chords)
            if (chord.key != key_none) {
                INFO(to_text(chord));
                REQUIRE(parse_chord(to_text(chord)).has_value());
                CHECK(*parse_chord(to_text(chord)) == chord);
            }
    for (const char* bad : {"", "Ctrl+", "Ctrl", "Strg+A", "a", "Ctrl+ctrl", "F13", "Num 12", "AB"})
        CHECK_FALSE(parse_chord(bad).has_value());
}

TEST_CASE("Ctrl+K finds a command by parts of its name and runs it", "[editor][ui][search]") {
    CHECK(match_quality("frame", "Frame everything View") == 3);
    CHECK(match_quality("every", "Frame everything View") == 2);
    CHECK(match_quality("ver", "Frame everything View") == 1);
    CHECK(match_quality("EVERY frame", "Frame everything View") == 2);
    CHECK(match_quality("wire frame", "Wireframe Show") == 1);
    CHECK(match_quality("axis", "Frame everything View") == 0);
    CHECK(match_quality("", "Frame everything View") == 3);

    Driver d;
    d.frame(3);
    d.key(key_k, {.ctrl = true});
    d.frame(3);
    REQUIRE(d.has("search/text"));
    d.type("wire");
    d.frame(2);
    CHECK(d.has("search/Wireframe"));
    CHECK_FALSE(d.has("search/Undo"));
    d.key(key_enter);
    d.frame(3);
    CHECK(d.state().wireframe);
    CHECK_FALSE(d.has("search/text"));

    d.key(key_k, {.ctrl = true});
    d.frame(3);
    d.type("frame");
    d.frame(2);
    d.click("search/One frame on");
    d.frame(2);
    CHECK(d.state().playback.playhead() == 1);

    d.key(key_k, {.ctrl = true});
    d.frame(3);
    d.type("frame");
    d.frame(2);
    CHECK(d.rect("search/Frame selection").min.y < d.rect("search/Frame everything").min.y);
    d.state().camera.zoom(3, 50, 50, {100, 100});
    const double distance = d.state().camera.distance();
    d.key(key_enter); // nothing is selected: the first that can be run is
    d.frame(3);
    CHECK_FALSE(d.has("search/text"));
    CHECK(d.state().camera.distance() < distance);

    d.key(key_k, {.ctrl = true});
    d.frame(3);
    d.type("no such thing");
    d.key(key_enter);
    CHECK(d.has("search/text")); // nothing to run: it stays
    d.key(key_escape);
    d.frame(3);
    CHECK_FALSE(d.has("search/text"));
    d.key(key_w); // the keys are the program's again
    CHECK_FALSE(d.state().wireframe);
}

TEST_CASE("Theme, mouse and keys of one's own come back in the next session", "[editor][ui][settings]") {
    const test::TempDir folder;
    write_file(folder.path() / "keys.json",
               R"({"wireframe": ["Ctrl+Alt+W"], "undo": ["Ctrl+Y"], "no-such": ["A"]})");
    {
        Driver d(test::small_scene(), 1280, 800, 1, true, folder.path());
        d.frame(3);
        const auto& messages = d.editor().log().messages();
        REQUIRE(messages.size() >= 2); // a key that is taken, a command that is not there
        d.key(key_w);
        CHECK_FALSE(d.state().wireframe);
        d.key(key_w, {.ctrl = true, .alt = true});
        CHECK(d.state().wireframe);
        CHECK(shortcut(Command::undo) == "Ctrl+Z");
        d.click("menu/Window");
        d.click("menu/mouse/blender");
        d.editor().run(Command::toggle_theme);
        d.frame(100);
        CHECK(read_file(folder.path() / "settings.json").find("\"mouse\": \"blender\"") != std::string::npos);
    }
    std::string text = read_file(folder.path() / "settings.json");
    text.insert(text.find('{') + 1, "\n  \"from_the_future\": 7,");
    write_file(folder.path() / "settings.json", text);
    {
        Driver d(test::small_scene(), 1280, 800, 1, true, folder.path());
        d.frame(3);
        CHECK(d.state().navigation == Navigation::blender);
        CHECK_FALSE(d.state().dark);
        d.state().navigation = Navigation::paraview;
        d.frame(100);
    }
    CHECK(read_file(folder.path() / "settings.json").find("from_the_future") != std::string::npos);
    CHECK(read_file(folder.path() / "settings.json").find("paraview") != std::string::npos);
    write_file(folder.path() / "settings.json", "not json");
    {
        Driver d(test::small_scene(), 1280, 800, 1, true, folder.path());
        d.frame(3);
        CHECK(d.state().dark);
        CHECK(d.editor().log().messages().size() >= 1);
    }
    reset_user_keys();
}

TEST_CASE("The framing keys of a preset go before the table, and only under it", "[editor][ui][navigation]") {
    struct Row {
        Navigation navigation;
        int key;
        Command command;
    };
    for (const Row& row : {Row{Navigation::paraview, key_r, Command::frame_selection},
                           Row{Navigation::blender, key_pad_period, Command::frame_selection},
                           Row{Navigation::blender, key_home, Command::frame_all}}) {
        Driver d;
        d.frame(2);
        d.click("tree/turning");
        const view::Camera whole = d.state().camera;
        d.key(row.key);
        CHECK(d.state().last_command != static_cast<int>(row.command));
        d.state().navigation = row.navigation;
        d.key(row.key);
        CHECK(d.state().last_command == static_cast<int>(row.command));
        if (row.command == Command::frame_selection)
            CHECK(d.state().camera.distance() < whole.distance());
    }
}

TEST_CASE("The mouse does what each preset says", "[editor][ui][navigation]") {
    struct Gesture {
        Navigation navigation;
        int button;
        Modifiers held;
        bool orbits, pans, zooms;
    };
    const Gesture gestures[] = {
        {Navigation::fascicle, 0, {}, true, false, false},
        {Navigation::fascicle, 1, {}, false, true, false},
        {Navigation::fascicle, 2, {}, true, false, false},
        {Navigation::fascicle, 0, {.shift = true}, false, true, false},
        {Navigation::fascicle, 2, {.shift = true}, false, true, false},
        {Navigation::fascicle, 0, {.ctrl = true}, false, false, true},
        {Navigation::paraview, 0, {}, true, false, false},
        {Navigation::paraview, 2, {}, false, true, false},
        {Navigation::paraview, 1, {}, false, false, true},
        {Navigation::paraview, 0, {.shift = true}, false, true, false},
        {Navigation::blender, 2, {}, true, false, false},
        {Navigation::blender, 2, {.shift = true}, false, true, false},
        {Navigation::blender, 2, {.ctrl = true}, false, false, true},
        {Navigation::blender, 0, {}, false, false, false},
        {Navigation::blender, 0, {.alt = true}, true, false, false},
        {Navigation::blender, 0, {.shift = true, .alt = true}, false, true, false},
    };
    Driver d;
    d.frame(3);
    for (const Gesture& gesture : gestures) {
        INFO("preset " << static_cast<int>(gesture.navigation) << ", button " << gesture.button << ", shift "
                       << gesture.held.shift << ", ctrl " << gesture.held.ctrl << ", alt "
                       << gesture.held.alt);
        d.state().navigation = gesture.navigation;
        const view::Camera before = d.state().camera;
        const ImVec2 from = d.middle("viewport");
        d.hold(gesture.held);
        d.drag(from, {from.x + 60, from.y + 45}, gesture.button);
        d.hold({});
        const view::Camera& after = d.state().camera;
        CHECK((after.backward() != before.backward()) == gesture.orbits);
        CHECK((after.pivot() != before.pivot()) == gesture.pans);
        CHECK((std::abs(after.distance() / before.distance() - 1) > 1e-9) == gesture.zooms);
    }
}
