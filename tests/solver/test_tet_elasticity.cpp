#include "solver/rivals/polar.hpp"
#include "solver/rivals/tet_elasticity.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

using Corners = std::array<Vec3, 4>;

const Corners rest{Vec3(0.1, 0, 0), Vec3(2, 0.2, 0.1), Vec3(0.3, 1.8, -0.1), Vec3(0.2, 0.4, 1.7)};

Mat3 random_matrix(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> number(-size, size);
    Mat3 m;
    for (int i = 0; i < 9; ++i)
        m(i) = number(random);
    return m;
}

Mat3 some_rotation(double angle) {
    return Eigen::AngleAxisd(angle, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
}

Corners mapped(const Corners& x, const Mat3& f, const Vec3& shift = Vec3::Zero()) {
    Corners y;
    for (std::size_t i = 0; i < 4; ++i)
        y[i] = f * x[i] + shift;
    return y;
}

double energy(const TetMaterial& material, const TetShape& shape, const Corners& x) {
    return shape.volume * energy_density(material, shape.fibre, deformation_gradient(shape, x));
}

Eigen::Matrix<double, 12, 1> gradient(const TetMaterial& material, const TetShape& shape, const Corners& x) {
    Eigen::Matrix<double, 12, 1> g;
    const auto parts = tet_gradient(material, shape, deformation_gradient(shape, x));
    for (int i = 0; i < 4; ++i)
        g.segment<3>(3 * i) = parts[std::size_t(i)];
    return g;
}

/// Shapes that are stretched, squeezed, turned and inverted.
std::vector<Mat3> samples() {
    std::mt19937 random(7);
    std::vector<Mat3> all;
    for (int k = 0; k < 6; ++k)
        all.push_back(some_rotation(0.7 * k) * (Mat3::Identity() + random_matrix(random, 0.35)));
    all.push_back(Vec3(1.4, 0.8, -0.3).asDiagonal());
    all.push_back(some_rotation(2) * Mat3(Vec3(1.5, 1.2, -0.6).asDiagonal()) * some_rotation(-1));
    return all;
}

const Vec3 along = Vec3(0.6, 0, 0.8);

} // namespace

TEST_CASE("The signed decomposition gives rotations back for any matrix, also without rank",
          "[solver][tet]") {
    std::mt19937 random(3);
    std::vector<Mat3> all = samples();
    for (int k = 0; k < 200; ++k)
        all.push_back(random_matrix(random, 3.0));
    all.push_back(Mat3::Zero());
    all.push_back(Mat3::Identity());
    all.push_back(-Mat3::Identity());
    all.push_back(Vec3(1, 2, 3) * Vec3(0.5, -1, 2).transpose());
    all.push_back(Vec3(2, 2, 0).asDiagonal());
    for (const Mat3& f : all) {
        const SignedSvd svd = signed_svd(f);
        CHECK((svd.u * svd.sigma.asDiagonal() * svd.v.transpose() - f).norm() < 1e-12 * (1 + f.norm()));
        CHECK((svd.u.transpose() * svd.u - Mat3::Identity()).norm() < 1e-12);
        CHECK((svd.v.transpose() * svd.v - Mat3::Identity()).norm() < 1e-12);
        CHECK(svd.u.determinant() == Approx(1));
        CHECK(svd.v.determinant() == Approx(1));
        CHECK(svd.sigma[0] >= svd.sigma[1]);
        CHECK(svd.sigma[1] >= std::abs(svd.sigma[2]) - 1e-12 * (1 + f.norm()));
    }
}

TEST_CASE("The force of a tetrahedron is the derivative of its energy, inverted or not", "[solver][tet]") {
    const TetMaterial material = material_from(30, 0.47, 50);
    const TetShape shape = tet_shape(rest, 0.7, along);
    for (const Mat3& f : samples()) {
        const Corners x = mapped(rest, f, Vec3(1, 2, 3));
        const auto g = gradient(material, shape, x);
        const double h = 1e-6;
        for (int i = 0; i < 12; ++i) {
            Corners plus = x, minus = x;
            plus[std::size_t(i / 3)][i % 3] += h;
            minus[std::size_t(i / 3)][i % 3] -= h;
            const double measured =
                (energy(material, shape, plus) - energy(material, shape, minus)) / (2 * h);
            CHECK(g[i] == Approx(measured).epsilon(1e-6).margin(1e-5));
        }
        Vec3 sum = Vec3::Zero(), turn = Vec3::Zero();
        for (int i = 0; i < 4; ++i) {
            sum += g.segment<3>(3 * i);
            turn += x[std::size_t(i)].cross(Vec3(g.segment<3>(3 * i)));
        }
        CHECK(sum.norm() < 1e-11 * (1 + g.norm()));
        CHECK(turn.norm() < 1e-10 * (1 + g.norm()));
    }
}

