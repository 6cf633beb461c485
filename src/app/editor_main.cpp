// fascicle-editor: opens a window on a scene.

#include "app/cli/options.hpp"
#include "app/cli/source_options.hpp"
#include "app/cli/standard_streams.hpp"
#include "app/item_file.hpp"
#include "app/window.hpp"
#include "editor/editor.hpp"
#include "editor/features.hpp"
#include "editor/measure.hpp"
#include "editor/project/project_flow.hpp"
#include "editor/screens.hpp"
#include "fascicle/base/build_info.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/png.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/io/user_folder.hpp"
#include "render/gl_functions.hpp"
#include "render/imgui_renderer.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <imgui.h>
#include <iostream>
#include <thread>

namespace fascicle::app {

namespace {

struct EditorCommandLine {
    std::string file; ///< a project
    SourceOptions source;
    SolveOptions solve;
    double scale = 0; ///< 0: the monitor's
    int quit_after = 0;
    bool start = false; ///< the start page first
    bool measure = false;
    std::string items;   ///< file for the places of widgets, for tests
    std::string screens; ///< folder to write pictures of the screens into
    std::vector<std::string> only;
    std::string screen_size = "1280x800";
    bool light = false;
};

constexpr double awake_seconds = 0.8, asleep_seconds = 1.0, text_cursor_seconds = 0.25;

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// "hip.fascicle * - fascicle".
std::string title_of(const Document& document) {
    const std::string name =
        document.path().empty() ? document.scene().name : document.path().filename().string();
    return name + (document.dirty() ? " *" : "") + " - fascicle";
}

/// What is opened at the start, and what happens once the window is there.
struct Beginning {
    LoadedScene loaded;
    std::filesystem::path project; ///< where it came from
    std::string project_text;
    bool show_start = false, locate = false; ///< locate: the project's files are asked for
};

Beginning load_scene_to_edit(EditorCommandLine& options) {
    if (!options.file.empty()) {
        if (options.source.given)
            throw_error("fascicle-editor", "got the file '" + options.file + "' and a source",
                        "one of the two", ErrorKind::usage);
        options.source.request.project = options.file;
        options.source.given = true;
    }
    Beginning begin;
    begin.project = options.source.request.project;
    if (!options.source.given) {
        begin.loaded.scene = editor::empty_scene();
        begin.show_start = true;
        return begin;
    }
    begin.locate = !begin.project.empty() && !missing_project_files(begin.project).empty();
    if (begin.locate) {
        begin.loaded.scene = editor::empty_scene();
        begin.show_start = true;
        return begin;
    }
    if (begin.project.empty()) {
        begin.loaded = load(options.source, options.solve);
    } else { // may be half done: without muscles it can be edited all the same
        begin.loaded = load_scene(options.source.request);
        apply(options.solve, begin.loaded.scene.parameters);
    }
    begin.show_start = options.start;
    if (!begin.project.empty())
        begin.project_text = read_file(begin.project);
    return begin;
}

/// One picture after the other; sleeps while nothing changes.
void run_window(Window& window, editor::Editor& program, render::ImguiRenderer& renderer, int quit_after,
                ItemFile& items) {
    bool full_screen = false;
    double last = seconds_now(), last_activity = last;
    std::string title;
    for (int frame = 0; !program.state().wants_quit; ++frame) {
        if (quit_after > 0 && frame >= quit_after)
            break;
        const bool closing = window.wants_close();
        if (closing) { // asks first when something would be lost
            window.refuse_close();
            program.run(editor::Command::quit);
            if (program.state().wants_quit)
                break;
        }
        if (std::string now = title_of(program.document()); now != title)
            window.set_title(title = std::move(now));
        std::optional<double> next = quit_after > 0 ? 0 : program.next_redraw();
        if (ImGui::GetIO().WantTextInput)
            next = std::min(next.value_or(1), text_cursor_seconds);
        // After the last move of the hand tooltips may still come.
        if (seconds_now() - last_activity < awake_seconds)
            next = std::min(next.value_or(1), 1.0 / 30);
        const double pause = next ? last + *next - seconds_now() : asleep_seconds;
        const bool happened = pause > 0 ? window.wait(pause) : (window.poll(), false);
        if (!happened && !next && !closing)
            continue;
        if (window.take_activity())
            last_activity = seconds_now();
        int width = 0, height = 0;
        window.framebuffer_size(width, height);
        if (width < 1 || height < 1) { // minimised
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            continue;
        }
        const double now = seconds_now();
        program.apply_look();
        renderer.new_frame();
        program.draw_frame(static_cast<float>(width), static_cast<float>(height), now - last);
        last = now;
        render::gl::BindFramebuffer(GL_FRAMEBUFFER, 0);
        render::gl::Viewport(0, 0, width, height);
        renderer.draw(ImGui::GetDrawData());
        items.write();
        window.update_cursor();
        window.swap();
        if (full_screen != program.state().wants_full_screen) {
            full_screen = program.state().wants_full_screen;
            window.set_full_screen(full_screen);
        }
    }
}

int write_screens(const EditorCommandLine& options) {
    editor::ScreenOptions wanted;
    char more = 0;
    if (std::sscanf(options.screen_size.c_str(), "%dx%d%c", &wanted.width, &wanted.height, &more) != 2 ||
        wanted.width < 64 || wanted.height < 64 || wanted.width > 8192 || wanted.height > 8192)
        throw_error("--size", "got '" + options.screen_size + "'", "WIDTHxHEIGHT, 64 to 8192 each",
                    ErrorKind::usage);
    wanted.scale = options.scale > 0 ? static_cast<float>(options.scale) : 1;
    wanted.dark = !options.light;
    wanted.only = options.only;
    for (const editor::ScreenPicture& picture : editor::draw_screens(wanted)) {
        const std::filesystem::path file =
            std::filesystem::path(options.screens) / (std::string(picture.row->id) + ".png");
        write_png(file, picture.image.width, picture.image.height, picture.image.rgba.data());
        std::cout << file.string() << "\n";
    }
    return 0;
}

int run_editor(EditorCommandLine& options) {
    Beginning begin = load_scene_to_edit(options);
    Document document(std::move(begin.loaded.scene), begin.locate ? std::filesystem::path() : begin.project);
    Window window(1360, 860, title_of(document));
    render::load_gl_functions(window.lookup());
    const double scale = options.scale > 0 ? options.scale : double(window.content_scale());
    render::ImguiHost host(static_cast<float>(scale));
    render::ImguiRenderer renderer;
    editor::Editor program(host, std::move(document), editor::simulate_on_thread(options.solve.threads),
                           {.user_folder = user_folder()});
    for (const std::string& note : begin.loaded.notes)
        program.log().add(editor::Severity::note, note);
    program.use_gl();
    program.project_opened(begin.project_text);
    if (begin.locate)
        program.features().opener.open_project(begin.project);
    program.state().show_start = begin.show_start;
    program.state().playback.playing = !begin.show_start; // the first run is watched as it comes
    window.connect(program.input(),
                   [&](std::vector<std::filesystem::path> files) { program.drop_files(files); });
    ItemFile items(options.items);
    run_window(window, program, renderer, options.quit_after, items);
    return 0;
}

int parse_and_run(int argc, char** argv) {
    CLI::App app("The editor of fascicle: skeletal muscles that deform around moving bones.",
                 "fascicle-editor");
    EditorCommandLine options;
    app.set_version_flag("--version", std::string("fascicle-editor ") + program_version());
    app.add_option("FILE", options.file,
                   "A project (.fascicle); instead of a source. Without any: the start page");
    add_source_options(app, options.source);
    add_solve_options(app, options.solve);
    app.add_flag("--start", options.start, "Shows the start page first, whatever is opened");
    add_number(app, "--scale", options.scale, "S",
               "Size of text and controls, 0.75 to 3 (default: the monitor's)");
    add_whole(app, "--quit-after", options.quit_after, 1, 1000000000, "N",
              "Closes after N pictures; for tests");
    app.add_option("--write-items", options.items,
                   "Writes names and places of the widgets into this file when they change; for tests");
    app.add_option("--screens", options.screens,
                   "Draws the main screens into this folder as PNG and ends; needs no display");
    app.add_option("--only", options.only, "Of --screens: these alone, by name");
    app.add_option("--size", options.screen_size, "Of --screens: WIDTHxHEIGHT in pixels (default 1280x800)");
    app.add_flag("--light", options.light, "Of --screens: the light theme");
    app.add_flag(
        "--measure", options.measure,
        "Prints what the editor's own work costs a frame, idle and while painting; needs no display");
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const CLI::CallForVersion& version) {
        return app.exit(version);
    } catch (const CLI::ParseError& error) {
        throw_error("fascicle-editor", error.what(), {}, ErrorKind::usage);
    }
    if (app.count("--scale") > 0 && !(options.scale >= 0.75 && options.scale <= 3))
        throw_error("--scale", "got " + number_text(options.scale), "0.75 to 3", ErrorKind::usage);
    if (!options.screens.empty())
        return write_screens(options);
    if (options.measure) {
        std::cout << editor::to_text(editor::measure_editor());
        return 0;
    }
    return run_editor(options);
}

} // namespace

} // namespace fascicle::app

int main(int argc, char** argv) {
    try {
        fascicle::app::secure_standard_streams();
        fascicle::report_file_size_limit();
        return fascicle::app::parse_and_run(argc, argv);
    } catch (const fascicle::Error& error) {
        std::cerr << "fascicle-editor: " << error.what() << "\n";
        return static_cast<int>(error.kind());
    } catch (const std::exception& error) {
        std::cerr << "fascicle-editor: " << error.what() << "\n";
        return 1;
    }
}
