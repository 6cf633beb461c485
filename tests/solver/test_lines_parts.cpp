#include "fascicle/geometry/primitives.hpp"
#include "solver/rivals/lines/attachment_pairs.hpp"
#include "solver/rivals/lines/end_shares.hpp"
#include "solver/rivals/lines/line_binding.hpp"
#include "solver/rivals/lines/line_ends.hpp"
#include "solver/rivals/lines/middle_line.hpp"
#include "solver/rivals/lines/taut_string.hpp"
#include "support/rival_scenes.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <random>

using namespace fascicle;
using namespace fascicle::solver;

namespace {

constexpr double radius = 20;

ContactSettings contact_of(double offset) {
    ContactSettings contact;
    contact.offset = offset;
    contact.least = 0.1 * offset;
    return contact;
}

/// A string of 41 nodes over a solid, begun as an arc on its upper side (z > 0).
Points string_over(const TriMesh& mesh, const Vec3& from, const Vec3& to, double clearance, int& sweeps) {
    DistanceGridOptions options;
    const DistanceGrid grid(mesh, options);
    const std::vector<ContactSolid> solids{{&grid, Pose{}, Pose{}}};
    Points nodes;
    for (int k = 0; k <= 40; ++k)
        nodes.push_back(from + k / 40.0 * (to - from) +
                        Vec3(0, 0, 1.2 * radius * std::sin(std::numbers::pi * k / 40.0)));
    const Points before = nodes;
    const std::vector<std::uint8_t> free(nodes.size(), 0);
    const std::vector<double> clearances(nodes.size(), clearance);
    StringSettings settings;
    settings.tolerance = 1e-3;
    sweeps = tighten(nodes, {free, clearances}, before, solids, contact_of(0.1), settings);
    CHECK(sweeps < settings.most_sweeps);
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
        CHECK(grid.value(nodes[k]) > clearance - 0.01);
    const Points tight = nodes;
    CHECK(tighten(nodes, {free, clearances}, nodes, solids, contact_of(0.1), settings) == 0);
    CHECK(nodes == tight);
    return nodes;
}

/// Two tangents and an arc about a circle, in its plane, for ends at the distances a and b from the centre and the angle between them.
double over_circle(double a, double b, double angle, double r) {
    const double arc = angle - std::acos(r / a) - std::acos(r / b);
    REQUIRE(arc > 0.0);
    return std::sqrt(a * a - r * r) + std::sqrt(b * b - r * r) + r * arc;
}

} // namespace

TEST_CASE("lines: a string over a sphere is two tangents and an arc", "[solver][lines]") {
    const TriMesh ball = test::sphere(radius, 4);
    const Vec3 from(-40, 0, -5), to(30, 10, -10);
    const double angle = std::acos(from.normalized().dot(to.normalized()));
    for (const double clearance : {0.1, 4.0}) {
        int sweeps = 0;
        const Points nodes = string_over(ball, from, to, clearance, sweeps);
        CHECK(length_of(nodes) ==
              Approx(over_circle(from.norm(), to.norm(), angle, radius + clearance)).epsilon(0.01));
        CHECK(sweeps > 0);
    }
}

TEST_CASE("lines: a string over a cylinder is straight on its unrolled side", "[solver][lines]") {
    const TriMesh bar = cylinder_mesh(Vec3(0, -80, 0), Vec3(0, 80, 0), radius, 96, 80);
    for (const double along : {0.0, 25.0}) {
        const Vec3 from(-40, -along, -5), to(35, along, -8);
        const double a = std::hypot(from.x(), from.z()), b = std::hypot(to.x(), to.z());
        // Over the upper side, which is the longer way.
        const double angle =
            2 * std::numbers::pi - std::acos((from.x() * to.x() + from.z() * to.z()) / (a * b));
        int sweeps = 0;
        const Points nodes = string_over(bar, from, to, 0.1, sweeps);
        CHECK(length_of(nodes) ==
              Approx(std::hypot(over_circle(a, b, angle, radius + 0.1), 2 * along)).epsilon(0.01));
    }
}

