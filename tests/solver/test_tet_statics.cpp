#include "fascicle/geometry/primitives.hpp"
#include "solver/rivals/tet_statics.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

/// A box of cubes cut into six tetrahedra each (Kuhn), faces matching.
struct Bar {
    Points nodes;
    std::vector<Tet> tets;
    std::vector<double> weights;
    std::array<int, 3> cells;

    Bar(const Vec3& size, std::array<int, 3> count) : cells(count) {
        for (int k = 0; k <= cells[2]; ++k)
            for (int j = 0; j <= cells[1]; ++j)
                for (int i = 0; i <= cells[0]; ++i)
                    nodes.push_back(size.cwiseProduct(
                        Vec3(double(i) / cells[0], double(j) / cells[1], double(k) / cells[2])));
        const std::array<std::array<int, 3>, 6> orders{
            {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
        for (int k = 0; k < cells[2]; ++k)
            for (int j = 0; j < cells[1]; ++j)
                for (int i = 0; i < cells[0]; ++i)
                    for (std::size_t o = 0; o < 6; ++o) {
                        std::array<int, 3> at{i, j, k};
                        Tet tet;
                        tet[0] = number(at);
                        for (std::size_t step = 0; step < 3; ++step) {
                            ++at[std::size_t(orders[o][step])];
                            tet[step + 1] = number(at);
                        }
                        if (o >= 3) // odd orders walk the other way round
                            std::swap(tet[1], tet[2]);
                        tets.push_back(tet);
                    }
        weights.assign(tets.size(), 1.0);
    }
    int number(const std::array<int, 3>& at) const {
        return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]);
    }
    bool on_border(std::size_t n, const Vec3& size) const {
        const Vec3& p = nodes[n];
        return p.minCoeff() < 1e-9 || (size - p).minCoeff() < 1e-9;
    }
};

StaticsSettings exact(double scale) {
    StaticsSettings settings;
    settings.tolerance = 1e-12;
    settings.most_steps = 40;
    settings.force_scale = scale;
    return settings;
}

double largest(const Points& a, const Points& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, (a[i] - b[i]).norm());
    return most;
}

/// Stretch of a bar with free sides under an end load F, over F L / (E A).
double end_load(double young, double poisson, double force) {
    const Vec3 size(50, 10, 10);
    const Bar bar(size, {10, 2, 2});
    TetStatics statics(bar.nodes, bar.tets, bar.weights, {}, material_from(young, poisson),
                       exact(young * 25));
    std::vector<std::uint8_t> fixed(3 * bar.nodes.size(), 0);
    Points loads(bar.nodes.size(), Vec3::Zero());
    for (std::size_t n = 0; n < bar.nodes.size(); ++n)
        if (bar.nodes[n].x() == 0) {
            fixed[3 * n] = 1;
            fixed[3 * n + 1] = bar.nodes[n].y() == 0;
            fixed[3 * n + 2] = bar.nodes[n].z() == 0;
        }
    // The load of each triangle of the end's surface, a third to each corner: uniform traction.
    for (const Tet& tet : bar.tets)
        for (std::size_t k = 0; k < 4; ++k) {
            const std::array<int, 3> face{tet[(k + 1) % 4], tet[(k + 2) % 4], tet[(k + 3) % 4]};
            bool at_end = true;
            for (const int n : face)
                at_end = at_end && bar.nodes[std::size_t(n)].x() == size.x();
            if (!at_end)
                continue;
            const Vec3 &a = bar.nodes[std::size_t(face[0])], &b = bar.nodes[std::size_t(face[1])],
                       &c = bar.nodes[std::size_t(face[2])];
            const double share = 0.5 * (b - a).cross(c - a).norm() / (size.y() * size.z());
            for (const int n : face)
                loads[std::size_t(n)].x() += force * share / 3;
        }
    statics.set_fixed(fixed);
    statics.set_loads(loads);
    Points x = bar.nodes;
    CHECK(statics.solve(x).converged);
    double mean = 0;
    int count = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
        if (bar.nodes[n].x() == size.x()) {
            mean += x[n].x() - size.x();
            ++count;
        }
    return mean / count / (force * size.x() / (young * size.y() * size.z()));
}

} // namespace

