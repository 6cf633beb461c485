#include "fascicle/metrics/fibre_measure.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/simulation/simulation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace fascicle;

namespace {

std::shared_ptr<Recording> cylinder_run(int segments) {
    Scene scene = make_embedded_scene("cylinder");
    scene.parameters.set_text("fibres.method", "kukacka");
    scene.parameters.set("fibres.count", 25);
    scene.parameters.set("fibres.segments", segments);
    auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(std::move(scene)));
    run_simulation(*recording, {2}, {});
    REQUIRE(recording->state() == RunState::finished);
    return recording;
}

/// Length of a fibre in the strap's middle surface between the attached ends, the strap thinning as it is stretched (its
/// width is kept): r = cylinder + clearance + thickness / (2 lambda), lambda = L / L(0).
double closed_form(double angle) {
    using C = CylinderScene;
    const double straight = 2 * (C::straight_length - C::attached_length), quarter = std::numbers::pi / 2;
    const double base = C::cylinder_radius + C::clearance;
    const double rest = straight + (base + C::thickness / 2) * quarter;
    double lambda = 1;
    for (int i = 0; i < 60; ++i)
        lambda = (straight + (base + C::thickness / (2 * lambda)) * (quarter + angle)) / rest;
    return lambda * rest;
}

} // namespace

TEST_CASE("cylinder scene: fibres' lengths and mean moment arm match the closed form within 1 %",
          "[metrics][fibre_measure][cylinder][slow]") {
    const auto recording = cylinder_run(60);
    const std::vector<FibreModelPtr> fibres = recording->fibres();
    REQUIRE(fibres.size() == 1);
    REQUIRE(fibres[0] != nullptr);
    FibreMeasure measure(recording->scene(), 0, fibres[0], *recording->frame(0));
    for (int k = 0; k < recording->frame_count(); ++k) {
        measure.measure(*recording->frame(k), 1.0);
        INFO("frame " << k);
        CHECK(measure.length_mm().mean == Approx(closed_form(recording->frame(k)->angle_rad)).epsilon(0.01));
    }
    // The strap goes behind the joint: it lengthens on the way out, its arm is negative.
    const FibreSeries& series = measure.series();
    double mean = 0;
    for (int k = 1; k <= 100; ++k) {
        const double arm = series.band(FibreQuantity::moment_arm, k).mean;
        mean += arm / 100;
        CHECK(arm == Approx(-(closed_form(0.8) - closed_form(0)) / 0.8).epsilon(0.06));
    }
    CHECK(mean == Approx(-(closed_form(0.8) - closed_form(0)) / 0.8).epsilon(0.01));
}

TEST_CASE("frames in any order are measured alike, ascending ones are kept",
          "[metrics][fibre_measure][slow]") {
    const auto recording = cylinder_run(10);
    const FibreModelPtr model = recording->fibres()[0];
    FibreMeasure ordered(recording->scene(), 0, model, *recording->frame(0));
    FibreMeasure jumping(recording->scene(), 0, model, *recording->frame(0));
    std::vector<double> lengths;
    for (const int k : {0, 10, 20, 30}) {
        ordered.measure(*recording->frame(k), 1.0);
        lengths.push_back(ordered.length_mm().mean);
    }
    CHECK(ordered.series().frame_count() == 4);
    jumping.measure(*recording->frame(30), 1.0);
    CHECK(jumping.length_mm().mean == lengths[3]);
    jumping.measure(*recording->frame(10), 1.0);
    CHECK(jumping.length_mm().mean == lengths[1]);
    CHECK(jumping.series().frame_count() == 2); // rest, and frame 30
}

TEST_CASE("metrics of fibres are not a number without fibres, and say so in the table",
          "[metrics][fibre_measure]") {
    Scene scene = make_embedded_scene("squish-box");
    scene.timeline.last_frame = 1;
    Recording recording(std::make_shared<const Scene>(std::move(scene)));
    run_simulation(recording, {1}, {});
    MetricsEngine engine(recording);
    const std::vector<double> values = engine.measure(*recording.frame(1))[0];
    int of_fibres = 0;
    for (std::size_t r = 0; r < values.size(); ++r) {
        const MetricRow& row = metric_table()[r];
        of_fibres += row.of_fibres ? 1 : 0;
        INFO(row.key);
        if (row.of_fibres)
            CHECK(std::isnan(values[r]));
        if (row.over_run)
            CHECK(row.of_fibres);
    }
    CHECK(of_fibres > 20);
}
