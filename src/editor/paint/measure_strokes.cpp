#include "editor/paint/measure_strokes.hpp"

#include "editor/paint/paint_measure.hpp"
#include "editor/paint/paint_touch.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "view/area_marks.hpp"
#include "view/colour_map.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace fascicle::editor {

namespace {

double now_ms() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

double worst(const std::vector<double>& times) {
    return times.empty() ? 0 : *std::max_element(times.begin(), times.end());
}

std::size_t colours_since(const render::LiveColours& live, std::uint64_t revision) {
    std::size_t count = 0;
    for (const render::LiveColours::Change& change : live.changes)
        count += change.revision > revision ? change.count : 0;
    return count;
}

} // namespace

double StrokeTimes::median_ms() const {
    std::vector<double> sorted = frame_ms;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0 : sorted[sorted.size() / 2];
}

double StrokeTimes::worst_ms() const {
    return worst(frame_ms);
}

double StrokeTimes::worst_hover_ms() const {
    return worst(hover_ms);
}

StrokeTimes measure_strokes(const MeshPtr& bone, double radius, int frames) {
    StrokeTimes times;
    Scene scene;
    scene.bones.push_back({"bone", bone, {}});
    Muscle muscle;
    muscle.name = "muscle";
    muscle.mesh = bone;
    scene.muscles.push_back(std::move(muscle));
    Document document(std::move(scene));
    BoneSurfaces surfaces;
    double start = now_ms();
    GeodesicSearch& search = surfaces.search(bone);
    times.prepare_ms = now_ms() - start;
    const SurfaceGraph& graph = search.graph();

    PaintView view;
    view.camera.look_from(view::StandardView::left);
    view.size = {1000, 800};
    const BoundingBox box = bounding_box(bone->positions);
    view.camera.set_scene_bounds(box);
    view.camera.frame(box, view.size.aspect());
    PaintSettings settings;
    settings.radius_mm = radius;
    const actions::AreaKey key{0, AttachmentKind::insertion, 0, ""};
    view::AreaMarks marks(bone);
    marks.update(0, {}, {{0, {0}, {}}}, view::palette::bone); // the first colours are a whole array
    PaintMeasure measure;
    const auto place = [&](int k) { // to and fro, slowly upwards
        const double swing = std::abs(std::fmod(0.02 * k, 1.2) - 0.6) / 0.6;
        return Vec2(view.size.width * (0.38 + 0.24 * swing),
                    view.size.height * (0.62 - 0.24 * k / std::max(1, frames)));
    };
    const auto shown = [&] {
        std::vector<std::vector<AttachmentArea>> by_muscle{document.scene().muscles[0].areas};
        return view::shown_areas(by_muscle, 0);
    };
    for (int k = 0; k < frames; ++k) {
        const std::uint64_t sent = marks.colours() ? marks.colours()->revision : 0;
        start = now_ms();
        const SurfacePoint at = view.pick(graph, place(k).x(), place(k).y());
        if (at.triangle < 0)
            continue;
        const PaintAim aim = paint_aim(settings, view, at, place(k), 1, 1);
        const Brush brush = paint_brush(settings, view, aim);
        const std::vector<int> preview = would_change(
            document.scene(), graph, key, actions::StrokeMode::paint, {}, brush_vertices(search, at, brush));
        cursor_ring(search, at, brush);
        marks.update(0, *shown(), {{0, preview, {1, 1, 1, 0.5f}}}, view::palette::bone);
        times.hover_ms.push_back(now_ms() - start);
        if (sent > 0)
            times.most_colours = std::max(times.most_colours, colours_since(*marks.colours(), sent));
    }
    actions::StrokeOptions options;
    const SurfacePoint first = view.pick(graph, place(0).x(), place(0).y());
    if (first.triangle < 0)
        return times;
    options.brush = paint_brush(settings, view, paint_aim(settings, view, first, place(0), 1, 1));
    actions::AreaStroke stroke(document, surfaces, key, options);
    for (int k = 0; k < frames; ++k) {
        const std::uint64_t sent = marks.colours() ? marks.colours()->revision : 0;
        start = now_ms();
        const SurfacePoint at = view.pick(graph, place(k).x(), place(k).y());
        stroke.step(at);
        if (at.triangle >= 0)
            cursor_ring(search, at, options.brush);
        marks.update(0, *shown(), {}, view::palette::bone);
        const AttachmentArea* area = actions::find_area(document.scene(), key);
        measure.follow(graph, area == nullptr ? nullptr : &area->vertices, true, 1e-3 * start);
        times.frame_ms.push_back(now_ms() - start);
        if (sent > 0 && marks.colours() != nullptr)
            times.most_colours = std::max(times.most_colours, colours_since(*marks.colours(), sent));
    }
    stroke.finish();
    if (const AttachmentArea* area = actions::find_area(document.scene(), key))
        times.painted = area->vertices.size();
    return times;
}

} // namespace fascicle::editor
