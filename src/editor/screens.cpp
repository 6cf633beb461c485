#include "editor/screens.hpp"

#include "editor/screen_stage.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/io/disk_cache.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/simulation/simulation.hpp"

#include <algorithm>
#include <filesystem>

namespace fascicle::editor {

namespace {

using C = Command;
constexpr int shown_frame = 70;

void start(ScreenStage& s) {
    s.run(C::show_start_page);
    s.wait(); // for the pictures of the scenes
}

void scene(ScreenStage& s) {
    s.click("tree/gluteus_maximus");
}

void motion(ScreenStage& s) {
    s.run(C::show_motion);
    s.frames(30);
}

void paint(ScreenStage& s) {
    s.run(C::first_frame);
    s.click("tree/femur");
    s.run(C::frame_selection);
    s.run(C::paint_mode);
    s.wait(); // until the bone's surface is prepared
    const Rect view = s.rect("viewport");
    const ImVec2 middle{(view.min.x + view.max.x) / 2, (view.min.y + view.max.y) / 2};
    s.drag({middle.x - 6, middle.y - 30}, {middle.x + 6, middle.y + 60});
    s.move({middle.x + 10, middle.y + 90});
    s.frames(6);
}

void fibres(ScreenStage& s) {
    s.tab("fibres");
    s.run_anew();
    s.click("fibres/template/pennate");
    s.state().colouring = view::Colouring::fibres;
    s.wait();
    s.state().playback.position = shown_frame;
    s.frames(20);
}

void tune(ScreenStage& s) {
    s.tab("parameters");
    s.hover("parameter/solver.anisotropy");
    s.frames(60); // the tooltip
}

void display(ScreenStage& s) {
    s.run(C::show_display);
    s.state().colouring = view::Colouring::strain;
    s.run(C::toggle_section);
    s.frames(20);
}

void plots(ScreenStage& s) {
    s.run_anew();
    s.tab("fibres");
    s.click("fibres/template/parallel");
    s.tab("parameters");
    s.state().layout.bottom = 420;
    s.state().layout.show_left = false;
    s.wait();
    s.hover("plot/edge_extension/area");
    s.frames(4);
}

void compare(ScreenStage& s) {
    s.second_run();
    s.tab("compare");
    s.run(C::compare_side_by_side);
    s.frames(30);
}

void difference(ScreenStage& s) {
    s.second_run();
    s.tab("compare");
    s.state().bottom_panel = "differences";
    s.run(C::compare_difference);
    s.frames(60);
}

void exporting(ScreenStage& s) {
    s.state().exporting.folder = std::filesystem::temp_directory_path(); // no picture shows where it was made
    s.run(C::export_run);
    s.frames(10);
}

void repairing(ScreenStage& s) {
    s.state().selection = {Selection::Kind::muscle, s.scene().muscles.at(0).name};
    s.run(C::repair_mesh);
    s.click("repair/by_edge");
    s.move({2, 2}); // no tooltip over it
    s.frames(30);   // until the choices have settled
    s.wait();
    s.frames(4);
}

void lesson(ScreenStage& s) {
    s.start_lesson("volume");
    s.wait();
    s.state().playback.position = 90;
    s.frames(6);
}

void search(ScreenStage& s) {
    s.run(C::search_commands);
    s.frames(4);
    s.type("frame");
    s.frames(4);
}

void shortcuts(ScreenStage& s) {
    s.run(C::show_shortcuts);
    s.frames(4);
}

RecordingPtr run_scene(const Scene& scene, const JobControl& control) {
    const auto recording = std::make_shared<Recording>(std::make_shared<const Scene>(scene));
    run_simulation(*recording, {hardware_threads(), open_cache()}, control);
    if (control.cancelled())
        throw Cancelled();
    return recording;
}

} // namespace

const std::vector<ScreenRow>& screens() {
    static const std::vector<ScreenRow> rows{
        {"start", "The start page", start},
        {"scene", "A scene with its run", scene},
        {"motion", "Setting the motion", motion},
        {"paint", "Painting an attachment area", paint},
        {"fibres", "Choosing a fibre template", fibres},
        {"tune", "Tuning parameters", tune},
        {"display", "Colours and a section", display},
        {"plots", "Watching plots", plots},
        {"compare", "Two runs side by side", compare},
        {"difference", "The difference of two runs", difference},
        {"export", "Exporting", exporting},
        {"repair", "Repairing a mesh", repairing},
        {"lesson", "A lesson", lesson},
        {"search", "Finding a command", search},
        {"shortcuts", "The keys", shortcuts},
    };
    return rows;
}

std::vector<ScreenPicture> draw_screens(const ScreenOptions& options, const JobControl& control) {
    for (const std::string& id : options.only)
        if (std::none_of(screens().begin(), screens().end(),
                         [&](const ScreenRow& row) { return id == row.id; }))
            throw_error("screens", "there is no screen '" + id + "'",
                        "one of those that are listed without a name", ErrorKind::usage);
    Scene scene = make_embedded_scene("hip", hardware_threads());
    Scene other = scene;
    other.parameters.set("solver.stiffness", 0.4);
    const std::vector<RecordingPtr> runs{run_scene(scene, control), run_scene(other, control)};
    std::vector<ScreenPicture> pictures;
    for (const ScreenRow& row : screens()) {
        if (!options.only.empty() && std::count(options.only.begin(), options.only.end(), row.id) == 0)
            continue;
        control.checkpoint(row.id, double(pictures.size()) / double(screens().size()));
        ScreenStage stage(runs, options);
        stage.state().playback.position = shown_frame;
        stage.frames(4);
        row.prepare(stage);
        pictures.push_back({&row, stage.picture()});
    }
    return pictures;
}

} // namespace fascicle::editor
