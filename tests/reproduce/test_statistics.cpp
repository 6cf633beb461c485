#include "reproduce/arm_shares.hpp"
#include "reproduce/findings.hpp"
#include "reproduce/sensitivity.hpp"
#include "reproduce/speed.hpp"
#include "reproduce/statistics.hpp"
#include "reproduce/surface_distance.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace fascicle;
using namespace fascicle::reproduce;

namespace {
const double none = std::numeric_limits<double>::quiet_NaN();
}

TEST_CASE("reproduce: equal values share their ranks", "[reproduce][unit]") {
    CHECK(ranks(std::vector<double>{10, 30, 20, 30, 30}) == std::vector<double>{1, 4, 2, 4, 4});
    CHECK(ranks(std::vector<double>{}).empty());
    const std::vector<double> with_gap = ranks(std::vector<double>{5, none, 1});
    CHECK(with_gap[0] == 2);
    CHECK(std::isnan(with_gap[1]));
    CHECK(with_gap[2] == 1);
}

TEST_CASE("reproduce: rank correlation of known lists", "[reproduce][unit]") {
    // The paper's own table: the more triangles, the fewer frames a second, without exception.
    const std::vector<double> triangles{19752, 17124, 13858, 10622, 5292},
        speeds{33.85, 35.89, 47.21, 57.12, 153.61};
    CHECK(spearman(triangles, speeds) == -1);
    // Without ties rho = 1 - 6 sum d^2 / (n (n^2 - 1)): sums of squared rank differences 4 and 32.
    CHECK(spearman(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{2, 1, 4, 3, 5}) == Approx(0.8));
    CHECK(spearman(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{5, 2, 3, 4, 1}) == Approx(-0.6));
    CHECK(spearman(std::vector<double>{1, 2, 3, 4}, std::vector<double>{1, 3, 2, 4}) == Approx(0.8));
    // With ties, ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: Pearson 4.5 / sqrt(4.5 * 5).
    CHECK(spearman(std::vector<double>{1, 2, 2, 3}, std::vector<double>{1, 2, 3, 4}) ==
          Approx(4.5 / std::sqrt(4.5 * 5)));
    // Any increasing map of either list changes nothing.
    CHECK(spearman(std::vector<double>{1, 8, 27, 64}, std::vector<double>{1, 3, 2, 4}) == Approx(0.8));
}

TEST_CASE("reproduce: rank correlation without an answer is not a number", "[reproduce][unit]") {
    CHECK(std::isnan(spearman(std::vector<double>{1}, std::vector<double>{2})));
    CHECK(std::isnan(spearman(std::vector<double>{1, 1, 1}, std::vector<double>{1, 2, 3})));
    CHECK(std::isnan(spearman(std::vector<double>{1, none}, std::vector<double>{2, 3})));
    CHECK(spearman(std::vector<double>{1, none, 2}, std::vector<double>{2, 3, 7}) == 1);
}

TEST_CASE("reproduce: speed rows are correlated by method and threads", "[reproduce][unit]") {
    const std::vector<SpeedRow> rows{{"a", "x", false, 100, 1, 1, 50},
                                     {"b", "x", false, 200, 1, 1, 20},
                                     {"a", "x", false, 100, 2, 1, 50},
                                     {"b", "x", false, 200, 2, 1, 60},
                                     {"a", "y", false, 100, 1, 1, 9}};
    const auto groups = speed_correlations(rows);
    REQUIRE(groups.size() == 3);
    CHECK((groups[0].method == "x" && groups[0].threads == 1 && groups[0].rho == -1));
    CHECK((groups[1].threads == 2 && groups[1].rho == 1));
    CHECK((groups[2].method == "y" && groups[2].objects == 1 && std::isnan(groups[2].rho)));
}

TEST_CASE("reproduce: the share of poses inside a band is linear between its points", "[reproduce][unit]") {
    const std::vector<BandPoint> band{{0, 0, 10}, {10, 10, 30}};
    const std::vector<double> x{0, 5, 10, 10, 20}, y{10, 5, 9.999, 30, 20};
    // Inside at its edge, inside at 5 (5 to 20), outside, inside at its edge; 20 has no band.
    CHECK(percent_inside(x, y, band) == Approx(75));
    CHECK(std::isnan(percent_inside(x, y, {})));
    CHECK(std::isnan(percent_inside(std::vector<double>{20}, std::vector<double>{1}, band)));
    CHECK(percent_inside(std::vector<double>{0, 1}, std::vector<double>{none, 2}, band) == 100);
}

