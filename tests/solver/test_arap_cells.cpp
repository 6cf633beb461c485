#include "solver/rivals/arap/arap_cells.hpp"
#include "solver/rivals/arap/arap_system.hpp"
#include "solver/rivals/arap/cotangent_weights.hpp"
#include "solver/rivals/best_rotation.hpp"
#include "support/shapes.hpp"

#include "fascicle/base/pose.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

struct Surface {
    TriMesh mesh;
    MeshTopology topology;
    ArapCells cells;
    explicit Surface(TriMesh m)
        : mesh(std::move(m)), topology(mesh.vertex_count(), mesh.triangles),
          cells(mesh.positions, topology, cotangent_weights(mesh.positions, mesh.triangles, topology)) {}
    std::size_t size() const { return mesh.positions.size(); }
};

Points shaken(const Points& points, double by, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-by, by);
    Points result = points;
    for (Vec3& p : result)
        for (int k = 0; k < 3; ++k)
            p[k] += shift(random);
    return result;
}

Points moved(const Points& points, const Pose& pose) {
    Points result;
    for (const Vec3& p : points)
        result.push_back(pose.apply(p));
    return result;
}

double largest(const Points& points) {
    double result = 0;
    for (const Vec3& p : points)
        result = std::max(result, p.norm());
    return result;
}

double farthest(const Points& a, const Points& b) {
    double result = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        result = std::max(result, (a[i] - b[i]).norm());
    return result;
}

/// A bar along x, 10 x 2 x 2, of 4 (n + 1) vertices and open at no end.
TriMesh bar(int n) {
    TriMesh mesh;
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < 4; ++k)
            mesh.positions.emplace_back(10.0 * i / n, (k == 1 || k == 2) ? 2.0 : 0.0, k >= 2 ? 2.0 : 0.0);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k) {
            const int a = 4 * i + k, b = 4 * i + (k + 1) % 4;
            mesh.triangles.push_back({a, b + 4, b});
            mesh.triangles.push_back({a, a + 4, b + 4});
        }
    mesh.triangles.push_back({0, 1, 2});
    mesh.triangles.push_back({0, 2, 3});
    mesh.triangles.push_back({4 * n, 4 * n + 2, 4 * n + 1});
    mesh.triangles.push_back({4 * n, 4 * n + 3, 4 * n + 2});
    return mesh;
}

} // namespace

TEST_CASE("arap: cotangents of known angles, and of triangles without area", "[solver][arap]") {
    const Vec3 o(1, 2, 3);
    CHECK(bounded_cotangent(o + Vec3(2, 0, 0), o + Vec3(0, 3, 0), o) == Approx(0).margin(1e-15));
    CHECK(bounded_cotangent(o + Vec3(1, 0, 0), o + Vec3(0.5, std::sqrt(0.75), 0), o) ==
          Approx(1 / std::sqrt(3.0)));
    CHECK(bounded_cotangent(o + Vec3(1, 0, 0), o + Vec3(-1, 1, 0), o) == Approx(-1));
    CHECK(bounded_cotangent(o + Vec3(1, 0, 0), o + Vec3(2, 0, 0), o) == most_cotangent);
    CHECK(bounded_cotangent(o + Vec3(1, 0, 0), o + Vec3(-2, 0, 0), o) == -most_cotangent);
    CHECK(bounded_cotangent(o, o + Vec3(1, 0, 0), o) == 0.0);
    CHECK(bounded_cotangent(o, o, o) == 0.0);
}

TEST_CASE("arap: cotangent weights of a cube, of an obtuse pair and of a border", "[solver][arap]") {
    const TriMesh cube = test::box();
    const MeshTopology topology(cube.vertex_count(), cube.triangles);
    const auto weights = cotangent_weights(cube.positions, cube.triangles, topology);
    for (std::size_t e = 0; e < weights.size(); ++e) {
        const Edge edge = topology.edges()[e];
        const double length =
            (cube.positions[std::size_t(edge.a)] - cube.positions[std::size_t(edge.b)]).norm();
        // A side is opposite of two angles of 45 degrees, a diagonal of two right ones.
        CHECK(weights[e] == Approx(length < 1.1 ? 1.0 : least_weight));
    }
    // Edge 0-1 lies opposite of two obtuse angles; 0-2 at the border opposite of one acute one.
    const TriMesh obtuse{{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(1, 0.5, 0), Vec3(1, -0.5, 0)},
                         {{0, 1, 2}, {1, 0, 3}}};
    const MeshTopology pair(4, obtuse.triangles);
    const auto two = cotangent_weights(obtuse.positions, obtuse.triangles, pair);
    CHECK(two[0] == least_weight);
    CHECK(two[1] == Approx(0.5 * 2.0)); // cot of atan(1 / 2)
    // They are plain numbers: the same for the same shape of any size.
    TriMesh ball = test::sphere(10, 2);
    const MeshTopology round(ball.vertex_count(), ball.triangles);
    const auto large = cotangent_weights(ball.positions, ball.triangles, round);
    for (Vec3& p : ball.positions)
        p *= 1e-3;
    const auto small = cotangent_weights(ball.positions, ball.triangles, round);
    for (std::size_t e = 0; e < large.size(); ++e)
        CHECK(small[e] == Approx(large[e]).epsilon(1e-12));
}

