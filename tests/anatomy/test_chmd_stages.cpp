// The stages of CHMD, each against a closed form.
#include "anatomy/chmd/curve_tools.hpp"
#include "anatomy/chmd/ends.hpp"
#include "anatomy/chmd/finish.hpp"
#include "anatomy/chmd_cases.hpp"
#include "geometry/surface_oracles.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::chmd;

namespace {

/// What decompose_chmd makes first, kept together.
struct Net {
    FibreProblem problem;
    SolidQuery solid;
    PatchSurface origin, insertion;
    ControlFibres control;
    Rows rows;
    explicit Net(const FibreProblem& p)
        : problem(p), solid(*p.surface), origin(make_patch_surface(p, AttachmentKind::origin)),
          insertion(make_patch_surface(p, AttachmentKind::insertion)),
          control(order_control_fibres(p, solid, origin, insertion)), rows(p, solid, control) {}
};

} // namespace

TEST_CASE("control fibres run from origin to insertion, side by side, left to right from outside",
          "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case();
    const Net net(box.problem(100, 15));
    REQUIRE(net.control.count() == 3);
    CHECK(net.control.rows() == 10); // 90 mm
    // Seen from the front (against +y) with the origin up, +x is to the right.
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 10; ++j) {
            const Vec3 expected(10 + 20 * i, 0, 95 - 10 * j);
            CHECK((net.control.fibres[std::size_t(i)][std::size_t(j)] - expected).norm() < 0.2);
        }
    CHECK(net.control.farthest < 1e-12);

    for (Vec3& p : box.fibres.points) // on its back left and right change places
        p.y() = 20.0;
    const Net behind(box.problem(100, 15));
    for (int i = 0; i < 3; ++i)
        CHECK(behind.control.fibres[std::size_t(i)].front().x() == Approx(50.0 - 20.0 * i));
}

TEST_CASE("a control fibre that is as near either way runs as its neighbours do", "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case();
    box.fibres = {};
    box.add_fibre({Vec3(10, 0, 95), Vec3(10, 0, 5)});
    box.add_fibre({Vec3(30, 0, 47), Vec3(30, 0, 53)});
    box.add_fibre({Vec3(50, 0, 5), Vec3(50, 0, 95)});
    // Over and under the middle fibre there is an origin and an insertion each.
    box.patches.clear();
    const auto middle = [](const Vec3& p) { return p.x() > 24.0 && p.x() < 36.0; };
    box.add_patch(AttachmentKind::origin, [&](const Vec3& p) { return p.z() > 99.9; });
    box.add_patch(AttachmentKind::origin, [&](const Vec3& p) { return p.z() < 0.1 && middle(p); });
    box.add_patch(AttachmentKind::insertion, [&](const Vec3& p) { return p.z() < 0.1; });
    box.add_patch(AttachmentKind::insertion, [&](const Vec3& p) { return p.z() > 99.9 && middle(p); });
    const Net net(box.problem(100, 15));
    for (const Points& fibre : net.control.fibres)
        CHECK(fibre.front().z() > fibre.back().z());
}

TEST_CASE("a line that only grazes the muscle at its rim is moved in", "[anatomy][chmd]") {
    test::ChmdCase ellipsoid = test::ellipsoid_case(5);
    ellipsoid.fibres = {};
    for (const double x : {-29.99, -10.0, 10.0, 33.0}) { // grazing, inside twice, beside the muscle
        const double y = -15.0 * std::sqrt(std::max(0.0, 1.0 - x * x / 900.0));
        ellipsoid.add_fibre({Vec3(x, y, 8), Vec3(x, y, 0), Vec3(x, y, -8)});
    }
    const Net net(ellipsoid.problem(100, 15));
    const int middle = net.rows.rows() / 2;
    for (const Thickness& line : {net.rows.thickness(middle, 0, 0.0), net.rows.thickness(middle, 2, 1.0)}) {
        CHECK(line.length() > 8.0);
        CHECK(std::abs(line.top.x()) < 29.0);
    }
}

