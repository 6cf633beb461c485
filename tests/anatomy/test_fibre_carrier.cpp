#include "anatomy/fibres/muscle_inside.hpp"
#include "fascicle/anatomy/fibre_carrier.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/closest_point.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/solid_query.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;

namespace {

MeshTopology topology_of(const TriMesh& mesh) {
    return MeshTopology(mesh.vertex_count(), mesh.triangles);
}

Points random_points(const TriMesh& mesh, int count, bool inside_only) {
    const BoundingBox box = bounding_box(mesh.positions);
    const WindingNumber winding(mesh);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-0.1, 1.1);
    Points points;
    while (static_cast<int>(points.size()) < count) {
        const Vec3 p = box.min + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(box.size());
        if (!inside_only || winding.exact(p) > 0.5)
            points.push_back(p);
    }
    return points;
}

Points carried(const FibreCarrier& carrier, const Points& surface) {
    Points points(carrier.point_count());
    carrier.carry(surface, points);
    return points;
}

double largest_error(const Points& a, const Points& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, (a[i] - b[i]).norm());
    return worst;
}

/// A tube along z, bent about the y axis and twisted about its own: the whole turn over its length.
Points bent_and_twisted(const Points& rest, double length, double bend, double twist) {
    Points moved;
    for (const Vec3& p : rest) {
        const double share = p.z() / length;
        const Vec3 q = Eigen::AngleAxisd(twist * share, Vec3::UnitZ()) * Vec3(p.x(), p.y(), 0);
        if (bend == 0) {
            moved.emplace_back(q.x(), q.y(), p.z());
            continue;
        }
        const double radius = length / bend, angle = bend * share;
        moved.emplace_back((radius - q.x()) * -std::cos(angle) + radius, q.y(),
                           (radius - q.x()) * std::sin(angle));
    }
    return moved;
}

} // namespace

TEST_CASE("line crossings: winding and distances agree with brute force", "[anatomy][fibres]") {
    const TriMesh mesh = test::joined(test::torus(), test::sphere(0.5, 2, Vec3(0, 0, 0.2)));
    const WindingNumber winding(mesh);
    const Points points = random_points(mesh, 300, false);
    for (const Vec3& direction : {chord_directions()[0], chord_directions()[5], Vec3(0, 0, 1)}) {
        const LineCrossings lines(mesh, direction);
        std::vector<std::pair<double, int>> all;
        for (const Vec3& p : points) {
            const LineNeighbours found = lines.at(p);
            REQUIRE(found.winding == std::lround(winding.exact(p)));
            lines.all(p, all);
            double ahead = std::numeric_limits<double>::infinity();
            for (const auto& [distance, sign] : all)
                if (distance >= 0)
                    ahead = std::min(ahead, distance);
            REQUIRE(found.ahead.distance == ahead);
            if (found.ahead.triangle >= 0) {
                const Tri& t = mesh.triangles[static_cast<std::size_t>(found.ahead.triangle)];
                Vec3 foot = Vec3::Zero();
                for (int k = 0; k < 3; ++k)
                    foot +=
                        found.ahead.weights[k] * mesh.positions[static_cast<std::size_t>(t[std::size_t(k)])];
                REQUIRE((p + found.ahead.distance * direction - foot).norm() < 1e-9);
            }
        }
    }
}

TEST_CASE("line crossings: lines through edges and vertices are counted once", "[anatomy][fibres]") {
    const TriMesh mesh = box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), {4, 4, 4});
    const LineCrossings lines(mesh, Vec3::UnitZ());
    for (const Vec3& p : {Vec3(2, 2, 1.5), Vec3(1.5, 2, 1.5), Vec3(1.5, 1.5, 3.9), Vec3(3, 1, 0.1)})
        CHECK(lines.at(p).winding == 1);
    CHECK(lines.at(Vec3(2, 2, 5)).winding == 0);
    CHECK(lines.at(Vec3(2, 2, -5)).winding == 0);
    CHECK(lines.at(Vec3(9, 9, 2)).ahead.triangle == -1);
}

