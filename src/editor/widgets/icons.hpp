#pragma once
// Font Awesome 4.7 code points in use, as UTF-8. Each with words for when the icon font is missing.

namespace fascicle::editor {

struct Icon {
    const char* glyph;
    const char* words;
};

namespace icons {
inline constexpr Icon open{"\xEF\x81\xBC", "Open"};      // U+F07C
inline constexpr Icon camera{"\xEF\x80\xB0", "Picture"}; // U+F030
inline constexpr Icon undo{"\xEF\x84\x92", "Undo"};      // U+F112
inline constexpr Icon redo{"\xEF\x81\xA4", "Redo"};      // U+F064
inline constexpr Icon play{"\xEF\x81\x8B", "Play"};      // U+F04B
inline constexpr Icon pause{"\xEF\x81\x8C", "Pause"};    // U+F04C
inline constexpr Icon stop{"\xEF\x81\x8D", "Stop"};      // U+F04D
inline constexpr Icon first{"\xEF\x81\x88", "|<"};       // U+F048
inline constexpr Icon last{"\xEF\x81\x91", ">|"};        // U+F051
inline constexpr Icon back{"\xEF\x81\x93", "<"};         // U+F053
inline constexpr Icon on{"\xEF\x81\x94", ">"};           // U+F054
inline constexpr Icon loop{"\xEF\x81\xB9", "Loop"};      // U+F079
inline constexpr Icon ping_pong{"\xEF\x83\xAC", "<->"};  // U+F0EC
inline constexpr Icon again{"\xEF\x80\xA1", "Run"};      // U+F021
inline constexpr Icon eye{"\xEF\x81\xAE", "on"};         // U+F06E
inline constexpr Icon eye_off{"\xEF\x81\xB0", "off"};    // U+F070
inline constexpr Icon reset{"\xEF\x83\xA2", "reset"};    // U+F0E2
inline constexpr Icon cube{"\xEF\x86\xB2", "Ortho"};     // U+F1B2
inline constexpr Icon expand{"\xEF\x82\xB2", "Fit"};     // U+F0B2
inline constexpr Icon grid{"\xEF\x80\x8A", "Wire"};      // U+F00A
inline constexpr Icon tag{"\xEF\x84\xBD", "Areas"};      // U+F13D
inline constexpr Icon warning{"\xEF\x81\xB1", "!"};      // U+F071
inline constexpr Icon error{"\xEF\x81\xAA", "x"};        // U+F06A
inline constexpr Icon note{"\xEF\x81\x9A", "i"};         // U+F05A
inline constexpr Icon ghost{"\xEF\x89\x8D", "Rest"};     // U+F24D
inline constexpr Icon plus{"\xEF\x81\xA7", "+"};         // U+F067
inline constexpr Icon close{"\xEF\x80\x8D", "x"};        // U+F00D
inline constexpr Icon file{"\xEF\x80\x96", ""};          // U+F016
inline constexpr Icon folder{"\xEF\x81\xBB", ""};        // U+F07B
inline constexpr Icon up{"\xEF\x81\xA2", "^"};           // U+F062
inline constexpr Icon trash{"\xEF\x80\x94", "Remove"};   // U+F014
inline constexpr Icon link{"\xEF\x83\x81", "fixed"};     // U+F0C1
inline constexpr Icon filter{"\xEF\x82\xB0", "changed"}; // U+F0B0
inline constexpr Icon circle{"\xEF\x84\x8C", "o"};       // U+F10C
inline constexpr Icon fibres{"\xEF\x83\x89", "Fibres"};  // U+F0C9
inline constexpr Icon pin{"\xEF\x82\x8D", "pin"};        // U+F08D
inline constexpr Icon sliders{"\xEF\x87\x9E", "use"};    // U+F1DE
inline constexpr Icon exchange{"\xEF\x83\xAC", "swap"};  // U+F0EC
inline constexpr Icon check{"\xEF\x80\x8C", "ok"};       // U+F00C

inline constexpr Icon brush{"\xEF\x87\xBC", "Brush"};        // U+F1FC
inline constexpr Icon eraser{"\xEF\x84\xAD", "Erase"};       // U+F12D
inline constexpr Icon drop{"\xEF\x81\x83", "Smooth"};        // U+F043
inline constexpr Icon wand{"\xEF\x83\x90", "Smart"};         // U+F0D0
inline constexpr Icon filled_ring{"\xEF\x86\x92", "Bucket"}; // U+F192
inline constexpr Icon pencil{"\xEF\x81\x80", "Lasso"};       // U+F040
inline constexpr Icon line_chart{"\xEF\x88\x81", "Line"};    // U+F201
inline constexpr Icon lock{"\xEF\x80\xA3", "locked"};        // U+F023
inline constexpr Icon unlock{"\xEF\x82\x9C", "open"};        // U+F09C
inline constexpr Icon adjust{"\xEF\x81\x82", "Through"};     // U+F042
inline constexpr Icon cut{"\xEF\x83\x84", "Cut"};            // U+F0C4
} // namespace icons

/// Whether the icon font is loaded; set once by the editor.
void set_icons_available(bool available);
bool icons_available();

/// Glyph or words.
const char* text(const Icon& icon);

} // namespace fascicle::editor