TEST_CASE("thickness of a box", "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case();
    const Net net(box.problem(100, 15));
    for (int j = 0; j < net.rows.rows(); ++j)
        for (int span = 0; span < 2; ++span)
            for (const double share : {0.0, 0.3, 0.8}) {
                const Thickness line = net.rows.thickness(j, span, share);
                CHECK((net.rows.normal(j, span, share) + Vec3::UnitY()).norm() < 1e-9);
                CHECK(line.length() == Approx(20.0).epsilon(1e-9));
                CHECK(std::abs(line.top.y()) < 1e-9);
                CHECK_FALSE(net.rows.gap(j, span).open);
            }
    CHECK_FALSE(net.rows.splits(0, true));
}

TEST_CASE("thickness of an ellipsoid", "[anatomy][chmd]") {
    test::ChmdCase ellipsoid = test::ellipsoid_case(5);
    const Net net(ellipsoid.problem(100, 15));
    const Vec3 r = test::ellipsoid_radii;
    for (int j = 3; j + 3 < net.rows.rows(); ++j)
        for (int span = 0; span < net.rows.spans(); ++span)
            for (const double share : {0.0, 0.5}) {
                const Thickness line = net.rows.thickness(j, span, share);
                const Vec3 p = line.top.cwiseQuotient(r),
                           d = -net.rows.normal(j, span, share).cwiseQuotient(r);
                // |p + t d|^2 = 1 with |p| = 1.
                CHECK(line.length() == Approx(-2.0 * p.dot(d) / d.squaredNorm()).epsilon(0.01));
                CHECK(p.norm() == Approx(1.0).epsilon(0.01));
            }
}

TEST_CASE("a gap between two bars is found where it is", "[anatomy][chmd]") {
    test::ChmdCase bars = test::two_bars_case();
    const Net net(bars.problem(100, 15));
    REQUIRE(net.rows.spans() == 1);
    for (int j = 0; j < net.rows.rows(); ++j) {
        const Gap& gap = net.rows.gap(j, 0);
        CHECK(gap.open);
        CHECK(gap.left == Approx(0.25).margin(0.015)); // x = 10 + 40 share; lines lean a little at the edges
        CHECK(gap.right == Approx(0.75).margin(0.015));
        CHECK(net.rows.place(j, 0, 0.25).x() == Approx(10.0 + 20.0 * gap.left)); // half way to the edge
        CHECK(net.rows.place(j, 0, 0.5).x() == Approx(10.0 + 40.0 * gap.left));
        CHECK(net.rows.place(j, 0, 0.51).x() == Approx(10.0 + 40.0 * (1.0 - 0.98 * (1.0 - gap.right))));
    }
    CHECK(net.rows.splits(0, true));
    CHECK(net.rows.splits(0, false));
}

TEST_CASE("lines that run into another part of the muscle are cut to their neighbours' length",
          "[anatomy][chmd]") {
    std::vector<Thickness> lines;
    for (int j = 0; j < 12; ++j)
        lines.push_back({Vec3(0, 0, 10 * j), Vec3(0, 10, 10 * j), true});
    const std::vector<Thickness> even = lines;
    for (const int wrong : {0, 1, 6, 11})
        lines[std::size_t(wrong)].bottom.y() = 80;
    even_out(lines);
    for (std::size_t j = 0; j < lines.size(); ++j) {
        CHECK((lines[j].top - even[j].top).norm() < 1e-12);
        CHECK((lines[j].bottom - even[j].bottom).norm() < 1e-12);
    }
    // Muscles that taper are left alone but for the smoothing; one line of its own too.
    for (std::size_t j = 0; j < lines.size(); ++j)
        lines[j].bottom.y() = 10.0 + double(j);
    even_out(lines);
    for (std::size_t j = 0; j < lines.size(); ++j)
        CHECK(lines[j].bottom.y() == Approx(10.0 + double(j)));
    std::vector<Thickness> one{{Vec3::Zero(), Vec3::UnitX(), true}};
    even_out(one);
    CHECK(one[0].bottom == Vec3::UnitX());
}

