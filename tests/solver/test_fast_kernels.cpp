#include "fascicle/geometry/dihedral_angle.hpp"
#include "fascicle/geometry/distance_grid.hpp"
#include "fascicle/geometry/volume.hpp"
#include "solver/coarse/elastic_terms.hpp"
#include "solver/constraints/dihedral.hpp"
#include "solver/constraints/distance.hpp"
#include "solver/contact/grid_slope.hpp"
#include "solver/fast/layout.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;
using namespace fascicle::solver::fast;

namespace {

std::vector<const Kernels*> all_kernels() {
    std::vector<const Kernels*> list(4);
    list.resize(available_kernels(list.data(), list.size()));
    return list;
}

/// Records of x, y, z, inverse mass, aligned.
struct alignas(64) Records {
    float v[4 * 64 + 64] = {};
    void set(std::size_t i, const Vec3& p, float w) {
        for (std::size_t k = 0; k < 3; ++k)
            v[4 * i + k] = static_cast<float>(p[static_cast<Eigen::Index>(k)]);
        v[4 * i + 3] = w;
    }
    Vec3 get(std::size_t i) const {
        return Vec3(double(v[4 * i]), double(v[4 * i + 1]), double(v[4 * i + 2]));
    }
};

std::vector<Vec3> random_points(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> in(-3.0, 3.0);
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back(
            Vec3(double(float(in(random))), double(float(in(random))), double(float(in(random)))));
    return points;
}

} // namespace

TEST_CASE("fast kernels: the portable ones are always there, and come last", "[solver][fast]") {
    const auto kernels = all_kernels();
    REQUIRE_FALSE(kernels.empty());
    CHECK(std::string(kernels.back()->name) == "portable");
    for (std::size_t i = 0; i + 1 < kernels.size(); ++i)
        CHECK(kernels[i]->lanes >= kernels[i + 1]->lanes);
}

TEST_CASE("fast kernels: a packet of edges moves as the plain constraints do", "[solver][fast]") {
    for (const Kernels* kernels : all_kernels()) {
        INFO(kernels->name);
        const auto points = random_points(32, 1);
        Records records;
        EdgePacket edges{};
        Points x;
        std::vector<double> mass;
        DistanceConstraints plain;
        const double h = 1e-3;
        for (std::size_t i = 0; i < 32; ++i) {
            mass.push_back(i % 5 == 0 ? 0.0 : 1.0);
            x.push_back(i == 9 ? points[25] : points[i]); // edge 9 - 25 has no length
            records.set(i, x.back(), float(mass.back()));
        }
        for (std::size_t i = 0; i < packet; ++i) {
            const double rest = 1.0 + 0.1 * double(i), compliance = 1e-7 * double(i);
            const double weight = mass[i] + mass[i + 16];
            plain.add({int(i), int(i + 16), rest, compliance});
            edges.p[0][i] = std::uint16_t(i);
            edges.p[1][i] = std::uint16_t(i + 16);
            edges.rest[i] = float(rest);
            edges.gain[i] = weight > 0 ? float(1.0 / (weight + compliance / (h * h))) : 0.0f;
        }
        kernels->edges(records.v, &edges, 1);
        plain.project(x, mass, h);
        for (std::size_t i = 0; i < 32; ++i)
            CHECK((records.get(i) - x[i]).norm() < 1e-5);
    }
}

