#include "fascicle/geometry/implicit.hpp"
#include "fascicle/geometry/implicit_field.hpp"
#include "fascicle/geometry/implicit_sheet.hpp"
#include "fascicle/geometry/implicit_tube.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;

namespace {

const double pi = 3.14159265358979323846;

/// Distance to the surface by walking f's zero set: |f| / |grad f| must be |f| for an exact distance.
void check_unit_gradient(const Implicit& f, double from, double to) {
    for (double x = from; x <= to; x += 1.37)
        for (double y = from; y <= to; y += 1.41)
            for (double z = from; z <= to; z += 1.43)
                CHECK(implicit_gradient(f, Vec3(x, y, z), 1e-5).norm() == Approx(1.0).margin(2e-3));
}

} // namespace

TEST_CASE("exact primitives have unit gradient and known values", "[geometry][implicit]") {
    const auto ball = sphere_shape(Vec3(1, 2, 3), 2.0);
    CHECK(ball(Vec3(1, 2, 8)) == Approx(3.0));
    CHECK(ball(Vec3(1, 2, 3)) == Approx(-2.0));

    const auto cone = round_cone_shape(Vec3(0, 0, 0), Vec3(0, 0, 10), 3.0, 1.0);
    CHECK(cone(Vec3(0, 0, -5)) == Approx(2.0));
    CHECK(cone(Vec3(0, 0, 12)) == Approx(1.0));
    const double slope =
        std::asin(0.2); // the side touches both balls: at height 0 its distance to the axis is 3 / cos
    CHECK(cone(Vec3((3.0 - 5.0 * std::sin(slope)) / std::cos(slope), 0, 5)) == Approx(0.0).margin(1e-12));
    check_unit_gradient(cone, -6.03, 6.03);
    CHECK(round_cone_shape(Vec3(0, 0, 0), Vec3(0, 0, 1), 5.0, 1.0)(Vec3(0, 0, 7)) == Approx(2.0));

    const auto box = box_shape(Vec3::Zero(), Vec3(1, 2, 3), 0.0);
    CHECK(box(Vec3(4, 6, 3)) == Approx(5.0));
    CHECK(box(Vec3(0, 0, 0)) == Approx(-1.0));
    CHECK(box_shape(Vec3::Zero(), Vec3(2, 2, 2), 1.0)(Vec3(2, 2, 2)) == Approx(std::sqrt(3.0) - 1.0));

    const auto arc = ring_shape(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), 0.5 * pi, 5.0, 1.0);
    CHECK(arc(Vec3(5, 0, 0)) == Approx(-1.0));
    CHECK(arc(Vec3(0, 8, 0)) == Approx(2.0));
    CHECK(arc(Vec3(0, 5, 2)) == Approx(1.0));
    CHECK(arc(Vec3(-3, 5, 0)) == Approx(2.0)); // beyond the end at (0, 5, 0)
    CHECK(ring_shape(Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), pi, 5.0, 1.0)(Vec3(-5, 0, 1)) ==
          Approx(0.0).margin(1e-9));
}

TEST_CASE("the ellipsoid estimate is zero on the surface with unit gradient there", "[geometry][implicit]") {
    const Mat3 axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const Vec3 radii(5, 3, 2), centre(1, -2, 4);
    const auto egg = ellipsoid_shape(centre, radii, axes);
    CHECK(egg(centre) == Approx(-2.0));
    for (double u = 0.1; u < 3.0; u += 0.4)
        for (double v = 0.0; v < 6.0; v += 0.7) {
            const Vec3 q(5 * std::sin(u) * std::cos(v), 3 * std::sin(u) * std::sin(v), 2 * std::cos(u));
            const Vec3 p = centre + axes * q;
            CHECK(egg(p) == Approx(0.0).margin(1e-12));
            CHECK(implicit_gradient(egg, p, 1e-5).norm() == Approx(1.0).margin(1e-4));
        }
}

TEST_CASE("smooth minimum and maximum bound the plain ones and meet them away from the blend",
          "[geometry][implicit]") {
    for (double a = -3.0; a <= 3.0; a += 0.25)
        for (double b = -3.0; b <= 3.0; b += 0.25) {
            CHECK(smooth_min(a, b, 1.0) <= std::min(a, b));
            CHECK(smooth_min(a, b, 1.0) >= std::min(a, b) - 0.25);
            CHECK(smooth_max(a, b, 1.0) >= std::max(a, b));
            if (std::abs(a - b) >= 1.0)
                CHECK(smooth_min(a, b, 1.0) == std::min(a, b));
        }
    CHECK(smooth_min(2.0, 2.0, 1.0) == 1.75);
    CHECK(smooth_min(2.0, 1.5, 0.0) == 1.5);
}

TEST_CASE("a union gives the same value with and without leaving far parts out", "[geometry][implicit]") {
    ImplicitUnion culled, plain;
    for (int i = 0; i < 6; ++i) {
        ImplicitShape s = round_cone_shape(Vec3(4.0 * i, 0, 0), Vec3(4.0 * i, 6, i), 2.0, 1.0);
        culled.add(s, 1.5);
        s.radius = 1e6;
        plain.add(s, 1.5);
    }
    for (double x = -5; x < 30; x += 1.3)
        for (double y = -5; y < 12; y += 1.7)
            CHECK(culled(Vec3(x, y, 0.3)) == plain(Vec3(x, y, 0.3)));
}

