#include "fascicle/io/load_scene.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/base/param_table.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/base/text.hpp"
#include "fascicle/geometry/bounding_box.hpp"
#include "fascicle/geometry/sphere_fit.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/fibre_template_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/mesh_file.hpp"
#include "fascicle/io/motion_file.hpp"
#include "fascicle/io/project_file.hpp"
#include "fascicle/io/unit_guess.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "io/load_parts.hpp"
#include "io/osim_scene/osim_scene.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <set>

namespace fascicle {
namespace fs = std::filesystem;
namespace {

std::string name_of(const fs::path& path) {
    const std::string name = valid_utf8(path.stem().string()); // what JSON can hold
    if (name.empty())
        throw_error(path.string(), "the file has no name to call the mesh by", "NAME.EXTENSION");
    return name;
}

void say(const fs::path& path, const MeshFile& file, std::vector<std::string>& notes) {
    for (const auto& lines : {file.report.lines(), file.notes})
        for (const std::string& line : lines)
            notes.push_back(path.filename().string() + ": " + line);
    if (is_inside_out(file.report))
        notes.push_back(path.filename().string() + ": " + inside_out_words);
}

[[noreturn]] void fail_usage(const std::string& where, const std::string& what, const std::string& expected) {
    throw_error(where, what, expected, ErrorKind::usage);
}

bool wants_meshes(const SceneRequest& r) {
    return !r.muscles.empty() || !r.bones.empty() || !r.moving_bones.empty();
}

/// Options that describe a scene of meshes mean nothing beside a scene that is whole.
void require_no_mesh_options(const SceneRequest& r, const std::string& source) {
    const std::pair<bool, const char*> given[] = {
        {r.hinge.has_value(), "--hinge"},          {r.angle_deg.has_value(), "--angle-deg"},
        {r.phases.has_value(), "--phases"},        {r.unit.has_value(), "--units"},
        {!r.attachments.empty(), "--attachments"}, {!r.surface_fibres.empty(), "--surface-fibres"}};
    for (const auto& [is, option] : given)
        if (is)
            fail_usage(option, "cannot go with " + source, "it beside --muscle and --bone");
}

void require_one_source(const SceneRequest& r) {
    const bool model = !r.osim.model.empty();
    const int sources =
        (r.embedded.empty() ? 0 : 1) + (r.project.empty() ? 0 : 1) + (model || wants_meshes(r) ? 1 : 0);
    if (sources != 1)
        fail_usage("", sources == 0 ? "no scene is named" : "more than one scene is named",
                   "one of --scene NAME, --project FILE, --osim MODEL with --motion TRIAL, or --muscle MESH "
                   "with --bone MESH");
    if (model)
        return io::check_osim_request(r);
    io::require_no_osim_options(r.osim);
    if (!r.embedded.empty())
        require_no_mesh_options(r, "--scene");
    if (!r.project.empty())
        require_no_mesh_options(r, "--project");
    // A motion file is the whole motion: nothing of a hinge's is left to say.
    const std::pair<bool, const char*> hinge_options[] = {{r.angle_deg.has_value(), "--angle-deg"},
                                                          {r.hinge.has_value(), "--hinge"},
                                                          {r.phases.has_value(), "--phases"}};
    for (const auto& [is, option] : hinge_options)
        if (is && !r.motion.empty())
            fail_usage(option, "cannot go with --motion, which tells every frame", "one of the two");
}

Muscle& muscle_named(Scene& scene, const std::string& option, const std::string& name) {
    const int index = scene.muscle_index(valid_utf8(name));
    if (index < 0) {
        std::string known;
        for (const Muscle& muscle : scene.muscles)
            known += (known.empty() ? "" : ", ") + muscle.name;
        fail_usage(option, "there is no muscle '" + name + "'",
                   known.empty() ? "a --muscle" : "one of " + known);
    }
    return scene.muscles[static_cast<std::size_t>(index)];
}

/// Centre of the ball by which a moving bone sits in the bones that stay; of several moving bones the one whose ball
/// covers most of its sphere.
Vec3 fitted_centre(LoadedScene& loaded, const std::vector<int>& moving) {
    std::vector<MeshPtr> fixed;
    for (int b = 0; b < static_cast<int>(loaded.scene.bones.size()); ++b)
        if (std::count(moving.begin(), moving.end(), b) == 0)
            fixed.push_back(loaded.scene.bones[static_cast<std::size_t>(b)].mesh);
    JointFit best;
    std::string best_name, reason = "no bone stays";
    for (const int b : fixed.empty() ? std::vector<int>{} : moving) {
        const Bone& bone = loaded.scene.bones[static_cast<std::size_t>(b)];
        const JointFit fit = fit_joint_centre(*bone.mesh, fixed);
        if (fit.sphere && (!best.sphere || fit.coverage > best.coverage)) {
            best = fit;
            best_name = bone.name;
        } else if (!fit.sphere) {
            reason = bone.name + ": " + fit.reason;
        }
    }
    if (!best.sphere)
        fail_usage("--hinge", "no joint centre can be fitted (" + reason + ")",
                   "--hinge \"cx,cy,cz;ax,ay,az\"");
    const Vec3& c = best.sphere->centre;
    const auto rounded = [](double x) { return number_text(std::round(x * 1000.0) / 1000.0); };
    loaded.notes.push_back("joint centre fitted to " +
                           std::string(best.ball_on_moving_bone ? "the ball of " : "the socket of ") +
                           best_name + ": (" + rounded(c.x()) + ", " + rounded(c.y()) + ", " +
                           rounded(c.z()) + "), radius " + rounded(best.sphere->radius) + ' ' +
                           to_text(loaded.scene.unit) + ", rms error " + rounded(best.rms));
    return c;
}

void set_motion(LoadedScene& loaded, const SceneRequest& r) {
    Scene& scene = loaded.scene;
    const int fixed = static_cast<int>(r.bones.size());
    std::vector<int> moving;
    for (int i = 0; i < static_cast<int>(r.moving_bones.size()); ++i)
        moving.push_back(fixed + i);
    const double angle_deg = r.angle_deg.value_or(0.0);
    if (moving.empty()) {
        if (angle_deg != 0.0)
            fail_usage("--angle-deg", "there is no bone to turn", "--moving-bone MESH");
        if (r.hinge)
            fail_usage("--hinge", "there is no bone to turn", "--moving-bone MESH");
    }
    const HingeRequest wanted = r.hinge.value_or(HingeRequest{});
    Hinge hinge;
    hinge.axis = wanted.axis;
    if (wanted.centre)
        hinge.centre = *wanted.centre;
    else if (!moving.empty())
        hinge.centre = fitted_centre(loaded, moving);
    scene.timeline =
        make_hinge_timeline(hinge, angle_deg * std::numbers::pi / 180.0, r.phases.value_or(Phases{}),
                            static_cast<int>(scene.bones.size()), moving);
    if (moving.empty())
        scene.timeline.hinge.reset();
    else if (angle_deg == 0.0)
        loaded.notes.push_back("no bone moves: --angle-deg was not given or is 0");
}

/// The scene's unit; meshes of files that state another one are converted.
void settle_units(LoadedScene& loaded, const SceneRequest& r) {
    Scene& scene = loaded.scene;
    std::vector<MeshPtr*> meshes;
    std::vector<MeshSource*> sources;
    for (Bone& bone : scene.bones) {
        meshes.push_back(&bone.mesh);
        sources.push_back(&bone.source);
    }
    for (Muscle& muscle : scene.muscles) {
        meshes.push_back(&muscle.mesh);
        sources.push_back(&muscle.source);
    }
    io::settle_units(meshes, sources, r.unit, scene.unit, loaded.notes);
}

LoadedScene load_meshes(const SceneRequest& r, const JobControl& control) {
    LoadedScene loaded;
    Scene& scene = loaded.scene;
    const std::size_t bones = r.bones.size() + r.moving_bones.size(), meshes = bones + r.muscles.size();
    const double total = static_cast<double>(meshes + r.attachments.size() + r.surface_fibres.size());
    double done = 0;
    const auto step = [&] { control.checkpoint("read", done++ / total); };
    // All meshes at once; what is said, and which error counts, is as if they came one after the other.
    scene.bones.resize(bones);
    scene.muscles.resize(r.muscles.size());
    std::vector<std::vector<std::string>> notes(meshes);
    std::vector<std::exception_ptr> errors(meshes);
    control.checkpoint("read", 0.0);
    parallel_for(r.threads, meshes, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            try {
                if (control.cancelled())
                    throw Cancelled();
                if (i >= bones)
                    scene.muscles[i - bones] = load_muscle(r.muscles[i - bones], notes[i]);
                else
                    scene.bones[i] = load_bone(
                        i < r.bones.size() ? r.bones[i] : r.moving_bones[i - r.bones.size()], notes[i]);
            } catch (...) {
                errors[i] = std::current_exception();
            }
    });
    for (std::size_t i = 0; i < meshes; ++i) {
        if (errors[i])
            std::rethrow_exception(errors[i]);
        loaded.notes.insert(loaded.notes.end(), notes[i].begin(), notes[i].end());
        step();
    }
    io::require_unique_names(scene);
    scene.name = scene.muscles.empty() ? scene.bones[0].name : scene.muscles[0].name;
    settle_units(loaded, r);
    io::load_muscle_files(scene, r, step, loaded.notes);
    if (r.motion.empty())
        set_motion(loaded, r);
    return loaded;
}

} // namespace

