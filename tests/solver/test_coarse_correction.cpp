#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/volume.hpp"
#include "fascicle/solver/soft_body_solver.hpp"
#include "solver/coarse/coarse_correction.hpp"
#include "solver/constraints/volume.hpp"
#include "support/shapes.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>
#include <sstream>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

/// A ball whose lower cap is fixed, with edges of k = 0.9, hinges of k = 0.3, at 3 substeps a frame.
struct Ball {
    TriMesh mesh = test::sphere(10, 4);
    MeshTopology topology{mesh.vertex_count(), mesh.triangles};
    std::vector<double> inverse_mass;
    std::vector<DistanceConstraint> edges;
    DihedralConstraints hinges{mesh.positions, topology.dihedrals(), 0.3};
    VolumeConstraint volume{mesh.positions, mesh.triangles, 1.0};
    ElasticTerms terms;
    CoarseCorrection coarse;

    explicit Ball(int clusters = 12) {
        for (const Vec3& p : mesh.positions)
            inverse_mass.push_back(p.z() < -8 ? 0.0 : 1.0);
        for (const Edge& e : topology.edges())
            edges.push_back({e.a, e.b, (at(e.a) - at(e.b)).norm(), compliance_from_stiffness(0.9, 2.0)});
        terms = {&edges, &hinges.items(), 0.3, 1.0 / 180, 1.0};
        coarse = CoarseCorrection(mesh.positions, topology, inverse_mass, clusters, 10);
    }
    const Vec3& at(int i) const { return mesh.positions[static_cast<std::size_t>(i)]; }

    /// Displacement energy and elastic energy of moving from y to x.
    double energy(const Points& x, const Points& y) const {
        double sum = 0;
        const auto add = [&](const ElasticTerm& t) { sum += 0.5 * t.weight * t.value * t.value; };
        for_each_edge_term(terms, x, {}, add);
        for_each_hinge_term(terms, x, {}, add);
        for (std::size_t i = 0; i < x.size(); ++i)
            sum += 0.5 * (x[i] - y[i]).squaredNorm();
        return sum;
    }
    /// Bent to the side, more with height; the fixed cap stays.
    Points bent(double by) const {
        Points x = mesh.positions;
        for (Vec3& p : x)
            p.x() += by * std::max(0.0, p.z() + 8) * std::max(0.0, p.z() + 8) / 324;
        return x;
    }
};

double largest_move(const Points& a, const Points& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, (a[i] - b[i]).norm());
    return largest;
}

double rms(const Points& a, const Points& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / double(a.size()));
}

} // namespace

TEST_CASE("banded cholesky: solves as a dense solver does", "[solver][coarse]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> value(-1, 1);
    const int n = 57, band = 19;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    BandedCholesky banded;
    banded.reset(n, band);
    for (int j = 0; j < n; ++j)
        for (int i = j; i <= std::min(n - 1, j + band); ++i) {
            banded.at(i, j) = value(random) + (i == j ? 2.0F * band : 0.0F);
            dense(i, j) = dense(j, i) = double(banded.at(i, j));
        }
    std::vector<float> b0(n), b1(n);
    Eigen::VectorXd d0(n), d1(n);
    for (int i = 0; i < n; ++i) {
        d0[i] = double(b0[std::size_t(i)] = value(random));
        d1[i] = double(b1[std::size_t(i)] = value(random));
    }
    REQUIRE(banded.factor() == 0);
    banded.solve(b0);
    banded.solve(b1);
    const Eigen::VectorXd x0 = dense.ldlt().solve(d0), x1 = dense.ldlt().solve(d1);
    for (int i = 0; i < n; ++i) {
        CHECK(double(b0[std::size_t(i)]) == Approx(x0[i]).margin(1e-6));
        CHECK(double(b1[std::size_t(i)]) == Approx(x1[i]).margin(1e-6));
    }
}

