#include "fascicle/metrics/fibre_series.hpp"

#include "fascicle/base/error.hpp"
#include "support/fibres.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace fascicle;
using namespace fascicle::test;
using Catch::Matchers::Contains;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// Two straight fibres whose lengths are 100 - 10 a and 50 + 20 a, and one without a length.
FibreSet fibres_at(double angle, double unit_mm = 1.0) {
    return straight_fibres({{Vec3(0, 0, 0), Vec3((100 - 10 * angle) / unit_mm, 0, 0)},
                            {Vec3(0, 1, 0), Vec3(0, 1, (50 + 20 * angle) / unit_mm)},
                            {Vec3(1, 1, 1), Vec3(1, 1, 1)}},
                           4);
}

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

} // namespace

TEST_CASE("a band holds the order statistics of what is finite", "[metrics][fibre]") {
    std::vector<double> values;
    for (int i = 0; i <= 100; ++i)
        values.push_back((i * 37) % 101);
    values.push_back(std::numeric_limits<double>::quiet_NaN());
    const Band band = band_of(values);
    CHECK(band.count == 101);
    CHECK(band.mean == Approx(50.0));
    CHECK(band.min == 0.0);
    CHECK(band.p5 == Approx(5.0));
    CHECK(band.p25 == Approx(25.0));
    CHECK(band.p50 == Approx(50.0));
    CHECK(band.p75 == Approx(75.0));
    CHECK(band.p95 == Approx(95.0));
    CHECK(band.max == 100.0);
    const Band none = band_of({});
    CHECK(none.count == 0);
    CHECK(std::isnan(none.mean));
    CHECK(std::isnan(none.p50));
}

TEST_CASE("a series in millimetres, degrees and against rest", "[metrics][fibre]") {
    for (const double unit_mm : {1.0, 1000.0}) {
        FibreSeries series("m", unit_mm, -1.0);
        CHECK(series.fibre_count() == 0);
        for (int k = 0; k <= 20; ++k)
            series.append(10 * k, -0.05 * k, fibres_at(0.05 * k, unit_mm));
        REQUIRE(series.frame_count() == 21);
        CHECK(series.fibre_count() == 3);
        CHECK(series.index_of(50) == 5);
        CHECK(series.index_of(55) == -1);
        CHECK(series.index_of(500) == -1);
        CHECK(series.angle_rad(5) == -0.25);
        CHECK(series.value(FibreQuantity::length, 20, 0) == Approx(90.0));
        CHECK(series.value(FibreQuantity::strain, 20, 0) == Approx(-0.1));
        CHECK(series.value(FibreQuantity::strain, 20, 1) == Approx(0.4));
        CHECK(std::isnan(series.value(FibreQuantity::strain, 20, 2)));
        CHECK(series.value(FibreQuantity::moment_arm, 7, 0) == Approx(10.0)); // shortens on the way out
        CHECK(series.value(FibreQuantity::moment_arm, 7, 1) == Approx(-20.0));
        CHECK(series.value(FibreQuantity::moment_arm, 7, 2) == Approx(0.0).margin(1e-9));
        // The two directions are at right angles; their mean is 45 degrees from both.
        CHECK(series.value(FibreQuantity::pennation_origin, 3, 0) == Approx(45.0));
        CHECK(series.course(FibreQuantity::length, 1).back() == Approx(70.0));
        CHECK(series.values(FibreQuantity::length, 0) == std::vector<double>{100, 50, 0});
        const Band band = series.band(FibreQuantity::strain, 20);
        CHECK(band.count == 2);
        CHECK(band.mean == Approx(0.15));
    }
}

TEST_CASE("arms frame by frame are those of the frames so far", "[metrics][fibre]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    for (const ArmMethod method : {ArmMethod::polynomial, ArmMethod::central_difference})
        for (int round = 0; round < 8; ++round) {
            ArmOptions options;
            options.method = method;
            FibreSeries series("m", 1.0, 1.0, options);
            std::vector<double> angles, lengths;
            double angle = 0.0, speed = 0.03;
            for (int k = 0; k < 120; ++k) {
                if (number(random) < 0.06) // turns, stands still, goes on
                    speed = number(random) < 0.4 ? 0.0 : 0.1 * (number(random) - 0.5);
                angle += speed + (round % 2 == 0 ? 0.0 : 0.002 * (number(random) - 0.5));
                const double a = 0.3 * std::sin(angle) + 0.01 * number(random);
                series.append(k, angle, fibres_at(a));
                angles.push_back(angle);
                for (const double l : series.values(FibreQuantity::length, k))
                    lengths.push_back(l);
                if (round < 6 ? k % (round + 1) != 0 : k != 119)
                    continue;
                const std::vector<double> all = excursion_arms(angles, lengths, 3, 1.0, options);
                bool equal = true;
                for (int i = 0; i <= k; ++i)
                    for (int f = 0; f < 3; ++f)
                        equal = equal && same(series.value(FibreQuantity::moment_arm, i, f),
                                              all[std::size_t(3 * i + f)]);
                CHECK(equal);
            }
        }
}