void io::load_muscle_files(Scene& scene, const SceneRequest& r, const std::function<void()>& step,
                           std::vector<std::string>& notes) {
    for (const auto& [name, path] : r.attachments) {
        step();
        load_attachments(muscle_named(scene, "--attachments", name), path, scene.unit);
    }
    for (const auto& [name, path] : r.surface_fibres) {
        step();
        Muscle& muscle = muscle_named(scene, "--surface-fibres", name);
        load_surface_fibres(muscle, path, notes);
        settle_fibre_unit(muscle, scene.unit, notes);
    }
}

void io::require_unique_names(const Scene& scene) {
    std::set<std::string> names;
    const auto check = [&](const std::string& name) {
        if (!names.insert(name).second)
            fail_usage(name, "two meshes have this name", "files of different names (without extension)");
    };
    for (const Bone& bone : scene.bones)
        check(bone.name);
    for (const Muscle& muscle : scene.muscles)
        check(muscle.name);
}

namespace {

LoadedScene load_source(const SceneRequest& request, const JobControl& control) {
    if (!request.embedded.empty()) {
        control.checkpoint("make the scene", 0.0);
        return {make_embedded_scene(request.embedded, request.threads), {}};
    }
    if (!request.project.empty()) {
        Project project = read_project_file(request.project, request.threads, control);
        return {std::move(project.scene), std::move(project.notes)};
    }
    return request.osim.model.empty() ? load_meshes(request, control) : io::load_osim_scene(request, control);
}

} // namespace