TEST_CASE("The tangent of a tetrahedron is the derivative of its force, and the definite one has no negative "
          "eigenvalue",
          "[solver][tet]") {
    const TetMaterial material = material_from(30, 0.47, 50);
    const TetShape shape = tet_shape(rest, 0.7, along);
    for (const Mat3& f : samples()) {
        const Corners x = mapped(rest, f);
        const Mat12 k = tet_stiffness(material, shape, f, false);
        const double h = 1e-6;
        for (int i = 0; i < 12; ++i) {
            Corners plus = x, minus = x;
            plus[std::size_t(i / 3)][i % 3] += h;
            minus[std::size_t(i / 3)][i % 3] -= h;
            const Eigen::Matrix<double, 12, 1> measured =
                (gradient(material, shape, plus) - gradient(material, shape, minus)) / (2 * h);
            CHECK((k.col(i) - measured).norm() < 1e-6 * k.norm());
        }
        CHECK((k - k.transpose()).norm() < 1e-12 * k.norm());
        const Mat12 definite = tet_stiffness(material, shape, f, true);
        CHECK(Eigen::SelfAdjointEigenSolver<Mat12>(definite).eigenvalues().minCoeff() >
              -1e-12 * definite.norm());
        // A pressure's part belongs to both.
        const Mat12 pressed = tet_stiffness(material, shape, f, false, -90.0);
        for (int i = 0; i < 12; ++i) {
            Corners plus = x, minus = x;
            plus[std::size_t(i / 3)][i % 3] += h;
            minus[std::size_t(i / 3)][i % 3] -= h;
            Eigen::Matrix<double, 12, 1> measured;
            const auto a = tet_gradient(material, shape, deformation_gradient(shape, plus), -90.0);
            const auto b = tet_gradient(material, shape, deformation_gradient(shape, minus), -90.0);
            for (int n = 0; n < 4; ++n)
                measured.segment<3>(3 * n) = (a[std::size_t(n)] - b[std::size_t(n)]) / (2 * h);
            CHECK((pressed.col(i) - measured).norm() < 1e-6 * pressed.norm());
        }
        const Mat12 raised = tet_stiffness(material, shape, f, true, -90.0);
        CHECK(Eigen::SelfAdjointEigenSolver<Mat12>(raised).eigenvalues().minCoeff() > -1e-12 * raised.norm());
        // Where nothing was to be raised both are the same.
        if (Eigen::SelfAdjointEigenSolver<Mat12>(k).eigenvalues().minCoeff() > -1e-12 * k.norm())
            CHECK((k - definite).norm() < 1e-12 * k.norm());
    }
}

TEST_CASE("Turning and shifting a tetrahedron costs nothing and turns its forces along", "[solver][tet]") {
    const TetMaterial material = material_from(30, 0.47, 50);
    const TetShape shape = tet_shape(rest, 1.0, along);
    const Corners moved = mapped(rest, some_rotation(2.5), Vec3(100, -50, 20));
    CHECK(energy(material, shape, moved) < 1e-22);
    CHECK(gradient(material, shape, moved).norm() < 1e-11);
    const Mat3 f = Mat3::Identity() + 0.3 * along * Vec3(1, 2, -1).transpose();
    const Mat3 r = some_rotation(-1.1);
    CHECK(energy_density(material, along, r * f) == Approx(energy_density(material, along, f)));
    CHECK((first_piola(material, along, r * f) - r * first_piola(material, along, f)).norm() < 1e-11);
    // Without fibres turning the rest shape changes nothing either.
    CHECK(energy_density(material, Vec3::Zero(), f * r) == Approx(energy_density(material, Vec3::Zero(), f)));
}

