#include "fascicle/geometry/region_overlap.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace fascicle;

TEST_CASE("Overlap of regions: the same is 1, apart is 0, half is two thirds and a half",
          "[geometry][overlap]") {
    // A flat strip of 2 x 8 unit squares: vertices of inner columns have the same area.
    auto mesh = std::make_shared<TriMesh>();
    for (int x = 0; x <= 8; ++x)
        for (int y = 0; y <= 1; ++y)
            mesh->positions.emplace_back(x, y, 0);
    for (int x = 0; x < 8; ++x) {
        const int a = 2 * x;
        mesh->triangles.push_back({a, a + 2, a + 1});
        mesh->triangles.push_back({a + 1, a + 2, a + 3});
    }
    const SurfaceGraph graph(mesh);
    const int n = mesh->vertex_count();
    const SurfaceRegion four(n, std::vector<int>{4, 5, 6, 7}), two(n, std::vector<int>{4, 5}),
        others(n, std::vector<int>{10, 11}), none(n);
    const double column = graph.vertex_area(4) + graph.vertex_area(5);
    CHECK(column == Approx(1.0)); // half of the two unit squares beside it

    const RegionOverlap same = overlap_of(graph, four, four);
    CHECK(same.first == Approx(2));
    CHECK(same.dice() == Approx(1));
    CHECK(same.jaccard() == Approx(1));
    const RegionOverlap apart = overlap_of(graph, four, others);
    CHECK(apart.both == 0);
    CHECK(apart.dice() == 0);
    CHECK(apart.jaccard() == 0);
    const RegionOverlap half = overlap_of(graph, two, four);
    CHECK(half.first == Approx(1));
    CHECK(half.second == Approx(2));
    CHECK(half.dice() == Approx(2.0 / 3));
    CHECK(half.jaccard() == Approx(0.5));
    CHECK(half.jaccard() == Approx(half.dice() / (2 - half.dice())));
    CHECK(overlap_of(graph, none, four).dice() == 0);
    CHECK(overlap_of(graph, none, none).dice() == 0);
    CHECK(overlap_of(graph, none, none).jaccard() == 0);
}
