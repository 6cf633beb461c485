#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/fibre_template_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "io/mesh_codec.hpp"
#include "io/project_json.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace fascicle::io {
namespace fs = std::filesystem;
namespace {

Points read_points(const JsonFields& entry) {
    const auto list = entry.json().find("points");
    if (list == entry.json().end() || !list->is_array())
        entry.fail("points", "missing", "a list of points");
    Points points;
    for (const Json& p : *list) {
        Vec3 point;
        bool good = p.is_array() && p.size() == 3;
        for (std::size_t k = 0; k < 3 && good; ++k) {
            good = p[k].is_number() && std::isfinite(p[k].get<double>());
            if (good)
                point[static_cast<Eigen::Index>(k)] = p[k].get<double>();
        }
        if (!good)
            entry.fail("points[" + std::to_string(points.size()) + "]", "is no point", "[x, y, z]");
        points.push_back(point);
    }
    return points;
}

/// Polylines that stand in the project itself.
Polylines read_polylines(const JsonFields& entry) {
    Polylines out;
    out.points = read_points(entry);
    const auto lines = entry.json().find("lines");
    if (lines == entry.json().end() || !lines->is_array())
        entry.fail("lines", "missing", "lists of point numbers");
    for (const Json& line : *lines) {
        std::vector<int> numbers;
        for (const Json& v : line) {
            if (!v.is_number_integer() || v.get<long long>() < 0 ||
                v.get<long long>() >= static_cast<long long>(out.points.size()))
                entry.fail("lines", "got a number that is no point",
                           "numbers below " + std::to_string(out.points.size()));
            numbers.push_back(v.get<int>());
        }
        out.lines.push_back(std::move(numbers));
    }
    return out;
}

std::vector<std::string> texts(const JsonFields& entry, const char* key) {
    std::vector<std::string> out;
    const auto list = entry.json().find(key);
    if (list == entry.json().end())
        return out;
    if (!list->is_array())
        entry.fail(key, "is no list", "a list of names");
    for (const Json& item : *list) {
        if (!item.is_string())
            entry.fail(key, "holds what is no name", "a list of names");
        out.push_back(item.get<std::string>());
    }
    return out;
}

} // namespace

AttachmentKind kind_of(const JsonFields& entry) {
    const std::string text = entry.text("kind");
    for (const AttachmentKind kind :
         {AttachmentKind::origin, AttachmentKind::insertion, AttachmentKind::unknown})
        if (text == to_text(kind))
            return kind;
    entry.fail("kind", "got '" + text + "'", "origin, insertion or unknown");
}

ProjectReader::ProjectReader(const JsonFields& fields, const fs::path& file, int threads,
                             const JobControl& control, const LocatedFiles& located)
    : fields_(fields), file_(file), folder_(fs::absolute(file).parent_path()), threads_(threads),
      control_(control), located_(located), version_(fields.integer("fascicle_project", project_version)) {}

void ProjectReader::read(Scene& scene, std::vector<std::string>& notes) {
    notes_ = &notes;
    scene.name = fields_.text("name", file_.stem().string());
    scene.embedded_name = fields_.text("embedded_scene");
    const std::string unit = fields_.text("unit", "mm");
    if (unit != "mm" && unit != "m")
        fields_.fail("unit", "got '" + unit + "'", "mm or m");
    scene.unit = unit == "m" ? LengthUnit::metre : LengthUnit::millimetre;
    if (!scene.embedded_name.empty())
        make_embedded(scene);
    const auto bones = fields_.objects("bones"), muscles = fields_.objects("muscles");
    const auto total = static_cast<double>(bones.size() + muscles.size());
    double done = 0;
    std::set<std::string> names;
    const auto check_name = [&](const JsonFields& entry) {
        control_.checkpoint("read", done++ / total);
        const std::string name = entry.text("name");
        if (name.empty() || !names.insert(name).second)
            entry.fail("name", name.empty() ? "no name" : "'" + name + "' is there twice",
                       "a name of its own");
    };
    for (const JsonFields& entry : bones) {
        check_name(entry);
        scene.bones.push_back(bone(entry));
    }
    for (const JsonFields& entry : muscles) {
        check_name(entry);
        scene.muscles.push_back(muscle(entry, scene));
    }
    if (fields_.has("timeline"))
        timeline(fields_.object("timeline"), scene);
    markers(scene);
    if (fields_.has("motion_file")) { // its poses are in the timeline: it is only said where they came from
        const JsonFields file = fields_.object("motion_file");
        scene.motion_source = {resolved(file).string(), file.text("hash")};
    }
    if (fields_.has("opensim"))
        opensim(fields_.object("opensim"), scene);
    if (fields_.has("line_muscles")) {
        const JsonFields file = fields_.object("line_muscles");
        load_line_muscles(scene, resolved(file), notes);
        compare(file, scene.line_muscles->source);
    }
    const Json none = Json::object();
    parameters(fields_.has("parameters") ? fields_.object("parameters")
                                         : JsonFields(none, file_.string(), "parameters"),
               scene);
}

