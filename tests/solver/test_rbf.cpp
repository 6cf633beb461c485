#include "fascicle/base/pose.hpp"
#include "solver/rivals/rbf/rbf_attachments.hpp"
#include "solver/rivals/rbf/rbf_contact.hpp"
#include "solver/rivals/rbf/rbf_field.hpp"
#include "solver/rivals/rbf/spread_points.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

Points cloud(int count, double size, unsigned seed, const Vec3& offset = Vec3(100, -50, 30)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    Points result;
    for (int i = 0; i < count; ++i) {
        const double x = number(random), y = number(random);
        result.push_back(offset + size * Vec3(x, y, number(random)));
    }
    return result;
}

RbfMatrix noise(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    RbfMatrix result(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index k = 0; k < columns; ++k)
            result(i, k) = number(random);
    return result;
}

RbfMatrix with_zeros(const RbfField& field, const RbfMatrix& data) {
    RbfMatrix right = RbfMatrix::Zero(field.size(), data.cols());
    right.topRows(data.rows()) = data;
    return right;
}

RbfMatrix values_at(const RbfField& field, const RbfMatrix& coefficients, const Points& points) {
    RbfMatrix values;
    evaluate(field, {}, coefficients, points, 1, values);
    return values.transpose();
}

/// phi of the plain sum, and the textbook system with an affine part in scene units, by a pivoted LU.
double phi(RbfKernel kernel, double r) {
    return kernel == RbfKernel::linear ? r : r * r * r;
}

RbfMatrix brute_force(const Points& centres, RbfKernel kernel, const RbfMatrix& data, const Points& at) {
    const auto n = Eigen::Index(centres.size());
    RbfMatrix system = RbfMatrix::Zero(n + 4, n + 4), right = RbfMatrix::Zero(n + 4, data.cols());
    right.topRows(n) = data;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Vec3& p = centres[std::size_t(i)];
        for (Eigen::Index j = 0; j < n; ++j)
            system(i, j) = phi(kernel, (p - centres[std::size_t(j)]).norm());
        system.row(i).tail(4) << 1.0, p.transpose();
        system.col(i).tail(4) = system.row(i).tail(4).transpose();
    }
    const RbfMatrix solved = system.fullPivLu().solve(right);
    RbfMatrix values(Eigen::Index(at.size()), data.cols());
    for (std::size_t k = 0; k < at.size(); ++k) {
        Eigen::RowVectorXd row(n + 4);
        for (Eigen::Index j = 0; j < n; ++j)
            row[j] = phi(kernel, (at[k] - centres[std::size_t(j)]).norm());
        row.tail(4) << 1.0, at[k].transpose();
        values.row(Eigen::Index(k)) = row * solved;
    }
    return values;
}

} // namespace

TEST_CASE("rbf: exact at the centres, side conditions hold, and the field is the plain one",
          "[solver][rbf]") {
    const Points centres = cloud(60, 20, 1), at = cloud(40, 30, 2);
    const RbfMatrix data = noise(60, 3, 3);
    for (const RbfKernel kernel : {RbfKernel::linear, RbfKernel::cubic}) {
        const RbfField field(centres, kernel);
        REQUIRE(field.polynomial().full());
        CHECK(field.kernel() == kernel);
        const RbfMatrix c = field.solve(with_zeros(field, data));
        CHECK((values_at(field, c, centres) - data).cwiseAbs().maxCoeff() < 1e-9);
        const double largest = c.topRows(60).cwiseAbs().maxCoeff();
        for (int k = 0; k < 3; ++k) {
            Vec3 moment = Vec3::Zero();
            for (int i = 0; i < 60; ++i)
                moment += c(i, k) * (centres[std::size_t(i)] - centres[0]);
            CHECK(std::abs(c.col(k).head(60).sum()) < 1e-9 * largest);
            CHECK(moment.norm() < 1e-7 * largest);
        }
        CHECK((values_at(field, c, at) - brute_force(centres, kernel, data, at)).cwiseAbs().maxCoeff() <
              1e-7);
    }
}

TEST_CASE("rbf: affine displacements are reproduced everywhere, in any unit", "[solver][rbf]") {
    for (const double unit : {1.0, 1e-3})
        for (const RbfKernel kernel : {RbfKernel::linear, RbfKernel::cubic}) {
            Points centres = cloud(30, 20, 4), at = cloud(20, 200, 5);
            for (Points* points : {&centres, &at})
                for (Vec3& p : *points)
                    p *= unit;
            Mat3 a;
            a << 0.2, 1, -0.5, 0.1, 0.3, 0.7, -1, 0.4, 0.6;
            const Vec3 b = unit * Vec3(5, -3, 2);
            const RbfField field(centres, kernel);
            RbfMatrix data(30, 3);
            for (int i = 0; i < 30; ++i)
                data.row(i) = (a * centres[std::size_t(i)] + b).transpose();
            const RbfMatrix values = values_at(field, field.solve(with_zeros(field, data)), at);
            for (int k = 0; k < 20; ++k)
                CHECK((values.row(k).transpose() - (a * at[std::size_t(k)] + b)).norm() < 1e-7 * unit);
        }
}

