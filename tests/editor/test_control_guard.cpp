#include "editor/control_guard.hpp"

#include <catch2/catch.hpp>

using namespace fascicle::editor;

TEST_CASE("Names with a star stand for all that begin so, and what is pointed at is never locked",
          "[editor][lessons]") {
    ControlGuard guard;
    guard.locked = {"parameter/*", "toolbar/run"};
    guard.highlighted = {"parameter/solver.volume"};
    CHECK(guard.is_locked("parameter/solver.stiffness"));
    CHECK(guard.is_locked("parameter/solver.stiffness/reset"));
    CHECK(guard.is_locked("toolbar/run"));
    CHECK_FALSE(guard.is_locked("toolbar/runner"));
    CHECK_FALSE(guard.is_locked("parameter/solver.volume"));
    CHECK_FALSE(guard.is_locked("parameter/solver.volume/free"));
    CHECK(guard.is_locked("parameter/solver.volumes"));
    CHECK(guard.is_highlighted("parameter/solver.volume"));
    CHECK_FALSE(guard.is_highlighted("parameter/solver.volume/free"));

    CHECK(lock_reason("toolbar/run").empty()); // no guard is set
    set_control_guard(&guard);
    CHECK(lock_reason("toolbar/run") == "locked by the lesson");
    CHECK(lock_reason("toolbar/open").empty());
    set_control_guard(nullptr);
    CHECK(lock_reason("toolbar/run").empty());
}
