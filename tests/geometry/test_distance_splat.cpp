#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/closest_point.hpp"
#include "geometry/distance_splat.hpp"
#include "geometry/surface_oracles.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace fascicle;

namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

GridShape grid_around(const TriMesh& mesh, double spacing, double reach) {
    const BoundingBox box = bounding_box(mesh.positions, mesh.triangles);
    GridShape shape;
    shape.low = box.min - Vec3::Constant(reach);
    shape.h = spacing;
    for (std::size_t k = 0; k < 3; ++k)
        shape.nodes[k] = static_cast<int>((box.size()[Eigen::Index(k)] + 2.0 * reach) / spacing) + 2;
    return shape;
}

std::vector<float> splat(const TriMesh& mesh, const GridShape& shape, double reach, int threads = 1) {
    std::vector<float> squared(shape.node_count(), nothing);
    splat_squared_distances(
        shape, mesh.positions, mesh.triangles, reach, threads, {}, [](double) {}, squared.data());
    return squared;
}

/// Every node against all triangles.
void check(const TriMesh& mesh, double spacing, double reach) {
    const GridShape shape = grid_around(mesh, spacing, reach);
    const std::vector<float> squared = splat(mesh, shape, reach);
    int missing = 0, surplus = 0, wrong = 0, near = 0;
    for (int k = 0; k < shape.nodes[2]; ++k)
        for (int j = 0; j < shape.nodes[1]; ++j)
            for (int i = 0; i < shape.nodes[0]; ++i) {
                const float got = squared[shape.row(j, k) + static_cast<std::size_t>(i)];
                const Vec3 p = shape.node(i, j, k);
                double truth = std::numeric_limits<double>::infinity();
                for (const Tri& t : mesh.triangles)
                    truth = std::min(truth, closest_point_on_triangle(p, mesh.positions[std::size_t(t[0])],
                                                                      mesh.positions[std::size_t(t[1])],
                                                                      mesh.positions[std::size_t(t[2])])
                                                .squared_distance);
                truth = std::sqrt(truth);
                near += truth < reach;
                missing += truth < reach * (1.0 - 1e-9) && got == nothing;
                surplus += truth > reach * (1.0 + 1e-9) && got != nothing;
                if (got != nothing)
                    wrong += std::abs(spacing * std::sqrt(double(got)) - truth) > 1e-6 * reach;
            }
    CHECK(missing == 0);
    CHECK(surplus == 0);
    CHECK(wrong == 0);
    CHECK(near > 0);
}

TriMesh turned(TriMesh mesh) {
    const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& p : mesh.positions)
        p = turn * p;
    return mesh;
}

} // namespace

TEST_CASE("splatted distances of closed shapes are those of brute force", "[geometry][distance_splat]") {
    check(test::sphere(4.0, 2), 0.7, 2.5);
    check(test::torus(4.0, 1.5, 12, 8), 0.6, 2.0);
    check(test::box(5, 3, 2), 0.5, 2.0);
    check(turned(test::box(5, 3, 2)), 0.5, 2.0);
    check(turned(test::box(6, 6, 0.01)), 0.5, 2.0);
    check(turned(test::tetrahedron(4.0)), 0.4, 3.0);
    check(test::inside_out(test::sphere(3.0, 1)), 0.5, 6.0); // the reach is larger than the shape
}

TEST_CASE("splatted distances of broken surfaces are those of brute force", "[geometry][distance_splat]") {
    test::Random random(3);
    SECTION("a hole, three triangles at an edge, both orientations") {
        TriMesh mesh = turned(test::sphere(4.0, 2));
        mesh.triangles.erase(mesh.triangles.begin() + 5, mesh.triangles.begin() + 20);
        mesh.positions.emplace_back(6, 5, 4);
        mesh.triangles.push_back({mesh.triangles[40][0], mesh.triangles[40][1], mesh.vertex_count() - 1});
        std::swap(mesh.triangles[50][0], mesh.triangles[50][1]);
        check(mesh, 0.7, 2.5);
    }
    SECTION("loose triangles of all shapes, crossing each other") {
        for (const double size : {0.3, 2.0, 6.0}) {
            TriMesh mesh;
            for (int t = 0; t < 12; ++t) {
                const Vec3 middle = random.in_box(Vec3::Constant(-3), Vec3::Constant(3));
                for (int corner = 0; corner < 3; ++corner)
                    mesh.positions.push_back(middle + size * random.direction());
                mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
            }
            check(mesh, 0.6, 2.0);
        }
    }
    SECTION("needles, slivers, segments and points") {
        TriMesh mesh;
        for (const double height : {1e-2, 1e-4, 1e-5, 1e-9, 0.0}) {
            const int first = mesh.vertex_count();
            const Vec3 a = random.in_box(Vec3::Constant(-3), Vec3::Constant(3)),
                       side = 5.0 * random.direction();
            mesh.positions.push_back(a);
            mesh.positions.push_back(a + side);
            mesh.positions.push_back(a + 0.3 * side + height * side.unitOrthogonal());
            mesh.triangles.push_back({first, first + 1, first + 2});
        }
        mesh.triangles.push_back({0, 0, 4}); // a segment
        mesh.triangles.push_back({7, 7, 7}); // a point
        check(mesh, 0.6, 2.0);
    }
    SECTION("a sheet: corners on straight borders, flat corners within, straight folds") {
        TriMesh mesh;
        for (int j = 0; j <= 4; ++j)
            for (int i = 0; i <= 4; ++i)
                mesh.positions.emplace_back(i, j, i > 2 ? 0.7 * (i - 2) : 0.0);
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 4; ++i) {
                const int v = 5 * j + i;
                mesh.triangles.push_back({v, v + 1, v + 6});
                mesh.triangles.push_back({v, v + 6, v + 5});
            }
        check(mesh, 0.5, 2.0);
        check(turned(mesh), 0.43, 2.0);
        for (Vec3& p : mesh.positions) // nearly flat everywhere
            p.z() = 1e-5 * random.real(-1, 1);
        check(turned(mesh), 0.43, 2.0);
    }
    SECTION("a corner of very many triangles, and every triangle with its own corners") {
        TriMesh fan;
        fan.positions.emplace_back(0, 0, 1);
        for (int i = 0; i < 40; ++i)
            fan.positions.emplace_back(3 * std::cos(i * 0.157), 3 * std::sin(i * 0.157), 0);
        for (int i = 0; i < 40; ++i)
            fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % 40});
        check(turned(fan), 0.5, 2.0);
        TriMesh soup;
        for (const Tri& t : fan.triangles) {
            const int first = soup.vertex_count();
            for (const int v : t)
                soup.positions.push_back(fan.positions[std::size_t(v)]);
            soup.triangles.push_back({first, first + 1, first + 2});
        }
        check(turned(soup), 0.5, 2.0);
        for (Vec3& p : soup.positions)
            p += 1e-7 * random.direction();
        check(turned(soup), 0.5, 2.0);
    }
}

TEST_CASE("splatted distances do not depend on the number of threads", "[geometry][distance_splat]") {
    const TriMesh mesh = turned(test::torus(6.0, 2.0, 48, 24));
    const GridShape shape = grid_around(mesh, 0.4, 2.0);
    const std::vector<float> one = splat(mesh, shape, 2.0, 1);
    for (const int threads : {2, 3, 8})
        CHECK(splat(mesh, shape, 2.0, threads) == one);
}
