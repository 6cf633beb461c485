#include "editor/paint/measure_strokes.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>
#include <cstdio>
#include <numbers>

using namespace fascicle;
using namespace fascicle::editor;

namespace {

/// A sphere of rings: as many triangles as wanted, unlike the refined octahedron's.
MeshPtr ringed_sphere(double radius, int rings, int columns) {
    TriMesh mesh;
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < columns; ++i) {
            const double t = std::numbers::pi * (j + 0.5) / rings, p = 2 * std::numbers::pi * i / columns;
            mesh.positions.emplace_back(radius * std::sin(t) * std::cos(p),
                                        radius * std::sin(t) * std::sin(p), radius * std::cos(t));
        }
    for (int j = 0; j + 1 < rings; ++j)
        for (int i = 0; i < columns; ++i) {
            const int a = j * columns + i, b = j * columns + (i + 1) % columns, c = a + columns,
                      d = b + columns;
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({b, c, d});
        }
    return std::make_shared<const TriMesh>(std::move(mesh));
}

} // namespace

TEST_CASE("A measured stroke paints, and sends a small part of the colours a frame", "[editor][paint]") {
    const MeshPtr bone = ringed_sphere(50, 60, 120);
    const StrokeTimes times = measure_strokes(bone, 6, 30);
    CHECK(times.frame_ms.size() == 30);
    CHECK(times.hover_ms.size() == 30);
    CHECK(times.painted > 50);
    CHECK(times.painted < bone->vertex_count() / 2);
    CHECK(times.most_colours > 0);
    CHECK(times.most_colours < std::size_t(bone->vertex_count()) / 2);
    CHECK(times.worst_ms() >= times.median_ms());
}

// Hidden: prints, judges nothing. tests "[paint_speed]"
TEST_CASE("Time of a stroke on a bone of 250,000 triangles", "[.][paint_speed]") {
    const MeshPtr bone = ringed_sphere(50, 354, 354);
    for (const double radius : {3.0, 8.0, 15.0}) {
        const StrokeTimes t = measure_strokes(bone, radius, 120);
        std::printf("%zu triangles, radius %.0f mm: prepare %.0f ms; stroke median %.2f, worst %.2f ms a "
                    "frame; hover "
                    "worst %.2f ms; at most %zu colours sent; %d vertices painted\n",
                    bone->triangles.size(), radius, t.prepare_ms, t.median_ms(), t.worst_ms(),
                    t.worst_hover_ms(), t.most_colours, t.painted);
    }
}