TEST_CASE("arap: the best rotation is proper and best, also of flat and mirrored cells", "[solver][arap]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int trial = 0; trial < 40; ++trial) {
        Mat3 s = Mat3::Zero();
        for (int link = 0; link < 1 + trial % 5; ++link) { // ranks 1 to 3
            const Vec3 e(number(random), number(random), number(random));
            Vec3 e2(number(random), number(random), number(random));
            s += e * e2.transpose();
        }
        if (trial % 4 == 3)
            s = -s; // often a reflection would fit better
        const Mat3 best = best_rotation(s);
        CHECK((best * best.transpose() - Mat3::Identity()).norm() < 1e-12);
        CHECK(best.determinant() == Approx(1));
        for (int k = 0; k < 200; ++k) {
            const Vec3 axis(number(random), number(random), number(random));
            const Mat3 other = rotation_about(Vec3::Zero(), axis, 3.2 * number(random)).rotation;
            CHECK((other * s).trace() <= (best * s).trace() + 1e-12);
        }
    }
    CHECK(best_rotation(Mat3::Zero()).determinant() == Approx(1));
}

TEST_CASE("arap: no energy and no gradient at rest or after a rigid motion", "[solver][arap]") {
    const Surface s(test::torus(3, 1, 16, 8));
    const Pose pose = rotation_about(Vec3(1, 2, 3), Vec3(1, -1, 2), 2.5);
    for (const Points& x : {s.mesh.positions, moved(s.mesh.positions, pose)}) {
        std::vector<Mat3> rotations;
        s.cells.fit(x, rotations, 1);
        CHECK(s.cells.energy(x, rotations) < 1e-24);
        CHECK(largest(s.cells.gradient(x, rotations)) < 1e-12);
    }
    std::vector<Mat3> rotations;
    s.cells.fit(moved(s.mesh.positions, pose), rotations, 1);
    for (const Mat3& r : rotations)
        CHECK((r - pose.rotation).norm() < 1e-12);
}

TEST_CASE("arap: the gradient is the energy's derivative, and the energy turns with the surface",
          "[solver][arap]") {
    const Surface s(test::sphere(2, 1));
    Points x = shaken(s.mesh.positions, 0.3);
    std::vector<Mat3> rotations;
    s.cells.fit(x, rotations, 1);
    const Points gradient = s.cells.gradient(x, rotations);
    const double h = 1e-5;
    for (std::size_t i = 0; i < s.size(); i += 3)
        for (int k = 0; k < 3; ++k) {
            // Rotations are the best ones, so the energy of best rotations has the same derivative.
            const auto energy_at = [&](double step) {
                Points y = x;
                y[i][k] += step;
                std::vector<Mat3> best;
                s.cells.fit(y, best, 1);
                return s.cells.energy(y, best);
            };
            CHECK((energy_at(h) - energy_at(-h)) / (2 * h) == Approx(gradient[i][k]).margin(1e-6));
        }
    const double energy = s.cells.energy(x, rotations);
    const Points turned = moved(x, rotation_about(Vec3(4, 0, 0), Vec3(0, 1, 1), 1.0));
    s.cells.fit(turned, rotations, 1);
    CHECK(s.cells.energy(turned, rotations) == Approx(energy));
}

TEST_CASE("arap: a surface of another size has the same rotations and the energy of its area",
          "[solver][arap]") {
    const Surface large(test::sphere(1000, 1));
    TriMesh mesh = large.mesh;
    for (Vec3& p : mesh.positions)
        p *= 1e-6;
    const Surface small(mesh);
    const Points x = shaken(large.mesh.positions, 100);
    Points y = x;
    for (Vec3& p : y)
        p *= 1e-6;
    std::vector<Mat3> of_large, of_small;
    large.cells.fit(x, of_large, 1);
    small.cells.fit(y, of_small, 1);
    for (std::size_t i = 0; i < large.size(); ++i)
        CHECK((of_large[i] - of_small[i]).norm() < 1e-9);
    CHECK(small.cells.energy(y, of_small) == Approx(1e-12 * large.cells.energy(x, of_large)));
}

