#include "solver/rivals/tet_constraints.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

const TetPoints rest{Vec3(0.1, 0, 0), Vec3(2, 0.2, 0.1), Vec3(0.3, 1.8, -0.1), Vec3(0.2, 0.4, 1.7)};
const Vec3 along = Vec3(0.6, 0, 0.8);

TetPoints shaken(int seed, double size) {
    std::mt19937 random{std::mt19937::result_type(seed)};
    std::uniform_real_distribution<double> shake(-size, size);
    TetPoints x = rest;
    for (Vec3& p : x)
        p += Vec3(shake(random), shake(random), shake(random));
    return x;
}

TetPoints turned(const TetPoints& x) {
    TetPoints y = x;
    for (Vec3& p : y)
        p = Eigen::AngleAxisd(1.3, Vec3(1, 2, -1).normalized()) * p + Vec3(30, -20, 10);
    return y;
}

double weighted(const TetPoints& a, const TetPoints& b) {
    double most = 0;
    for (std::size_t i = 0; i < 4; ++i)
        most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

} // namespace

TEST_CASE("Tetrahedral constraints have the derivatives they say, and do not see rigid motion",
          "[solver][tet]") {
    const TetShape shape = tet_shape(rest, 1.0, along);
    const auto all = [&](int which, const TetPoints& x) {
        return which == 0   ? volume_change(shape, x)
               : which == 1 ? distortion(shape, x)
                            : fibre_length(shape, x);
    };
    for (int which = 0; which < 3; ++which)
        for (int seed = 0; seed < 6; ++seed) {
            const TetPoints x = shaken(seed, 1.2);
            const TetConstraint c = all(which, x);
            Vec3 sum = Vec3::Zero();
            for (int i = 0; i < 12; ++i) {
                TetPoints plus = x, minus = x;
                plus[std::size_t(i / 3)][i % 3] += 1e-6;
                minus[std::size_t(i / 3)][i % 3] -= 1e-6;
                CHECK(c.gradient[std::size_t(i / 3)][i % 3] ==
                      Approx((all(which, plus).value - all(which, minus).value) / 2e-6)
                          .epsilon(1e-6)
                          .margin(1e-7));
            }
            for (const Vec3& g : c.gradient)
                sum += g;
            CHECK(sum.norm() < 1e-12);
            CHECK(all(which, turned(x)).value == Approx(c.value).margin(1e-11));
        }
}

TEST_CASE("Tetrahedral constraints take the values of the formulas, also of flat tetrahedra",
          "[solver][tet]") {
    const TetShape shape = tet_shape(rest, 1.0, along);
    CHECK(volume_change(shape, rest).value == Approx(0).margin(1e-12));
    CHECK(distortion(shape, rest).value == Approx(0).margin(1e-12));
    CHECK(fibre_length(shape, rest).value == Approx(0).margin(1e-12));
    TetPoints x;
    for (std::size_t i = 0; i < 4; ++i)
        x[i] = Vec3(1.5, 0.5, 2).cwiseProduct(rest[i]);
    CHECK(volume_change(shape, x).value == Approx(0.5));
    CHECK(distortion(shape, x).value == Approx(std::sqrt(0.25 + 0.25 + 1)));
    CHECK(fibre_length(shape, x).value == Approx(std::sqrt(0.81 + 2.56) - 1));
    x.fill(Vec3(1, 1, 1)); // shrunk to a point
    CHECK(distortion(shape, x).value == Approx(std::sqrt(3.0)));
    CHECK(fibre_length(shape, x).value == 0);
    TetPoints before = x;
    project_tet(material_from(30, 0.47, 30), shape, x, {1, 1, 1, 1}, 1e-3, 1.0);
    for (const Vec3& p : x)
        CHECK(p.allFinite());
    TetPoints nobody = shaken(1, 0.5);
    before = nobody;
    project_tet(material_from(30, 0.47, 30), shape, nobody, {0, 0, 0, 0}, 1e-3, 1.0);
    CHECK(nobody == before);
}

