#include "fascicle/geometry/volume.hpp"
#include "solver/rivals/mass_spring/binding.hpp"
#include "solver/rivals/mass_spring/spring_net.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace fascicle;
using namespace fascicle::mass_spring;

namespace {

struct Body {
    TriMesh mesh;
    MeshTopology topology;
    SolidQuery solid;
    std::vector<int> bodies;
    ParticleSet particles;
};

Body body_of(TriMesh mesh, int wanted, const Mat3& axes = Mat3::Identity(), std::vector<int> bodies = {}) {
    Body body{std::move(mesh), {}, {}, std::move(bodies), {}};
    body.topology = MeshTopology(body.mesh.vertex_count(), body.mesh.triangles);
    body.solid = SolidQuery(body.mesh);
    body.bodies.resize(body.mesh.positions.size(), -1);
    body.particles = sample_particles(body.mesh, body.topology, body.bodies, body.solid, axes, wanted);
    return body;
}

double energy(const SpringNet& net, double dt) {
    // E = k (L - L0 ln(L / L0)), from F = dE/dL, where no spring is below half its length; velocities of half steps.
    double sum = 0;
    const double u = net.unit();
    for (const Spring& s : net.springs()) {
        const double l = (net.positions()[std::size_t(s.a)] - net.positions()[std::size_t(s.b)]).norm() / u;
        const double rest = s.rest / u;
        sum += (l - rest - rest * std::log(l / rest)) / rest;
    }
    for (std::size_t i = 0; i < net.positions().size(); ++i)
        sum += 0.5 * ((net.positions()[i] - net.before()[i]) / (u * dt)).squaredNorm();
    return sum;
}

} // namespace

TEST_CASE("mass-spring: the force is the formula, is the derivative of its energy and turns with the spring",
          "[solver][mass-spring]") {
    const Vec3 p(1, 2, 3), d = Vec3(2, -1, 2) / 3.0;
    for (const double l : {1.3, 2.5, 4.0, 9.0}) { // rest 2.5, unit 2: L0 = 1.25, k = 0.8
        const Vec3 f = spring_force(p, p + l * d, 2.5, 2.0);
        CHECK((f - 0.8 * (l / 2 - 1.25) / (l / 2) * d).norm() < 1e-14);
        const auto potential = [](double x) { return 0.8 * (x / 2 - 1.25 * std::log(x / 2)); };
        CHECK(f.dot(d) == Approx((potential(l + 1e-4) - potential(l - 1e-4)) / 1e-4).margin(1e-7));
        const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 1, 0).normalized()).toRotationMatrix();
        CHECK((spring_force(turn * p, turn * (p + l * d), 2.5, 2.0) - turn * f).norm() < 1e-14);
        CHECK((spring_force(p + l * d, p, 2.5, 2.0) + f).norm() < 1e-15);
    }
    CHECK(spring_force(p, p, 2.5, 2.0) == Vec3::Zero());
    CHECK(spring_force(p, p + 1e-9 * d, 2.5, 2.0).norm() == Approx(0.8 * 2).epsilon(1e-6)); // guard: L0 / 2
}

TEST_CASE("mass-spring: two particles swing at the frequency of Verlet steps", "[solver][mass-spring]") {
    // Small swings of length: x'' = -2 x at rest (two unit masses, stiffness 1 / L0^2 = 1). Undamped Verlet turns by theta a
    // step, cos theta = 1 - dt^2 lambda / 2.
    SpringNet net({Vec3(0, 0, 0), Vec3(3, 0, 0)}, {0, 0}, {{0, 1, 3.0}});
    REQUIRE(net.unit() == Approx(3.0));
    const double dt = 0.4, lambda = 2, theta = std::acos(1 - dt * dt * lambda / 2), small = 1e-6;
    net.stop_at(1, Vec3(3 + small, 0, 0)); // starts at rest half a step before: cos((k + 1/2) theta)
    for (int k = 1; k <= 100; ++k) {
        net.step(dt, 0.0);
        const double stretch = (net.positions()[1] - net.positions()[0]).norm() - 3;
        CHECK(stretch / small == Approx(std::cos((k + 0.5) * theta) / std::cos(0.5 * theta)).margin(2e-4));
    }
}

