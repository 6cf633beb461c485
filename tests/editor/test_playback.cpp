#include "editor/playback.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <vector>

using namespace fascicle::editor;

TEST_CASE("Playing follows the clock, at its speed", "[editor][playback]") {
    Playback p;
    advance(p, 1.0, 0.1, 100, 99, false);
    CHECK(p.position == 0); // not playing
    p.playing = true;
    for (int i = 0; i < 10; ++i)
        advance(p, 0.1, 0.1, 100, 99, false);
    CHECK(p.position == Approx(10));
    p.speed = 0.5;
    advance(p, 0.2, 0.1, 100, 99, false);
    CHECK(p.position == Approx(11));
}

TEST_CASE("Playing waits for frames that come, loops or stops at the end", "[editor][playback]") {
    Playback p;
    p.playing = true;
    p.position = 8.5;
    advance(p, 0.2, 0.1, 10, 99, true);
    CHECK(p.playhead() == 9);
    advance(p, 0.2, 0.1, 10, 99, true);
    CHECK(p.playhead() == 9);
    CHECK(p.playing);
    advance(p, 0.2, 0.1, 20, 99, true);
    CHECK(p.playhead() == 11);

    p.position = 18.9;
    advance(p, 0.2, 0.1, 20, 99, false); // the run was stopped at 20 frames
    CHECK(p.playhead() == 0);
    p.repeat = Repeat::once;
    p.position = 98.9;
    advance(p, 0.25, 0.1, 100, 99, false);
    CHECK(p.playhead() == 99);
    CHECK_FALSE(p.playing);
}

TEST_CASE("A shorter timeline pulls the playhead in, and without frames nothing moves",
          "[editor][playback]") {
    Playback p;
    p.position = 80;
    advance(p, 0.1, 0.1, 0, 50, false);
    CHECK(p.position == 50);
    p.playing = true;
    p.position = 0;
    advance(p, 0.1, 0.1, 0, 50, true);
    CHECK(p.position == 0);
    advance(p, 100, 1e-4, 51, 50, false); // a hitch
    CHECK(p.position < 51);
}

TEST_CASE("Playing turns round at both ends, and goes backwards", "[editor][playback]") {
    Playback p;
    p.playing = true;
    p.repeat = Repeat::ping_pong;
    p.position = 8.5;
    std::vector<int> seen;
    for (int i = 0; i < 24; ++i) {
        advance(p, 0.1, 0.1, 11, 10, false);
        seen.push_back(p.playhead());
    }
    CHECK(seen == std::vector<int>{9, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 9, 8});
    p.repeat = Repeat::loop;
    p.turned = false;
    p.speed = -1;
    p.position = 2;
    seen.clear();
    for (int i = 0; i < 5; ++i) {
        advance(p, 0.1, 0.1, 11, 10, false);
        seen.push_back(p.playhead());
    }
    CHECK(seen == std::vector<int>{1, 0, 10, 9, 8});
    p.repeat = Repeat::once;
    p.position = 1;
    advance(p, 0.25, 0.1, 11, 10, false);
    CHECK(p.position == 0);
    CHECK_FALSE(p.playing);
}

TEST_CASE("A range keeps the playhead within its frames", "[editor][playback]") {
    Playback p;
    p.playing = true;
    p.range = {4, 6};
    advance(p, 0.1, 0.1, 11, 10, false);
    CHECK(p.playhead() == 5); // from outside it begins with the first
    std::set<int> seen;
    for (int i = 0; i < 20; ++i) {
        advance(p, 0.1, 0.1, 11, 10, false);
        seen.insert(p.playhead());
    }
    CHECK(seen == std::set<int>{4, 5, 6});
    p.position = 6;
    advance(p, 0.1, 0.1, 5, 10, true); // frame 4 is the last so far
    CHECK(p.playhead() == 4);
    CHECK(played_range(p, 5) == std::pair(4, 5));
    p.range = {30, 40};
    CHECK(played_range(p, 5) == std::pair(5, 5));
}

TEST_CASE("Without skipping no picture moves by more than a frame", "[editor][playback]") {
    Playback p;
    p.playing = true;
    p.every_frame = true;
    p.speed = 4;
    for (int i = 1; i < 9; ++i) {
        advance(p, 0.2, 0.1, 11, 10, false);
        CHECK(p.playhead() == i);
    }
}