TEST_CASE("rbf: few, flat, straight and single centres keep the affine part that they determine",
          "[solver][rbf]") {
    struct Case {
        Points centres;
        int functions;
    };
    const Vec3 o(10, 20, 30), u(1, 2, 2), v(2, -2, 1);
    const std::vector<Case> cases{{{o}, 1},
                                  {{o, o + u}, 2},
                                  {{o, o + u, o + 3 * u}, 2},
                                  {{o, o + u, o + v}, 3},
                                  {{o, o + u, o + v, o + u + v, o + 2 * u - v}, 3},
                                  {{o, o + u, o + v, o + u.cross(v)}, 4}};
    for (const Case& c : cases)
        for (const RbfKernel kernel : {RbfKernel::linear, RbfKernel::cubic}) {
            const RbfField field(c.centres, kernel);
            CHECK(field.polynomial().size() == c.functions);
            const RbfMatrix data = noise(Eigen::Index(c.centres.size()), 3, 8);
            const RbfMatrix solved = field.solve(with_zeros(field, data));
            CHECK((values_at(field, solved, c.centres) - data).cwiseAbs().maxCoeff() < 1e-10);
            CHECK(values_at(field, solved, cloud(10, 50, 9)).allFinite());
        }
    CHECK_THROWS_WITH(RbfField({o, o, o + u, o + v, o + u.cross(v), o}, RbfKernel::linear),
                      Catch::Contains("singular"));
}

TEST_CASE("rbf: bordered centres give the field that a new factor gives", "[solver][rbf]") {
    const Points fixed = cloud(50, 20, 11), extra = cloud(30, 22, 12), at = cloud(25, 30, 13);
    for (const RbfKernel kernel : {RbfKernel::linear, RbfKernel::cubic}) {
        const RbfField field(fixed, kernel);
        RbfContact contact(field, extra, 12);
        // Several solves: some columns are kept, in the third they no longer fit.
        for (const std::vector<int>& chosen : {std::vector<int>{3, 1, 7},
                                               {7, 9, 3, 20, 21},
                                               {0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 22, 24},
                                               {5, 11, 13, 15, 17, 19, 23, 25, 26, 27, 28, 29}}) {
            const RbfMatrix r = noise(Eigen::Index(chosen.size()), 3, unsigned(chosen.size()));
            RbfMatrix coefficients, values;
            REQUIRE(contact.solve(chosen, r, coefficients));
            Points all = fixed, more;
            for (const int k : chosen) {
                all.push_back(extra[std::size_t(k)]);
                more.push_back(extra[std::size_t(k)]);
            }
            evaluate(field, more, coefficients, at, 2, values);
            RbfMatrix data = RbfMatrix::Zero(Eigen::Index(all.size()), 3);
            data.bottomRows(r.rows()) = r;
            CHECK((values.transpose() - brute_force(all, kernel, data, at)).cwiseAbs().maxCoeff() < 1e-7);
        }
    }
    // A new centre where the field has one: no field can be both.
    const RbfField field(fixed, RbfKernel::linear);
    RbfContact contact(field, fixed, 4);
    RbfMatrix coefficients;
    CHECK_FALSE((contact.solve({3}, RbfMatrix::Ones(1, 3), coefficients) &&
                 coefficients.cwiseAbs().maxCoeff() < 1e6));
}

TEST_CASE("rbf: spread points are the farthest ones, each place once", "[solver][rbf]") {
    Points line;
    for (int i = 0; i <= 10; ++i)
        line.emplace_back(i, 0, 0);
    line.emplace_back(10, 0, 0); // twice
    std::vector<int> all(line.size()), chosen;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = int(i);
    spread_points(line, all, 3, 1e-9, chosen);
    CHECK(chosen == std::vector<int>{0, 10, 5});
    spread_points(line, all, 100, 1e-9, chosen);
    CHECK(chosen.size() == 11);
    spread_points(line, {}, 200, 1e-9, chosen);
    CHECK(chosen.size() == 11);
}

TEST_CASE("rbf: the best rigid motion is found, also for a line and a point", "[solver][rbf]") {
    const Pose pose = rotation_about(Vec3(1, 2, 3), Vec3(1, 1, 0), 1.2);
    const auto check = [&](const Points& from, double exact) {
        Points to;
        for (const Vec3& p : from)
            to.push_back(pose.apply(p));
        const Pose found = best_motion(from, to, pose);
        for (const Vec3& p : cloud(5, 10, 20))
            CHECK((found.apply(p) - pose.apply(p)).norm() < exact);
    };
    check(cloud(10, 10, 21), 1e-9);
    check({Vec3(1, 2, 3), Vec3(2, 4, 6), Vec3(3, 6, 9)},
          1e-6); // the turn about the line is the one of `like`
    check({Vec3(4, 5, 6)}, 1e-9);
}
