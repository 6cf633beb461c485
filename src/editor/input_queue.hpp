#pragma once
// Input events of windows and tests, handed to ImGui one change a frame, so that a fast click is never lost.
// The only file that knows how this ImGui release takes events (1.86 has no event queue of its own).

#include "editor/keys.hpp"

#include <deque>
#include <vector>

struct ImGuiIO;

namespace fascicle::editor {

class InputQueue {
public:
    /// Tells ImGui which key is which. Once per ImGui context.
    static void map_keys(ImGuiIO& io);

    void mouse_move(float x, float y); ///< pixels from the top left corner
    /// button: 0 left, 1 right, 2 middle; others are ignored.
    void mouse_button(int button, bool down);
    void wheel(float dx, float dy);
    /// repeat: the system's key repeat; it reaches presses(), not ImGui, which repeats by itself.
    void key(int key, bool down, Modifiers modifiers, bool repeat = false);
    void text(unsigned code_point);
    /// Losing the focus releases every key and button.
    void focus(bool focused);

    bool empty() const { return events_.empty(); }
    /// Before ImGui::NewFrame(): applies the next event. Moves in a row count as one, so do wheel steps and
    /// typed characters.
    void feed(ImGuiIO& io);
    /// Keys that went down (or repeated) with the last feed().
    struct Press {
        KeyChord chord;
        bool repeat = false;
    };
    const std::vector<Press>& presses() const { return presses_; }

private:
    enum class Kind { move, button, wheel, key, text, focus };
    struct Event {
        Kind kind;
        float x = 0, y = 0;
        int code = 0;
        bool down = false, repeat = false;
        Modifiers modifiers{};
    };
    void apply(const Event& event, ImGuiIO& io);

    std::deque<Event> events_;
    std::vector<Press> presses_;
};

} // namespace fascicle::editor
