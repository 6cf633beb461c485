#include "editor/hand_run.hpp"
#include "editor/run_manager.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/document/actions/scene_actions.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::editor;
using fascicle::test::HandRun;

namespace {

struct Bench {
    Document document{test::small_scene()};
    std::vector<HandRun*> started;
    RunManager runs{[this](ScenePtr scene) -> std::unique_ptr<Run> {
        auto run = std::make_unique<HandRun>(std::move(scene));
        started.push_back(run.get());
        return run;
    }};
    double now = 0;

    void wait(double seconds) {
        const double until = now + seconds;
        while (now < until) {
            now += 0.05;
            runs.update(document.head(), document.has_uncommitted_edits(), now);
        }
    }
};

} // namespace

TEST_CASE("The first run starts at once, the next when the scene has settled", "[editor][runs]") {
    Bench b;
    b.wait(0.05);
    REQUIRE(b.started.size() == 1);
    b.started[0]->compute(10);
    CHECK(b.runs.valid_count() == 10);
    CHECK(b.runs.at(9).state == FrameState::valid);
    CHECK(b.runs.at(10).state == FrameState::missing);

    actions::edit_parameter(b.document, "solver.stiffness", 0.2);
    b.wait(2);
    CHECK(b.started.size() == 1); // the slider is still held
    CHECK(b.runs.valid_count() == 0);
    CHECK(b.runs.at(9).state == FrameState::stale);
    CHECK(b.runs.available_count() == 10);

    actions::commit_parameter(b.document, "solver.stiffness");
    b.wait(0.1);
    CHECK(b.started.size() == 1);
    HandRun* old = b.started[0];
    b.wait(0.5);
    REQUIRE(b.started.size() == 2);
    static_cast<void>(old); // told to stop and done away with by now
    CHECK(b.started[1]->recording()->scene().parameters.get("solver.stiffness") == 0.2);
    CHECK(b.runs.at(9).state == FrameState::stale); // the old frames stand in
    b.started[1]->compute(4);
    CHECK(b.runs.at(3).state == FrameState::valid);
    CHECK(b.runs.at(3).recording == b.started[1]->recording());
    CHECK(b.runs.at(4).state == FrameState::stale);
    CHECK(b.runs.at_or_before(50).frame->index == 9);
}

TEST_CASE("A stopped run is not started again by itself", "[editor][runs]") {
    Bench b;
    b.wait(0.1);
    b.started[0]->compute(3);
    CHECK(b.runs.running());
    b.runs.cancel();
    CHECK(b.started[0]->cancelled);
    b.wait(2);
    CHECK(b.started.size() == 1);
    CHECK(b.runs.valid_count() == 3);
    actions::set_parameter(b.document, "solver.pressure", 1.2);
    b.wait(1);
    CHECK(b.started.size() == 2);
    b.runs.cancel();
    b.runs.restart();
    CHECK(b.started.size() == 3);
}

TEST_CASE("A stopped run goes on where frames are asked for, also after a change that is none of its problem",
          "[editor][runs]") {
    Bench b;
    b.wait(0.1);
    b.started[0]->compute(3);
    b.runs.compute_on();
    CHECK(b.started.size() == 1); // it runs
    b.runs.cancel();
    b.started[0]->recording()->finish(RunState::cancelled);
    actions::rename_muscle(b.document, 0, "other");
    b.wait(1);
    CHECK(b.started.size() == 1);
    b.runs.compute_on();
    b.wait(0.1);
    CHECK(b.started.size() == 2);
}

TEST_CASE("Undo before the new run begins makes the old frames valid again", "[editor][runs]") {
    Bench b;
    b.wait(0.1);
    b.started[0]->compute(5);
    actions::set_parameter(b.document, "solver.pressure", 1.2);
    b.wait(0.1);
    CHECK(b.runs.valid_count() == 0);
    b.document.undo();
    b.wait(1);
    CHECK(b.started.size() == 1);
    CHECK(b.runs.valid_count() == 5);
}

TEST_CASE("A new name needs no new run, a new body makes old frames useless", "[editor][runs]") {
    Bench b;
    b.wait(0.1);
    b.started[0]->compute(5);
    const Scene& before = b.runs.recording()->scene();
    const std::string name = before.muscles[0].name;
    actions::rename_muscle(b.document, 0, "other");
    b.wait(1);
    CHECK(b.started.size() == 1);
    CHECK(b.runs.valid_count() == 5);
    CHECK(b.runs.recording()->scene().muscles[0].name == "other"); // view, plots and exports go by it
    CHECK(before.muscles[0].name == name);                         // who holds the former scene keeps it
    b.document.undo();
    b.wait(1);
    CHECK(b.runs.recording()->scene().muscles[0].name == name);
    actions::remove_bone(b.document, 0);
    b.wait(0.05);
    CHECK(b.runs.available_count() == 0);
    CHECK(b.runs.at(2).state == FrameState::missing);
    b.wait(1);
    CHECK(b.started.size() == 2);
}

TEST_CASE("The longer of two old runs stands in", "[editor][runs]") {
    Bench b;
    b.wait(0.1);
    b.started[0]->compute(20);
    actions::set_parameter(b.document, "solver.pressure", 1.2);
    b.wait(1);
    b.started[1]->compute(2);
    actions::set_parameter(b.document, "solver.pressure", 1.3);
    b.wait(1);
    REQUIRE(b.started.size() == 3);
    CHECK(b.runs.available_count() == 20);
    CHECK(b.runs.at(15).state == FrameState::stale);
}

TEST_CASE("A shown recording is not run", "[editor][runs]") {
    const RecordingPtr recording = test::small_recording(7);
    RunManager runs(nullptr);
    runs.show(recording);
    const Document document(recording->scene());
    runs.update(document.head(), false, 1);
    CHECK_FALSE(runs.outdated());
    CHECK(runs.valid_count() == 7);
    CHECK(runs.at_or_before(100).frame->index == 6);
}
