#include "editor/input_queue.hpp"

#include "render/imgui_host.hpp"

#include <catch2/catch.hpp>
#include <imgui.h>

using namespace fascicle::editor;

TEST_CASE("Input comes one change a frame, so that a fast click is not lost", "[editor][input]") {
    const fascicle::render::ImguiHost host;
    ImGuiIO& io = ImGui::GetIO();
    InputQueue queue;
    queue.mouse_move(10, 20);
    queue.mouse_move(30, 40);
    queue.mouse_button(0, true);
    queue.mouse_button(0, false);
    queue.feed(io);
    CHECK(io.MousePos.x == 30); // moves in a row are one
    CHECK_FALSE(io.MouseDown[0]);
    queue.feed(io);
    CHECK(io.MouseDown[0]);
    CHECK_FALSE(queue.empty());
    queue.feed(io);
    CHECK_FALSE(io.MouseDown[0]);
    CHECK(queue.empty());
}

TEST_CASE("Keys report what was held with them", "[editor][input]") {
    const fascicle::render::ImguiHost host;
    ImGuiIO& io = ImGui::GetIO();
    InputQueue queue;
    queue.key(key_left_ctrl, true, {.ctrl = true});
    queue.key(key_z, true, {.ctrl = true});
    queue.key(key_z, true, {.ctrl = true}, true);
    queue.key(key_z, false, {.ctrl = true});
    queue.key(key_left_ctrl, false, {});
    queue.feed(io);
    queue.feed(io);
    REQUIRE(queue.presses().size() == 1);
    CHECK(queue.presses()[0].chord == KeyChord{key_z, {.ctrl = true}});
    CHECK_FALSE(queue.presses()[0].repeat);
    CHECK(io.KeyCtrl);
    queue.feed(io);
    CHECK(queue.presses()[0].repeat);
    queue.feed(io);
    CHECK(queue.presses().empty());
    queue.feed(io);
    CHECK_FALSE(io.KeyCtrl);
    queue.key(100000, true, {}); // no such key: refused, not written out of bounds
    queue.mouse_button(17, true);
    CHECK(queue.empty());
}

TEST_CASE("Losing the focus releases everything", "[editor][input]") {
    const fascicle::render::ImguiHost host;
    ImGuiIO& io = ImGui::GetIO();
    InputQueue queue;
    queue.key(key_left_shift, true, {.shift = true});
    queue.mouse_button(1, true);
    queue.focus(false);
    for (int i = 0; i < 3; ++i)
        queue.feed(io);
    CHECK_FALSE(io.KeyShift);
    CHECK_FALSE(io.MouseDown[1]);
}