TEST_CASE("mass-spring: without attachments momentum and angular momentum stay, energy falls",
          "[solver][mass-spring]") {
    const Body body = body_of(test::sphere(10, 2), 300);
    SpringNet net(body.particles.rest, std::vector<char>(body.particles.size(), 0),
                  make_springs(body.particles, SpringLayout::lattice26, body.solid, body.topology));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    Vec3 centre = Vec3::Zero();
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
        net.stop_at(i, body.particles.rest[i] +
                           net.mean_length() * Vec3(uniform(random), uniform(random), uniform(random)));
        centre += net.positions()[i];
    }
    double last = energy(net, 0.4);
    const double first = last;
    for (int k = 0; k < 200; ++k) {
        CHECK(net.step(0.4, 1.0) == 0);
        const double now = energy(net, 0.4);
        CHECK(now <= last * (1 + 1e-9) + 1e-12);
        last = now;
        Vec3 sum = Vec3::Zero(), turn = Vec3::Zero();
        for (std::size_t i = 0; i < body.particles.size(); ++i) {
            sum += net.positions()[i];
            turn += net.before()[i].cross(net.positions()[i]);
        }
        CHECK((sum - centre).norm() < 1e-8);
        CHECK(turn.norm() < 1e-8);
    }
    CHECK(last < 1e-2 * first);
}

TEST_CASE("mass-spring: steps are stable in any unit and layout, from a crushed start too",
          "[solver][mass-spring]") {
    const bool crushed = GENERATE(false, true);
    for (const auto layout : {SpringLayout::lattice6, SpringLayout::lattice26, SpringLayout::nearest15}) {
        CAPTURE(static_cast<int>(layout), crushed);
        std::vector<Points> results;
        std::vector<std::size_t> springs;
        for (const double unit : {1.0, 1e-3, 1e4}) {
            TriMesh mesh = test::sphere(10, 2);
            for (Vec3& p : mesh.positions)
                p = unit * Vec3(p.x() + 0.13 * p.y() + 0.01 * p.z() * p.z(), 0.7 * p.y() + 0.2 * p.z(),
                                1.4 * p.z() + 0.02 * p.x() * p.x()); // no two equally far but in the lattice
            const Body body = body_of(std::move(mesh), 300);
            SpringNet net(body.particles.rest, std::vector<char>(body.particles.size(), 0),
                          make_springs(body.particles, layout, body.solid, body.topology));
            CHECK(net.unit() <= net.mean_length());
            for (std::size_t i = 0; i < body.particles.size(); ++i)
                net.stop_at(i, (crushed ? 0.4 : 0.9) * body.particles.rest[i]);
            for (int k = 0; k < 600; ++k)
                CHECK(net.step(0.4, 1.0) == 0);
            double moving = 0, longest = 0;
            for (std::size_t i = 0; i < body.particles.size(); ++i)
                moving = std::max(moving, (net.positions()[i] - net.before()[i]).norm());
            for (const Spring& s : net.springs())
                longest = std::max(
                    longest,
                    (net.positions()[std::size_t(s.a)] - net.positions()[std::size_t(s.b)]).norm() / s.rest);
            CHECK(moving < (crushed ? 1e-2 : 1e-3) * net.mean_length());
            CHECK(longest < (crushed ? 2.0 : 1.01)); // a crushed net may stay buckled
            results.push_back(net.positions());
            springs.push_back(net.springs().size());
        }
        CHECK(springs[1] == springs[0]);
        CHECK(springs[2] == springs[0]);
        for (std::size_t i = 0; i < results[0].size() && !crushed; ++i)
            CHECK((results[0][i] - 1e3 * results[1][i]).norm() < 1e-3);
    }
}

TEST_CASE("mass-spring: a position that is not finite is refused", "[solver][mass-spring]") {
    SpringNet net({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}, {1, 0, 0}, {{0, 1, 1.0}, {1, 2, 1.0}});
    net.stop_at(0, Vec3::Constant(std::nan("")));
    CHECK(net.step(0.4, 1.0) == 1);
    CHECK(net.positions()[1] == Vec3(1, 0, 0));
    net.stop_at(0, Vec3(0, 0, 0));
    CHECK(net.step(0.4, 1.0) == 0);
    CHECK(net.positions()[2].allFinite());
}

