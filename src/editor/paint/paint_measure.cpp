#include "editor/paint/paint_measure.hpp"

#include "fascicle/anatomy/attached_vertices.hpp"
#include "fascicle/geometry/region_border.hpp"

#include <chrono>

namespace fascicle::editor {

void PaintMeasure::follow(const SurfaceGraph& graph, const SurfaceRegion* region, bool stroke, double now) {
    constexpr double cheap_seconds = 0.003, every_seconds = 0.25;
    const SurfaceRegion none(graph.vertex_count());
    const SurfaceRegion& wanted =
        region != nullptr && region->vertex_count() == graph.vertex_count() ? *region : none;
    late_ = false;
    if (graph_ == &graph && measured_ == wanted)
        return;
    if (graph_ == &graph && stroke && cost_ > cheap_seconds && now - at_ < every_seconds) {
        late_ = true;
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    numbers_ = {};
    numbers_.region = measure_region(graph, wanted);
    for (const BorderLoop& loop : region_border(graph, wanted)) {
        numbers_.border += border_length(graph, loop);
        ++numbers_.loops;
    }
    cost_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    at_ = now;
    measured_ = wanted;
    graph_ = &graph;
}

void FixedVertices::follow(const MeshPtr& muscle, const SurfaceGraph& bone, const SurfaceRegion* region,
                           double unit_mm) {
    const SurfaceRegion none(bone.vertex_count());
    const SurfaceRegion& wanted =
        region != nullptr && region->vertex_count() == bone.vertex_count() ? *region : none;
    if (busy() || (bone_ == &bone && muscle_ == muscle && region_ == wanted))
        return;
    bone_ = &bone;
    muscle_ = muscle;
    region_ = wanted;
    job_ = std::async(std::launch::async, [muscle, &bone, area = wanted, rules = attach_rules(unit_mm)] {
        GeodesicSearch search(bone);
        return vertices_of(attached_vertices(area, search, *muscle, rules));
    });
}

void FixedVertices::update() {
    if (busy() && job_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        vertices_ = std::make_shared<const std::vector<int>>(job_.get());
}

void FixedVertices::finish() {
    if (busy())
        job_.wait();
    update();
}

void FixedVertices::forget() {
    finish();
    bone_ = nullptr;
    muscle_ = nullptr;
    vertices_ = nullptr;
}

} // namespace fascicle::editor