TEST_CASE("a straight round tube is a capsule, an elliptic one has its half axes", "[geometry][implicit]") {
    const auto tube = tube_shape({{Vec3(0, 0, 0), 2, 2}, {Vec3(0, 0, 4), 2, 2}, {Vec3(0, 0, 10), 2, 2}}, 5);
    const auto capsule = round_cone_shape(Vec3(0, 0, 0), Vec3(0, 0, 10), 2, 2);
    for (double x = -4.1; x < 5; x += 0.9)
        for (double z = -4; z < 15; z += 0.8)
            CHECK(tube(Vec3(x, 0.7, z)) == Approx(capsule(Vec3(x, 0.7, z))).margin(1e-9));
    const auto flat =
        tube_shape({{Vec3(0, 0, 0), 5, 1, Vec3::UnitY()}, {Vec3(10, 0, 0), 5, 1, Vec3::UnitY()}});
    CHECK(flat(Vec3(5, 5, 0)) == Approx(0.0).margin(1e-12));
    CHECK(flat(Vec3(5, 0, 1)) == Approx(0.0).margin(1e-12));
    CHECK(flat(Vec3(5, 7, 0)) == Approx(2.0));
    CHECK(flat(Vec3(11, 0, 0)) == Approx(0.0).margin(1e-12));
}

TEST_CASE("a flat sheet is a plate with its thickness and a round rim, and a curved one passes its stations",
          "[geometry][implicit]") {
    const SheetPlane plane{Vec3(0, 0, 5), Vec3::UnitX(), Vec3::UnitY()};
    std::vector<SheetStation> rim;
    for (int i = 0; i < 12; ++i)
        rim.push_back({Vec3(20 * std::cos(pi * i / 6), 20 * std::sin(pi * i / 6), 5), 2.0});
    const auto plate = sheet_shape(plane, rim, {{Vec3(0, 0, 5), 2.0}}, 1.0);
    CHECK(plate(Vec3(1, 3, 5)) == Approx(-2.0).margin(1e-6));
    CHECK(plate(Vec3(-4, 2, 9)) == Approx(2.0).margin(1e-6));
    CHECK(plate(Vec3(23, 0, 5)) == Approx(3.0).margin(0.1));
    CHECK(plate(Vec3(0, 0, 45)) == Approx(38.0).margin(1e-6));

    std::vector<SheetStation> bowl = rim;
    for (auto& s : bowl)
        s.point.z() = 9.0;
    const auto curved = sheet_shape(plane, bowl, {{Vec3(0, 0, 5), 3.0}}, 1.0);
    CHECK(curved(Vec3(0, 0, 5)) == Approx(-3.0).margin(0.05));
    CHECK(curved(Vec3(0, 0, 8)) == Approx(0.0).margin(0.1));
}

TEST_CASE("a field holds f itself near the surface and the right sign everywhere", "[geometry][implicit]") {
    ImplicitUnion shape;
    shape.add(tube_shape({{Vec3(-8, 0, 0), 6, 2, Vec3::UnitY()},
                          {Vec3(2, 4, 1), 4, 3, Vec3::UnitY()},
                          {Vec3(9, 0, 5), 2, 2, Vec3::UnitY()}}),
              0.0);
    shape.add(ellipsoid_shape(Vec3(4, -6, 0), Vec3(7, 2, 3)), 2.0);
    const FieldBox box{Vec3(-18, -16, -12), Vec3(18, 14, 14), 0.5, 1.5};
    const ImplicitField field(shape, box, 1), threaded(shape, box, 4);
    const auto& n = field.nodes();
    int wrong_sign = 0, wrong_value = 0, differ = 0, near = 0;
    for (int k = 1; k + 1 < n[2]; ++k)
        for (int j = 1; j + 1 < n[1]; ++j)
            for (int i = 1; i + 1 < n[0]; ++i) {
                const double exact = shape(field.position(i, j, k)), held = field.at(i, j, k);
                wrong_sign += (exact < 0.0) != (held < 0.0);
                differ += held != threaded.at(i, j, k);
                if (std::abs(exact) < 2.0 * box.spacing) {
                    ++near;
                    wrong_value += std::abs(exact - held) > 1e-5;
                }
            }
    CHECK(wrong_sign == 0);
    CHECK(wrong_value == 0);
    CHECK(differ == 0);
    CHECK(near > 1000);
    const Vec3 p(5.1, -6.2, 2.8);
    CHECK(field(p) == Approx(shape(p)).margin(0.05));
    CHECK(field(Vec3(30, 0, 0)) > 12.0);
    CHECK((field.gradient(p) - implicit_gradient(shape, p, 0.1)).norm() < 0.1);
    CHECK_THROWS_AS(ImplicitField(shape, FieldBox{Vec3::Zero(), Vec3::Ones(), 1e-6}, 1), std::runtime_error);
}