TEST_CASE("mass-spring: inner particles are inside, boundary ones are vertices, about as many as wanted",
          "[solver][mass-spring]") {
    for (const int wanted : {200, 1000}) {
        const Mat3 axes = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
        const Body body = body_of(test::torus(30, 10, 64, 32), wanted, axes);
        const ParticleSet& set = body.particles;
        CHECK(double(set.size()) == Approx(wanted).epsilon(0.25));
        double closest = 1e300, farthest = 0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (set.vertex[i] >= 0)
                CHECK(set.rest[i] == body.mesh.positions[std::size_t(set.vertex[i])]);
            else
                CHECK(body.solid.signed_distance(set.rest[i]) <= -0.499 * set.spacing);
            for (std::size_t j = 0; j < i; ++j)
                closest = std::min(closest, (set.rest[i] - set.rest[j]).squaredNorm());
        }
        CHECK(std::sqrt(closest) > 0.49 * set.spacing);
        CHECK(set.vertex.back() == -1);
        for (const Vec3& p : body.mesh.positions) {
            double nearest = 1e300;
            for (const Vec3& q : set.rest)
                nearest = std::min(nearest, (p - q).squaredNorm());
            farthest = std::max(farthest, nearest);
        }
        CHECK(std::sqrt(farthest) <= 0.8 * set.spacing);
    }
}

TEST_CASE("mass-spring: every body that holds a vertex holds a particle", "[solver][mass-spring]") {
    std::vector<int> bodies(66, -1);
    bodies[5] = 0;
    bodies[40] = bodies[41] = 1;
    const Body body = body_of(test::sphere(10, 2), 50, Mat3::Identity(), bodies);
    std::set<int> held;
    for (const int v : body.particles.vertex)
        held.insert(v < 0 ? -1 : bodies[std::size_t(v)]);
    CHECK(held == std::set<int>{-1, 0, 1});
}

TEST_CASE("mass-spring: the lattice runs along the fibres, or along a long body", "[solver][mass-spring]") {
    TriMesh mesh = test::sphere(10, 3);
    for (Vec3& p : mesh.positions)
        p.x() *= 3;
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    const Mat3 alone = lattice_axes(mesh, topology, {});
    CHECK(std::abs(alone(0, 0)) == Approx(1).epsilon(1e-6));
    const Vec3 fibres = Vec3(1, 2, -1).normalized();
    std::vector<double> along;
    for (const Edge& e : topology.edges()) {
        const Vec3 u = (mesh.positions[std::size_t(e.b)] - mesh.positions[std::size_t(e.a)]).normalized();
        along.push_back(u.dot(fibres) * u.dot(fibres));
    }
    const Mat3 fitted = lattice_axes(mesh, topology, along);
    CHECK(std::abs(fitted.col(0).dot(fibres)) == Approx(1).epsilon(1e-9));
    for (const Mat3& axes : {alone, fitted}) {
        CHECK((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-12);
        CHECK(axes.determinant() == Approx(1));
    }
    // Noise has no direction: the shape decides.
    along.assign(along.size(), 0.3);
    CHECK(std::abs(lattice_axes(mesh, topology, along)(0, 0)) == Approx(1).epsilon(1e-6));
}

TEST_CASE("mass-spring: deep inside springs are the lattice's 6 and 26 neighbours, or at least 15",
          "[solver][mass-spring]") {
    const Body body = body_of(test::sphere(10, 3), 2000);
    const ParticleSet& set = body.particles;
    const std::map<SpringLayout, std::size_t> counts{{SpringLayout::lattice6, 6},
                                                     {SpringLayout::lattice26, 26}};
    for (const auto layout : {SpringLayout::lattice6, SpringLayout::lattice26, SpringLayout::nearest15}) {
        const auto springs = make_springs(set, layout, body.solid, body.topology);
        std::vector<std::size_t> joined(set.size(), 0);
        for (const Spring& s : springs) {
            REQUIRE(s.a < s.b);
            ++joined[std::size_t(s.a)];
            ++joined[std::size_t(s.b)];
        }
        int deep = 0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            CHECK(joined[i] >= 6);
            if (body.solid.signed_distance(set.rest[i]) > -3 * set.spacing)
                continue;
            ++deep;
            if (layout == SpringLayout::nearest15)
                CHECK(joined[i] >= 15);
            else
                CHECK(joined[i] == counts.at(layout));
        }
        CHECK(deep > 50);
    }
}