TEST_CASE("as many strands as wanted, in layers inside the muscle", "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case(), ellipsoid = test::ellipsoid_case(), bars = test::two_bars_case();
    for (test::ChmdCase* made : {&box, &ellipsoid, &bars})
        for (const int count : {1, 2, 3, 17, 100, 451, 2000}) {
            const Net net(made->problem(count, 15));
            const std::vector<Strand> strands = make_strands(net.problem, net.rows);
            REQUIRE(strands.size() == std::size_t(count));
            double shallow = 1, deep = 0;
            for (const Strand& strand : strands) {
                REQUIRE(strand.path.size() == std::size_t(net.rows.rows()));
                shallow = std::min(shallow, strand.depth);
                deep = std::max(deep, strand.depth);
            }
            if (count >= 17) {
                CHECK(shallow == 0.0);
                CHECK(deep == 1.0);
            }
            if (made == &box && count == 1)
                CHECK((strands[0].path[5] - Vec3(30, 10, 45)).norm() < 11.0); // about the middle
            if (count > 100)
                continue;
            for (const Strand& strand : strands)
                for (const Vec3& p : strand.path) {
                    double outside = net.solid.signed_distance(p);
                    if (made == &box)          // exactly known
                        CHECK(outside <= 3.6); // side strands bulge out of a box until they are put inside
                    else if (made == &bars)
                        CHECK(outside <= 2.6);
                    else
                        CHECK(outside <= 1.0);
                }
        }
}

TEST_CASE("strands of a box without sides are exactly inside, at their depth", "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case();
    const Net net(box.problem(400, 15));
    int between = 0, shifted = 0;
    const std::vector<Strand> strands = make_strands(net.problem, net.rows);
    for (const Strand& strand : strands) {
        const bool side = strand.path[3].x() < 9.9 || strand.path[3].x() > 50.1;
        for (const Vec3& p : strand.path)
            if (!side) {
                CHECK(p.y() == Approx(20.0 * strand.depth).margin(1e-6));
                CHECK((p.z() >= 4.9 && p.z() <= 95.1));
            }
        if (strand.depth == 0.0 || strand.depth == 1.0 || side)
            continue;
        ++between;
        bool in_column = false; // of a strand on the surface
        for (const Strand& other : strands)
            in_column =
                in_column || (other.depth == 0.0 && std::abs(other.path[3].x() - strand.path[3].x()) < 1e-6);
        shifted += in_column ? 0 : 1;
    }
    CHECK(shifted > between * 3 / 4); // no rake
    CHECK(between > 150);
}

TEST_CASE("attachment samples are spread evenly over the patch", "[anatomy][chmd]") {
    test::ChmdCase box = test::box_case();
    const FibreProblem problem = box.problem(100, 15);
    const PatchSurface patch = make_patch_surface(problem, AttachmentKind::origin);
    CHECK(patch.triangles.size() == 2 * 12 * 4);
    const Points samples = sample_patch(box.mesh.positions, patch.triangles, 240, 5);
    REQUIRE(samples.size() == 240);
    int right = 0, upper = 0;
    for (const Vec3& p : samples) {
        CHECK(p.z() == Approx(100.0));
        CHECK((p.x() >= 0 && p.x() <= 60 && p.y() >= 0 && p.y() <= 20));
        right += p.x() > 30 ? 1 : 0;
        upper += p.y() > 10 ? 1 : 0;
    }
    CHECK(std::abs(right - 120) <= 12);
    CHECK(std::abs(upper - 120) <= 20);
    // Vertices that span no triangle, or triangles without area: still as many as wanted, on the patch.
    const Points on_points = sample_patch(box.mesh.positions, {{0, 0, 0}, {3, 3, 3}}, 10, 5);
    REQUIRE(on_points.size() == 10);
    int first = 0;
    for (const Vec3& p : on_points) {
        CHECK(std::min((p - box.mesh.positions[0]).norm(), (p - box.mesh.positions[3]).norm()) < 1e-9);
        first += (p - box.mesh.positions[0]).norm() < 1e-9 ? 1 : 0;
    }
    CHECK(first == 5);
}