TEST_CASE("lines: a string without solids is straight between held nodes", "[solver][lines]") {
    Points nodes;
    for (int k = 0; k <= 20; ++k)
        nodes.emplace_back(k * k, std::sin(k), std::cos(3 * k));
    std::vector<std::uint8_t> hold(nodes.size(), 0);
    hold[8] = 1;
    const Points start = nodes;
    StringSettings settings;
    settings.tolerance = 1e-9;
    tighten(nodes, {hold, {}}, start, {}, contact_of(0.1), settings);
    for (std::size_t k = 0; k <= 20; ++k) {
        const Vec3 expected = k <= 8 ? Vec3(start[0] + double(k) / 8.0 * (start[8] - start[0]))
                                     : Vec3(start[8] + double(k - 8) / 12.0 * (start[20] - start[8]));
        CHECK((nodes[k] - expected).norm() < 1e-6);
    }
    // Nothing to do: two nodes, all held, or all at one place.
    const std::vector<std::uint8_t> both(2, 0);
    Points two{Vec3(0, 0, 0), Vec3(1, 2, 3)};
    CHECK(tighten(two, {both, {}}, two, {}, contact_of(0.1), settings) == 0);
    const std::vector<std::uint8_t> held(21, 1);
    Points all = start;
    CHECK(tighten(all, {held, {}}, start, {}, contact_of(0.1), settings) == 0);
    CHECK(all == start);
    Points one(21, Vec3(1, 2, 3));
    CHECK(tighten(one, {hold, {}}, one, {}, contact_of(0.1), settings) == 0);
}

TEST_CASE("lines: ends are spread evenly and joined without crossing", "[solver][lines]") {
    Points points;
    std::vector<double> areas;
    std::vector<int> low, high;
    for (int i = 0; i < 20; ++i)
        for (int k = 0; k < 10; ++k) {
            low.push_back(int(points.size()));
            points.emplace_back(i, k, 0);
            high.push_back(int(points.size()));
            points.emplace_back(0.5 * k, 0.2 * i, 30);
            areas.insert(areas.end(), 2, 1.0);
        }
    const std::vector<int> two = even_vertices(points, areas, low, 2);
    REQUIRE(two.size() == 2);
    for (const int v : two) { // the middles of two halves
        const Vec3& p = points[std::size_t(v)];
        CHECK(std::abs(std::abs(p.x() - 9.5) - 5.0) <= 1.0);
        CHECK(std::abs(p.y() - 4.5) <= 1.0);
    }
    const std::vector<int> from = even_vertices(points, areas, low, 8);
    std::vector<int> to = even_vertices(points, areas, high, 8);
    REQUIRE((from.size() == 8 && to.size() == 8));
    std::vector<int> sorted = to;
    pair_ends(points, from, to);
    CHECK(std::is_permutation(to.begin(), to.end(), sorted.begin()));
    const auto squared = [&](std::size_t i, std::size_t k) {
        return (points[std::size_t(from[i])] - points[std::size_t(to[k])]).squaredNorm();
    };
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = i + 1; k < 8; ++k)
            CHECK(squared(i, i) + squared(k, k) <= squared(i, k) + squared(k, i) + 1e-9);
    // More than there are; and all at one place.
    CHECK(even_vertices(points, areas, std::vector<int>{0, 2, 4}, 9).size() == 3);
    CHECK(even_vertices(Points(5, Vec3(1, 1, 1)), areas, std::vector<int>{0, 1, 2}, 3).size() == 1);
}