LoadedScene load_scene(const SceneRequest& request, const JobControl& control) {
    require_one_source(request);
    LoadedScene loaded = load_source(request, control);
    // Part of the program: nobody owns them, and nothing is read.
    loaded.scene.fibre_templates = std::shared_ptr<const std::vector<FibreTemplate>>(
        std::shared_ptr<void>(), &built_in_fibre_templates());
    for (const auto& [name, path] : request.fibre_templates) {
        Muscle& muscle = muscle_named(loaded.scene, "--fibre-template", name);
        load_fibre_template(muscle, path);
    }
    if (!request.motion.empty() && loaded.scene.model_motion == nullptr)
        load_motion(loaded.scene, request.motion, loaded.notes);
    if (!request.lines.empty()) // after the motion: what a note says of the joint counts for it
        load_line_muscles(loaded.scene, request.lines, loaded.notes);
    return loaded;
}

Bone load_bone(const fs::path& path, std::vector<std::string>& notes) {
    MeshFile file = read_mesh_file(path);
    require_bone_surface(file.report, path.string());
    say(path, file, notes);
    return {name_of(path), std::make_shared<const TriMesh>(std::move(file.mesh)), {path.string(), file.hash}};
}

Muscle load_muscle(const fs::path& path, std::vector<std::string>& notes) {
    MeshFile file = read_mesh_file(path);
    require_muscle_surface(file.report, path.string());
    say(path, file, notes);
    Muscle muscle;
    muscle.name = name_of(path);
    muscle.mesh = std::make_shared<const TriMesh>(std::move(file.mesh));
    muscle.source = {path.string(), file.hash};
    return muscle;
}

void load_attachments(Muscle& muscle, const fs::path& path, LengthUnit unit) {
    const std::string bytes = read_file(path);
    std::vector<AttachmentOutline> outlines = read_attachments(bytes, path.string(), unit);
    StateHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    muscle.outlines = std::move(outlines);
    muscle.outline_files = {{path.string(), hash.hex()}};
}

void load_surface_fibres(Muscle& muscle, const fs::path& path, std::vector<std::string>& notes) {
    const MeshFile file = read_mesh_file(path);
    if (file.lines.lines.empty())
        throw_error(path.string(), "the file holds no lines", "polylines of superficial fibres");
    say(path, file, notes);
    muscle.surface_fibres = std::make_shared<const Polylines>(joined_lines(file.lines));
    muscle.surface_fibres_source = {path.string(), file.hash};
}

void load_motion(Scene& scene, const fs::path& path, std::vector<std::string>& notes) {
    const std::string bytes = read_file(path);
    scene.timeline = read_motion(bytes, path.string(), scene);
    StateHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    scene.motion_source = {path.string(), hash.hex()};
    std::string moving;
    for (std::size_t b = 0; b < scene.bones.size(); ++b)
        if (scene.timeline.bone_tracks[b].moves())
            moving += (moving.empty() ? "" : ", ") + scene.bones[b].name;
    notes.push_back(path.filename().string() + ": moves " + (moving.empty() ? "no bone" : moving) + ", " +
                    std::to_string(scene.timeline.last_frame) + " frames");
}

void load_fibre_template(Muscle& muscle, const fs::path& path) {
    const std::string bytes = read_file(path);
    StateHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    muscle.fibre_template = std::make_shared<const FibreTemplate>(parse_fibre_template(bytes, path.string()));
    muscle.fibre_template_source = {path.string(), hash.hex()};
}

double scene_diagonal(const Scene& scene) {
    BoundingBox box;
    for (const Bone& bone : scene.bones)
        box.add(bounding_box(bone.mesh->positions, bone.mesh->triangles));
    for (const Muscle& muscle : scene.muscles)
        box.add(bounding_box(muscle.mesh->positions, muscle.mesh->triangles));
    return box.diagonal();
}

} // namespace fascicle
