#include "app/cli/source_options.hpp"

#include "app/cli/options.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/preset_file.hpp"
#include "fascicle/io/user_folder.hpp"
#include "fascicle/solver/soft_body_solver.hpp"

namespace fascicle::app {

namespace {

const int most_threads = 256;
const char* const group = "SOURCE";

using NamedFiles = std::vector<std::pair<std::string, std::filesystem::path>>;

/// An option of SOURCE that hands its text, once per occurrence, to `read`.
void add(CLI::App& app, SourceOptions& options, const std::string& name, const std::string& type,
         const std::string& meaning, bool repeatable, std::function<void(const std::string&)> read) {
    const auto take = [&options, read](const std::string& text) {
        options.given = true;
        read(text);
    };
    add_reader(app, name, type, meaning, repeatable, take)->group(group);
}

std::function<void(const std::string&)> into(std::vector<std::filesystem::path>& paths) {
    return [&paths](const std::string& text) { paths.emplace_back(text); };
}

std::function<void(const std::string&)> into(NamedFiles& files, const std::string& name) {
    return [&files, name](const std::string& text) { files.push_back(parse_named_file(name, text)); };
}

/// A model in place of bones and hinge.
void add_osim_options(CLI::App& app, SourceOptions& options) {
    OsimRequest& osim = options.request.osim;
    const auto seconds = [](const std::string& option, const std::string& text) {
        return read_numbers(option, text, ',', 1, "a number of seconds").front();
    };
    add(app, options, "--osim", "MODEL.osim",
        "OpenSim model whose trial (--motion) moves the bones; --muscle and --bone are then "
        "MESH=BODY[,BODY...]",
        false, [&osim](const std::string& text) { osim.model = text; });
    add(app, options, "--mesh-frame", "body|ground|scan",
        "Where meshes beside a model lie: in their body's frame, in ground, or as scanned; guessed otherwise",
        false, [&osim](const std::string& text) { osim.mesh_frame = parse_mesh_frame(text); });
    add(app, options, "--axes", "MAPPING",
        "Turns a model's axes: opensim_to_lps, ras_to_lps, lps_to_opensim; as_is otherwise", false,
        [&osim](const std::string& text) { osim.axes = parse_axis_mapping(text); });
    add(app, options, "--coordinate", "NAME", "Coordinate of the model that angle_deg is", false,
        [&osim](const std::string& text) { osim.coordinate = text; });
    add(app, options, "--from", "SECONDS", "Where in the trial to begin", false,
        [&osim, seconds](const std::string& text) { osim.reading.from_s = seconds("--from", text); });
    add(app, options, "--to", "SECONDS", "Where in the trial to end", false,
        [&osim, seconds](const std::string& text) { osim.reading.to_s = seconds("--to", text); });
    add(app, options, "--trial-frames", "N", "Frames of the trial (default: its own rate)", false,
        [&osim](const std::string& text) {
            osim.reading.frames = read_whole("--trial-frames", text, 1, 100000);
        });
}

} // namespace

void add_source_options(CLI::App& app, SourceOptions& options) {
    SceneRequest& r = options.request;
    add(app, options, "--scene", "NAME", "Embedded scene, see 'fascicle scenes'", false,
        [&r](const std::string& text) { r.embedded = text; });
    add(app, options, "--project", "FILE.fascicle", "Project saved by the editor", false,
        [&r](const std::string& text) { r.project = text; });
    add(app, options, "--muscle", "MESH", "Muscle surface; again for more", true, into(r.muscles));
    add(app, options, "--bone", "MESH", "Bone that stays; again for more", true, into(r.bones));
    add(app, options, "--moving-bone", "MESH", "Bone that turns about the hinge; again for more", true,
        into(r.moving_bones));
    add(app, options, "--hinge", "CX,CY,CZ;AX,AY,AZ", "Centre and axis of the joint", false,
        [&r](const std::string& text) { r.hinge = parse_hinge(text); });
    add(app, options, "--angle-deg", "A", "Angle that the moving bones turn by, right-hand rule", false,
        [&r](const std::string& text) {
            r.angle_deg = read_numbers("--angle-deg", text, ',', 1, "a number of degrees").front();
        });
    add(app, options, "--phases", "OUT,BACK,REST", "Frames there, back and at rest (100,100,100)", false,
        [&r](const std::string& text) { r.phases = parse_phases(text); });
    add(app, options, "--motion", "FILE",
        "Poses of bones (.csv) instead of a hinge, or a model's trial (.mot, .sto)", false,
        [&r](const std::string& text) { r.motion = text; });
    add_osim_options(app, options);
    add(app, options, "--attachments", "MUSCLE=FILE.csv", "Outlines of origin and insertion", true,
        into(r.attachments, "--attachments"));
    add(app, options, "--surface-fibres", "MUSCLE=FILE", "Superficial fibres as polylines", true,
        into(r.surface_fibres, "--surface-fibres"));
    add(app, options, "--fibre-template", "MUSCLE=FILE.json",
        "A template of your own, instead of fibres.template", true,
        into(r.fibre_templates, "--fibre-template"));
    add(app, options, "--lines", "MODEL.osim", "Line muscles of an OpenSim model, beside the muscles", false,
        [&r](const std::string& text) { r.lines = text; });
    add(app, options, "--units", "mm|m",
        "Length unit of the scene, and of files that say none; told from their size otherwise", false,
        [&r](const std::string& text) { r.unit = parse_unit(text); });
}

void add_solve_options(CLI::App& app, SolveOptions& options) {
    std::vector<std::string> methods;
    for (const SolverMethod& method : solver_methods())
        methods.push_back(method.name);
    const int most_iterations = static_cast<int>(parameter_table().find("solver.iterations")->maximum);
    add_text(
        app, "--preset", options.preset, "NAME|FILE",
        "Named parameter values, see 'fascicle parameters --presets'; options below change them further");
    add_choice(app, "--method", options.method, methods, "How muscles are solved (default: xpbd)");
    add_whole(app, "--iterations", options.iterations, 1, most_iterations, "N",
              "Solver passes a frame, see solver.iterations (default: the method's own)");
    add_whole(app, "--threads", options.threads, 1, most_threads, "N",
              "Threads (default: all); never changes a result");
    add_texts(app, "--set", options.sets, "KEY=VALUE",
              "Any parameter of 'fascicle parameters'; again for more");
}

int thread_count(const SolveOptions& options) {
    return options.threads > 0 ? options.threads : std::min(hardware_threads(), most_threads);
}

void apply(const SolveOptions& options, ParamSet& parameters) {
    if (!options.preset.empty())
        apply_preset(find_preset(options.preset, presets_folder(user_folder())), parameters);
    if (!options.method.empty())
        set_method(parameters, options.method);
    if (options.iterations > 0)
        parameters.set("solver.iterations", options.iterations);
    for (const std::string& text : options.sets) {
        // The method brings defaults of its own: not a value like the others.
        const std::string method_key = "solver.method=";
        if (text.starts_with(method_key))
            set_method(parameters, text.substr(method_key.size()));
        else
            parameters.assign(text);
    }
}

std::vector<std::filesystem::path> input_files(const SourceOptions& source, const SolveOptions& solve) {
    const SceneRequest& r = source.request;
    std::vector<std::filesystem::path> files{r.project, r.motion, r.lines, r.osim.model, solve.preset};
    for (const auto* list : {&r.muscles, &r.bones, &r.moving_bones})
        files.insert(files.end(), list->begin(), list->end());
    for (const auto* list : {&r.attachments, &r.surface_fibres, &r.fibre_templates})
        for (const auto& [name, path] : *list)
            files.push_back(path);
    std::erase(files, std::filesystem::path());
    return files;
}

void check_output_file(const std::filesystem::path& out, const std::string& run, const SourceOptions& source,
                       const SolveOptions& solve) {
    namespace fs = std::filesystem;
    check_output_name(out);
    std::error_code ignored;
    for (const fs::path& input : input_files(source, solve))
        if (fs::equivalent(input, out, ignored))
            throw_error(out.string(), "the output would replace the input", "another name", ErrorKind::usage);
    if (run.empty() || !fs::exists(out, ignored))
        return;
    const fs::path inside = fs::canonical(out, ignored).lexically_relative(fs::canonical(run, ignored));
    const std::string kind = out.extension().string();
    if (!inside.empty() && *inside.begin() != ".." &&
        (kind == ".csv" || kind == ".json" || kind == ".vtp" || kind == ".pvd"))
        throw_error(out.string(), "the output would replace a file of the run", "another name",
                    ErrorKind::usage);
}

LoadedScene load(const SourceOptions& source, const SolveOptions& solve) {
    if (!source.given)
        throw_error({}, "no source",
                    "--scene NAME, --project FILE, --osim MODEL with --motion TRIAL, or --muscle MESH with "
                    "--bone MESH",
                    ErrorKind::usage);
    // A wrong key is told before large files are read.
    ParamSet checked = default_parameters();
    apply(solve, checked);
    SceneRequest request = source.request;
    request.threads = thread_count(solve);
    LoadedScene loaded = load_scene(request);
    if (loaded.scene.muscles.empty())
        throw_error({}, "there is no muscle to simulate", "--muscle MESH", ErrorKind::usage);
    apply(solve, loaded.scene.parameters);
    return loaded;
}

} // namespace fascicle::app
