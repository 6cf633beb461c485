#pragma once
// Drives the editor like a person would, without a window: moves, clicks, drags and types at widgets found by name.

#include "editor/commands.hpp"
#include "editor/editor.hpp"
#include "editor/hand_run.hpp"
#include "editor/widgets/item_recorder.hpp"

#include <string>

namespace fascicle::test {

class Driver {
public:
    explicit Driver(Scene scene = small_scene(), float width = 1280, float height = 800, float scale = 1,
                    bool still = true, std::filesystem::path user_folder = {});
    ~Driver();

    void frame(int count = 1);
    /// Lets runs start: waits out the settling time.
    void settle();
    /// One frame that comes so much later.
    void wait(double seconds);

    bool has(const std::string& name) const { return recorder_.find(name) != nullptr; }
    /// Place of a widget; fails the test when it is not on the screen.
    editor::Rect rect(const std::string& name) const;
    ImVec2 middle(const std::string& name) const;

    void move_to(ImVec2 point);
    void press(int button = 0);
    void release(int button = 0);
    void click(const std::string& name, int button = 0);
    void double_click(const std::string& name);
    /// From one place to another in a few steps.
    void drag(ImVec2 from, ImVec2 to, int button = 0);
    void wheel(const std::string& name, float steps);
    void key(int code, editor::Modifiers modifiers = {});
    /// Holds these keys down from now on, and no others.
    void hold(editor::Modifiers modifiers);
    void type(const std::string& text);

    /// Of a row of the key table, now.
    editor::CommandState command_state(editor::Command command) {
        return editor::command_state(editor_->context(), command);
    }
    editor::Editor& editor() { return *editor_; }
    editor::EditorState& state() { return editor_->state(); }
    Document& document() { return editor_->document(); }
    /// The newest run; null before the first.
    HandRun* run() { return run_; }
    int runs_started() const { return runs_started_; }

private:
    float width_, height_;
    render::ImguiHost host_;
    editor::ItemRecorder recorder_;
    HandRun* run_ = nullptr;
    int runs_started_ = 0;
    editor::Modifiers held_{};
    std::unique_ptr<editor::Editor> editor_;
};

} // namespace fascicle::test
