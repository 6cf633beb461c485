#include "app/window.hpp"

#include "editor/keys.hpp"
#include "fascicle/base/error.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <algorithm>
#include <imgui.h>
#include <utility>

namespace fascicle::app {

namespace ed = fascicle::editor;

// The editor's key codes are GLFW's.
static_assert(ed::key_space == GLFW_KEY_SPACE && ed::key_comma == GLFW_KEY_COMMA &&
              ed::key_slash == GLFW_KEY_SLASH);
static_assert(ed::key_equal == GLFW_KEY_EQUAL && ed::key_0 == GLFW_KEY_0 && ed::key_a == GLFW_KEY_A);
static_assert(ed::key_z == GLFW_KEY_Z && ed::key_escape == GLFW_KEY_ESCAPE &&
              ed::key_enter == GLFW_KEY_ENTER);
static_assert(ed::key_delete == GLFW_KEY_DELETE && ed::key_right == GLFW_KEY_RIGHT &&
              ed::key_up == GLFW_KEY_UP);
static_assert(ed::key_home == GLFW_KEY_HOME && ed::key_end == GLFW_KEY_END && ed::key_f1 == GLFW_KEY_F1);
static_assert(ed::key_f12 == GLFW_KEY_F12 && ed::key_pad_0 == GLFW_KEY_KP_0);
static_assert(ed::key_pad_enter == GLFW_KEY_KP_ENTER && ed::key_left_shift == GLFW_KEY_LEFT_SHIFT);
static_assert(ed::key_left_alt == GLFW_KEY_LEFT_ALT && ed::key_right_alt == GLFW_KEY_RIGHT_ALT);

namespace {

std::string glfw_reason() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

/// Keeps the numeric pad's digits on whatever Num Lock says; letters by what is printed on them, so that Ctrl+Z is
/// where the user's layout has it.
int layout_key(int key, int scancode) {
    if (key < GLFW_KEY_A || key > GLFW_KEY_Z)
        return key;
    const char* name = glfwGetKeyName(key, scancode);
    if (name == nullptr || name[0] == '\0' || name[1] != '\0')
        return key;
    const char c = name[0];
    if (c >= 'a' && c <= 'z')
        return c - 'a' + GLFW_KEY_A;
    return c >= 'A' && c <= 'Z' ? c : key;
}

ed::Modifiers modifiers(int mods) {
    return {(mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0, (mods & GLFW_MOD_SHIFT) != 0,
            (mods & GLFW_MOD_ALT) != 0};
}

int button_index(int button) {
    return button == GLFW_MOUSE_BUTTON_LEFT     ? 0
           : button == GLFW_MOUSE_BUTTON_RIGHT  ? 1
           : button == GLFW_MOUSE_BUTTON_MIDDLE ? 2
                                                : -1;
}

} // namespace

Window::Window(int width, int height, const std::string& title) {
    if (glfwInit() != GLFW_TRUE)
        throw_error("window", "cannot be opened: " + glfw_reason(),
                    "a display (pictures without one: fascicle render)");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string reason = glfw_reason();
        glfwTerminate();
        throw_error("window", "cannot be opened: " + reason, "a display with OpenGL 3.3");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
}

Window::~Window() {
    for (void* cursor : cursors_)
        if (cursor != nullptr)
            glfwDestroyCursor(static_cast<GLFWcursor*>(cursor));
    glfwDestroyWindow(window_);
    glfwTerminate();
}

Window& Window::self(GLFWwindow* window) {
    auto& result = *static_cast<Window*>(glfwGetWindowUserPointer(window));
    result.activity_ = true;
    return result;
}

void Window::connect(ed::InputQueue& queue, std::function<void(std::vector<std::filesystem::path>)> drop) {
    queue_ = &queue;
    drop_ = std::move(drop);
    glfwSetWindowUserPointer(window_, this);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        // Positions come in screen units, the interface lives in pixels.
        int window_width = 1, window_height = 1, width = 1, height = 1;
        glfwGetWindowSize(w, &window_width, &window_height);
        glfwGetFramebufferSize(w, &width, &height);
        const double sx = window_width > 0 ? double(width) / window_width : 1,
                     sy = window_height > 0 ? double(height) / window_height : 1;
        self(w).queue_->mouse_move(static_cast<float>(x * sx), static_cast<float>(y * sy));
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
        self(w).queue_->mouse_button(button_index(button), action == GLFW_PRESS);
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double dx, double dy) {
        self(w).queue_->wheel(static_cast<float>(dx), static_cast<float>(dy));
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
        self(w).queue_->key(layout_key(key, scancode), action != GLFW_RELEASE, modifiers(mods),
                            action == GLFW_REPEAT);
    });
    glfwSetCharCallback(window_,
                        [](GLFWwindow* w, unsigned code_point) { self(w).queue_->text(code_point); });
    glfwSetWindowFocusCallback(
        window_, [](GLFWwindow* w, int focused) { self(w).queue_->focus(focused == GLFW_TRUE); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { self(w); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { self(w); });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
        std::vector<std::filesystem::path> files(paths, paths + count);
        self(w).drop_(std::move(files));
    });