TEST_CASE("reproduce: spans and distances leave out what is not finite", "[reproduce][unit]") {
    const Span3 span = span_of(std::vector<double>{none, 3, 1, 2});
    CHECK((span.least == 1 && span.mean == 2 && span.greatest == 3));
    CHECK(std::isnan(span_of(std::vector<double>{}).mean));
    CHECK(farthest(std::vector<double>{1.1, none, 0.7}, 1) == Approx(0.3));
    CHECK(std::isnan(farthest(std::vector<double>{none}, 1)));
    CHECK(interpolated(std::vector<double>{0, 2}, std::vector<double>{10, 30}, 0.5) == 15);
    CHECK(std::isnan(interpolated(std::vector<double>{0, 2}, std::vector<double>{10, 30}, 2.5)));
}

TEST_CASE("reproduce: less is better by a tenth", "[reproduce][unit]") {
    CHECK(judge(0.5, 1, 0.01) == Verdict::better);
    CHECK(judge(0.95, 1, 0.01) == Verdict::kept);
    CHECK(judge(1.2, 1, 0.01) == Verdict::worse);
    CHECK(judge(0.009, 0.001, 0.01) == Verdict::kept);
    CHECK(judge(none, 1, 0.01) == Verdict::shown);
}

TEST_CASE("reproduce: distance of a shifted box is the shift at most", "[reproduce][unit]") {
    const TriMesh box = test::box(10, 10, 10);
    Points moved = box.positions;
    for (Vec3& p : moved)
        p += Vec3(0, 0, 1);
    const SurfaceDistance same = surface_distance(box.positions, box.positions, box.triangles, 1);
    CHECK((same.mean == 0 && same.max == 0));
    // The four lower corners of the one and the four upper ones of the other are 1 off; the others lie on the sides.
    const SurfaceDistance apart = surface_distance(box.positions, moved, box.triangles, 1000);
    CHECK(apart.mean == Approx(500));
    CHECK(apart.max == Approx(1000));
    moved[0].x() = none;
    CHECK(std::isnan(surface_distance(box.positions, moved, box.triangles, 1).mean));
}

TEST_CASE("reproduce: an effect counts as another beyond a quarter and noise", "[reproduce][unit]") {
    CHECK_FALSE(effects_differ(1.0, 0.8, 0.01));
    CHECK(effects_differ(1.0, 0.7, 0.01));
    CHECK(effects_differ(0.5, -0.5, 0.01));
    CHECK_FALSE(effects_differ(0.5, -0.5, 2));
}

TEST_CASE("reproduce: a remeshed muscle keeps shape and attachments", "[reproduce][unit]") {
    Muscle muscle;
    auto mesh = std::make_shared<TriMesh>(test::sphere(10, 3));
    Attachment top{AttachmentKind::origin, 0, {}};
    for (int v = 0; v < mesh->vertex_count(); ++v)
        if (mesh->positions[static_cast<std::size_t>(v)].z() > 8)
            top.vertices.push_back(v);
    muscle.attachments = {top};
    muscle.mesh = mesh;
    const Muscle half = remeshed(muscle, mesh->triangle_count() / 2);
    CHECK(half.mesh->triangle_count() <= mesh->triangle_count() / 2);
    CHECK(half.mesh->triangle_count() > mesh->triangle_count() / 3);
    REQUIRE_FALSE(half.attachments[0].vertices.empty());
    for (const int v : half.attachments[0].vertices)
        CHECK(half.mesh->positions[static_cast<std::size_t>(v)].z() > 7.5);
    for (const Vec3& p : half.mesh->positions)
        CHECK(p.norm() == Approx(10).epsilon(0.03)); // the octahedron sphere is that coarse
}

TEST_CASE("reproduce: the way out ends where the angle is greatest", "[reproduce][unit]") {
    RunData run;
    run.angle_deg = {0, -20, -40, -40, -20, 0};
    const WayOut poses = way_out(run);
    CHECK(poses.places == std::vector<std::size_t>{0, 1, 2});
    CHECK(poses.flexion_deg == std::vector<double>{0, 20, 40});
    LineNumbers lines;
    lines.names = {"glut_max1_r", "iliacus_r"};
    lines.moment_arm_mm = {1, 3, 2, 4, none, 5};
    CHECK(mean_arms(lines, poses) == std::vector<double>{2, 3, 5});
    CHECK(lines_of("iliacus", lines) == std::vector<std::size_t>{1});
    run.angle_deg.assign(6, 0.0);
    CHECK(way_out(run).places.empty());
}