TEST_CASE("A bar under an end load stretches by F L / (E A), and by the formula of large strain",
          "[solver][tet]") {
    CHECK(end_load(30, 0.3, 1e-3) == Approx(1).epsilon(1e-6)); // 0.3 millionths longer
    CHECK(end_load(30, 0.47, 1e-3) == Approx(1).epsilon(1e-6));
    CHECK(end_load(5000, 0.0, 20.0) == Approx(1).epsilon(1e-9)); // without cross terms exact at any load
    // Free sides: 2 mu (s - 1) + lambda (J - 1) l s = 0 gives the side's stretch s for each l, J = l s^2; then
    // P11 = 2 mu (l - 1) + lambda (J - 1) s^2 is to be F / A. A uniform stretch is in the space of the elements.
    const double force = 300.0; // 10 % longer
    const TetMaterial material = material_from(30, 0.47);
    const auto side = [&](double l) {
        double s = 1.0;
        for (int i = 0; i < 50; ++i) {
            const double f = 2 * material.mu * (s - 1) + material.lambda * (l * s * s - 1) * l * s;
            s -= f / (2 * material.mu + material.lambda * l * (3 * l * s * s - 1));
        }
        return s;
    };
    double low = 1.0, high = 1.5;
    for (int i = 0; i < 60; ++i) {
        const double l = 0.5 * (low + high), s = side(l);
        const double stress = 2 * material.mu * (l - 1) + material.lambda * (l * s * s - 1) * s * s;
        (stress < force / 100 ? low : high) = l;
    }
    CHECK(end_load(30, 0.47, force) == Approx((low - 1) / (force / (30 * 100))).epsilon(1e-9));
}

TEST_CASE("The volume of all tetrahedra is held by their common term, whatever Poisson's ratio",
          "[solver][tet]") {
    const Vec3 size(20, 20, 20);
    const Bar bar(size, {3, 3, 3});
    TetStatics statics(bar.nodes, bar.tets, bar.weights, {}, material_from(30, 0.2), exact(30 * 25));
    std::vector<std::uint8_t> fixed(3 * bar.nodes.size(), 0);
    Points x = bar.nodes;
    for (std::size_t n = 0; n < x.size(); ++n) {
        fixed[3 * n] = bar.nodes[n].x() == 0;
        fixed[3 * n + 1] = bar.nodes[n].y() == 0;
        fixed[3 * n + 2] = bar.nodes[n].z() == 0 || bar.nodes[n].z() == size.z();
        if (bar.nodes[n].z() == size.z())
            x[n].z() = 0.7 * size.z(); // squeezed, free to the sides
    }
    statics.set_fixed(fixed);
    CHECK(statics.solve(x).converged);
    const double without = statics.volume_ratio(x);
    CHECK(without < 0.9);
    TetVolume volume{1.0, 1500};
    for (int round = 0; round < 8; ++round) {
        statics.set_volume(volume);
        CHECK(statics.solve(x).converged);
        volume.ratio += 1.0 - statics.volume_ratio(x);
    }
    CHECK(statics.volume_ratio(x) == Approx(1).epsilon(1e-6));
    // Uniform: both sides longer by the root of 1 / 0.7.
    for (std::size_t n = 0; n < x.size(); ++n)
        CHECK((x[n] - bar.nodes[n].cwiseProduct(Vec3(std::sqrt(1 / 0.7), std::sqrt(1 / 0.7), 0.7))).norm() <
              1e-4);
}

TEST_CASE("Patch test: an affine motion of the border moves the inside affinely", "[solver][tet]") {
    const Vec3 size(12, 9, 9);
    Bar bar(size, {4, 3, 3});
    std::mt19937 random(5);
    std::uniform_real_distribution<double> shake(-0.4, 0.4);
    for (std::size_t n = 0; n < bar.nodes.size(); ++n) // an irregular mesh inside
        if (!bar.on_border(n, size))
            bar.nodes[n] += Vec3(shake(random), shake(random), shake(random));
    Mat3 f;
    f << 1.1, 0.2, 0, -0.1, 0.95, 0.05, 0.03, 0, 1.05;
    f = Eigen::AngleAxisd(0.8, Vec3(1, 1, 0).normalized()) * f;
    // Any weights and fibres but the same everywhere.
    const std::vector<Vec3> fibres(bar.tets.size(), Vec3(0.6, 0, 0.8));
    TetStatics statics(bar.nodes, bar.tets, bar.weights, fibres, material_from(30, 0.47, 60), exact(30 * 9));
    std::vector<std::uint8_t> fixed(3 * bar.nodes.size(), 0);
    Points x = bar.nodes, wanted;
    for (std::size_t n = 0; n < x.size(); ++n) {
        wanted.push_back(f * bar.nodes[n] + Vec3(5, -3, 2));
        if (bar.on_border(n, size)) {
            x[n] = wanted[n];
            for (std::size_t axis = 0; axis < 3; ++axis)
                fixed[3 * n + axis] = 1;
        } else {
            x[n] = wanted[n] + Vec3(shake(random), shake(random), shake(random));
        }
    }
    statics.set_fixed(fixed);
    statics.solve(x);
    CHECK(largest(x, wanted) < 1e-9);
}

