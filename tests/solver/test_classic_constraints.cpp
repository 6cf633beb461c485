#include "fascicle/geometry/volume.hpp"
#include "solver/classic/classic_bending.hpp"
#include "solver/classic/classic_edges.hpp"
#include "solver/classic/classic_volume.hpp"
#include "support/shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <map>
#include <numbers>
#include <random>

using namespace fascicle;
using namespace fascicle::test;
using namespace fascicle::classic;

namespace {

constexpr double pi = std::numbers::pi;

ClassicState state_of(const Points& candidates, std::vector<int> body = {}, bool meant = false) {
    body.resize(candidates.size(), -1);
    return make_state(candidates, body, meant);
}

Points shaken(const Points& points, double amount, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> in(-amount, amount);
    Points result = points;
    for (Vec3& p : result)
        p += Vec3(in(random), in(random), in(random));
    return result;
}

/// Two triangles over the edge p1-p2 = y axis of length 1, wings of height 1; `fold` is the angle between the outward
/// normals, positive over a ridge. Scaled by `unit`.
TriMesh folded_pair(double fold, double unit = 1.0) {
    TriMesh mesh{{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(-1, 0.5, 0), Vec3(std::cos(fold), 0.5, -std::sin(fold))},
                 {{0, 1, 2}, {1, 0, 3}}};
    for (Vec3& p : mesh.positions)
        p *= unit;
    return mesh;
}

double fold_of(const Points& p) {
    const Vec3 a = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    const Vec3 b = (p[0] - p[1]).cross(p[3] - p[1]).normalized();
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

/// Fold after one projection towards `rest` from `now`.
double fold_after(double rest, double now, double unit, double bending, bool meant) {
    const TriMesh at_rest = folded_pair(rest, unit);
    const auto pairs = bending_pairs(at_rest, MeshTopology(4, at_rest.triangles));
    REQUIRE(pairs.size() == 1);
    ClassicState state = state_of(folded_pair(now, unit).positions);
    project_bending(state, pairs, bending, meant);
    return fold_of(state.candidate);
}

} // namespace

TEST_CASE("published sweep: vertex by vertex, every edge once in each direction",
          "[solver][classic][edges]") {
    const TriMesh mesh = sphere(1.0, 2);
    const MeshTopology topology(mesh.vertex_count(), mesh.triangles);
    std::vector<double> softness(topology.edges().size());
    for (std::size_t e = 0; e < softness.size(); ++e)
        softness[e] = 1e-3 * static_cast<double>(e);
    const auto sweep = edge_sweep(mesh, topology, softness, 0.5, false);
    REQUIRE(sweep.size() == 2 * topology.edges().size());
    std::map<std::pair<int, int>, int> seen;
    for (std::size_t i = 0; i < sweep.size(); ++i) {
        CHECK((i == 0 || sweep[i - 1].from <= sweep[i].from));
        ++seen[{sweep[i].from, sweep[i].to}];
    }
    for (std::size_t e = 0; e < topology.edges().size(); ++e) {
        const Edge& edge = topology.edges()[e];
        CHECK(seen[{edge.a, edge.b}] == 1);
        CHECK(seen[{edge.b, edge.a}] == 1);
    }
    for (const DirectedEdge& d : sweep) {
        const Edge edge{std::min(d.from, d.to), std::max(d.from, d.to)};
        const auto at = std::find(topology.edges().begin(), topology.edges().end(), edge);
        CHECK(d.factor == Approx(0.5e-3 * static_cast<double>(at - topology.edges().begin())));
    }
    CHECK(edge_sweep(mesh, topology, softness, 0.5, true).size() == topology.edges().size());
}

TEST_CASE("an edge's factor acts twice a sweep and a fixed end swallows its half",
          "[solver][classic][edges]") {
    const Points start{Vec3(0, 0, 0), Vec3(3, 0, 0)};
    const std::vector<DirectedEdge> both{{0, 1, 1.0, 0.5}, {1, 0, 1.0, 0.5}};
    ClassicState state = state_of(start);
    project_edges(state, both);
    const double length = (state.candidate[1] - state.candidate[0]).norm();
    CHECK(length == Approx(1.0 + 2.0 * 0.25)); // error 2, left: (1 - k)^2
    CHECK((state.candidate[0] + state.candidate[1] - Vec3(3, 0, 0)).norm() < 1e-12); // momentum

    const std::vector<DirectedEdge> once{{0, 1, 1.0, 1.0}};
    ClassicState published = state_of(start, {0, -1});
    project_edges(published, once);
    CHECK(published.candidate[1][0] == Approx(2.0));
    CHECK(published.candidate[0][0] == Approx(1.0)); // moved, and thrown away at the end
    CHECK(accept(published) == 0);
    CHECK(published.position[0] == start[0]);
    CHECK(published.position[1][0] == Approx(2.0));
    CHECK(published.velocity[1][0] == Approx(-1000.0));

    ClassicState meant = state_of(start, {0, -1}, true);
    project_edges(meant, once);
    CHECK(meant.candidate[0] == start[0]);
    CHECK(meant.candidate[1][0] == Approx(1.0));

    ClassicState collapsed = state_of({Vec3(1, 1, 1), Vec3(1, 1, 1)});
    project_edges(collapsed, once);
    CHECK(collapsed.candidate[0] == Vec3(1, 1, 1));
    ClassicState held = state_of(start, {0, 0}, true);
    project_edges(held, once);
    CHECK(held.candidate == start);
}

TEST_CASE("one volume projection takes away a sixth of the error, meant all of it",
          "[solver][classic][volume]") {
    const TriMesh mesh = sphere(10.0, 3, Vec3(50, -20, 30));
    const double v0 = signed_volume(mesh.positions, mesh.triangles);
    for (const bool meant : {false, true}) {
        VolumeConstraint volume(mesh.positions, mesh.triangles, 1.0, meant);
        CHECK(volume.rest_volume() == Approx(v0));
        Points grown = mesh.positions;
        for (Vec3& p : grown)
            p = Vec3(50, -20, 30) + 1.001 * (p - Vec3(50, -20, 30));
        ClassicState state = state_of(grown);
        const double before = signed_volume(grown, mesh.triangles) - v0;
        volume.project(state);
        const double after = signed_volume(state.candidate, mesh.triangles) - v0;
        CHECK(after / before == Approx(meant ? 0.0 : 5.0 / 6.0).margin(2e-3));
        for (int i = 0; i < 2; ++i)
            volume.project(state);
        if (!meant) // a frame of three substeps: (5/6)^3
            CHECK((signed_volume(state.candidate, mesh.triangles) - v0) / before ==
                  Approx(0.5787).margin(2e-3));
    }
}

TEST_CASE("volume: pressure, momentum, rest, fixed vertices, no gradient", "[solver][classic][volume]") {
    const TriMesh mesh = sphere(10.0, 3, Vec3(5, 0, 0));
    const bool meant = GENERATE(false, true);
    VolumeConstraint inflated(mesh.positions, mesh.triangles, 1.2, meant);
    ClassicState state = state_of(shaken(mesh.positions, 0.3, 3), {}, meant);
    const Points before = state.candidate;
    for (int i = 0; i < 80; ++i)
        inflated.project(state);
    CHECK(signed_volume(state.candidate, mesh.triangles) ==
          Approx(1.2 * inflated.rest_volume()).epsilon(1e-6));
    Vec3 moved = Vec3::Zero();
    for (std::size_t i = 0; i < before.size(); ++i)
        moved += state.candidate[i] - before[i];
    CHECK(moved.norm() < 1e-9);

    VolumeConstraint keeps(mesh.positions, mesh.triangles, 1.0, meant);
    ClassicState rest = state_of(mesh.positions, {}, meant);
    keeps.project(rest);
    for (std::size_t i = 0; i < rest.size(); ++i)
        CHECK((rest.candidate[i] - mesh.positions[i]).norm() < 1e-12);

    // Meant: only free vertices are in the sum and move; the volume still comes right.
    std::vector<int> half(mesh.positions.size(), -1);
    for (std::size_t i = 0; i < half.size(); ++i)
        half[i] = mesh.positions[i][2] > 0 ? 0 : -1;
    ClassicState held = state_of(mesh.positions, half, meant);
    VolumeConstraint grows(mesh.positions, mesh.triangles, 1.001, meant);
    grows.project(held);
    double fixed_motion = 0;
    for (std::size_t i = 0; i < half.size(); ++i)
        fixed_motion += half[i] >= 0 ? (held.candidate[i] - mesh.positions[i]).norm() : 0.0;
    CHECK((fixed_motion == 0.0) == meant);
    if (meant)
        CHECK(signed_volume(held.candidate, mesh.triangles) ==
              Approx(1.001 * grows.rest_volume()).epsilon(1e-6));

    VolumeConstraint empty({Vec3::Zero()}, {}, 1.0, meant);
    ClassicState point = state_of({Vec3(1, 2, 3)});
    empty.project(point);
    CHECK(point.candidate[0] == Vec3(1, 2, 3));
}

TEST_CASE("bending terms are the gradient of acos(n1.n2), sum to zero and carry no torque",
          "[solver][classic][bending]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> in(-1.0, 1.0);
    for (int tried = 0; tried < 200; ++tried) {
        std::array<Vec3, 4> p;
        for (Vec3& x : p)
            x = Vec3(in(random), in(random), in(random));
        const auto terms = bending_terms(p[0], p[1], p[2], p[3]);
        if (!terms || std::abs(terms->cosine) > 0.99 || (p[1] - p[0]).cross(p[2] - p[0]).norm() < 0.1 ||
            (p[1] - p[0]).cross(p[3] - p[0]).norm() < 0.1)
            continue; // differences are poor there
        const std::array<Vec3, 4> q{terms->q1, terms->q2, terms->q3, terms->q4};
        const double sine = std::sqrt(1.0 - terms->cosine * terms->cosine);
        Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
        for (std::size_t i = 0; i < 4; ++i) {
            sum += q[i];
            torque += p[i].cross(q[i]);
            for (int k = 0; k < 3; ++k) {
                std::array<Vec3, 4> lo = p, hi = p;
                lo[i][k] -= 1e-6;
                hi[i][k] += 1e-6;
                const double difference = (bending_terms(hi[0], hi[1], hi[2], hi[3])->angle_rad -
                                           bending_terms(lo[0], lo[1], lo[2], lo[3])->angle_rad) /
                                          2e-6;
                REQUIRE(q[i][k] / sine == Approx(difference).epsilon(1e-4).margin(1e-4));
            }
        }
        CHECK(sum.norm() < 1e-9);
        CHECK(torque.norm() < 1e-9);
    }
}

TEST_CASE("bending pairs: every inner edge once, with the rest angle, for flat ones too",
          "[solver][classic][bending]") {
    const TriMesh cube = box(2, 3, 4);
    const auto pairs = bending_pairs(cube, MeshTopology(8, cube.triangles));
    REQUIRE(pairs.size() == 18); // 12 edges and 6 diagonals
    int flat = 0, right = 0;
    for (const BendingPair& pair : pairs) {
        flat += std::abs(pair.rest_rad) < 1e-7;
        right += std::abs(pair.rest_rad - pi / 2) < 1e-12;
        CHECK((pair.p3 != pair.p4 && pair.p1 != pair.p3 && pair.p2 != pair.p4));
    }
    CHECK(flat == 6);
    CHECK(right == 12);
    TriMesh open = sheet(1, 1);
    open.triangles.push_back({0, 1, 1}); // no triangle
    CHECK(bending_pairs(open, MeshTopology(4, open.triangles)).size() == 1);
}

TEST_CASE("published bending corrects only what is folded more than at rest, and only inside its window",
          "[solver][classic][bending]") {
    const double unit = 3.0;                                        // r is an area: here inside the window
    CHECK(fold_after(0.5, 1.0, unit, 0.9, false) < 0.95);           // too much folded: opens
    CHECK(fold_after(1.0, 0.5, unit, 0.9, false) == Approx(0.5));   // too flat: r < 0, left
    CHECK(fold_after(0.5, 1.0, 0.003, 0.9, false) == Approx(1.0));  // the same shape in metres: r < 0.1, left
    CHECK(fold_after(0.5, 1.0, 3000.0, 0.9, false) == Approx(1.0)); // r > 10, left
    CHECK(fold_after(0.5, 0.5 + 1e-4, unit, 0.9, false) == Approx(0.5001)); // too little: r < 0.1, left
}

TEST_CASE("meant bending corrects both ways, whatever the unit", "[solver][classic][bending]") {
    const double unit = GENERATE(0.003, 3.0, 3000.0);
    CHECK(fold_after(0.5, 0.6, unit, 1.0, true) == Approx(0.5).margin(5e-3));
    CHECK(fold_after(0.6, 0.5, unit, 1.0, true) == Approx(0.6).margin(5e-3));
    CHECK(fold_after(0.6, 0.5, unit, 0.5, true) == Approx(0.55).margin(5e-3));
    CHECK(fold_after(0.5, 0.5 + 1e-4, unit, 1.0, true) == Approx(0.5).margin(1e-7));
    CHECK(fold_after(0.2, 3.0, unit, 1.0, true) < 2.7); // bounded step, right direction
}

TEST_CASE("bending keeps momentum, leaves rest alone and survives flat, folded and broken pairs",
          "[solver][classic][bending]") {
    const bool meant = GENERATE(false, true);
    const TriMesh mesh = sphere(20.0, 3);
    const auto pairs = bending_pairs(mesh, MeshTopology(mesh.vertex_count(), mesh.triangles));
    ClassicState rest = state_of(mesh.positions);
    project_bending(rest, pairs, 0.9, meant);
    for (std::size_t i = 0; i < rest.size(); ++i)
        CHECK((rest.candidate[i] - mesh.positions[i]).norm() < 1e-9);

    ClassicState state = state_of(shaken(mesh.positions, 0.5, 9));
    const Points before = state.candidate;
    project_bending(state, pairs, 0.9, meant);
    Vec3 moved = Vec3::Zero();
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        moved += state.candidate[i] - before[i];
        most = std::max(most, (state.candidate[i] - before[i]).norm());
    }
    CHECK(most > 1e-3);
    CHECK(moved.norm() < 1e-9);

    for (const double now : {0.0, pi, 1e-6}) { // 0/0 in Mueller's form
        const double after = fold_after(1.0, now, 3.0, 0.9, meant);
        CHECK(std::isfinite(after));
    }
    const TriMesh pair = folded_pair(0.5);
    const auto one = bending_pairs(pair, MeshTopology(4, pair.triangles));
    Points broken = pair.positions;
    broken[3] = Vec3(0, 0.5, 0); // wing on the edge
    ClassicState thin = state_of(broken);
    project_bending(thin, one, 0.9, meant);
    CHECK(thin.candidate == broken);
}
