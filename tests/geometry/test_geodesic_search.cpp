#include "fascicle/geometry/geodesic_search.hpp"
#include "geometry/surface_shapes.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace fascicle;
using namespace fascicle::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bellman and Ford: no queue, no limit.
std::vector<double> edge_distances(const SurfaceGraph& graph, int from) {
    std::vector<double> d(std::size_t(graph.vertex_count()), infinity);
    d[std::size_t(from)] = 0;
    for (bool changed = true; changed;) {
        changed = false;
        for (const Edge& e : graph.topology().edges()) {
            const double l = (graph.position(e.a) - graph.position(e.b)).norm();
            for (const auto& [a, b] : {std::pair{e.a, e.b}, std::pair{e.b, e.a}})
                if (d[std::size_t(a)] + l < d[std::size_t(b)]) {
                    d[std::size_t(b)] = d[std::size_t(a)] + l;
                    changed = true;
                }
        }
    }
    return d;
}

/// Largest relative error of reached vertices further than `from_distance`.
template <typename Exact>
double worst_error(const GeodesicSearch& search, const Exact& exact, double from_distance) {
    double worst = 0;
    for (const int v : search.reached())
        if (const double d = exact(search.graph().position(v)); d > from_distance)
            worst = std::max(worst, std::abs(search.distance(v) / d - 1));
    return worst;
}

} // namespace

TEST_CASE("distances along edges are those of Bellman and Ford", "[geometry][geodesic]") {
    for (const TriMesh& mesh : {sphere(5, 3), torus(), rough_sheet(12, 0.3, 7)}) {
        const SurfaceGraph graph(shared(mesh));
        GeodesicSearch search(graph);
        for (const int seed : {0, graph.vertex_count() / 2, graph.vertex_count() - 1}) {
            const std::vector<double> oracle = edge_distances(graph, seed);
            const GeodesicSearch::Seed from{seed, 0};
            for (const double limit : {0.7, 3.0, infinity}) {
                GeodesicLimits limits;
                limits.distance = limit;
                search.run(std::span(&from, 1), limits, WaveFront::edges);
                for (int v = 0; v < graph.vertex_count(); ++v) {
                    if (oracle[std::size_t(v)] <= limit)
                        CHECK(search.distance(v) == Approx(oracle[std::size_t(v)]).margin(1e-12));
                    else
                        CHECK(search.distance(v) == infinity);
                    if (search.distance(v) < infinity && v != seed) {
                        const int p = search.parent(v);
                        REQUIRE(p >= 0);
                        CHECK(search.distance(v) ==
                              search.distance(p) + graph.edge_length(graph.edge_between(v, p)));
                    }
                }
                for (std::size_t i = 1; i < search.reached().size(); ++i)
                    CHECK(search.distance(search.reached()[i - 1]) <= search.distance(search.reached()[i]));
            }
        }
    }
}

TEST_CASE("round waves are exact on a plane, whatever the triangles", "[geometry][geodesic]") {
    const auto roughness = GENERATE(0.0, 0.1, 0.22);
    const SurfaceGraph graph(shared(rough_sheet(40, roughness, 3)));
    GeodesicSearch search(graph);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(5, 35);
    GeodesicLimits limits;
    limits.distance = 12;
    for (int k = 0; k < 10; ++k) {
        const Vec3 p(place(random), place(random), 0);
        const SurfacePoint at = foot(graph, p);
        search.run(std::span(&at, 1), limits);
        int inside = 0;
        for (int v = 0; v < graph.vertex_count(); ++v)
            inside += (graph.position(v) - p).norm() <= 12 ? 1 : 0;
        CHECK(std::abs(int(search.reached().size()) - inside) <= 2);
        CHECK(worst_error(
                  search, [&](const Vec3& q) { return (q - p).norm(); }, 1e-6) < 0.003);
    }
}

TEST_CASE("round waves on a sphere are within a per cent of great circles", "[geometry][geodesic]") {
    const double radius = 20;
    const SurfaceGraph graph(shared(sphere(radius, 5)));
    GeodesicSearch search(graph);
    GeodesicLimits limits;
    limits.distance = 40; // most of the way to the other pole
    for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(0.3, -0.5, 0.9)}) {
        const Vec3 n = direction.normalized();
        const SurfacePoint at = foot(graph, radius * n);
        search.run(std::span(&at, 1), limits);
        const auto great_circle = [&](const Vec3& q) {
            return radius * std::atan2(n.cross(q).norm(), n.dot(q));
        };
        CHECK(worst_error(search, great_circle, 2.0) < 0.01);
    }
}

TEST_CASE("plane waves run straight off a whole region", "[geometry][geodesic]") {
    const SurfaceGraph graph(shared(sheet(30, 30)));
    GeodesicSearch search(graph);
    std::vector<GeodesicSearch::Seed> column;
    for (int j = 0; j <= 30; ++j)
        column.push_back({31 * j + 10, 0.0});
    GeodesicLimits limits;
    limits.distance = infinity;
    search.run(column, limits, WaveFront::plane);
    for (int v = 0; v < graph.vertex_count(); ++v)
        CHECK(search.distance(v) == Approx(std::abs(graph.position(v).x() - 10)).margin(1e-9));
}

TEST_CASE("a wave stays on its part, and where it may pass", "[geometry][geodesic]") {
    TriMesh other = sphere(5, 2, Vec3(0, 0, 10.1)); // nearly touches the first
    const SurfaceGraph graph(shared(joined(sphere(5, 2), other)));
    GeodesicSearch search(graph);
    const SurfacePoint at = foot(graph, Vec3(0, 0, 4.9));
    GeodesicLimits limits;
    limits.distance = infinity;
    search.run(std::span(&at, 1), limits);
    CHECK(int(search.reached().size()) == graph.vertex_count() / 2);
    limits.passes = [&](int t) {
        return graph.position(graph.triangle(t)[0]).z() > 0 && graph.position(graph.triangle(t)[1]).z() > 0 &&
               graph.position(graph.triangle(t)[2]).z() > 0;
    };
    search.run(std::span(&at, 1), limits);
    CHECK(search.reached().size() > 10);
    for (const int v : search.reached())
        CHECK(graph.position(v).z() > 0);
}

TEST_CASE("searches on odd surfaces end: needles, folded and non-manifold triangles",
          "[geometry][geodesic]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-1, 1);
    for (int round = 0; round < 30; ++round) {
        TriMesh mesh;
        for (int i = 0; i < 40; ++i) {
            const double x = place(random), y = place(random), z = place(random);
            mesh.positions.emplace_back(x, y, round % 3 == 0 ? 0 : z);
        }
        mesh.positions[1] = mesh.positions[0];
        for (int t = 0; t < 120; ++t)
            mesh.triangles.push_back({int(random() % 40), int(random() % 40), int(random() % 40)});
        const SurfaceGraph graph(shared(mesh));
        GeodesicSearch search(graph);
        const GeodesicSearch::Seed seed{graph.triangle(0)[0], 0};
        GeodesicLimits limits;
        limits.distance = infinity;
        search.run(std::span(&seed, 1), limits, WaveFront::edges);
        const std::vector<int> all = search.reached();
        std::vector<double> longest;
        for (const int v : all)
            longest.push_back(search.distance(v));
        for (const WaveFront front : {WaveFront::round, WaveFront::plane}) {
            search.run(std::span(&seed, 1), limits, front);
            CHECK(search.reached().size() == all.size());
            for (std::size_t i = 0; i < all.size(); ++i) {
                CHECK(search.distance(all[i]) <= longest[i] + 1e-9);
                CHECK(search.distance(all[i]) >= 0);
            }
        }
    }
}