TEST_CASE("fast kernels: a packet of dihedrals moves as the plain constraints do", "[solver][fast]") {
    for (const Kernels* kernels : all_kernels())
        for (unsigned seed = 0; seed < 40; ++seed) {
            const double kappa = seed % 3 == 0 ? 5.0 : 1.0;
            INFO(kernels->name << ", seed " << seed);
            Points rest = random_points(64, 2 * seed), x = random_points(64, 2 * seed + 1);
            const double bend = seed % 4 == 0 ? 1.0 : 0.1; // far from rest, and near to it
            Records records;
            HingePacket hinges{};
            std::vector<double> mass;
            std::vector<Dihedral> pairs;
            for (std::size_t i = 0; i < 64; ++i) {
                x[i] = (rest[i] + bend * (x[i] - rest[i])).cast<float>().cast<double>();
                mass.push_back(i % 7 == 3 ? 0.0 : 1.0);
                records.set(i, x[i], float(mass[i]));
            }
            for (int i = 0; i < 16; ++i)
                pairs.push_back({i, i + 16, i + 32, i + 48, i});
            const DihedralConstraints plain(rest, pairs, 0.4);
            if (plain.size() < 16) // one of them is a sliver by chance
                continue;
            const double h = 2e-3;
            for (std::size_t i = 0; i < packet; ++i) {
                const DihedralConstraint& c = plain.items()[i];
                for (std::size_t k = 0; k < 4; ++k)
                    hinges.p[k][i] = std::uint16_t(c.p[k]);
                hinges.cosine[i] = float(std::cos(c.rest_rad));
                hinges.sine[i] = float(std::sin(c.rest_rad));
                hinges.compliance[i] = float(c.compliance / (h * h));
            }
            kernels->hinges(records.v, &hinges, 1, float(kappa));
            plain.project(x, mass, h, kappa);
            for (std::size_t i = 0; i < 64; ++i)
                CHECK((records.get(i) - x[i]).norm() < 2e-4);
        }
}

TEST_CASE("fast kernels: slivers and folded pairs stay finite, rest stays rest", "[solver][fast]") {
    for (const Kernels* kernels : all_kernels()) {
        Records records;
        HingePacket hinges{};
        for (std::size_t i = 0; i < 16; ++i)
            for (std::size_t k = 0; k < 4; ++k)
                hinges.p[k][i] = std::uint16_t(4 * i + k);
        const Vec3 good[4] = {{0, 1, 0.2}, {0.4, -1, 0.1}, {-1, 0, 0}, {1, 0, 0}};
        const auto angle = signed_dihedral_angle(good[0], good[1], good[2], good[3]);
        for (std::size_t i = 0; i < 16; ++i) {
            for (std::size_t k = 0; k < 4; ++k)
                records.set(4 * i + k, good[k], 1.0f);
            hinges.cosine[i] = float(std::cos(*angle));
            hinges.sine[i] = float(std::sin(*angle));
        }
        records.set(0, {0.1, 1e-5, 0}, 1.0f); // wing of hinge 0 without height
        records.set(6, {1, 0, 0}, 1.0f);      // edge of hinge 1 without length
        records.set(11, {-1, 0, 0}, 1.0f);    // the same at the other end
        const Records before = records;
        kernels->hinges(records.v, &hinges, 1, 1.0f);
        for (std::size_t i = 0; i < 64; ++i) {
            CHECK(records.get(i).allFinite());
            CHECK((records.get(i) - before.get(i)).norm() < 1e-6);
        }
        // Half a turn away: the correction is limited, whichever way it goes.
        for (std::size_t i = 0; i < 16; ++i) {
            hinges.cosine[i] = -hinges.cosine[i];
            hinges.sine[i] = -hinges.sine[i];
        }
        kernels->hinges(records.v, &hinges, 1, 1.0f);
        for (std::size_t i = 0; i < 64; ++i)
            CHECK((records.get(i) - before.get(i)).norm() < 2.0);
    }
}

TEST_CASE("fast kernels: the slope of a grid bounds every step of its interpolant", "[solver][fast]") {
    DistanceGridOptions options;
    options.spacing = 1.5;
    options.saturation = 4;
    const DistanceGrid grid(test::box(10, 7, 5), options);
    const double slope = largest_slope(grid, 2);
    CHECK(slope >= 1.0);
    CHECK(slope < 4.0);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> in(-5, 15), step(-0.3, 0.3);
    double steepest = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p(in(random), in(random), in(random)),
            q = p + Vec3(step(random), step(random), step(random));
        const double change = std::abs(grid.value(p) - grid.value(q)) / (p - q).norm();
        CHECK(change <= slope * (1 + 1e-9));
        steepest = std::max(steepest, change);
    }
    CHECK(steepest > 0.7);
}