TEST_CASE("fibre carrier: gives the rest points back and follows every affine motion", "[anatomy][fibres]") {
    for (const TriMesh& mesh : {test::torus(), test::sphere(40.0, 3, Vec3(500, -300, 200)),
                                cylinder_mesh(Vec3(1, 2, 3), Vec3(5, 9, 40), 6, 30, 20)}) {
        const double size = bounding_box(mesh.positions).diagonal();
        const Points rest = random_points(mesh, 200, true);
        const FibreCarrier carrier = bind_inside(mesh, topology_of(mesh), rest);
        REQUIRE(carrier.point_count() == rest.size());
        CHECK(carrier.bytes() > carrier.weight_count() * 8);
        CHECK(largest_error(carried(carrier, mesh.positions), rest) < 1e-9 * size);
        Mat3 affine;
        affine << 1.2, 0.3, -0.1, 0.2, 0.7, 0.4, -0.3, 0.1, 1.6;
        const Vec3 shift(10, -20, 30);
        const auto moved = [&](Points points) {
            for (Vec3& p : points)
                p = affine * p + shift;
            return points;
        };
        CHECK(largest_error(carried(carrier, moved(mesh.positions)), moved(rest)) < 1e-8 * size);
        for (std::size_t i = 0; i < rest.size(); ++i) {
            double sum = 0;
            for (const double w : carrier.weights(i))
                sum += w;
            REQUIRE(sum == Approx(1.0).margin(1e-12));
        }
    }
}

TEST_CASE("fibre carrier: points on the surface keep their place in their triangle", "[anatomy][fibres]") {
    const TriMesh mesh = test::sphere(10.0, 2);
    Points rest;
    std::vector<std::array<double, 3>> shares;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 7)
        for (const auto& w : {std::array<double, 3>{0.2, 0.3, 0.5}, std::array<double, 3>{1, 0, 0}}) {
            Vec3 p = Vec3::Zero();
            for (std::size_t k = 0; k < 3; ++k)
                p += w[k] * mesh.positions[static_cast<std::size_t>(mesh.triangles[t][k])];
            rest.push_back(p);
            shares.push_back(w);
        }
    const FibreCarrier carrier = bind_inside(mesh, topology_of(mesh), rest);
    Points surface = mesh.positions;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> noise(-1, 1);
    for (Vec3& p : surface)
        p += Vec3(noise(random), noise(random), noise(random));
    const Points now = carried(carrier, surface);
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Tri& t = mesh.triangles[i / 2 * 7];
        Vec3 p = Vec3::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            p += shares[i][k] * surface[static_cast<std::size_t>(t[k])];
        CHECK((now[i] - p).norm() < 1e-7);
    }
}

TEST_CASE("fibre carrier: a tube bent by 90 and twisted by 120 degrees keeps all points inside",
          "[anatomy][fibres]") {
    const double length = 60;
    const TriMesh mesh = cylinder_mesh(Vec3(0, 0, 0), Vec3(0, 0, length), 10, 32, 40);
    Points rest = random_points(mesh, 400, true);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int k = 0; k < 100; ++k) { // just below the surface
        const double angle = 6.2831853 * unit(random), depth = 0.1 + 0.2 * unit(random);
        rest.emplace_back((10 - depth) * std::cos(angle), (10 - depth) * std::sin(angle),
                          1 + 58 * unit(random));
    }
    const FibreCarrier carrier = bind_inside(mesh, topology_of(mesh), rest);
    for (const auto& [bend, twist] :
         {std::pair{1.5708, 2.0944}, std::pair{0.0, 2.0944}, std::pair{-1.2, 0.0}}) {
        const TriMesh now{bent_and_twisted(mesh.positions, length, bend, twist), mesh.triangles};
        const WindingNumber winding(now);
        const Points points = carried(carrier, now.positions);
        int outside = 0;
        for (const Vec3& p : points)
            outside += winding.exact(p) > 0.5 ? 0 : 1;
        CHECK(outside == 0);
        // And they are about where the motion takes them.
        CHECK(largest_error(points, bent_and_twisted(rest, length, bend, twist)) < 2.5);
    }
}

