#include "editor/measure.hpp"

#include "editor/editor.hpp"
#include "editor/widgets/item_recorder.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/geometry/primitives.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "render/imgui_renderer.hpp"
#include "render/osmesa_context.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <imgui.h>
#include <thread>

namespace fascicle::editor {

namespace {

constexpr float width = 1600, height = 1000;
constexpr int frames = 60;

double cpu_seconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Closed, about 12 n^2 triangles.
MeshPtr ellipsoid(int n, const Vec3& radii, const Vec3& centre) {
    TriMesh mesh = box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), {n, n, n});
    for (Vec3& p : mesh.positions)
        p = centre + radii.cwiseProduct(p.normalized());
    return std::make_shared<const TriMesh>(std::move(mesh));
}

/// Two long bones and a spindle between them, in millimetres.
Scene make_scene() {
    Scene scene;
    scene.name = "measure";
    scene.bones.push_back({"fixed", ellipsoid(76, {15, 15, 80}, {-70, 0, 0}), {}});
    scene.bones.push_back({"turning", ellipsoid(76, {15, 15, 80}, {70, 0, 0}), {}});
    Muscle muscle;
    muscle.name = "spindle";
    muscle.mesh = ellipsoid(41, {54.5, 18, 18}, Vec3::Zero());
    scene.muscles.push_back(std::move(muscle));
    scene.timeline =
        make_hinge_timeline({Vec3(0, -40, 0), Vec3::UnitZ()}, 0.3, {frames / 2, frames / 2, 0}, 2, {1});
    scene.parameters.set_text("fibres.method", "streamlines"); // as many for every shape
    scene.parameters.set("fibres.count", 100);
    scene.parameters.set("attachment.distance_mm", 3);
    return scene;
}

class Bench {
public:
    explicit Bench(RecordingPtr recording)
        : editor_(host_, Document(recording->scene()), nullptr, {true, false}),
          target_(int(width), int(height)) {
        editor_.use_gl();
        editor_.show(std::move(recording));
        set_item_recorder(&recorder_);
        for (int i = 0; i < 3; ++i)
            frame();
        editor_.metrics().finish();
        for (int i = 0; i < 3; ++i)
            frame();
    }
    ~Bench() { set_item_recorder(nullptr); }

    void frame() {
        editor_.apply_look();
        renderer_.new_frame();
        editor_.draw_frame(width, height, 1.0 / 60);
        target_.bind();
        renderer_.draw(ImGui::GetDrawData());
        target_.resolve();
    }

    /// Waits for the rasteriser's threads, which go on behind the calls.
    void finish_drawing() { target_.read_back(); }

    /// Calls `before(k)` and draws, `count` times, taking the times.
    template <typename Before>
    FrameCost measure(const char* what, int count, Before before) {
        FrameCost cost;
        cost.what = what;
        for (int k = 0; k < count; ++k) {
            before(k);
            editor_.apply_look();
            renderer_.new_frame();
            const double raster = editor_.view()->raster_seconds(),
                         start = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
            editor_.draw_frame(width, height, 1.0 / 60);
            const double all = cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
            const double drawn = editor_.view()->raster_seconds() - raster;
            cost.own_ms.push_back((all - drawn) * 1e3);
            cost.raster_ms.push_back(drawn * 1e3);
            target_.bind();
            renderer_.draw(ImGui::GetDrawData());
            target_.resolve();
        }
        return cost;
    }

    Editor& editor() { return editor_; }
    Rect rect(const char* name) const {
        const Rect* found = recorder_.find(name);
        return found == nullptr ? Rect{} : *found;
    }
    int plots() const {
        int count = 0;
        for (const auto& [name, rect] : recorder_.items())
            count +=
                name.rfind("plot/", 0) == 0 && name.size() > 5 && name.substr(name.size() - 5) == "/area";
        return count;
    }

private:
    const render::OsmesaContext gl_;
    render::ImguiHost host_{1};
    render::ImguiRenderer renderer_;
    ItemRecorder recorder_;
    Editor editor_;
    render::OffscreenTarget target_;
};

double percentile(std::vector<double> values, double share) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(share * double(values.size() - 1) + 0.5)];
}

} // namespace

