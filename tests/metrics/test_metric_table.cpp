#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "metrics/measured_scene.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <set>

using namespace fascicle;

namespace {

std::vector<std::vector<double>> values_of(MetricsEngine& engine, const Frame& frame) {
    return engine.measure(frame);
}

double value(const std::vector<std::vector<double>>& values, std::size_t muscle, const char* key) {
    const int row = metric_index(key);
    REQUIRE(row >= 0);
    return values.at(muscle).at(static_cast<std::size_t>(row));
}

} // namespace

TEST_CASE("the first columns are those of the contract, keys are unique", "[metrics][metric_table]") {
    const auto& rows = metric_table();
    const std::vector<std::string> first{"volume_ratio",         "edge_extension_mean",
                                         "edge_extension_p99",   "dihedral_change_mean_rad",
                                         "penetrating_vertices", "penetration_max_mm"};
    REQUIRE(rows.size() > first.size());
    std::set<std::string> keys;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i < first.size())
            CHECK(rows[i].key == first[i]);
        CHECK(keys.insert(rows[i].key).second);
        CHECK(rows[i].key.find_first_of(", \"\n") == std::string::npos);
        CHECK_FALSE(rows[i].label.empty());
        CHECK_FALSE(rows[i].unit.empty());
        CHECK_FALSE(rows[i].meaning.empty());
        CHECK(metric_index(rows[i].key) == static_cast<int>(i));
    }
    CHECK(metric_index("no such metric") == -1);
}

TEST_CASE("rest measured against itself", "[metrics][metric_table]") {
    const auto scene = test::scene_of(test::torus(30, 10), {test::box()});
    scene->muscles[0].attachments = {{AttachmentKind::origin, 0, {3, 4}}};
    const Frame rest = test::rest_frame(*scene);
    MetricsEngine engine(scene, rest);
    const auto values = values_of(engine, rest);
    REQUIRE(values.size() == 1);
    REQUIRE(values[0].size() == metric_table().size());
    for (const char* key : {"volume_ratio", "edge_extension_mean", "edge_extension_p1", "edge_extension_p10",
                            "edge_extension_p25", "edge_extension_p50", "edge_extension_p75",
                            "edge_extension_p90", "edge_extension_p99", "edge_extension_max"})
        CHECK(value(values, 0, key) == 1.0);
    for (const char* key : {"dihedral_change_mean_rad",
                            "dihedral_change_p90_rad",
                            "dihedral_change_unsigned_mean_deg",
                            "penetrating_vertices",
                            "penetration_max_mm",
                            "hausdorff_to_rest_mm",
                            "displacement_mean_mm",
                            "displacement_rms_mm",
                            "displacement_max_mm",
                            "attachment_drift_mm",
                            "contacts",
                            "unresolved",
                            "non_finite",
                            "solve_ms",
                            "penetrating_centroids",
                            "centroid_penetration_max_mm",
                            "penetrating_midpoints",
                            "midpoint_penetration_max_mm",
                            "muscle_overlap_mm",
                            "unconverged"})
        CHECK(value(values, 0, key) == 0.0);
}

TEST_CASE("metres and millimetres give the same columns", "[metrics][metric_table]") {
    std::vector<std::vector<double>> columns;
    for (const double unit : {1.0, 0.001}) {
        TriMesh muscle = test::torus(30, 10), bone = test::sphere(12, 3, Vec3(0, 0, 40));
        for (TriMesh* mesh : {&muscle, &bone})
            for (Vec3& p : mesh->positions)
                p *= unit;
        const auto scene =
            test::scene_of(muscle, {bone}, unit == 1.0 ? LengthUnit::millimetre : LengthUnit::metre);
        scene->muscles[0].attachments = {{AttachmentKind::origin, 0, {3, 4}}};
        MetricsEngine engine(scene, test::rest_frame(*scene));
        Frame frame =
            test::frame_of(*scene,
                           test::mapped(muscle.positions,
                                        [&](const Vec3& p) { return Vec3(1.2 * p.x(), p.y(), 1.3 * p.z()); }),
                           {rotation_about(Vec3::Zero(), Vec3(1, 0, 0), 1.0)});
        frame.report.solve_seconds = 0.0125;
        frame.report.contacts = 7;
        columns.push_back(engine.measure(frame)[0]);
    }
    CHECK(columns[0][static_cast<std::size_t>(metric_index("penetrating_vertices"))] > 0);
    CHECK(columns[0][static_cast<std::size_t>(metric_index("attachment_drift_mm"))] > 1);
    CHECK(columns[0][static_cast<std::size_t>(metric_index("solve_ms"))] == Approx(12.5));
    CHECK(columns[0][static_cast<std::size_t>(metric_index("contacts"))] == 7);
    for (std::size_t i = 0; i < metric_table().size(); ++i) {
        INFO(metric_table()[i].key);
        if (metric_table()[i].of_fibres) // there are none
            CHECK((std::isnan(columns[0][i]) && std::isnan(columns[1][i])));
        else
            CHECK(columns[1][i] == Approx(columns[0][i]).margin(1e-9));
    }
}

TEST_CASE("two muscles, attachments of the recording", "[metrics][metric_table]") {
    const auto scene = test::scene_of(test::torus(30, 10), {test::box()});
    scene->muscles.push_back(scene->muscles[0]);
    scene->muscles[1].mesh = test::shared(test::sphere(4, 2));
    Recording recording(scene);
    recording.set_attachments({{{AttachmentKind::origin, 0, {0}}}, {}});
    auto rest = std::make_shared<Frame>(test::rest_frame(*scene));
    rest->muscle_positions.push_back(std::make_shared<const Points>(scene->muscles[1].mesh->positions));
    recording.append(rest);
    Frame frame = *rest;
    frame.muscle_positions[0] = std::make_shared<const Points>(
        test::mapped(*rest->muscle_positions[0], [](const Vec3& p) { return Vec3(p + Vec3(0, 0, 2)); }));
    MetricsEngine engine(recording);
    const auto values = engine.measure(frame);
    REQUIRE(values.size() == 2);
    CHECK(value(values, 0, "attachment_drift_mm") == Approx(2.0));
    CHECK(value(values, 0, "displacement_rms_mm") == Approx(2.0));
    CHECK(value(values, 1, "attachment_drift_mm") == 0.0);
    CHECK(value(values, 1, "displacement_max_mm") == 0.0);
    CHECK(engine.muscle(0).rest_distance().max == Approx(2.0));
    // Without the recording the attachments that are found automatically are not known.
    MetricsEngine unknown(scene, *rest);
    CHECK(std::isnan(value(unknown.measure(frame), 0, "attachment_drift_mm")));
}
