#include "fascicle/geometry/winding_number.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace fascicle;

namespace {

TriMesh open_sphere() {
    TriMesh mesh = test::sphere(2.0, 3);
    std::erase_if(mesh.triangles,
                  [&](const Tri& t) { return mesh.positions[static_cast<std::size_t>(t[0])].z() > 1.2; });
    return mesh;
}

/// Two boxes that share the edge x = y = 1, four triangles at it.
TriMesh boxes_at_an_edge() {
    TriMesh mesh = test::box();
    TriMesh other = test::box();
    for (Vec3& p : other.positions)
        p += Vec3(1, 1, 0);
    mesh = test::joined(mesh, other);
    for (Tri& t : mesh.triangles)
        for (int& v : t)
            v = v == 8 ? 3 : v == 12 ? 7 : v;
    return mesh;
}

} // namespace

TEST_CASE("solid angles known in closed form", "[geometry][winding_number]") {
    const double octant = std::numbers::pi / 2.0;
    CHECK(solid_angle(Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)) == Approx(octant));
    CHECK(solid_angle(Vec3(3, 0, 0), Vec3(0, 0, 2), Vec3(0, 1, 0)) == Approx(-octant));
    CHECK(solid_angle(Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(0, 0, 1)) == 0.0);
    CHECK(solid_angle(Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 0, 1)) == 0.0);
}

TEST_CASE("fast and exact winding numbers agree with brute force", "[geometry][winding_number]") {
    const auto [name, mesh] = GENERATE(table<const char*, TriMesh>({
        {"closed", test::sphere(2.0, 3)},
        {"torus", test::torus(2.0, 0.7)},
        {"nested", test::joined(test::sphere(2.0, 3), test::inside_out(test::sphere(1.0, 3)))},
        {"open", open_sphere()},
        {"non-manifold", boxes_at_an_edge()},
        {"a sheet", test::sheet(3, 4)},
        {"a tetrahedron", test::tetrahedron()},
    }));
    INFO(name);
    const WindingNumber winding(mesh);
    test::Random random(11);
    double worst_2 = 0, worst_6 = 0;
    int undecided = 0;
    for (int i = 0; i < 1500; ++i) {
        const Vec3 p = random.in_box(Vec3::Constant(-3), Vec3::Constant(3));
        const double w = winding_number(mesh.positions, mesh.triangles, p);
        CHECK(winding.exact(p) == Approx(w).margin(1e-12));
        worst_2 = std::max(worst_2, std::abs(winding.fast(p) - w));
        worst_6 = std::max(worst_6, std::abs(winding.fast(p, 6.0) - w));
        if (std::abs(w - 0.5) > 1e-9)
            CHECK(winding.inside(p) == (w > 0.5));
        undecided += std::abs(w - 0.5) < 0.1;
    }
    CHECK(worst_2 < 0.08);
    CHECK(worst_6 < 0.002);
    if (name == std::string("open"))
        CHECK(undecided > 10); // the fall-back was needed
}

TEST_CASE("winding number of nothing", "[geometry][winding_number]") {
    const WindingNumber winding{TriMesh{}};
    CHECK(winding.fast(Vec3(1, 2, 3)) == 0.0);
    CHECK(winding.exact(Vec3(1, 2, 3)) == 0.0);
    CHECK_FALSE(winding.inside(Vec3(1, 2, 3)));
}