TEST_CASE("a series refuses what it cannot measure and stays as it was", "[metrics][fibre]") {
    FibreSeries series("psoas", 1.0, 1.0);
    series.append(0, 0.0, fibres_at(0));
    FibreSet bad = fibres_at(0.1);
    bad.points[7].z() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(series.append(1, 0.1, bad), Contains("fibres of psoas, frame 1: point 2 of fibre 1"));
    CHECK_THROWS_WITH(series.append(1, std::nan(""), fibres_at(0.1)), Contains("angle is not finite"));
    CHECK_THROWS_WITH(series.append(1, 0.1, straight_fibres({{Vec3(0, 0, 0), Vec3(1, 0, 0)}}, 4)),
                      Contains("1 fibres of 4 segments; expected 3 of 4"));
    CHECK(series.frame_count() == 1);
    series.append(1, 0.1, fibres_at(0.1));
    CHECK(series.value(FibreQuantity::moment_arm, 1, 0) == Approx(10.0));
    // No motion, no arm; no fibres, no trouble.
    FibreSeries still("m", 1.0, 1.0);
    still.append(0, 0.0, fibres_at(0));
    still.append(1, 0.0, fibres_at(0.2));
    CHECK(std::isnan(still.value(FibreQuantity::moment_arm, 1, 0)));
    CHECK(still.band(FibreQuantity::moment_arm, 1).count == 0);
    FibreSeries empty("m", 1.0, 1.0);
    empty.append(0, 0.0, FibreSet{});
    empty.append(1, 1.0, FibreSet{});
    CHECK(empty.values(FibreQuantity::moment_arm, 1).empty());
}

TEST_CASE("every quantity of a fibre has its row", "[metrics][fibre]") {
    const auto rows = fibre_quantities();
    REQUIRE(rows.size() == 5);
    for (std::size_t i = 0; i < rows.size(); ++i)
        CHECK(static_cast<std::size_t>(rows[i].quantity) == i);
    CHECK(std::string(rows[0].key) == "length_mm");
    CHECK(std::string(rows[2].key) == "moment_arm_mm");
}

TEST_CASE("the hip's sign: flexors shorten and have positive arms", "[metrics][fibre]") {
    // A fibre in front of the head (an iliacus) and one behind it (a gluteus maximus), straight, about the hinge of the
    // hip data; LPS axes, so the front is -y and flexion a negative angle about +x.
    const Hinge hip{Vec3(143.86, 243.37, -432.53), Vec3(1, 0, 0)};
    const Timeline timeline = make_hinge_timeline(hip, -60 * degree, Phases{60, 60, 10}, 1, {0});
    FibreSeries series("m", 1.0, flexion_sign(timeline));
    std::vector<double> lines;
    for (int k = 0; k <= timeline.last_frame; ++k) {
        const Pose femur = timeline.bone_pose(0, k);
        const FibreSet fibres = straight_fibres({{Vec3(144, 200, -370), femur.apply(Vec3(140, 212, -480))},
                                                 {Vec3(144, 300, -360), femur.apply(Vec3(105, 290, -520))}},
                                                3);
        series.append(k, timeline.angle_rad(k), fibres);
        for (const double r : line_arms(fibres, FibreEnd::insertion, hip, series.sign()))
            lines.push_back(r);
    }
    for (const int k : {0, 20, 50, 60, 75, 110, 130}) {
        const double flexor = series.value(FibreQuantity::moment_arm, k, 0);
        const double extensor = series.value(FibreQuantity::moment_arm, k, 1);
        CHECK(flexor > 20.0);
        CHECK(extensor < (k == 0 || k == 20 ? -20.0 : -4.0));
        CHECK(flexor == Approx(lines[std::size_t(2 * k)]).margin(0.3));
        CHECK(extensor == Approx(lines[std::size_t(2 * k + 1)]).margin(0.3));
    }
    CHECK(series.value(FibreQuantity::strain, 60, 0) < 0.0);
    CHECK(series.value(FibreQuantity::strain, 60, 1) > 0.0);
}