TEST_CASE("A tetrahedron under uniform stretch has the energy of the formula", "[solver][tet]") {
    const double young = 30, poisson = 0.3;
    const TetMaterial material = material_from(young, poisson);
    // One axis: W = mu e^2 + lambda e^2 / 2, P11 = (2 mu + lambda) e, P22 = lambda e (1 + e).
    const double e = 0.2;
    const Mat3 f = Vec3(1 + e, 1, 1).asDiagonal();
    CHECK(energy_density(material, Vec3::Zero(), f) == Approx((material.mu + 0.5 * material.lambda) * e * e));
    const Mat3 p = first_piola(material, Vec3::Zero(), f);
    CHECK(p(0, 0) == Approx((2 * material.mu + material.lambda) * e));
    CHECK(p(1, 1) == Approx(material.lambda * e * (1 + e)));
    // Small, with free sides: e2 = e3 = -nu e1, W = E e1^2 / 2.
    const double small = 1e-5;
    const Mat3 bar = Vec3(1 + small, 1 - poisson * small, 1 - poisson * small).asDiagonal();
    CHECK(energy_density(material, Vec3::Zero(), bar) == Approx(0.5 * young * small * small).epsilon(1e-4));
    // All around: W = 3 mu e^2 + lambda/2 ((1 + e)^3 - 1)^2.
    const double growth = std::pow(1 + e, 3) - 1;
    CHECK(energy_density(material, Vec3::Zero(), (1 + e) * Mat3::Identity()) ==
          Approx(3 * material.mu * e * e + 0.5 * material.lambda * growth * growth));
    // A pressure adds itself times dJ/dF.
    CHECK((first_piola(material, Vec3::Zero(), f, 7.0) - p - 7.0 * f.determinant() * f.inverse().transpose())
              .norm() < 1e-12);
    // Simple shear by a small angle: W = G gamma^2 / 2.
    Mat3 shear = Mat3::Identity();
    shear(0, 1) = 1e-4;
    CHECK(energy_density(material, Vec3::Zero(), shear) ==
          Approx(0.5 * young / (2 * (1 + poisson)) * 1e-8).epsilon(1e-3));
}

TEST_CASE("Fibres pull by their stiffness times their stretch, along themselves and not when short",
          "[solver][tet]") {
    TetMaterial only_fibres;
    only_fibres.mu = only_fibres.lambda = 0;
    only_fibres.fibre = 40;
    const double stretch = 1.25;
    const Mat3 f = Mat3::Identity() + (stretch - 1) * along * along.transpose();
    CHECK(energy_density(only_fibres, along, f) == Approx(0.5 * 40 * 0.25 * 0.25));
    const Mat3 p = first_piola(only_fibres, along, f);
    CHECK((p - 40 * 0.25 * along * along.transpose()).norm() < 1e-12);
    const Mat3 shorter = Mat3::Identity() - 0.2 * along * along.transpose();
    CHECK(energy_density(only_fibres, along, shorter) == 0);
    CHECK(first_piola(only_fibres, along, shorter).norm() == 0);
    CHECK(first_piola(only_fibres, Vec3::Zero(), f).norm() == 0);
    CHECK(first_piola(only_fibres, along, Mat3::Zero()).allFinite());
}

TEST_CASE("Active fibres make the shorter and thicker tetrahedron the one without stress", "[solver][tet]") {
    const TetMaterial material = material_from(30, 0.47, 50);
    const double s = 0.8;
    const Mat3 g = active_inverse(along, s);
    CHECK(g.determinant() == Approx(1));
    const Mat3 across = Mat3::Identity() - along * along.transpose();
    const Mat3 shape = s * along * along.transpose() + across / std::sqrt(s);
    CHECK(energy_density(material, along, shape * g) < 1e-25);
    CHECK(energy_density(material, along, g) > 0.1); // at rest it is under tension
    CHECK((active_inverse(along, 1.0) - Mat3::Identity()).norm() < 1e-15);
}

TEST_CASE("Flat, needle-like and point-like tetrahedra have finite energies, forces and tangents",
          "[solver][tet]") {
    const TetMaterial material = material_from(30, 0.47, 50);
    const TetShape shape = tet_shape(rest, 1.0, along);
    const std::vector<Mat3> flat{Mat3::Zero(), -Mat3::Identity(), Vec3(1, 0, 0).asDiagonal(),
                                 Vec3(1, 1, 0).asDiagonal(), Vec3(1, 1, -1).asDiagonal()};
    for (const Mat3& f : flat) {
        CHECK(std::isfinite(energy_density(material, along, f)));
        CHECK(first_piola(material, along, f).allFinite());
        CHECK(tet_stiffness(material, shape, f, true).allFinite());
    }
    // Flattened, it is pushed apart again: the energy falls towards the upright side.
    const Mat3 flattened = Vec3(1, 1, 0).asDiagonal(), up = Vec3(1, 1, 0.01).asDiagonal();
    CHECK(energy_density(material, along, up) < energy_density(material, along, flattened));
}
