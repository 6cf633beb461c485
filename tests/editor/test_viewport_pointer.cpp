#include "editor/viewport_pointer.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;

namespace {

struct Hand {
    ViewportPointer pointer;
    view::Camera camera;
    view::ViewSize size{800, 600};
    double x = 400, y = 300;
    bool ctrl = false, shift = false;

    ViewportPointer::Result step(double to_x, double to_y, int pressed = -1, int released = -1,
                                 double wheel = 0) {
        PointerInput input;
        input.x = to_x;
        input.y = to_y;
        input.dx = to_x - x;
        input.dy = to_y - y;
        input.pressed = pressed;
        input.released = released;
        input.wheel = wheel;
        input.ctrl = ctrl;
        input.shift = shift;
        input.inside = to_x >= 0 && to_y >= 0 && to_x < size.width && to_y < size.height;
        x = to_x;
        y = to_y;
        return pointer.update(input, size, 1, camera);
    }
    bool turned() const { return camera.yaw_rad() != 0 || camera.pitch_rad() != 0; }
};

} // namespace

TEST_CASE("Less than four pixels is a click, more a drag", "[editor][pointer]") {
    Hand hand;
    hand.step(400, 300, 0);
    CHECK_FALSE(hand.step(402, 301).clicked);
    CHECK(hand.step(402, 302, -1, 0).clicked == 0);
    CHECK_FALSE(hand.turned());
    hand.step(400, 300, 0);
    hand.step(404, 300);
    CHECK(hand.pointer.dragging());
    CHECK(hand.turned());
    CHECK_FALSE(hand.step(400, 300, -1, 0).clicked); // back where it began, but it was a drag
}

TEST_CASE("A drag keeps the view until release, also outside of it", "[editor][pointer]") {
    Hand hand;
    hand.step(400, 300, 0);
    hand.step(500, 300);
    const double yaw = hand.camera.yaw_rad();
    hand.step(2000, -300);
    CHECK(hand.camera.yaw_rad() != yaw);
    hand.step(2000, -300, -1, 0);
    const double after = hand.camera.yaw_rad();
    hand.step(100, 100);
    CHECK(hand.camera.yaw_rad() == after);
}

TEST_CASE("Buttons and modifiers choose orbit, pan and zoom", "[editor][pointer]") {
    struct Case {
        int button;
        bool ctrl, shift;
        const char* does;
    };
    const std::vector<Case> cases{{0, false, false, "orbit"}, {2, false, false, "orbit"},
                                  {1, false, false, "pan"},   {0, false, true, "pan"},
                                  {2, false, true, "pan"},    {0, true, false, "zoom"}};
    for (const Case& c : cases) {
        INFO(c.button << c.ctrl << c.shift);
        Hand hand;
        hand.ctrl = c.ctrl;
        hand.shift = c.shift;
        const Vec3 pivot = hand.camera.pivot();
        const double distance = hand.camera.distance();
        hand.step(400, 300, c.button);
        hand.step(440, 340);
        hand.step(440, 340, -1, c.button);
        const std::string does = c.does;
        CHECK(hand.turned() == (does == "orbit"));
        CHECK(((hand.camera.pivot() - pivot).norm() > 1e-9) == (does == "pan"));
        CHECK((hand.camera.distance() != distance) == (does == "zoom"));
    }
}

TEST_CASE("The wheel zooms towards the pointer, only over the view", "[editor][pointer]") {
    Hand hand;
    const double distance = hand.camera.distance();
    hand.step(700, 100, -1, -1, 1);
    CHECK(hand.camera.distance() < distance);
    CHECK(hand.camera.pivot().norm() > 0); // moved towards what is under the pointer
    const double now = hand.camera.distance();
    hand.step(-50, 100, -1, -1, 1);
    CHECK(hand.camera.distance() == now);
}
