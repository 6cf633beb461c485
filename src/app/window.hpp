#pragma once
// The one place that knows GLFW: a window with a GL context, its events handed to the editor's queue.

#include "editor/input_queue.hpp"
#include "render/gl_lookup.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

struct GLFWwindow;

namespace fascicle::app {

class Window {
public:
    /// Opens a window of width x height screen units with a GL 3.3 core context, current on this thread.
    /// Error when there is no display or no such context.
    Window(int width, int height, const std::string& title);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Sends input to `queue` and dropped files to `drop` from here on. Both must outlive the window. An ImGui
    /// context must exist: clipboard and pointer shapes are connected too.
    void connect(editor::InputQueue& queue, std::function<void(std::vector<std::filesystem::path>)> drop);

    render::GlLookup lookup() const;
    /// Interface scale of the monitor: 1 at 96 dpi.
    float content_scale() const;
    /// Pixels; 0 x 0 while minimised.
    void framebuffer_size(int& width, int& height) const;
    bool wants_close() const;
    /// The wish to close it was heard: it stays open until told otherwise.
    void refuse_close();
    void set_title(const std::string& title);

    /// Handles what happened, without waiting.
    void poll();
    /// Sleeps until something happens, at most `seconds`. True when something did.
    bool wait(double seconds);
    /// Something has happened since the last call.
    bool take_activity();
    /// Shows the drawn picture; waits for the monitor.
    void swap();
    void set_full_screen(bool on);
    /// Gives the pointer the shape that ImGui asks for.
    void update_cursor();

private:
    static Window& self(GLFWwindow* window);

    GLFWwindow* window_ = nullptr;
    editor::InputQueue* queue_ = nullptr;
    std::function<void(std::vector<std::filesystem::path>)> drop_;
    std::vector<void*> cursors_; ///< by ImGuiMouseCursor
    bool activity_ = true;
    int restore_[4] = {0, 0, 0, 0}; ///< place and size before full screen
};

} // namespace fascicle::app
