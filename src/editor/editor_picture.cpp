#include "editor/editor_picture.hpp"

#include "editor/editor.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/io/disk_cache.hpp"
#include "fascicle/simulation/simulation.hpp"
#include "render/imgui_renderer.hpp"
#include "render/osmesa_context.hpp"

#include <imgui.h>

namespace fascicle::editor {

render::Image render_editor_picture(RecordingPtr recording, int frame, const EditorPictureOptions& options) {
    const render::OsmesaContext gl;
    render::ImguiHost host(options.scale);
    render::ImguiRenderer renderer;
    Editor editor(host, Document(recording->scene()), nullptr, {options.dark, true});
    editor.use_gl();
    editor.show(std::move(recording));
    editor.state().playback.position = frame;
    editor.state().colouring = options.colouring;
    const render::OffscreenTarget target(options.width, options.height);
    const auto draw = [&] {
        editor.apply_look();
        renderer.new_frame();
        editor.draw_frame(static_cast<float>(options.width), static_cast<float>(options.height), 1.0 / 60);
    };
    draw(); // windows find their sizes
    editor.metrics().finish();
    draw();
    draw();
    target.bind();
    renderer.draw(ImGui::GetDrawData());
    target.resolve();
    return target.read_back();
}

render::Image render_editor_picture(const Scene& scene, int frame, const EditorPictureOptions& options,
                                    const JobControl& control) {
    const auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(scene));
    if (!scene.muscles.empty())
        run_simulation(*recording, {hardware_threads(), open_cache()}, control);
    if (control.cancelled())
        throw Cancelled();
    return render_editor_picture(recording, frame, options);
}

} // namespace fascicle::editor
