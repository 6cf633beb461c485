#pragma once
// Key codes. The numbers are GLFW's, so that windows, tests and pictures speak alike without including GLFW
// here (window.cpp checks them when it is compiled).

namespace fascicle::editor {

/// Printable keys are their upper-case ASCII character on a US layout.
enum Key : int {
    key_none = 0,
    key_space = 32,
    key_comma = 44,
    key_minus = 45,
    key_period = 46,
    key_slash = 47,
    key_0 = 48,
    key_1 = 49,
    key_2 = 50,
    key_3 = 51,
    key_4 = 52,
    key_5 = 53,
    key_6 = 54,
    key_7 = 55,
    key_equal = 61,
    key_left_bracket = 91,
    key_right_bracket = 93,
    key_a = 65,
    key_b = 66,
    key_c = 67,
    key_e = 69,
    key_d = 68,
    key_f = 70,
    key_h = 72,
    key_i = 73,
    key_j = 74,
    key_k = 75,
    key_l = 76,
    key_m = 77,
    key_n = 78,
    key_o = 79,
    key_p = 80,
    key_q = 81,
    key_r = 82,
    key_s = 83,
    key_t = 84,
    key_v = 86,
    key_w = 87,
    key_x = 88,
    key_y = 89,
    key_z = 90,
    key_escape = 256,
    key_enter = 257,
    key_tab = 258,
    key_backspace = 259,
    key_insert = 260,
    key_delete = 261,
    key_right = 262,
    key_left = 263,
    key_down = 264,
    key_up = 265,
    key_page_up = 266,
    key_page_down = 267,
    key_home = 268,
    key_end = 269,
    key_f1 = 290,
    key_f5 = 294,
    key_f11 = 300,
    key_f12 = 301,
    key_pad_0 = 320,
    key_pad_1 = 321,
    key_pad_period = 330,
    key_pad_enter = 335,
    key_left_shift = 340,
    key_left_ctrl = 341,
    key_left_alt = 342,
    key_right_shift = 344,
    key_right_ctrl = 345,
    key_right_alt = 346,
};

struct Modifiers {
    bool ctrl = false;
    bool shift = false;
    bool alt = false;
    bool operator==(const Modifiers&) const = default;
};

/// A key with what must be held, and nothing else held: Ctrl+F is not F.
struct KeyChord {
    int key = key_none;
    Modifiers modifiers{};
    bool operator==(const KeyChord&) const = default;
};

} // namespace fascicle::editor
