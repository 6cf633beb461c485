// fascicle export RUN|FILE --as KEY --out TARGET: a run that is in a folder, or an animation of another program, in another form.

#include "app/cli/command.hpp"
#include "app/cli/frame_range.hpp"
#include "app/cli/options.hpp"
#include "app/cli/run_exports.hpp"
#include "app/cli/run_scene.hpp"
#include "app/cli/source_options.hpp"
#include "fascicle/base/interrupt.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/suggest.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/io/mesh_units.hpp"
#include "fascicle/io/run_reader.hpp"
#include "fascicle/io/unit_guess.hpp"
#include "output/animation_export.hpp"

#include <iostream>

namespace fascicle::app {

namespace {

namespace fs = std::filesystem;

struct ExportCommand {
    std::string in, kind, out, units, frames;
    ExportOptions options;
    bool quiet = false;
};

std::vector<std::string> data_kinds() {
    std::vector<std::string> keys;
    for (const output::ExportKindRow& row : output::export_kinds())
        if (!row.traits.draws)
            keys.emplace_back(row.key);
    return keys;
}

/// By --as, or by the extension of --out where one kind alone has it.
const output::ExportKindRow& kind_of(const ExportCommand& command) {
    const std::vector<std::string> known = data_kinds();
    std::string list;
    for (const std::string& key : known)
        list += (list.empty() ? "" : ", ") + key;
    if (command.kind.empty()) {
        const std::string extension = fs::path(command.out).extension().string();
        for (const output::ExportKindRow& row : output::export_kinds())
            if (!row.traits.draws && *row.extension != 0 && extension == row.extension)
                return row;
        throw_error("export", "the name '" + command.out + "' does not tell what to write",
                    "--as one of " + list, ErrorKind::usage);
    }
    const output::ExportKindRow* row = output::find_export_kind(command.kind);
    if (row != nullptr && row->traits.draws)
        throw_error("--as", "'" + command.kind + "' is drawn", "fascicle render or fascicle report",
                    ErrorKind::usage);
    if (row == nullptr)
        throw_error("--as", "got '" + command.kind + "'" + did_you_mean(command.kind, known),
                    "one of " + list, ErrorKind::usage);
    return *row;
}

/// Of an animation that was read: the frames of the range that it has.
Animation chosen(Animation animation, const FrameRange& range, const std::string& file) {
    std::vector<std::size_t> places;
    const int last = range.last.value_or(animation.frames.back());
    for (std::size_t k = 0; k < animation.frame_count(); ++k)
        if (const int frame = animation.frames[k]; frame >= range.first && frame <= last &&
                                                   ((frame - range.first) % range.step == 0 || frame == last))
            places.push_back(k);
    if (places.empty())
        throw_error("--frames", file + " has none of them",
                    std::to_string(animation.frames.front()) + " to " +
                        std::to_string(animation.frames.back()),
                    ErrorKind::usage);
    Animation out = animation;
    out.frames.clear();
    out.seconds.clear();
    for (const std::size_t k : places) {
        out.frames.push_back(animation.frames[k]);
        out.seconds.push_back(animation.seconds[k]);
    }
    for (AnimatedBody& body : out.bodies) {
        std::vector<Pose> poses;
        if (!body.poses.empty())
            for (const std::size_t k : places)
                poses.push_back(body.poses[k]);
        body.poses = std::move(poses);
        if (body.points != nullptr)
            body.points = [from = body.points, places](std::size_t k, Points& points) {
                from(places[k], points);
            };
        if (body.poses.empty())
            body.points(0, body.rest);
    }
    return out;
}

/// The unit of an animation that was read: --units, else what the file says, else, where the format must say one, a guess by the size of
/// the first frame. A guess and a contradiction are told, also with --quiet.
void settle_unit(Animation& animation, const ExportCommand& command, const std::string& kind) {
    double& said = animation.millimetres_per_unit;
    if (!command.units.empty()) {
        const double wanted = command.units == "mm" ? 1 : 1000;
        if (said > 0 && said != wanted)
            std::cerr << "note: " << one_line(command.in) << " says " << unit_words(said) << "; --units "
                      << command.units << " counts\n";
        said = wanted;
        return;
    }
    const bool must_say = kind == "glb" || kind == "usda"; // others can leave it out, and do
    if (said > 0 || !must_say)
        return;
    BoundingBox box;
    for (const AnimatedBody& body : animation.bodies)
        for (const Vec3& p : body.rest)
            box.add(p);
    const UnitGuess guess = guess_length_unit(box.diagonal());
    said = millimetres_per_unit(guess.unit);
    std::cerr << "note: " << guess.sentence() << '\n';
}

/// An export never changes the run that it reads.
void check_not_in_run(const fs::path& run, const output::ExportKindRow& row, const fs::path& target) {
    if (!row.traits.folder) {
        check_output_file(target, run.string(), {}, {});
        if (std::string_view(row.key) == "metrics") { // what was run goes into a .json beside it
            fs::path facts = target;
            check_output_file(facts.replace_extension(".json"), run.string(), {}, {});
        }
        return;
    }
    std::error_code ignored;
    const fs::path inside =
        fs::weakly_canonical(target, ignored).lexically_relative(fs::canonical(run, ignored));
    const std::string first = inside.empty() ? ".." : inside.begin()->string();
    for (const char* own : {".", "", "frames", "fibres", "bones"})
        if (first == own)
            throw_error(target.string(), "the output would change the run that is read", "another folder",
                        ErrorKind::usage);
}

int run(const ExportCommand& command) {
    if (command.in.empty() || command.out.empty())
        throw_error("export", "needs a run and a target", "export RUN --as KEY --out TARGET",
                    ErrorKind::usage);
    const output::ExportKindRow& row = kind_of(command);
    if (!command.frames.empty() && !row.traits.frames && !row.traits.one)
        throw_error("--frames", "'" + std::string(row.key) + "' has all frames of the run",
                    "it with a kind that has a choice, such as meshes", ErrorKind::usage);
    const FrameRange range = read_frame_range(command.frames.empty() ? "0:" : command.frames);
    output::ExportRequest request;
    request.kind = row.key;
    request.target = output::with_extension(command.out, row.key);
    request.frame = request.first = range.first;
    request.step = range.step;
    request.morph_targets = command.options.morph_targets;
    request.up = command.options.up.empty() ? 'z' : command.options.up[0];
    request.threads = hardware_threads();
    if (is_run_folder(command.in)) { // before anything is read
        check_not_in_run(command.in, row, request.target);
    } else if (!row.traits.folder) {
        SourceOptions source;
        source.request.motion = command.in;
        check_output_file(request.target, "", source, {});
    }
    if (!command.units.empty() && is_run_folder(command.in))
        throw_error("--units", "a run says its unit itself", "it with an animation of another program",
                    ErrorKind::usage);
    std::vector<std::string> told;
    ProgressDisplay progress = ProgressDisplay::for_user(command.quiet);
    if (is_run_folder(command.in)) {
        JobControl control;
        control.cancel = &watch_interrupts();
        const RecordingPtr recording = RunReader(command.in).read_recording(control);
        request.last = range.last.value_or(recording->last_frame()->index);
        if (row.reason_against != nullptr)
            if (const std::string reason = row.reason_against(*recording); !reason.empty())
                throw_error(command.in, reason);
        told = write_export(request, recording, progress);
    } else {
        if (find_animation_format(row.key) == nullptr)
            throw_error(command.in, "'" + std::string(row.key) + "' needs a run",
                        "the folder of a run, with its summary.json", ErrorKind::usage);
        Animation animation = chosen(read_animation(command.in), range, command.in);
        settle_unit(animation, command, row.key);
        if (!command.options.up.empty())
            animation.up = command.options.up[0];
        for (const std::string& note : animation.notes)
            if (!command.quiet)
                std::cout << "note: " << one_line(note) << '\n';
        JobControl control;
        control.cancel = &watch_interrupts();
        control.report = [&](std::string_view stage, double fraction) {
            progress.update({std::string(stage), fraction, 0, 0}, steady_seconds());
        };
        try {
            output::export_animation(request, animation, command.in, control);
        } catch (const Cancelled&) {
            progress.finish();
            throw_error(request.target.string(), "cancelled, nothing was written");
        }
        progress.finish();
    }
    for (const std::string& sentence : told)
        if (!command.quiet)
            std::cout << one_line(sentence) << '\n';
    if (!command.quiet)
        std::cout << "written to " << one_line(request.target.string()) << '\n';
    return 0;
}

} // namespace

std::function<int()> add_export(CLI::App& app) {
    const auto command = std::make_shared<ExportCommand>();
    app.add_option("RUN", command->in,
                   "Folder of a run made with --export vtp; or an animation: .glb, .usda, .pc2, .mdd, .pvd, "
                   "one OBJ of a series");
    std::string keys;
    for (const std::string& key : data_kinds())
        keys += (keys.empty() ? "" : ", ") + key;
    add_text(app, "--as", command->kind, "KEY",
             "What to write: " + keys + " (default: by the extension of --out)");
    add_text(app, "--out", command->out, "TARGET", "File, or folder for what has many files");
    add_text(app, "--frames", command->frames, "A:B[:STEP]",
             "Frames, where the kind has a choice; B may be left out (default: all); of mesh the first");
    add_choice(app, "--units", command->units, {"mm", "m"},
               "Unit of an animation (default: what the file says, else guessed from its size)");
    add_export_options(app, command->options);
    app.add_flag("--quiet", command->quiet, "No progress");
    return [command] { return run(*command); };
}

} // namespace fascicle::app
