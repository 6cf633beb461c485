#include "editor/hand_run.hpp"
#include "editor/metrics_worker.hpp"
#include "fascicle/simulation/simulation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::editor;

TEST_CASE("Frames are measured as they come and agree with the engine", "[editor][metrics]") {
    test::HandRun run(std::make_shared<const Scene>(test::small_scene()));
    MetricsWorker worker;
    run.compute(3);
    worker.follow(run.recording());
    worker.finish();
    CHECK(worker.current().frame_count() == 3);
    CHECK_FALSE(worker.behind());
    run.compute(8);
    CHECK(worker.behind());
    worker.finish();
    REQUIRE(worker.current().frame_count() == 8);
    MetricsEngine engine(*run.recording());
    const int row = metric_index("volume_ratio");
    REQUIRE(row >= 0);
    for (int k = 0; k < 8; ++k) {
        const auto expected = engine.measure(*run.recording()->frame(k));
        CHECK(worker.current().rows[std::size_t(k)][0][std::size_t(row)] == expected[0][std::size_t(row)]);
    }
    CHECK(worker.current().rows[7][0][std::size_t(row)] != 1.0);
    CHECK(metric_index("no such row") == -1);
}

TEST_CASE("The worker has every number that the command line writes, of attachments found by distance too",
          "[editor][metrics]") {
    Scene scene = test::small_scene();
    scene.muscles[0].attachments.clear(); // found when the run is prepared: only the recording has them
    scene.muscles[0].attach_automatically = true;
    scene.parameters.set("attachment.distance_mm", 8);
    scene.timeline.last_frame = 6;
    const auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(scene));
    run_simulation(*recording, {1}, {});
    REQUIRE(recording->attachments().at(0).size() == 2);
    MetricsWorker worker;
    worker.follow(recording);
    worker.finish();
    REQUIRE(worker.current().frame_count() == 7);
    MetricsEngine engine(*recording, 2); // as in 'fascicle simulate'
    for (int k = 0; k < 7; ++k) {
        const auto expected = engine.measure(*recording->frame(k));
        for (std::size_t r = 0; r < metric_table().size(); ++r) {
            INFO("frame " << k << ", " << metric_table()[r].key);
            if (metric_table()[r].of_fibres)
                continue; // there are none
            CHECK(std::isfinite(expected[0][r]));
            CHECK(worker.current().rows[std::size_t(k)][0][r] == expected[0][r]);
        }
    }
}

TEST_CASE("Values of earlier runs stay, newest first, capped", "[editor][metrics]") {
    MetricsWorker worker;
    for (int i = 0; i < 8; ++i) {
        worker.follow(test::small_recording(3 + i));
        worker.finish();
    }
    CHECK(worker.current().frame_count() == 10);
    REQUIRE(worker.earlier().size() == MetricsWorker::kept_runs);
    CHECK(worker.earlier().front().frame_count() == 9);
    worker.follow(nullptr);
    worker.finish();
    CHECK(worker.current().frame_count() == 0);
    CHECK(worker.take_error().empty());
}