TEST_CASE("mass-spring: springs do not leap over a gap in the body", "[solver][mass-spring]") {
    const Body body = body_of(test::torus(12, 8, 96, 64), 1500); // a hole 8 wide
    for (const auto layout : {SpringLayout::lattice26, SpringLayout::nearest15})
        for (const Spring& s : make_springs(body.particles, layout, body.solid, body.topology))
            CHECK(body.solid.signed_distance(0.5 * (body.particles.rest[std::size_t(s.a)] +
                                                    body.particles.rest[std::size_t(s.b)])) < 0.16 * s.rest);
}

TEST_CASE("mass-spring: the surface follows affine maps of the particles exactly", "[solver][mass-spring]") {
    const Body body = body_of(test::sphere(10, 4), 600);
    std::vector<int> particle_of(body.mesh.positions.size(), -1), failed;
    for (std::size_t i = 0; i < body.particles.size(); ++i)
        if (body.particles.vertex[i] >= 0)
            particle_of[std::size_t(body.particles.vertex[i])] = int(i);
    std::vector<char> wanted(body.mesh.positions.size(), 1);
    wanted[700] = 0;
    particle_of[700] = -1;
    const Binding binding = bind_to_particles(body.particles.rest, particle_of, body.mesh.positions, wanted,
                                              body.particles.spacing, failed);
    REQUIRE(failed.empty());
    Mat3 map;
    map << 1.2, 0.3, -0.1, 0, 0.8, 0.2, 0.1, -0.4, 1.1;
    const Vec3 shift(100, -20, 7);
    Points moved, points(body.mesh.positions.size(), Vec3(9, 9, 9));
    for (const Vec3& p : body.particles.rest)
        moved.push_back(map * p + shift);
    binding.apply(moved, points, 2);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i == 700) {
            CHECK(points[i] == Vec3(9, 9, 9));
            continue;
        }
        CHECK((points[i] - (map * body.mesh.positions[i] + shift)).norm() < 1e-6);
        double sum = 0, size = 0;
        for (const double w : binding.weights(i)) {
            sum += w;
            size += std::abs(w);
        }
        CHECK(sum == Approx(1).epsilon(1e-9));
        CHECK(size <= 2.5);
    }
    // W^T: in . (W p) = (W^T in) . p
    Points in(points.size()), back(body.particles.size());
    for (std::size_t i = 0; i < in.size(); ++i)
        in[i] = i == 700 ? Vec3(0, 0, 0) : Vec3(std::sin(double(i)), std::cos(2.0 * double(i)), 0.5);
    binding.transpose(in, back);
    double left = 0, right = 0;
    for (std::size_t i = 0; i < in.size(); ++i)
        left += in[i].dot(points[i]);
    for (std::size_t i = 0; i < back.size(); ++i)
        right += back[i].dot(moved[i]);
    CHECK(left == Approx(right).epsilon(1e-9));
}

TEST_CASE("mass-spring: a point off a flat set of particles is not bound, one in it is",
          "[solver][mass-spring]") {
    Points flat;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            flat.emplace_back(i, j, 0);
    std::vector<int> failed;
    const Binding binding =
        bind_to_particles(flat, std::vector<int>(2, -1), {Vec3(2.3, 2.6, 0), Vec3(2.3, 2.6, 0.5)},
                          std::vector<char>(2, 1), 1.0, failed);
    CHECK(failed == std::vector<int>{1});
    CHECK(binding.weights(0).size() >= 3);
    CHECK(binding.weights(1).empty());
}