TEST_CASE("fibre carrier: a dent that passes over points takes them along", "[anatomy][fibres]") {
    const TriMesh mesh = test::sphere(10.0, 4);
    const Points rest = random_points(mesh, 1500, true);
    const FibreCarrier carrier = bind_inside(mesh, topology_of(mesh), rest);
    TriMesh now = mesh;
    for (Vec3& p : now.positions) { // a thumb of radius 5 from the top, 8 deep
        const double d = p.head<2>().norm();
        if (p.z() > 0)
            p.z() -= 8.0 * std::exp(-d * d / 25.0);
    }
    const SolidQuery solid(now);
    Points blended;
    for (std::size_t i = 0; i < rest.size(); ++i) {
        Vec3 sum = Vec3::Zero();
        for (std::size_t k = 0; k < carrier.weights(i).size(); ++k)
            sum += carrier.weights(i)[k] * now.positions[static_cast<std::size_t>(carrier.vertices(i)[k])];
        blended.push_back(sum);
    }
    int outside_without = 0, outside = 0, touched = 0;
    const Points points = carried(carrier, now.positions);
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const bool was_in = solid.signed_distance(blended[i]) <= 0;
        outside_without += was_in ? 0 : 1;
        outside += solid.signed_distance(points[i]) > 0 ? 1 : 0;
        touched += was_in && points[i] != blended[i] ? 1 : 0;
    }
    CHECK(outside_without > 5); // else nothing is tried here
    CHECK(outside == 0);
    CHECK(touched == 0); // what is inside stays as it is
}

TEST_CASE("fibre carrier: points outside, far away and in open surfaces are given back too",
          "[anatomy][fibres]") {
    TriMesh open = test::sphere(10.0, 2);
    open.triangles.resize(open.triangles.size() / 2);
    for (const TriMesh& mesh : {test::sphere(10.0, 2), open, test::sheet(3, 3)}) {
        Points rest{Vec3(10.5, 0.1, 0.2), Vec3(0.1, 0.2, 40), Vec3(1, 2, 3), Vec3(-300, 20, 5)};
        if (mesh.positions[0].z() == 0 && mesh.positions.back().z() == 0)
            rest = {Vec3(0.5, 0.7, 0)};
        const FibreCarrier carrier = bind_inside(mesh, topology_of(mesh), rest);
        CHECK(largest_error(carried(carrier, mesh.positions), rest) < 1e-7);
    }
}

TEST_CASE("fibre carrier: refuses what it cannot bind", "[anatomy][fibres]") {
    const TriMesh mesh = test::sphere(1.0, 1), nothing;
    const Points bad{Vec3::Zero(), Vec3(0, std::nan(""), 0)};
    CHECK_THROWS_WITH(bind_inside(mesh, topology_of(mesh), bad), Catch::Contains("point 1 is not finite"));
    CHECK_THROWS_WITH(bind_inside(nothing, topology_of(nothing), Points{}), Catch::Contains("no triangles"));
    CHECK(bind_inside(mesh, topology_of(mesh), Points{}).point_count() == 0);
    // A frame that is not finite does no harm.
    const FibreCarrier carrier = bind_inside(mesh, topology_of(mesh), Points{Vec3(0.1, 0, 0.2)});
    CHECK_FALSE(carried(carrier, Points(mesh.positions.size(), Vec3::Constant(std::nan(""))))[0].allFinite());
}

TEST_CASE("fibre carrier: the same bits for any number of threads", "[anatomy][fibres]") {
    const TriMesh mesh = test::torus(3, 1, 40, 20);
    const Points rest = random_points(mesh, 500, true);
    const FibreCarrier one = bind_inside(mesh, topology_of(mesh), rest, 1);
    const FibreCarrier four = bind_inside(mesh, topology_of(mesh), rest, 4);
    CHECK(carried(one, mesh.positions) == carried(four, mesh.positions));
    CHECK(one.weight_count() == four.weight_count());
}

TEST_CASE("move inside: what is outside or near goes below the surface, the rest keeps its bits",
          "[anatomy][fibres]") {
    const TriMesh mesh = test::torus(3, 1, 40, 20);
    const SolidQuery solid(mesh);
    const double depth = 0.05;
    Points points = random_points(mesh, 600, false);
    for (const Vec3& p : mesh.positions)
        points.push_back(p);
    const Points before = points;
    int expected = 0;
    const int moved = move_inside(mesh, points, depth, 2);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double was = solid.signed_distance(before[i]), is = solid.signed_distance(points[i]);
        if (was <= -depth)
            CHECK(points[i] == before[i]);
        else {
            ++expected;
            CHECK(is < -0.4 * depth);
            if (was > 0) // no farther than to the surface and a little below
                CHECK((points[i] - before[i]).norm() < was + depth + 1e-9);
        }
    }
    CHECK(moved == expected);
    // Thinner than two depths: half-way is as deep as it gets.
    const TriMesh plate = box_mesh(Vec3(0, 0, 0), Vec3(10, 10, 0.06), {5, 5, 1});
    Points above{Vec3(5, 5, 1)};
    move_inside(plate, above, depth);
    CHECK(above[0].z() == Approx(0.03).margin(0.02));
}