TEST_CASE("fast kernels: forces and stiffness of the coarse step are those of the elastic terms",
          "[solver][fast]") {
    for (const Kernels* kernels : all_kernels()) {
        INFO(kernels->name);
        const double h = 1.0 / 180, share = 0.9;
        Points rest = random_points(64, 11), x = random_points(64, 12), u = random_points(64, 13);
        std::vector<DistanceConstraint> edges;
        std::vector<Dihedral> pairs;
        for (int i = 0; i < 16; ++i) {
            pairs.push_back({i, i + 16, i + 32, i + 48, i});
            edges.push_back(
                {i, i + 16, (rest[std::size_t(i)] - rest[std::size_t(i) + 16]).norm(), 1e-6 * (i + 1)});
        }
        for (std::size_t i = 0; i < 64; ++i) // near enough to rest for the angles to be within their limit
            x[i] = (rest[i] + 0.02 * (x[i] - rest[i])).cast<float>().cast<double>();
        const DihedralConstraints hinges(rest, pairs, 0.3);
        REQUIRE(hinges.size() == 16);
        const ElasticTerms terms{&edges, &hinges.items(), 0.3, h, share};
        EdgePacket edge{};
        HingePacket hinge{};
        Records records, forces, moves;
        for (std::size_t i = 0; i < 64; ++i) {
            records.set(i, x[i], 1.0f);
            moves.set(i, u[i], 0.0f);
        }
        for (std::size_t i = 0; i < packet; ++i) {
            edge.rest[i] = float(edges[i].rest);
            edge.stiffness[i] = float(share / (edges[i].compliance / (h * h)));
            for (std::size_t k = 0; k < 2; ++k)
                edge.p[k][i] = std::uint16_t(i + 16 * k);
            const DihedralConstraint& c = hinges.items()[i];
            hinge.cosine[i] = float(std::cos(c.rest_rad));
            hinge.sine[i] = float(std::sin(c.rest_rad));
            hinge.compliance[i] = float(c.compliance / (h * h));
            for (std::size_t k = 0; k < 4; ++k)
                hinge.p[k][i] = std::uint16_t(c.p[k]);
        }
        const HingeSprings springs{float(share), float(thin_hinge_compliance(terms))};
        Points force(64, Vec3::Zero());
        double stiffness = 0, scale = 0;
        const auto add = [&](const ElasticTerm& t) {
            double along = 0;
            for (std::size_t j = 0; j < std::size_t(t.count); ++j) {
                force[std::size_t(t.point[j])] -= t.weight * t.value * t.gradient[j];
                along += t.gradient[j].dot(u[std::size_t(t.point[j])]);
            }
            stiffness += t.weight * along * along;
        };
        for_each_edge_term(terms, x, {}, add);
        kernels->edge_forces(records.v, forces.v, &edge, 1);
        CHECK(kernels->edge_stiffness(records.v, moves.v, &edge, 1, 1) == Approx(stiffness).epsilon(1e-4));
        for_each_hinge_term(terms, x, {}, add);
        kernels->hinge_forces(records.v, forces.v, &hinge, 1, springs);
        CHECK(kernels->edge_stiffness(records.v, moves.v, &edge, 1, 1) +
                  kernels->hinge_stiffness(records.v, moves.v, &hinge, 1, 1, springs) ==
              Approx(stiffness).epsilon(1e-3));
        for (const Vec3& f : force)
            scale = std::max(scale, f.norm());
        for (std::size_t i = 0; i < 64; ++i)
            CHECK((forces.get(i) - force[i]).norm() < 1e-3 * scale);
    }
}