TEST_CASE("lines: lines run from what stays to what moves, else from the attachment that is alone",
          "[solver][lines]") {
    const auto area = [](int solid, std::size_t vertices, const Vec3& middle, bool moves) {
        return AttachedArea{solid, std::vector<int>(vertices, 0), middle, moves};
    };
    // Two heads and an insertion; the second head has most vertices.
    std::vector<AttachedArea> areas{area(0, 10, Vec3(-5, 0, 0), false), area(1, 30, Vec3(5, 0, 0), false),
                                    area(4, 20, Vec3(0, 0, 50), true)};
    const auto ends = [](const std::vector<AttachmentPair>& pairs) {
        std::vector<std::array<int, 3>> list;
        for (const AttachmentPair& p : pairs)
            list.push_back({int(p.from), int(p.to), p.lines});
        return list;
    };
    using Ends = std::vector<std::array<int, 3>>;
    CHECK(ends(pair_attachments(areas, 12)) == Ends{{0, 2, 3}, {1, 2, 9}});
    areas[2].moves = false; // nothing is known
    CHECK(ends(pair_attachments(areas, 12)) == Ends{{2, 0, 3}, {2, 1, 9}});
    for (AttachedArea& a : areas)
        a.moves = true;
    CHECK(ends(pair_attachments(areas, 1)) == Ends{{2, 0, 1}, {2, 1, 1}});
    // Two of each.
    areas[0].moves = areas[1].moves = false;
    areas.push_back(area(5, 20, Vec3(0, 5, 50), true));
    CHECK(ends(pair_attachments(areas, 16)) == Ends{{0, 2, 2}, {0, 3, 2}, {1, 2, 6}, {1, 3, 6}});
    // Two alone: the one with more vertices begins, then the first.
    areas.resize(2);
    CHECK(ends(pair_attachments(areas, 4)) == Ends{{1, 0, 4}});
    areas[0].vertices.resize(30);
    CHECK(ends(pair_attachments(areas, 4)) == Ends{{0, 1, 4}});
    areas.resize(1);
    CHECK(pair_attachments(areas, 4).empty());
    CHECK(pair_attachments({}, 4).empty());
}

TEST_CASE("lines: shares of the ends rise evenly along a bar, and the middle line is its axis",
          "[solver][lines]") {
    SoftBodyProblem problem;
    problem.surface = std::make_shared<TriMesh>(box_mesh(Vec3(0, 0, 0), Vec3(80, 10, 6), {40, 5, 3}));
    const Points& rest = problem.surface->positions;
    problem.solids.resize(3); // of which nothing is attached to the middle one
    problem.body_of_vertex.assign(rest.size(), -1);
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (rest[v].x() < 1e-9 || rest[v].x() > 80 - 1e-9)
            problem.body_of_vertex[v] = rest[v].x() < 40 ? 0 : 2;
    const MeshTopology topology(problem.surface->vertex_count(), problem.surface->triangles);
    const EndShares shares = end_shares(problem, topology);
    CHECK(shares.solids == std::vector<int>{0, 2});
    std::vector<double> u(rest.size());
    for (std::size_t v = 0; v < rest.size(); ++v) {
        u[v] = shares.of(v, 1);
        CHECK(shares.of(v, 0) + u[v] == Approx(1.0).margin(1e-9));
        CHECK(u[v] == Approx(rest[v].x() / 80).margin(0.02));
    }
    const MiddleLine line = middle_line(rest, problem.surface->triangles, u,
                                        std::vector<double>(rest.size(), 1.0), Vec3(0, 5, 3), Vec3(80, 5, 3));
    CHECK(line.points.size() == 33);
    for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0})
        CHECK((line.at(share) - Vec3(80 * share, 5, 3)).norm() < 0.5);
    // No contours: the ends alone.
    const MiddleLine straight = middle_line(rest, {}, u, u, Vec3(0, 0, 0), Vec3(4, 0, 0));
    CHECK(straight.at(0.25) == Vec3(1, 0, 0));
}

TEST_CASE("lines: stations lie at equal shares of the length, with unit tangents", "[solver][lines]") {
    Points arc, places, tangents;
    for (int k = 0; k <= 400; ++k) // unevenly spaced on a half circle
        arc.emplace_back(10 * std::cos(std::numbers::pi * k * k / 160000.0),
                         10 * std::sin(std::numbers::pi * k * k / 160000.0), 0);
    find_stations(arc, places, tangents);
    REQUIRE((places.size() == line_stations && tangents.size() == line_stations));
    for (std::size_t k = 0; k < line_stations; ++k) {
        const double angle = std::numbers::pi * double(k) / double(line_stations - 1);
        CHECK((places[k] - 10 * Vec3(std::cos(angle), std::sin(angle), 0)).norm() < 1e-2);
        CHECK(tangents[k].norm() == Approx(1.0));
        CHECK((tangents[k] - Vec3(-std::sin(angle), std::cos(angle), 0)).norm() < 0.1);
    }
    find_stations(Points(41, Vec3(1, 2, 3)), places, tangents);
    CHECK(places[12] == Vec3(1, 2, 3));
    CHECK(tangents[12] == Vec3(0, 0, 0));
}