TEST_CASE("banded cholesky: an unknown without a pivot drops out", "[solver][coarse]") {
    BandedCholesky banded;
    banded.reset(3, 1);
    banded.at(0, 0) = 4;
    banded.at(2, 2) = 9;
    std::vector<float> b0{8, 1, 18}, b1{0, 0, 0};
    CHECK(banded.factor() == 1);
    banded.solve(b0);
    banded.solve(b1);
    CHECK(b0[0] == 2.0F);
    CHECK(std::abs(b0[1]) < 1e-20F);
    CHECK(b0[2] == 2.0F);
}

TEST_CASE("cluster basis: weights sum to one away from fixed vertices, and vanish there",
          "[solver][coarse]") {
    const Ball ball;
    const ClusterBasis& basis = ball.coarse.basis();
    REQUIRE(basis.clusters() == 12);
    int full = 0;
    for (std::size_t i = 0; i < ball.mesh.positions.size(); ++i) {
        double sum = 0;
        for (const float share : basis.weights()[i].weight) {
            const auto w = static_cast<double>(share);
            CHECK(w >= 0.0);
            sum += w;
        }
        CHECK(sum < 1 + 1e-6);
        if (ball.inverse_mass[i] == 0.0)
            CHECK(sum == 0.0);
        else
            CHECK(sum > 0.0);
        full += std::abs(sum - 1) < 1e-6 ? 1 : 0;
    }
    CHECK(full > int(ball.mesh.positions.size()) / 3);
}

TEST_CASE("cluster basis: restriction is the transpose of prolongation, in turned frames too",
          "[solver][coarse]") {
    Ball ball;
    ClusterBasis basis(ball.mesh.positions, ball.topology, ball.inverse_mass, 9);
    Points x = ball.mesh.positions;
    const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& p : x)
        p = turn * p + Vec3(3, -1, 2);
    // A few iterations a call: enough for the turn of a substep, not for a jump.
    basis.update_frames(x);
    basis.update_frames(x);
    basis.update_frames(x);
    basis.update_frames(x);
    CHECK((basis.turn(0) - turn).norm() < 1e-4);
    CHECK(basis.mean_bend() < 1e-4); // all alike
    std::mt19937 random(5);
    std::uniform_real_distribution<double> value(-1, 1);
    Points f(x.size()), u(x.size());
    for (Vec3& v : f)
        v = Vec3(value(random), value(random), value(random));
    std::vector<float> q(std::size_t(basis.unknowns())), r(q.size());
    for (float& v : q)
        v = float(value(random));
    basis.restrict_forces(x, f, r);
    basis.prolong(x, q, u);
    double coarse = 0, fine = 0;
    for (std::size_t i = 0; i < q.size(); ++i)
        coarse += double(q[i]) * double(r[i]);
    for (std::size_t i = 0; i < f.size(); ++i)
        fine += f[i].dot(u[i]);
    CHECK(coarse == Approx(fine).epsilon(1e-5));
}

TEST_CASE("cluster basis: no more than a cluster for twenty free vertices, none without any",
          "[solver][coarse]") {
    const TriMesh mesh = test::sphere(1, 2);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const std::size_t count = mesh.positions.size();
    CHECK(ClusterBasis(mesh.positions, topology, std::vector<double>(count, 1.0), 1000).clusters() ==
          int(count / 20));
    CHECK(ClusterBasis(mesh.positions, topology, std::vector<double>(count, 0.0), 10).clusters() == 0);
}

TEST_CASE("coarse correction: rest stays rest", "[solver][coarse]") {
    Ball ball;
    Points x = ball.mesh.positions;
    for (int k = 0; k < 3; ++k)
        ball.coarse.correct(x, ball.terms, ball.volume, ball.inverse_mass, {});
    CHECK(largest_move(x, ball.mesh.positions) < 1e-9);
}