TEST_CASE("equal arcs of a polyline", "[anatomy][chmd]") {
    const Points corner{Vec3(0, 0, 0), Vec3(6, 0, 0), Vec3(6, 2, 0)};
    CHECK(polyline_length(corner) == 8.0);
    const Points even = equal_arcs(corner, 4);
    REQUIRE(even.size() == 5);
    CHECK((even[1] - Vec3(2, 0, 0)).norm() < 1e-12);
    CHECK((even[3] - Vec3(6, 0, 0)).norm() < 1e-12);
    CHECK(even[4] == corner[2]);
    CHECK(point_at_share(corner, 0.875) == Vec3(6, 1, 0));
    const Points part = part_of_line(corner, 0.25, 0.875);
    REQUIRE(part.size() == 3);
    CHECK((part[0] - Vec3(2, 0, 0)).norm() < 1e-12);
    CHECK((part[2] - Vec3(6, 1, 0)).norm() < 1e-12);
    const Points nothing = equal_arcs(Points(3, Vec3(1, 2, 3)), 5);
    for (const Vec3& p : nothing)
        CHECK(p == Vec3(1, 2, 3));
}

TEST_CASE("strands that would turn back sharply are shortened before they are led to their places",
          "[anatomy][chmd]") {
    // The origin is a band on the back of the box, below its upper end: strands come from above it.
    test::ChmdCase box = test::box_case();
    box.patches.erase(box.patches.begin());
    box.add_patch(AttachmentKind::origin,
                  [](const Vec3& p) { return p.y() > 19.9 && p.z() > 64.9 && p.z() < 85.1; });
    const Net net(box.problem(100, 15));
    const std::vector<Strand> strands = make_strands(net.problem, net.rows);
    const StrandEnds from = assign_ends(net.problem, net.rows, strands, net.origin, true);
    const StrandEnds to = assign_ends(net.problem, net.rows, strands, net.insertion, false);
    int shortened = 0;
    for (std::size_t i = 0; i < strands.size(); ++i) {
        CHECK((from.trim[i] >= 0.0 && from.trim[i] <= 0.45));
        CHECK(to.trim[i] == 0.0);
        CHECK((from.targets[i].y() > 19.9 && from.targets[i].z() > 64.9 && from.targets[i].z() < 85.1));
        CHECK(to.targets[i].z() == Approx(0.0).margin(1e-9));
        shortened += from.trim[i] > 0.0 ? 1 : 0;
    }
    CHECK(shortened > 50);
}

TEST_CASE("a fibre whose straight way leaves the muscle follows its surface at equal arcs",
          "[anatomy][chmd]") {
    // Half a ring between radii 30 and 50; the strand ends 60 degrees before the ends do.
    TriMesh mesh = box_mesh(Vec3(0, 0, 0), Vec3(180, 20, 20), {60, 4, 4});
    const auto bent = [](double degrees, double radius, double y) {
        const double angle = degrees * std::numbers::pi / 180.0;
        return Vec3(-radius * std::cos(angle), y, radius * std::sin(angle));
    };
    for (Vec3& p : mesh.positions)
        p = bent(p.x(), 30.0 + p.z(), p.y());
    const SolidQuery solid(mesh);
    REQUIRE(solid.inside(bent(90, 40, 10)));
    Strand strand;
    for (int k = 0; k <= 10; ++k)
        strand.path.push_back(bent(60 + 6 * k, 31, 10));
    for (const int segments : {12, 40}) {
        const Points fibre =
            finish_fibre(mesh, solid, strand, 0, 0, bent(0, 31, 10), bent(180, 31, 10), segments);
        REQUIRE(fibre.size() == std::size_t(segments) + 1);
        CHECK(fibre.front() == bent(0, 31, 10));
        CHECK(fibre.back() == bent(180, 31, 10));
        double longest = 0, shortest = 1e300;
        for (std::size_t k = 1; k < fibre.size(); ++k) {
            longest = std::max(longest, (fibre[k] - fibre[k - 1]).norm());
            shortest = std::min(shortest, (fibre[k] - fibre[k - 1]).norm());
            CHECK(solid.signed_distance(fibre[k]) < 1e-3);
        }
        CHECK(longest < 1.05 * shortest);
        CHECK(polyline_length(fibre) == Approx(std::numbers::pi * 30.5).epsilon(0.03));
    }
}
