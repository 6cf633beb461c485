#include "editor/driver.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::Driver;

namespace {

ImVec2 at_frame(Driver& d, double frame, float share_of_height = 0.5f) {
    const Rect r = d.rect("timeline/ruler");
    const auto last = double(d.document().scene().timeline.last_frame);
    return {r.min.x + r.width() * static_cast<float>(frame / last), r.min.y + r.height() * share_of_height};
}

void double_click(Driver& d, ImVec2 at) {
    d.move_to(at);
    for (int i = 0; i < 2; ++i) {
        d.press();
        d.release();
    }
}

} // namespace

TEST_CASE("A double-click on the ruler adds a marker that is named, moved and removed",
          "[editor][ui][timeline]") {
    Driver d;
    d.frame(3);
    d.run()->compute(61);
    d.frame(3);
    double_click(d, at_frame(d, 45));
    d.frame(3);
    REQUIRE(d.document().scene().markers.size() == 1);
    CHECK(d.document().scene().markers[0] == Marker{45, "Marker 1"});
    REQUIRE(d.has("timeline/marker_name"));
    d.type("Peak");
    d.key(key_enter);
    d.frame(2);
    CHECK(d.document().scene().markers[0].name == "Peak");
    CHECK_FALSE(d.has("timeline/marker_name"));
    CHECK(d.runs_started() == 1); // a name changes no result

    d.drag(d.middle("timeline/marker/Peak"), at_frame(d, 20));
    CHECK(d.document().scene().markers[0].frame == 20);
    CHECK(d.document().history().undo_name() == "Move Peak");
    CHECK(d.state().playback.playhead() == 45); // the drag was the marker's

    d.click("timeline/first");
    d.key(key_period);
    CHECK(d.state().playback.playhead() == 20);
    d.key(key_right);
    d.key(key_comma);
    CHECK(d.state().playback.playhead() == 20);
    d.key(key_home);
    d.key(key_right);
    d.key(key_m);
    REQUIRE(d.document().scene().markers.size() == 2);
    CHECK(d.document().scene().markers[0].frame == 1);

    d.click("timeline/marker/Peak", 1);
    d.frame(2);
    d.click("timeline/menu/remove");
    REQUIRE(d.document().scene().markers.size() == 1);
    CHECK(d.document().history().undo_name() == "Remove Peak");
    d.key(key_z, {.ctrl = true});
    CHECK(d.document().scene().markers.size() == 2);
}

TEST_CASE("The handles of the ruler set the frames that are played", "[editor][ui][timeline]") {
    Driver d;
    d.frame(3);
    d.run()->compute(61);
    d.run()->finish();
    d.frame(3);
    d.drag(d.middle("timeline/range/first"), at_frame(d, 10, 0.9f));
    d.drag(d.middle("timeline/range/last"), at_frame(d, 14, 0.9f));
    REQUIRE(d.state().playback.range);
    CHECK(*d.state().playback.range == std::pair(10, 14));
    d.click("timeline/play");
    for (int i = 0; i < 60; ++i) {
        d.frame();
        CHECK(d.state().playback.playhead() >= 10);
        CHECK(d.state().playback.playhead() <= 14);
    }
    d.key(key_space);
    d.key(key_home);
    d.key(key_left_bracket, {.ctrl = true});
    CHECK(*d.state().playback.range == std::pair(0, 14));
    d.drag(d.middle("timeline/range/last"), at_frame(d, 60, 0.9f));
    CHECK_FALSE(d.state().playback.range); // all of them again
    d.key(key_right);
    d.key(key_right_bracket, {.ctrl = true});
    CHECK(*d.state().playback.range == std::pair(0, 1));
    d.editor().run(Command::loop_everything);
    CHECK_FALSE(d.state().playback.range);
}

TEST_CASE("Loop, ping-pong and speed are chosen at the timeline", "[editor][ui][timeline]") {
    Driver d;
    d.frame(3);
    d.run()->compute(61);
    d.frame(3);
    d.click("timeline/ping_pong");
    CHECK(d.state().playback.repeat == Repeat::ping_pong);
    d.click("timeline/loop");
    CHECK(d.state().playback.repeat == Repeat::loop);
    d.click("timeline/loop");
    CHECK(d.state().playback.repeat == Repeat::once);
    d.click("timeline/speed");
    d.click("timeline/speed/-2x");
    CHECK(d.state().playback.speed == -2);
    d.click("timeline/play"); // at frame 0, backwards: begins at the end, and goes two frames a picture
    const int there = d.state().playback.playhead();
    CHECK(there > 4);
    CHECK(there < 60);
    d.frame();
    CHECK(d.state().playback.playhead() == there - 2);
    CHECK(d.state().playback.playing);
    d.editor().run(Command::toggle_every_frame);
    CHECK(d.state().playback.every_frame);
}

TEST_CASE("Scrubbing behind the frames of a stopped run computes on, and the frames there are stay valid",
          "[editor][ui][timeline]") {
    Driver d;
    d.frame(3);
    d.run()->compute(21);
    d.frame(2);
    d.run()->recording()->finish(RunState::cancelled);
    d.editor().runs().cancel();
    d.frame(3);
    CHECK_FALSE(d.editor().runs().running());
    d.drag(at_frame(d, 5), at_frame(d, 15)); // within what there is
    CHECK(d.runs_started() == 1);
    d.drag(at_frame(d, 15), at_frame(d, 40));
    CHECK(d.runs_started() == 2);
    d.frame(2);
    CHECK(d.editor().runs().running());
    CHECK(d.editor().runs().at(20).state == FrameState::valid);
    CHECK(d.editor().runs().at(30).state == FrameState::missing);
    d.run()->compute(31);
    CHECK(d.editor().runs().at(30).state == FrameState::valid);
    d.key(key_escape); // stops it again
    CHECK_FALSE(d.editor().runs().running());
}