TEST_CASE("coarse matrix: solves as the dense matrix of its own movements does", "[solver][coarse]") {
    Ball ball;
    CoarseMatrix matrix(ball.mesh.positions, ball.topology, ball.inverse_mass, 12, 3);
    ClusterBasis& basis = matrix.basis();
    const Points x = ball.bent(1.0);
    matrix.assemble(x, ball.terms, ball.inverse_mass, {});
    const int n = basis.unknowns();
    const auto points = static_cast<Eigen::Index>(x.size());
    Eigen::MatrixXd modes(3 * points, n); // P, column by column
    Points u(x.size());
    for (int j = 0; j < n; ++j) {
        std::vector<float> q(std::size_t(n), 0.0F);
        q[std::size_t(j)] = 1.0F;
        basis.prolong(x, q, u);
        for (Eigen::Index i = 0; i < points; ++i)
            modes.block<3, 1>(3 * i, j) = u[std::size_t(i)];
    }
    Eigen::MatrixXd dense = modes.transpose() * modes;
    const auto add = [&](double factor) {
        return [&dense, &modes, n, factor](const ElasticTerm& t) {
            Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
            for (std::size_t j = 0; j < std::size_t(t.count); ++j)
                row += modes.middleRows<3>(3 * t.point[j]).transpose() * t.gradient[j];
            dense += factor * t.weight * row * row.transpose();
        };
    };
    // So many vertices a cluster: every second edge and every fourth hinge.
    for_each_edge_term(ball.terms, x, {0, 2}, add(2 * matrix_safety));
    for_each_hinge_term(ball.terms, x, {0, 4}, add(4 * matrix_safety));
    std::mt19937 random(11);
    std::uniform_real_distribution<float> value(-1, 1);
    std::vector<float> b(std::size_t(n), 0.0F);
    Eigen::VectorXd right(n);
    for (int i = 0; i < n; ++i)
        right[i] = double(b[std::size_t(i)] = value(random));
    matrix.solve(b);
    const Eigen::VectorXd wanted = dense.ldlt().solve(right);
    for (int i = 0; i < n; ++i)
        CHECK(double(b[std::size_t(i)]) == Approx(wanted[i]).margin(1e-3 * wanted.lpNorm<Eigen::Infinity>()));
}

TEST_CASE("coarse matrix: outdated when clusters turn against each other, not when all turn alike",
          "[solver][coarse]") {
    Ball ball;
    CoarseMatrix matrix(ball.mesh.positions, ball.topology, ball.inverse_mass, 12, 3);
    matrix.assemble(ball.mesh.positions, ball.terms, ball.inverse_mass, {});
    const auto follow = [&](const Points& x) {
        for (int k = 0; k < 20; ++k)
            matrix.basis().update_frames(x);
        return matrix.outdated();
    };
    Points turned = ball.mesh.positions, twisted = turned;
    for (std::size_t i = 0; i < turned.size(); ++i) {
        turned[i] = Eigen::AngleAxisd(1.0, Vec3::UnitZ()) * turned[i];
        twisted[i] = Eigen::AngleAxisd(0.1 * twisted[i].z(), Vec3::UnitZ()) * twisted[i];
    }
    CHECK_FALSE(follow(turned));
    CHECK(follow(twisted));
}

TEST_CASE("coarse correction: lessens the energy of a bend, and fixed vertices stay", "[solver][coarse]") {
    const double by = GENERATE(0.2, 1.0, 3.0);
    Ball ball;
    const Points y = ball.bent(by);
    Points x = y;
    const double before = ball.energy(y, y);
    ball.coarse.correct(x, ball.terms, ball.volume, ball.inverse_mass, {});
    CHECK(ball.energy(x, y) < before);
    CHECK(largest_move(x, y) > 0.01 * by);
    CHECK(std::abs(ball.volume.evaluate(x) / ball.volume.rest_volume() - 1) < 2e-3);
    for (std::size_t i = 0; i < x.size(); ++i)
        if (ball.inverse_mass[i] == 0.0)
            CHECK(x[i] == y[i]);
}

