#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/volume.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

using namespace fascicle;
using namespace fascicle::test;

TEST_CASE("volume, area and centroid have their closed forms", "[geometry][volume]") {
    const TriMesh b = box(2, 3, 4);
    CHECK(signed_volume(b.positions, b.triangles) == Approx(24.0).epsilon(1e-14));
    CHECK(surface_area(b.positions, b.triangles) == Approx(52.0).epsilon(1e-14));
    CHECK((surface_centroid(b.positions, b.triangles) - Vec3(1, 1.5, 2)).norm() < 1e-14);

    const TriMesh t = tetrahedron(2.0);
    CHECK(signed_volume(t.positions, t.triangles) == Approx(8.0 / 6.0).epsilon(1e-14));
    CHECK(surface_area(t.positions, t.triangles) == Approx(6.0 + std::sqrt(12.0)).epsilon(1e-14));

    // A refined octahedron stays inside the sphere and comes near it.
    const TriMesh s = sphere(5.0, 5);
    const double ball = 4.0 / 3.0 * M_PI * 125.0;
    CHECK(signed_volume(s.positions, s.triangles) < ball);
    CHECK(signed_volume(s.positions, s.triangles) == Approx(ball).epsilon(2e-3));
    CHECK(surface_area(s.positions, s.triangles) == Approx(100.0 * M_PI).epsilon(2e-3));
}

TEST_CASE("volume changes sign with the orientation and not with the place", "[geometry][volume]") {
    const TriMesh s = sphere(1.0, 2);
    const double v = signed_volume(s.positions, s.triangles);
    const TriMesh turned = inside_out(s);
    CHECK(signed_volume(turned.positions, turned.triangles) == Approx(-v).epsilon(1e-13));

    Points far = s.positions;
    for (Vec3& p : far)
        p += Vec3(1e6, -2e6, 3e6);
    CHECK(signed_volume(far, s.triangles) == Approx(v).epsilon(1e-8)); // 1e6 * 2^-53 of the radius
}

TEST_CASE("degenerate input has volume, area and gradient zero", "[geometry][volume]") {
    CHECK(signed_volume({}, {}) == 0.0);
    CHECK(surface_area({}, {}) == 0.0);
    CHECK(surface_centroid({}, {}) == Vec3::Zero());
    const Points line{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(3, 0, 0)};
    CHECK(signed_volume(line, {{0, 1, 2}}) == 0.0);
    CHECK(surface_area(line, {{0, 1, 2}}) == 0.0);
    CHECK((surface_centroid(line, {{0, 1, 2}}) - Vec3(4.0 / 3.0, 0, 0)).norm() < 1e-15);
    Points gradient;
    volume_gradient(line, {}, gradient);
    CHECK(gradient == Points(3, Vec3::Zero()));
}

TEST_CASE("volume gradient agrees with central differences and sums to zero", "[geometry][volume]") {
    TriMesh mesh = sphere(1.0, 1, Vec3(3, -2, 5));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) // no symmetry that hides mistakes
        mesh.positions[i] +=
            0.1 * Vec3(std::sin(7.0 * double(i)), std::cos(3.0 * double(i)), std::sin(5.0 * double(i)));
    Points gradient;
    volume_gradient(mesh.positions, mesh.triangles, gradient);
    REQUIRE(gradient.size() == mesh.positions.size());
    Vec3 sum = Vec3::Zero();
    const double h = 1e-5;
    for (std::size_t i = 0; i < gradient.size(); ++i) {
        sum += gradient[i];
        for (int k = 0; k < 3; ++k) {
            Points moved = mesh.positions;
            moved[i][k] += h;
            const double up = signed_volume(moved, mesh.triangles);
            moved[i][k] -= 2 * h;
            const double down = signed_volume(moved, mesh.triangles);
            CHECK(gradient[i][k] == Approx((up - down) / (2 * h)).margin(1e-9));
        }
    }
    CHECK(sum.norm() < 1e-13);
}

TEST_CASE("winding number tells inside from outside", "[geometry][volume]") {
    const TriMesh ring = torus(3.0, 1.0);
    CHECK(winding_number(ring.positions, ring.triangles, Vec3(3, 0, 0)) == Approx(1.0).epsilon(1e-12));
    CHECK(winding_number(ring.positions, ring.triangles, Vec3(0, 0, 0)) == Approx(0.0).margin(1e-12));
    CHECK(winding_number(ring.positions, ring.triangles, Vec3(50, 1, 2)) == Approx(0.0).margin(1e-12));
    const TriMesh b = box();
    CHECK(winding_number(b.positions, b.triangles, Vec3(0.5, 0.5, 0.5)) == Approx(1.0).epsilon(1e-12));
    CHECK(std::isfinite(winding_number(b.positions, b.triangles, Vec3(0, 0, 0)))); // on a vertex
}

TEST_CASE("bounding box", "[geometry][bounding_box]") {
    CHECK(bounding_box(Points{}).empty());
    CHECK(BoundingBox{}.diagonal() == 0.0);
    CHECK(BoundingBox{}.center() == Vec3::Zero());
    const TriMesh b = box(2, 3, 6);
    const BoundingBox all = bounding_box(b.positions);
    CHECK_FALSE(all.empty());
    CHECK(all.min == Vec3(0, 0, 0));
    CHECK(all.max == Vec3(2, 3, 6));
    CHECK(all.diagonal() == Approx(7.0));
    CHECK(all.center() == Vec3(1, 1.5, 3));
    CHECK(bounding_box({Vec3(1, 2, 3)}).diagonal() == 0.0);
    CHECK_FALSE(bounding_box({Vec3(1, 2, 3)}).empty());

    TriMesh with_stray = b;
    with_stray.positions.emplace_back(1e9, 0, 0);
    CHECK(bounding_box(with_stray.positions, with_stray.triangles).max == Vec3(2, 3, 6));
    CHECK(bounding_box(with_stray.positions).contains(all));
    CHECK_FALSE(all.contains(bounding_box(with_stray.positions)));
    CHECK(all.contains(BoundingBox{}));
}