void ProjectReader::make_embedded(Scene& scene) {
    const auto& all = embedded_scenes();
    if (std::none_of(all.begin(), all.end(),
                     [&](const auto& info) { return info.name == scene.embedded_name; }))
        fields_.fail("embedded_scene", "there is no embedded scene '" + scene.embedded_name + "'",
                     "a name that 'fascicle scenes' lists");
    const Scene made = make_embedded_scene(scene.embedded_name, threads_);
    const auto add = [&](const char* kind, const std::string& name, const EmbeddedThing& thing) {
        embedded_.emplace(mesh_hash(*thing.mesh), thing);
        embedded_.emplace(kind + name, thing);
    };
    for (const Bone& b : made.bones)
        add("bone ", b.name, {b.mesh, nullptr});
    for (const Muscle& m : made.muscles)
        add("muscle ", m.name, {m.mesh, m.surface_fibres});
    if (version_ == 1) // did not write them
        scene.parameters = made.parameters;
    else
        scene.parameters.keep_defaults_of(
            made.parameters); // those of a method other than the one in force are not in the file
}

fs::path ProjectReader::resolved(const JsonFields& entry) const {
    const std::string name = entry.text("path");
    if (name.empty())
        entry.fail("path", "missing", "the path of a file");
    const fs::path path = (folder_ / name).lexically_normal();
    const auto it = located_.find(path);
    return it == located_.end() ? path : it->second;
}

void ProjectReader::compare(const JsonFields& entry, const MeshSource& source) {
    const std::string then = entry.text("hash");
    if (!then.empty() && then != source.hash)
        notes_->push_back(source.path + ": not the file that the project was saved with");
}

const ProjectReader::EmbeddedThing* ProjectReader::embedded_thing(const JsonFields& entry, const char* kind) {
    if (const auto it = embedded_.find(entry.text("embedded")); it != embedded_.end())
        return &it->second;
    const auto it = embedded_.find(kind + entry.text("name"));
    if (it == embedded_.end())
        return nullptr;
    notes_->push_back(entry.text("name") + ": the embedded scene has changed since the project was saved");
    return &it->second;
}

MeshPtr ProjectReader::inner_mesh(const JsonFields& entry, const char* kind,
                                  void (*check)(const MeshReport&, const std::string&)) {
    if (entry.has("mesh")) {
        TriMesh mesh = read_carried_mesh(entry.object("mesh"));
        check(check_mesh(mesh), file_.string() + ", mesh of " + entry.text("name"));
        return std::make_shared<const TriMesh>(std::move(mesh));
    }
    const EmbeddedThing* thing = embedded_thing(entry, kind);
    if (thing == nullptr)
        entry.fail("path", "missing, and no mesh of an embedded scene fits",
                   "the path of a mesh file, or a mesh");
    return thing->mesh;
}

Bone ProjectReader::bone(const JsonFields& entry) {
    Bone out;
    if (entry.has("path")) {
        out = load_bone(resolved(entry), *notes_);
        compare(entry, out.source);
    } else {
        out.mesh = inner_mesh(entry, "bone ", require_bone_surface);
    }
    out.name = entry.text("name");
    return out;
}

Muscle ProjectReader::muscle(const JsonFields& entry, const Scene& scene) {
    Muscle out;
    if (entry.has("path")) {
        out = load_muscle(resolved(entry), *notes_);
        compare(entry, out.source);
    } else {
        out.mesh = inner_mesh(entry, "muscle ", require_muscle_surface);
    }
    out.name = entry.text("name");
    out.attach_automatically = entry.flag("attach_automatically", true);
    out.attach_to = texts(entry, "attach_to");
    outlines(entry, out, scene);
    fibres(entry, out);
    out.attachments = attachments(entry, out, scene);
    out.areas = areas(entry, scene);
    return out;
}

void ProjectReader::outlines(const JsonFields& entry, Muscle& muscle, const Scene& scene) {
    for (const JsonFields& file : entry.objects("outline_files")) {
        Muscle one;
        load_attachments(one, resolved(file), scene.unit);
        compare(file, one.outline_files[0]);
        muscle.outlines.insert(muscle.outlines.end(), one.outlines.begin(), one.outlines.end());
        muscle.outline_files.push_back(one.outline_files[0]);
    }
    for (const JsonFields& item : entry.objects("outlines")) {
        muscle.outlines.push_back({kind_of(item), item.text("bone"), read_points(item), item.text("head"),
                                   item.flag("hole", false)});
    }
}

void ProjectReader::fibres(const JsonFields& entry, Muscle& muscle) {
    if (entry.has("surface_fibres")) {
        const JsonFields file = entry.object("surface_fibres");
        if (file.has("path")) {
            load_surface_fibres(muscle, resolved(file), *notes_);
            compare(file, muscle.surface_fibres_source);
        } else {
            muscle.surface_fibres = std::make_shared<const Polylines>(read_polylines(file));
        }
    } else if (version_ == 1 && !entry.has("path") && !entry.has("mesh")) {
        muscle.surface_fibres = embedded_thing(entry, "muscle ")->fibres; // it did not write them
    }
    if (!entry.has("fibre_template"))
        return;
    const JsonFields file = entry.object("fibre_template");
    if (file.has("path")) {
        load_fibre_template(muscle, resolved(file));
        compare(file, muscle.fibre_template_source);
    } else {
        muscle.fibre_template = std::make_shared<const FibreTemplate>(
            parse_fibre_template(file.object("template").json().dump(), file_.string()));
    }
}

} // namespace fascicle::io
