// fascicle render SOURCE|RUN --frame K --size WxH --out FILE.png: the viewport as a picture, without a display; with --frames A:B
// numbered pictures, a GIF or a film.

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/run_film.hpp"
#include "app/cli/run_scene.hpp"
#include "app/cli/source_options.hpp"
#include "editor/editor_picture.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/io/run_reader.hpp"
#include "output/run_pictures.hpp"
#include "output/staged_files.hpp"

#include <cmath>

namespace fascicle::app {

namespace {

const int smallest_side = 16, largest_side = 16384;

struct RenderOptions {
    std::string run;
    SourceOptions source;
    SolveOptions solve;
    int frame = 0;
    std::string frames; ///< A:B[:STEP]; empty: one frame
    double fps = 25;
    bool transparent = false;
    std::string size = "1280x800";
    std::string out;
    std::string view;
    std::string colour = "anatomy";
    bool ui = false;
    bool quiet = false;
};

output::PictureOptions picture_options(const RenderOptions& options) {
    output::PictureOptions picture;
    const std::vector<double> sides =
        read_numbers("--size", options.size, 'x', 2, "WIDTHxHEIGHT in pixels, e.g. 1280x800");
    for (const double side : sides)
        if (side != std::floor(side) || side < smallest_side || side > largest_side)
            throw_error("--size", "got '" + options.size + "'",
                        "whole numbers from " + std::to_string(smallest_side) + " to " +
                            std::to_string(largest_side),
                        ErrorKind::usage);
    picture.width = static_cast<int>(sides[0]);
    picture.height = static_cast<int>(sides[1]);
    const auto& names = output::standard_view_names();
    if (const auto it = std::find(names.begin(), names.end(), options.view); it != names.end())
        picture.from = static_cast<view::StandardView>(it - names.begin());
    for (const view::ColouringRow& row : view::colourings())
        if (options.colour == row.key)
            picture.colouring = row.colouring;
    return picture;
}

JobControl interruptible() {
    JobControl control;
    control.cancel = &watch_interrupts();
    return control;
}

/// Frames 0 to `frame` of the source, or all of them.
RecordingPtr simulate(const RenderOptions& options, int frame, bool all) {
    LoadedScene loaded = load(options.source, options.solve);
    int& last = loaded.scene.timeline.last_frame;
    if (frame > last)
        throw_error(options.frames.empty() ? "--frame" : "--frames", "got " + std::to_string(frame),
                    "0 to " + std::to_string(last), ErrorKind::usage);
    if (!all)
        last = frame;
    ProgressDisplay progress = ProgressDisplay::for_user(options.quiet);
    RecordingPtr recording = run_scene(std::make_shared<const Scene>(std::move(loaded.scene)),
                                       {thread_count(options.solve), loaded.notes}, progress,
                                       [](const Recording&, const FramePtr&) {});
    if (recording->state() == RunState::cancelled)
        throw_error(options.out, "cancelled, no picture was written");
    return recording;
}

/// Rest and one frame of a folder of a run; the frame is the last.
RecordingPtr read_frames(const RunReader& reader, int frame) {
    auto recording = std::make_shared<Recording>(reader.scene());
    recording->set_attachments(reader.attachments());
    recording->set_fibres(reader.fibres());
    recording->append(reader.read_frame(0));
    if (frame != 0)
        recording->append(reader.read_frame(frame));
    recording->finish(RunState::finished);
    return recording;
}

void write_unless_cancelled(const RenderOptions& options, const Recording& recording,
                            const render::Image& image) {
    if (watch_interrupts())
        throw_error(options.out, "cancelled, no picture was written");
    output::check_no_input(options.out, recording.scene());
    output::write_picture(options.out, image);
}

void draw_viewport(const RenderOptions& options, const output::PictureOptions& picture) {
    const RecordingPtr recording = options.run.empty() ? simulate(options, options.frame, false)
                                                       : read_frames(RunReader(options.run), options.frame);
    output::Pictures pictures(*recording, picture);
    if (options.transparent)
        pictures.set_transparent();
    write_unless_cancelled(options, *recording, pictures.draw(recording->frame_count() - 1));
}

void draw_film(const RenderOptions& options, const output::PictureOptions& picture) {
    FilmOptions film{read_frame_range(options.frames), options.fps, options.transparent, options.out};
    film.kind(); // a wrong name or speed is told before anything is computed
    ProgressDisplay progress = ProgressDisplay::for_user(options.quiet);
    RecordingPtr recording;
    if (!options.run.empty()) {
        recording = RunReader(options.run).read_recording(interruptible());
        if (film.range.last)
            output::place_of_frame(*recording, *film.range.last); // tells when there is no such frame
    } else {
        recording = simulate(options, film.range.last.value_or(film.range.first), !film.range.last);
    }
    write_film(film, recording, picture, progress);
}

/// The editor shows plots over the whole run: all frames are needed.
void draw_editor(const RenderOptions& options, const output::PictureOptions& picture) {
    RecordingPtr recording;
    if (options.run.empty()) {
        recording = simulate(options, options.frame, true);
    } else {
        const RunReader reader(options.run);
        reader.read_frame(options.frame); // tells when there is no such frame
        if (reader.frames().back() + 1 != static_cast<int>(reader.frames().size()))
            throw_error(options.run, "the editor shows a run with all of its frames", "a run without --every",
                        ErrorKind::usage);
        recording = reader.read_recording(interruptible());
    }
    editor::EditorPictureOptions look;
    look.width = picture.width;
    look.height = picture.height;
    look.colouring = picture.colouring;
    write_unless_cancelled(options, *recording,
                           editor::render_editor_picture(recording, options.frame, look));
}

int render(const RenderOptions& options) {
    if (options.out.empty())
        throw_error("render", "no picture to write", "--out FILE.png", ErrorKind::usage);
    if (!options.run.empty() && options.source.given)
        throw_error("render", "got the run '" + options.run + "' and a source", "one of the two",
                    ErrorKind::usage);
    if (options.ui && !options.view.empty())
        throw_error("--view", "cannot go with --ui", "one of the two", ErrorKind::usage);
    if (options.ui && (!options.frames.empty() || options.transparent))
        throw_error(options.transparent ? "--transparent" : "--frames", "cannot go with --ui",
                    "one of the two", ErrorKind::usage);
    const output::PictureOptions picture = picture_options(options);
    if (options.frames.empty() ||
        FilmOptions{{}, options.fps, options.transparent, options.out}.kind() != "frames")
        check_output_file(options.out, options.run, options.source, options.solve);
    watch_interrupts(); // what is being written is finished, or not begun
    if (!options.frames.empty())
        draw_film(options, picture);
    else if (options.ui)
        draw_editor(options, picture);
    else
        draw_viewport(options, picture);
    return 0;
}

} // namespace

std::function<int()> add_render(CLI::App& app) {
    const auto options = std::make_shared<RenderOptions>();
    app.add_option("RUN", options->run, "Folder of a run made with --export vtp; instead of SOURCE");
    add_source_options(app, options->source);
    add_whole(app, "--frame", options->frame, 0, 1000000000, "K", "Frame, 0 is rest (default: 0)");
    add_text(app, "--frames", options->frames, "A:B[:STEP]",
             "Several frames instead: numbered pictures in a folder, a .gif or an .mp4 by the name of --out");
    add_number(app, "--fps", options->fps, "N",
               "Pictures a second of a .gif (at most 50) or .mp4 (default: 25)");
    app.add_flag("--transparent", options->transparent, "No background; for pictures");
    add_text(app, "--size", options->size, "WxH", "Pixels (default: 1280x800)");
    add_text(app, "--out", options->out, "FILE.png", "The picture; with --frames DIR, FILE.gif or FILE.mp4");
    add_choice(app, "--view", options->view, output::standard_view_names(),
               "Side to look from (default: where most muscle is seen)");
    std::vector<std::string> colours;
    for (const view::ColouringRow& row : view::colourings())
        colours.emplace_back(row.key);
    add_choice(app, "--colour", options->colour, colours, "What colours of muscles show (default: anatomy)");
    app.add_flag("--ui", options->ui, "The whole editor instead of the viewport alone");
    add_solve_options(app, options->solve);
    app.add_flag("--quiet", options->quiet, "No progress");
    return [options] { return render(*options); };
}

} // namespace fascicle::app
