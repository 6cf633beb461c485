#include "bench/paint_bench.hpp"

#include "fascicle/geometry/brush.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/geometry/region_border.hpp"
#include "fascicle/geometry/region_measure.hpp"
#include "fascicle/geometry/subdivide.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace fascicle::bench {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A thin curved blade, as that of an iliac bone.
MeshPtr blade(int subdivisions) {
    TriMesh mesh = box_mesh(Vec3(0, 0, 0), Vec3(150, 120, 4), {75, 60, 2});
    for (int i = 0; i < subdivisions; ++i)
        mesh = subdivide(mesh).mesh;
    for (Vec3& p : mesh.positions)
        p.z() += 12.0 * std::sin(p.x() / 40.0) + 8.0 * std::cos(p.y() / 35.0);
    return std::make_shared<const TriMesh>(std::move(mesh));
}

struct PaintTimes {
    double step_ms = 0, slowest_ms = 0, measures_ms = 0;
};

/// One stroke round in a spiral, 60 steps.
PaintTimes paint(GeodesicSearch& search) {
    const int steps = 60;
    const SurfaceGraph& graph = search.graph();
    SurfaceRegion region(graph.vertex_count());
    Brush brush;
    brush.radius = 8.0;
    brush.eye = Vec3(75, 60, 1000);
    PaintTimes times;
    SurfacePoint before;
    double angle = 0, radius = 15;
    for (int k = 0; k < steps; ++k) {
        angle += 2.0 / radius;
        radius += 0.25;
        const Vec3 at(75 + radius * std::cos(angle), 60 + radius * std::sin(angle), 40);
        const SurfacePoint point = graph.tree().closest(at);
        const auto start = Clock::now();
        region.insert(stroke_vertices(search, before, point, brush));
        const double spent = milliseconds_since(start);
        times.step_ms += spent / steps;
        times.slowest_ms = std::max(times.slowest_ms, spent);
        before = point;
        const auto measuring = Clock::now();
        const RegionMeasure measure = measure_region(graph, region);
        const std::size_t loops = region_border(graph, region).size();
        times.measures_ms += milliseconds_since(measuring) / steps;
        if (measure.vertices == 0 || loops == 0)
            break; // never: it uses what was measured
    }
    return times;
}

} // namespace

std::vector<LimitRow> measure_paint(int runs, bool is_short, const JobControl& control) {
    control.checkpoint("paint", 0.0);
    const MeshPtr mesh = blade(is_short ? 0 : 2);
    std::vector<double> build, step, slowest, measures;
    for (int r = 0; r < runs; ++r) {
        control.checkpoint("paint", double(r) / runs);
        const auto start = Clock::now();
        const SurfaceGraph graph(mesh);
        GeodesicSearch search(graph);
        build.push_back(milliseconds_since(start));
        const PaintTimes times = paint(search);
        step.push_back(times.step_ms);
        slowest.push_back(times.slowest_ms);
        measures.push_back(times.measures_ms);
    }
    const std::string bone = ", " + std::to_string(mesh->triangle_count()) + " triangles";
    return {{"surface graph" + bone, "ms", 1, spread_of(build)},
            {"stroke step of 8 mm" + bone, "ms", 1, spread_of(step)},
            {"slowest of 60 stroke steps" + bone, "ms", 1, spread_of(slowest)},
            {"area, islands, border" + bone, "ms", 1, spread_of(measures)}};
}

} // namespace fascicle::bench