TEST_CASE("coarse correction: a turned ball is corrected by the turned step", "[solver][coarse]") {
    Ball still, moved;
    const Points y = still.bent(1.0);
    const Mat3 turn = Eigen::AngleAxisd(1.3, Vec3(-1, 2, 0.5).normalized()).toRotationMatrix();
    const Vec3 shift(40, -7, 12);
    Points a = y, b = y;
    for (Vec3& p : b)
        p = turn * p + shift;
    // The second steps work with matrices made before: one at the bend, one in frames that have turned.
    for (int k = 0; k < 3; ++k) {
        still.coarse.correct(a, still.terms, still.volume, still.inverse_mass, {});
        moved.coarse.correct(b, moved.terms, moved.volume, moved.inverse_mass, {});
    }
    Points back = b;
    for (Vec3& p : back)
        p = turn.transpose() * (p - shift);
    CHECK(largest_move(a, y) > 0.01);
    CHECK(largest_move(back, a) < 0.02 * largest_move(a, y));
}

TEST_CASE("coarse correction: does not push a point into what it touches", "[solver][coarse]") {
    Ball free, held;
    const Points y = free.bent(1.0);
    Points a = y, b = y;
    free.coarse.correct(a, free.terms, free.volume, free.inverse_mass, {});
    // The bend comes back towards -x. Solids on that side hold it.
    Points normals(y.size(), Vec3::Zero());
    for (std::size_t i = 0; i < y.size(); ++i)
        if (free.inverse_mass[i] != 0.0 && y[i].x() < -2)
            normals[i] = Vec3::UnitX();
    held.coarse.correct(b, held.terms, held.volume, held.inverse_mass, normals);
    double in_free = 0, in_held = 0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        in_free += std::max(0.0, -(a[i] - y[i]).dot(normals[i]));
        in_held += std::max(0.0, -(b[i] - y[i]).dot(normals[i]));
    }
    REQUIRE(in_free > 0.0);
    CHECK(in_held < 0.1 * in_free);
}

TEST_CASE("coarse correction: few substeps come near to many", "[solver][coarse][slow]") {
    // A ball between two solids of which one walks off sideways, then waits.
    const TriMesh mesh = test::sphere(10, 4);
    const auto settle = [&](const std::string& settings) {
        SoftBodyProblem problem;
        problem.surface = std::make_shared<TriMesh>(mesh);
        for (const Vec3& p : mesh.positions)
            problem.body_of_vertex.push_back(p.z() < -8 ? 0 : p.z() > 8 ? 1 : -1);
        DistanceGridOptions options;
        options.spacing = 2;
        for (int b = 0; b < 2; ++b) {
            TriMesh box = test::box(4, 4, 4);
            for (Vec3& p : box.positions)
                p += Vec3(100, 100 * b, -100);
            const auto shared = std::make_shared<TriMesh>(box);
            problem.solids.push_back({shared, std::make_shared<DistanceGrid>(box, options)});
        }
        problem.parameters.assign("solver.coarse=0");
        std::istringstream list(settings);
        for (std::string word; list >> word;)
            problem.parameters.assign(word);
        const auto solver = find_solver_method("xpbd")->make(problem);
        std::vector<Pose> from(2), to(2);
        for (int f = 1; f <= 40; ++f) {
            if (f <= 20)
                to[1].translation = Vec3(0.1 * f, 0, 0.02 * f);
            solver->advance(from, to);
            from = to;
        }
        return solver->positions();
    };
    const Points many = settle("solver.iterations=100 solver.kernel=reference");
    for (const std::string kernel : {" solver.kernel=reference", " solver.kernel=fast"}) {
        const double plain3 = rms(settle("solver.iterations=3" + kernel), many);
        const double coarse3 = rms(settle("solver.iterations=3 solver.coarse=40" + kernel), many);
        const double plain10 = rms(settle("solver.iterations=10" + kernel), many);
        const double coarse10 = rms(settle("solver.iterations=10 solver.coarse=40" + kernel), many);
        INFO("plain " << plain3 << ", " << plain10 << ", coarse " << coarse3 << ", " << coarse10 << kernel);
        CHECK(coarse3 < 0.5 * plain3);
        CHECK(coarse10 < 0.25 * plain10);
    }
}