EditorCost measure_editor(const JobControl& control) {
    EditorCost cost;
    const auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(make_scene()));
    run_simulation(*recording, {hardware_threads(), {}}, control);
    const Scene& scene = recording->scene();
    for (const Bone& bone : scene.bones)
        cost.bone_triangles += static_cast<int>(bone.mesh->triangle_count());
    cost.muscle_triangles = static_cast<int>(scene.muscles[0].mesh->triangle_count());
    if (const std::vector<FibreModelPtr> fibres = recording->fibres();
        !fibres.empty() && fibres[0] != nullptr)
        cost.fibres = fibres[0]->rest.count;

    {
        Bench bench(recording);
        Editor& editor = bench.editor();
        cost.plots = bench.plots();
        cost.frames.push_back(bench.measure("playing, anatomy", frames, [&](int k) {
            editor.state().playback.position = k % recording->frame_count();
        }));
        editor.state().colouring = view::Colouring::fibres;
        cost.frames.push_back(bench.measure("playing, fibres", frames, [&](int k) {
            editor.state().playback.position = k % recording->frame_count();
        }));
        editor.state().colouring = view::Colouring::strain;
        cost.frames.push_back(bench.measure("playing, strain", frames, [&](int k) {
            editor.state().playback.position = k % recording->frame_count();
        }));
        editor.state().colouring = view::Colouring::anatomy;
        cost.frames.push_back(bench.measure("turning the camera", frames,
                                            [&](int) { editor.state().camera.orbit_by(0.02, 0); }));
        const Rect plot = bench.rect("plot/edge_extension/area");
        cost.frames.push_back(bench.measure("pointer over a plot", frames, [&](int k) {
            editor.input().mouse_move(plot.min.x + plot.width() * float(k) / frames,
                                      (plot.min.y + plot.max.y) / 2);
        }));
        cost.frames.push_back(bench.measure("nothing changes", frames, [](int) {}));

        // Idle: what the loop of the window does when nothing is wanted is sleep.
        for (int i = 0; i < 40 && editor.next_redraw(); ++i)
            bench.frame();
        bench.finish_drawing();
        cost.idle_redraw = editor.next_redraw();
        const double start = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
        constexpr double seconds = 2;
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
        cost.idle_cpu_share = (cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - start) / seconds;
    }
    const MeshPtr bone = ellipsoid(145, {60, 60, 70}, Vec3::Zero());
    cost.stroke_triangles = static_cast<int>(bone->triangle_count());
    cost.strokes = measure_strokes(bone, 8, 100);
    return cost;
}

std::string to_text(const EditorCost& cost) {
    std::string text;
    char line[200];
    const auto add = [&](auto... values) {
        std::snprintf(line, sizeof line, values...);
        text += line;
    };
    add("Bones of %d triangles, a muscle of %d, %d fibres, %d plots, window of %.0f x %.0f\n\n",
        cost.bone_triangles, cost.muscle_triangles, cost.fibres, cost.plots, double(width), double(height));
    add("%-22s %10s %10s %12s\n", "CPU ms a frame", "median", "95 %", "rasteriser");
    for (const FrameCost& row : cost.frames)
        add("%-22s %10.2f %10.2f %12.2f\n", row.what.c_str(), percentile(row.own_ms, 0.5),
            percentile(row.own_ms, 0.95), percentile(row.raster_ms, 0.5));
    add("%s",
        "(own work, to be 4 ms at most; the software rasteriser's part of the same thread beside it)\n\n");
    add("Idle: %.2f %% of one processor, %s\n", 100 * cost.idle_cpu_share,
        cost.idle_redraw ? "a redraw is wanted" : "no redraw wanted");
    const StrokeTimes& s = cost.strokes;
    add("Painting, 8 mm on %d triangles: %.2f ms a frame, %.2f at most (16 allowed); hovering at most %.2f; "
        "prepared in %.0f ms\n",
        cost.stroke_triangles, s.median_ms(), s.worst_ms(), s.worst_hover_ms(), s.prepare_ms);
    return text;
}

} // namespace fascicle::editor