TEST_CASE("A turned body needs no force, and pulls that turn carry it along exactly", "[solver][tet]") {
    const Bar bar(Vec3(30, 10, 10), {6, 2, 2});
    TetStatics statics(bar.nodes, bar.tets, bar.weights, {}, material_from(30, 0.47), exact(30 * 25));
    const Mat3 r = Eigen::AngleAxisd(2.0, Vec3(0, 1, 1).normalized()).toRotationMatrix();
    Points turned, x = bar.nodes;
    for (const Vec3& p : bar.nodes)
        turned.push_back(r * p + Vec3(100, 0, -40));
    CHECK(statics.gradient(turned).lpNorm<Eigen::Infinity>() < 1e-10);
    for (std::size_t t = 0; t < bar.tets.size(); t += 7)
        statics.pulls().push_back(
            {{int(t), {0.25, 0.25, 0.25, 0.25}},
             0.25 * (turned[std::size_t(bar.tets[t][0])] + turned[std::size_t(bar.tets[t][1])] +
                     turned[std::size_t(bar.tets[t][2])] + turned[std::size_t(bar.tets[t][3])]),
             1000.0});
    CHECK(statics.solve(x).converged); // starts unturned: Newton finds the large turn
    CHECK(largest(x, turned) < 1e-7);
}

TEST_CASE("Forces of a whole body are the derivative of its energy, pulls and obstacles included",
          "[solver][tet]") {
    const Bar bar(Vec3(10, 10, 5), {2, 2, 1});
    TetStatics statics(bar.nodes, bar.tets, bar.weights, {}, material_from(30, 0.4), exact(30 * 25));
    statics.pulls().push_back({{3, {0.1, 0.2, 0.3, 0.4}}, Vec3(1, 2, 8), 50});
    statics.touches().push_back({{5, {0.4, 0.1, 0.3, 0.2}}, 70, Vec3(0.6, 0, 0.8), 50.0});
    statics.touches().push_back({{9, {0.25, 0.25, 0.25, 0.25}}, 70, Vec3(0, 0, 1), -50.0}); // free of it
    statics.set_volume({1.2, 90});
    statics.set_loads(Points(bar.nodes.size(), Vec3(0.1, 0, -0.2)));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> shake(-0.5, 0.5);
    Points x = bar.nodes;
    for (Vec3& p : x)
        p += Vec3(shake(random), shake(random), shake(random));
    const Eigen::VectorXd g = statics.gradient(x);
    Eigen::MatrixXd k = statics.stiffness(x, false);
    k += statics.volume_slope() * statics.volume_slope().transpose(); // kept beside the sparse matrix
    const double h = 1e-5;
    for (int i = 0; i < int(g.size()); ++i) {
        Points plus = x, minus = x;
        plus[std::size_t(i / 3)][i % 3] += h;
        minus[std::size_t(i / 3)][i % 3] -= h;
        CHECK(g[i] ==
              Approx((statics.energy(plus) - statics.energy(minus)) / (2 * h)).epsilon(1e-6).margin(1e-6));
        const Eigen::VectorXd measured = (statics.gradient(plus) - statics.gradient(minus)) / (2 * h);
        CHECK((k.col(i) - measured).norm() < 1e-6 * (k.col(i).norm() + 1));
    }
    CHECK((k - k.transpose()).norm() < 1e-12 * k.norm());
}

TEST_CASE("Inverted tetrahedra are turned back the right way round", "[solver][tet]") {
    const Bar bar(Vec3(20, 10, 10), {4, 2, 2});
    TetStatics statics(bar.nodes, bar.tets, bar.weights, {}, material_from(30, 0.4), exact(30 * 25));
    std::vector<std::uint8_t> fixed(3 * bar.nodes.size(), 0);
    Points x = bar.nodes;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> shake(-8, 8);
    for (std::size_t n = 0; n < x.size(); ++n)
        if (bar.nodes[n].x() == 0)
            fixed[3 * n] = fixed[3 * n + 1] = fixed[3 * n + 2] = 1;
        else
            x[n] += Vec3(shake(random), shake(random), shake(random));
    statics.set_fixed(fixed);
    statics.solve(x);
    CHECK(largest(x, bar.nodes) < 1e-6);
}

TEST_CASE("A body at rest stays, bit by bit the same for any number of threads", "[solver][tet]") {
    const Bar bar(Vec3(40, 20, 20), {8, 4, 4});
    std::vector<Points> results;
    for (const int threads : {1, 3}) {
        StaticsSettings settings = exact(30 * 25);
        settings.tolerance = 1e-8;
        settings.threads = threads;
        TetStatics statics(bar.nodes, bar.tets, bar.weights, {}, material_from(30, 0.47), settings);
        Points x = bar.nodes;
        statics.set_loose(std::vector<std::uint8_t>(x.size(), 1), x); // nothing holds it
        CHECK(statics.solve(x).steps == 0);
        CHECK(x == bar.nodes);
        statics.pulls().push_back({{0, {0.25, 0.25, 0.25, 0.25}}, Vec3(-5, 3, 2), 200});
        statics.solve(x);
        results.push_back(x);
    }
    CHECK(results[0] == results[1]);
}
