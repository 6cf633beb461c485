#include "fascicle/metrics/run_difference.hpp"
#include "metrics/measured_scene.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace fascicle;

namespace {

/// Frames of the given indices; frame k has the muscle's points moved by k times `step`.
RecordingPtr moving(const std::shared_ptr<Scene>& scene, const std::vector<int>& indices, const Vec3& step) {
    auto recording = std::make_shared<Recording>(scene);
    recording->set_attachments({{}});
    for (const int index : indices) {
        Frame frame =
            test::frame_of(*scene, test::mapped(scene->muscles[0].mesh->positions,
                                                [&](const Vec3& p) { return Vec3(p + index * step); }));
        frame.index = index;
        recording->append(std::make_shared<const Frame>(std::move(frame)));
    }
    recording->finish(RunState::finished);
    return recording;
}

} // namespace

TEST_CASE("A shifted copy is as far away as the shift, at every vertex", "[metrics][compare]") {
    const Points points = test::sphere(10, 2).positions;
    const Vec3 shift(3, 4, 12);
    const Points moved = test::mapped(points, [&](const Vec3& p) { return Vec3(p + shift); });
    const PointDistance distance = point_distance(points, moved, 1000);
    CHECK(distance.rms_mm == Approx(13'000));
    CHECK(distance.max_mm == Approx(13'000));
    for (const double mm : vertex_distances_mm(points, moved, 1))
        CHECK(mm == Approx(13));
    CHECK(point_distance(points, points, 1).rms_mm == 0);
    CHECK(point_distance({}, {}, 1).vertex == -1);
}

TEST_CASE("Distances between two shapes are those of a loop over all coordinates", "[metrics][compare]") {
    const Points a = test::sphere(10, 2).positions;
    Points b = a;
    for (std::size_t i = 0; i < b.size(); ++i)
        b[i] += Vec3(std::sin(double(i)), 0.1 * double(i % 7), i == 31 ? 9.0 : 0.0);
    double sum = 0, largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += (a[i][c] - b[i][c]) * (a[i][c] - b[i][c]);
        sum += square;
        largest = std::max(largest, std::sqrt(square));
    }
    const PointDistance distance = point_distance(a, b, 1);
    CHECK(distance.rms_mm == Approx(std::sqrt(sum / double(a.size()))));
    CHECK(distance.max_mm == Approx(largest));
    CHECK(distance.vertex == 31);
    b[3].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(point_distance(a, b, 1).rms_mm));
}

TEST_CASE("Runs are compared frame by frame of the same number", "[metrics][compare]") {
    const auto scene = test::scene_of(test::sphere(10, 1));
    const RecordingPtr a = moving(scene, {0, 1, 2, 3, 4, 5}, Vec3::Zero());
    const RecordingPtr b = moving(scene, {0, 2, 4, 6, 8}, Vec3(0, 1, 0));
    const RunMatch match = match_runs(a->scene(), b->scene());
    REQUIRE(match.comparable());
    const std::vector<FrameDifference> frames = run_difference(*a, *b, match);
    REQUIRE(frames.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(frames[i].index == static_cast<int>(2 * i));
        CHECK(frames[i].muscles[0].rms_mm == Approx(2.0 * double(i)));
    }
    const std::vector<DifferenceSummary> all = summarise(match, frames);
    CHECK(all[0].max_index == 4);
    CHECK(all[0].max_mm == Approx(4));
    CHECK(all[0].rms_mm == Approx(std::sqrt((0.0 + 4 + 16) / 3)));
    CHECK(run_difference(*a, *b, match, {}, 1, 1).size() == 1); // in parts
    CHECK(run_difference(*a, *b, match, {}, 1, 1)[0].index == 2);
    CHECK(frame_not_after(*b, 5)->index == 4);
    CHECK(frame_not_after(*b, 100)->index == 8);
    CHECK(frame_not_after(*b, 0)->index == 0);
    std::atomic<bool> stop{true};
    JobControl control;
    control.cancel = &stop;
    CHECK_THROWS_AS(run_difference(*a, *b, match, control), Cancelled);
}

TEST_CASE("Runs that do not belong together are refused with the reason", "[metrics][compare]") {
    const auto scene = test::scene_of(test::sphere(10, 1));
    auto other = test::scene_of(test::sphere(10, 2));
    CHECK(match_runs(*scene, *other).reason ==
          "muscle has other meshes: 18 vertices and 32 triangles in A, 66 vertices and 128 triangles in B");
    other = test::scene_of(test::sphere(10, 1));
    CHECK(match_runs(*scene, *other).comparable()); // read from a file: another mesh of the same vertices
    other->muscles[0].name = "soleus";
    CHECK(match_runs(*scene, *other).reason == "muscle is only in A");
    other->muscles.push_back(scene->muscles[0]);
    const RunMatch some = match_runs(*scene, *other);
    CHECK(some.comparable());
    REQUIRE(some.muscles.size() == 1);
    CHECK(some.muscles[0].b == 1);
    CHECK(some.left_out == std::vector<std::string>{"soleus is only in B"});
    other->unit = LengthUnit::metre;
    CHECK(match_runs(*scene, *other).reason == "lengths are in mm in A and in m in B");
    CHECK_FALSE(match_runs(Scene{}, Scene{}).comparable());
}

TEST_CASE("A muscle that was renamed between two runs is known by its mesh", "[metrics][compare]") {
    Scene a;
    for (const char* name : {"biceps", "triceps"}) {
        a.muscles.emplace_back().name = name;
        a.muscles.back().mesh = std::make_shared<TriMesh>(test::sphere(10, 2));
    }
    Scene b = a;
    b.muscles[0].name = "biceps_long_head";
    RunMatch match = match_runs(a, b);
    REQUIRE(match.muscles.size() == 2);
    CHECK(match.left_out.empty());
    CHECK(match.muscles[0].a == 0);
    CHECK(match.muscles[0].b == 0);
    // A name counts before a mesh; and another mesh is another muscle.
    b.muscles[0].mesh = std::make_shared<TriMesh>(test::sphere(10, 2));
    match = match_runs(a, b);
    CHECK(match.muscles.size() == 1);
    CHECK(match.left_out.size() == 2);
}

TEST_CASE("Parameters that differ are listed with both values", "[metrics][compare]") {
    ParamSet a = default_parameters(), b = a;
    CHECK(parameter_differences(a, b).empty());
    b.set("solver.stiffness", 0.25);
    set_method(a, "classic");
    a.set("solver.stiffness", 0.75);
    bool stiffness = false, method = false;
    for (const ParamDifference& row : parameter_differences(a, b)) {
        if (row.row->key == "solver.stiffness") {
            stiffness = true;
            CHECK(row.a == "0.75");
            CHECK(row.b == "0.25");
        }
        method |= row.row->key == "solver.method" && row.a == "classic" && row.b == "xpbd";
        CHECK(row.a != row.b);
    }
    CHECK(stiffness);
    CHECK(method);
}

TEST_CASE("Differences of metrics are B minus A, and none where one has no value", "[metrics][compare]") {
    const auto scene = test::scene_of(test::sphere(10, 2));
    const RecordingPtr a = moving(scene, {0, 1, 2}, Vec3(1, 0, 0));
    auto b = std::make_shared<Recording>(scene);
    b->set_attachments({{}});
    for (int k = 0; k < 2; ++k) { // grows by a tenth a frame
        Frame frame =
            test::frame_of(*scene, test::mapped(scene->muscles[0].mesh->positions,
                                                [&](const Vec3& p) { return Vec3(p * (1 + 0.1 * k)); }));
        frame.index = k;
        b->append(std::make_shared<const Frame>(std::move(frame)));
    }
    const MetricRows ra = measure_run(*a), rb = measure_run(*b);
    REQUIRE(ra.size() == 3);
    const int volume = metric_index("volume_ratio"), fibres = metric_index("fibre_length_mean_mm");
    const MatchedMuscle muscle{"muscle", 0, 0};
    const std::vector<FramePair> pairs = common_frames(*a, *b);
    REQUIRE(pairs.size() == 2);
    CHECK(metric_difference(ra, rb, pairs[0], muscle, volume) == Approx(0).margin(1e-12));
    CHECK(metric_difference(ra, rb, pairs[1], muscle, volume) == Approx(1.1 * 1.1 * 1.1 - 1));
    CHECK(std::isnan(metric_difference(ra, rb, pairs[1], muscle, fibres)));
    CHECK(std::isnan(metric_difference(ra, {}, pairs[1], muscle, volume)));
    CHECK(comparable_metric(metric_table()[static_cast<std::size_t>(volume)]));
    CHECK_FALSE(comparable_metric(metric_table()[static_cast<std::size_t>(metric_index("solve_ms"))]));
}