TEST_CASE("arap: the factored system is the dense one, and its solution ends the gradient",
          "[solver][arap]") {
    const Surface s(bar(6));
    std::vector<std::uint8_t> free(s.size(), 1);
    for (std::size_t i = 0; i < 4; ++i)
        free[i] = free[s.size() - 1 - i] = 0;
    std::vector<double> penalties(s.size(), 0.0);
    penalties[9] = 3.0;
    ArapSystem system(s.cells, free, std::vector<double>(s.size(), 0.0));
    system.set_penalties(penalties);
    Points x = shaken(s.mesh.positions, 0.2);
    std::vector<Mat3> rotations;
    s.cells.fit(x, rotations, 1);
    Points b, y;
    s.cells.right_side(rotations, b, 1);
    const Points plain = b;
    const Vec3 target(4, 5, 6);
    b[9] += penalties[9] * target;
    const Points forces = shaken(Points(s.size(), Vec3::Zero()), 1, 7);
    system.solve(b, forces, x, y);

    const auto n = Eigen::Index(s.size());
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n), right(n, 6);
    for (Eigen::Index i = 0; i < n; ++i) {
        if (free[std::size_t(i)] == 0) {
            dense(i, i) = 1;
            right.row(i) << x[std::size_t(i)].transpose(), 0, 0, 0;
            continue;
        }
        dense(i, i) = s.cells.weight_at(std::size_t(i)) + penalties[std::size_t(i)];
        for (const auto& link : s.cells.links(std::size_t(i)))
            dense(i, link.other) -= link.weight;
        right.row(i) << b[std::size_t(i)].transpose(), forces[std::size_t(i)].transpose();
    }
    const Eigen::MatrixXd exact = dense.fullPivLu().solve(right);
    for (Eigen::Index i = 0; i < n; ++i) {
        CHECK((exact.row(i).head<3>().transpose() - x[std::size_t(i)]).norm() < 1e-12);
        CHECK((exact.row(i).tail<3>().transpose() - y[std::size_t(i)]).norm() < 1e-12);
    }
    const Points gradient = s.cells.gradient(x, rotations);
    for (std::size_t i = 0; i < s.size(); ++i)
        if (free[i] != 0)
            CHECK((gradient[i] / 4 + penalties[i] * (x[i] - target)).norm() < 1e-12);
}

TEST_CASE("arap: a part that nothing holds has no solution, and the error says so", "[solver][arap]") {
    const Surface s(test::tetrahedron());
    CHECK_THROWS_WITH(ArapSystem(s.cells, {1, 1, 1, 1}, {0, 0, 0, 0}), Catch::Contains("singular"));
    ArapSystem nothing(s.cells, {0, 0, 0, 0}, {0, 0, 0, 0});
    Points x = s.mesh.positions, y;
    nothing.solve(x, x, x, y);
    CHECK(x == s.mesh.positions);
}

TEST_CASE("arap: alternations never raise the energy, and end where a brute-force minimiser does",
          "[solver][arap]") {
    const Surface s(bar(4));
    const Pose bent = rotation_about(Vec3(5, -4, 0), Vec3(0, 0.2, 1), -0.6);
    std::vector<std::uint8_t> free(s.size(), 1);
    Points x = s.mesh.positions;
    for (std::size_t k = 0; k < 4; ++k) {
        free[k] = free[s.size() - 1 - k] = 0;
        x[s.size() - 1 - k] = bent.apply(x[s.size() - 1 - k]);
    }
    Points brute = x;
    const std::vector<double> none(s.size(), 0.0);
    ArapSystem system(s.cells, free, none);
    const Points no_force(s.size(), Vec3::Zero());
    std::vector<Mat3> rotations;
    Points b, y;
    double last = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 200; ++k) {
        s.cells.fit(x, rotations, 1);
        const double fitted = s.cells.energy(x, rotations);
        CHECK(fitted <= last * (1 + 1e-12) + 1e-14);
        s.cells.right_side(rotations, b, 1);
        system.solve(b, no_force, x, y);
        last = s.cells.energy(x, rotations);
        CHECK(last <= fitted * (1 + 1e-12) + 1e-14);
    }
    CHECK(last > 1e-3);
    // Plain gradient descent with halved steps, which knows neither the factor nor the alternation.
    const auto least = [&](const Points& at, Points* slope) {
        std::vector<Mat3> best;
        s.cells.fit(at, best, 1);
        if (slope != nullptr)
            *slope = s.cells.gradient(at, best);
        return s.cells.energy(at, best);
    };
    Points slope;
    double energy = least(brute, &slope), step = 0.05;
    for (int k = 0; k < 1000; ++k) {
        Points next = brute;
        for (std::size_t i = 0; i < next.size(); ++i)
            if (free[i] != 0)
                next[i] -= step * slope[i];
        if (const double there = least(next, nullptr); there < energy) {
            brute = next;
            energy = least(brute, &slope);
            step *= 1.1;
        } else
            step *= 0.5;
    }
    CHECK(last == Approx(energy).epsilon(1e-3));
    CHECK(farthest(x, brute) < 0.02);
}