TEST_CASE(
    "The tetrahedral constraints have the energy of Young's modulus and Poisson's ratio at small strain",
    "[solver][tet]") {
    const double young = 30, poisson = 0.4;
    const TetMaterial material = material_from(young, poisson);
    const TetShape shape = tet_shape(rest, 1.0, Vec3::Zero());
    const double e = 1e-4;
    const auto stretched = [&](const Vec3& s) {
        TetPoints x;
        for (std::size_t i = 0; i < 4; ++i)
            x[i] = s.cwiseProduct(rest[i]);
        return tet_energy(material, shape, x) / shape.volume;
    };
    CHECK(stretched(Vec3(1 + e, 1 - poisson * e, 1 - poisson * e)) ==
          Approx(0.5 * young * e * e).epsilon(1e-3));
    CHECK(stretched(Vec3::Constant(1 + e)) ==
          Approx(4.5 * young / (3 * (1 - 2 * poisson)) * e * e).epsilon(1e-3));
    TetPoints x = turned(rest);
    project_tet(material, shape, x, {1, 2, 3, 4}, 1e-3, 1.0);
    CHECK(weighted(x, turned(rest)) < 1e-12);
}

TEST_CASE("A projection lowers the energy of a distorted tetrahedron and keeps its momentum",
          "[solver][tet]") {
    const TetMaterial material = material_from(30, 0.47, 60);
    const TetShape shape = tet_shape(rest, 1.0, along);
    for (int seed = 0; seed < 16; ++seed) {
        // From heavy and soft to light and stiff.
        const double light = seed < 8 ? 1e4 : 1e8;
        const std::array<double, 4> w{light, 2 * light, light, 3 * light};
        TetPoints x = shaken(seed, 0.25);
        const TetPoints start = x;
        project_tet(material, shape, x, w, 1e-3, 1.0);
        CHECK(tet_energy(material, shape, x) < tet_energy(material, shape, start));
        Vec3 momentum = Vec3::Zero();
        for (std::size_t i = 0; i < 4; ++i)
            momentum += (x[i] - start[i]) / w[i];
        CHECK(momentum.norm() < 1e-14 / light);
        // The same in metres.
        TetPoints metres = start;
        TetPoints rest_metres = rest;
        for (std::size_t i = 0; i < 4; ++i) {
            metres[i] /= 1000;
            rest_metres[i] /= 1000;
        }
        project_tet(material, tet_shape(rest_metres, 1.0, along), metres, w, 1e-3, 1000.0);
        for (std::size_t i = 0; i < 4; ++i)
            CHECK((1000 * metres[i] - x[i]).norm() < 1e-9);
    }
}

TEST_CASE("One step of a single mode is the implicit step of the formula", "[solver][tet]") {
    // The fibre term alone, all mass far away but at one end: C = l - 1 = c, w g^2 = W, dl = -c / (W + 1/(k V h^2)).
    TetMaterial material;
    material.mu = material.lambda = 1e-12;
    material.fibre = 40;
    const TetPoints corner{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    const TetShape shape = tet_shape(corner, 1.0, Vec3::UnitX());
    TetPoints x = corner;
    x[1].x() = 1.5;
    const double w = 5e4, h = 2e-3, alpha = 1 / (40 * shape.volume * h * h);
    project_tet(material, shape, x, {0, w, 0, 0}, h, 1.0);
    CHECK(x[1].x() == Approx(1.5 - 0.5 * w / (w + alpha)).epsilon(1e-6));
}

TEST_CASE("A bound point is brought to its target by the least motion", "[solver][tet]") {
    TetPoints x = rest;
    const std::array<double, 4> weights{0.1, 0.2, 0.3, 0.4}, w{1, 0, 2, 4};
    const Vec3 target(3, 1, 2);
    project_point(x, weights, target, w);
    Vec3 p = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i)
        p += weights[i] * x[i];
    CHECK((p - target).norm() < 1e-12);
    CHECK(x[1] == rest[1]);
    // Least motion: every way is along the same direction, in proportion to w_i b_i.
    CHECK(((x[2] - rest[2]) / (2 * 0.3) - (x[3] - rest[3]) / (4 * 0.4)).norm() < 1e-12);
    x = rest;
    project_point(x, weights, target, {0, 0, 0, 0});
    CHECK(x == rest);
}