    ImGuiIO& io = ImGui::GetIO();
    io.ClipboardUserData = window_;
    io.SetClipboardTextFn = [](void* w, const char* text) {
        glfwSetClipboardString(static_cast<GLFWwindow*>(w), text);
    };
    io.GetClipboardTextFn = [](void* w) { return glfwGetClipboardString(static_cast<GLFWwindow*>(w)); };
    cursors_.assign(ImGuiMouseCursor_COUNT, nullptr);
    cursors_[ImGuiMouseCursor_Arrow] = glfwCreateStandardCursor(GLFW_ARROW_CURSOR);
    cursors_[ImGuiMouseCursor_TextInput] = glfwCreateStandardCursor(GLFW_IBEAM_CURSOR);
    cursors_[ImGuiMouseCursor_ResizeEW] = glfwCreateStandardCursor(GLFW_HRESIZE_CURSOR);
    cursors_[ImGuiMouseCursor_ResizeNS] = glfwCreateStandardCursor(GLFW_VRESIZE_CURSOR);
    cursors_[ImGuiMouseCursor_Hand] = glfwCreateStandardCursor(GLFW_HAND_CURSOR);
}

render::GlLookup Window::lookup() const {
    return [](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); };
}

float Window::content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return x > 0 && y > 0 ? std::min(x, y) : 1.0f;
}

void Window::framebuffer_size(int& width, int& height) const {
    glfwGetFramebufferSize(window_, &width, &height);
}

bool Window::wants_close() const {
    return glfwWindowShouldClose(window_) == GLFW_TRUE;
}

void Window::refuse_close() {
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::poll() {
    glfwPollEvents();
}

bool Window::wait(double seconds) {
    glfwWaitEventsTimeout(seconds);
    return activity_;
}

bool Window::take_activity() {
    return std::exchange(activity_, false);
}

void Window::swap() {
    glfwSwapBuffers(window_);
}

void Window::set_full_screen(bool on) {
    const bool is = glfwGetWindowMonitor(window_) != nullptr;
    if (on == is)
        return;
    activity_ = true;
    if (!on) {
        glfwSetWindowMonitor(window_, nullptr, restore_[0], restore_[1], restore_[2], restore_[3],
                             GLFW_DONT_CARE);
        return;
    }
    glfwGetWindowPos(window_, &restore_[0], &restore_[1]);
    glfwGetWindowSize(window_, &restore_[2], &restore_[3]);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor == nullptr ? nullptr : glfwGetVideoMode(monitor);
    if (mode != nullptr)
        glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::update_cursor() {
    const int shape = ImGui::GetMouseCursor();
    const bool known = shape >= 0 && static_cast<std::size_t>(shape) < cursors_.size();
    void* cursor = known ? cursors_[static_cast<std::size_t>(shape)] : nullptr;
    glfwSetCursor(window_, static_cast<GLFWcursor*>(cursor));
}

} // namespace fascicle::app
