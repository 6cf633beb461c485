#include "editor/playback.hpp"

#include <catch2/catch.hpp>

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
    p.loop = false;
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
