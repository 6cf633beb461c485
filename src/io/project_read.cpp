#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/attachment_file.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "io/project_json.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <set>

namespace fascicle::io {
namespace fs = std::filesystem;
namespace {

AttachmentKind kind_of(const JsonFields& entry) {
    const std::string text = entry.text("kind");
    for (const AttachmentKind kind :
         {AttachmentKind::origin, AttachmentKind::insertion, AttachmentKind::unknown})
        if (text == to_text(kind))
            return kind;
    entry.fail("kind", "got '" + text + "'", "origin, insertion or unknown");
}

template <typename Key, typename Add>
void read_keys(const std::vector<JsonFields>& entries, std::vector<Key>& keys, Add add) {
    for (const JsonFields& entry : entries) {
        Key key;
        key.frame = entry.number("frame", 0.0);
        if (!keys.empty() && key.frame <= keys.back().frame)
            entry.fail("frame", "keys are not in ascending order", "ascending frames");
        add(entry, key);
        keys.push_back(key);
    }
}

} // namespace

void ProjectReader::read(Scene& scene, std::vector<std::string>& notes) {
    notes_ = &notes;
    scene.name = fields_.text("name", file_.stem().string());
    scene.embedded_name = fields_.text("embedded_scene");
    const std::string unit = fields_.text("unit", "mm");
    if (unit != "mm" && unit != "m")
        fields_.fail("unit", "got '" + unit + "'", "mm or m");
    scene.unit = unit == "m" ? LengthUnit::metre : LengthUnit::millimetre;
    if (!scene.embedded_name.empty()) {
        const Scene made = make_embedded_scene(scene.embedded_name, threads_);
        for (const Bone& b : made.bones) {
            embedded_.emplace(mesh_hash(*b.mesh), b.mesh);
            embedded_.emplace("bone " + b.name, b.mesh);
        }
        for (const Muscle& m : made.muscles) {
            embedded_.emplace(mesh_hash(*m.mesh), m.mesh);
            embedded_.emplace("muscle " + m.name, m.mesh);
        }
    }
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
    if (fields_.has("line_muscles")) {
        const JsonFields file = fields_.object("line_muscles");
        load_line_muscles(scene, resolved(file), notes);
        compare(file, scene.line_muscles->source);
    }
    if (fields_.has("parameters"))
        parameters(fields_.object("parameters"), scene);
}

fs::path ProjectReader::resolved(const JsonFields& entry) const {
    return (file_.parent_path() / entry.text("path")).lexically_normal();
}

void ProjectReader::compare(const JsonFields& entry, const MeshSource& source) {
    const std::string then = entry.text("hash");
    if (!then.empty() && then != source.hash)
        notes_->push_back(source.path + ": not the file that the project was saved with");
}

MeshPtr ProjectReader::embedded_mesh(const JsonFields& entry) const {
    const auto it = embedded_.find(entry.text("embedded"));
    return it == embedded_.end() ? nullptr : it->second;
}

Bone ProjectReader::bone(const JsonFields& entry) {
    Bone out;
    if (entry.has("path")) {
        out = load_bone(resolved(entry), *notes_);
        compare(entry, out.source);
    } else {
        out.mesh = embedded_mesh(entry);
        if (const auto it = embedded_.find("bone " + entry.text("name"));
            !out.mesh && it != embedded_.end()) {
            out.mesh = it->second;
            notes_->push_back(entry.text("name") +
                              ": the embedded scene has changed since the project was saved");
        }
    }
    if (!out.mesh)
        entry.fail("path", "missing, and no mesh of an embedded scene fits", "the path of a mesh file");
    out.name = entry.text("name");
    return out;
}

Muscle ProjectReader::muscle(const JsonFields& entry, const Scene& scene) {
    Muscle out;
    if (entry.has("path")) {
        out = load_muscle(resolved(entry), *notes_);
        compare(entry, out.source);
    } else {
        out.mesh = embedded_mesh(entry);
        if (const auto it = embedded_.find("muscle " + entry.text("name"));
            !out.mesh && it != embedded_.end()) {
            out.mesh = it->second;
            notes_->push_back(entry.text("name") +
                              ": the embedded scene has changed since the project was saved");
        }
    }
    if (!out.mesh)
        entry.fail("path", "missing, and no mesh of an embedded scene fits", "the path of a mesh file");
    out.name = entry.text("name");
    out.attach_automatically = entry.flag("attach_automatically", true);
    for (const JsonFields& file : entry.objects("outline_files")) {
        Muscle one;
        load_attachments(one, resolved(file), scene.unit);
        compare(file, one.outline_files[0]);
        out.outlines.insert(out.outlines.end(), one.outlines.begin(), one.outlines.end());
        out.outline_files.push_back(one.outline_files[0]);
    }
    for (const JsonFields& item : entry.objects("outlines")) {
        AttachmentOutline outline{
            kind_of(item), item.text("bone"), {}, item.text("head"), item.flag("hole", false)};
        const auto points = item.json().find("points");
        if (points == item.json().end() || !points->is_array())
            item.fail("points", "missing", "a list of points");
        for (const Json& p : *points) {
            const Json wrapped{{"p", p}};
            outline.points.push_back(JsonFields(wrapped, file_.string(), "outlines.points").vector("p"));
        }
        out.outlines.push_back(std::move(outline));
    }
    if (entry.has("surface_fibres")) {
        const JsonFields file = entry.object("surface_fibres");
        load_surface_fibres(out, resolved(file), *notes_);
        compare(file, out.surface_fibres_source);
    }
    if (entry.has("fibre_template")) {
        const JsonFields file = entry.object("fibre_template");
        load_fibre_template(out, resolved(file));
        compare(file, out.fibre_template_source);
    }
    out.attachments = attachments(entry, out, scene);
    out.areas = areas(entry, scene);
    return out;
}

std::vector<Attachment> ProjectReader::attachments(const JsonFields& entry, const Muscle& muscle,
                                                   const Scene& scene) {
    std::vector<Attachment> out;
    for (const JsonFields& item : entry.objects("attachments")) {
        Attachment a;
        a.kind = kind_of(item);
        const std::string bone_name = item.text("bone");
        a.bone = scene.bone_index(bone_name);
        if (a.bone < 0)
            item.fail("bone", "there is no bone '" + bone_name + "'", "a bone of the project");
        const auto list = item.json().find("vertices");
        if (list == item.json().end() || !list->is_array())
            item.fail("vertices", "missing", "a list of vertex numbers");
        for (const Json& v : *list) {
            if (!v.is_number_integer() || v.get<long long>() < 0 ||
                v.get<long long>() >= muscle.mesh->vertex_count())
                item.fail("vertices", "got a number that is no vertex",
                          "0 to " + std::to_string(muscle.mesh->vertex_count() - 1));
            a.vertices.push_back(v.get<int>());
        }
        std::sort(a.vertices.begin(), a.vertices.end());
        a.vertices.erase(std::unique(a.vertices.begin(), a.vertices.end()), a.vertices.end());
        out.push_back(std::move(a));
    }
    return out;
}

std::vector<AttachmentArea> ProjectReader::areas(const JsonFields& entry, const Scene& scene) {
    std::vector<AttachmentArea> out;
    for (const JsonFields& item : entry.objects("areas")) {
        AttachmentArea area;
        area.kind = kind_of(item);
        area.head = item.text("head");
        const std::string bone_name = item.text("bone");
        area.bone = scene.bone_index(bone_name);
        if (area.bone < 0)
            item.fail("bone", "there is no bone '" + bone_name + "'", "a bone of the project");
        const int vertex_count = scene.bones[static_cast<std::size_t>(area.bone)].mesh->vertex_count();
        const std::string what = entry.text("name") + ": " + area_text(area, bone_name);
        if (item.integer("vertex_count", vertex_count) != vertex_count) {
            // The bone's file was replaced; a message says so already, the area means nothing on the new mesh.
            notes_->push_back(what + " is left out: it was made for another mesh");
            continue;
        }
        area.vertices = SurfaceRegion(vertex_count);
        const auto list = item.json().find("ranges");
        if (list == item.json().end() || !list->is_array() || list->size() % 2 != 0)
            item.fail("ranges", "missing, or not in pairs", "a list of first and last vertices");
        long long before = -1;
        for (std::size_t i = 0; i < list->size(); ++i) {
            const Json& v = (*list)[i];
            const bool is_first = i % 2 == 0;
            if (!v.is_number_integer() || v.get<long long>() < before + (is_first ? 1 : 0) ||
                v.get<long long>() >= vertex_count)
                item.fail("ranges", "got a number that is no vertex, or not in order",
                          "ascending, 0 to " + std::to_string(vertex_count - 1));
            if (!is_first)
                for (long long u = before; u <= v.get<long long>(); ++u)
                    area.vertices.insert(static_cast<int>(u));
            before = v.get<long long>();
        }
        out.push_back(std::move(area));
    }
    for (std::size_t i = 0; i < out.size(); ++i)
        give_vertices(out, i); // a file made by hand may have them overlap
    return out;
}

void ProjectReader::timeline(const JsonFields& entry, Scene& scene) {
    Timeline timeline;
    timeline.last_frame = entry.integer("last_frame", timeline.last_frame);
    if (timeline.last_frame < 1 || timeline.last_frame > 3000000)
        entry.fail("last_frame", "out of range", "1 to 3000000");
    if (entry.has("hinge")) {
        const JsonFields hinge = entry.object("hinge");
        timeline.hinge = Hinge{hinge.vector("centre"), hinge.vector("axis")};
        if (!(timeline.hinge->axis.stableNorm() > 0))
            hinge.fail("axis", "has no direction", "an axis other than 0,0,0");
    }
    read_keys(entry.objects("angles"), timeline.angles,
              [](const JsonFields& item, AngleKey& key) { key.angle_rad = item.number("angle_rad", 0.0); });
    timeline.bone_tracks.resize(scene.bones.size());
    for (const JsonFields& track : entry.objects("tracks")) {
        const int bone = scene.bone_index(track.text("bone"));
        if (bone < 0)
            track.fail("bone", "there is no bone '" + track.text("bone") + "'", "a bone of the project");
        auto& keys = timeline.bone_tracks[static_cast<std::size_t>(bone)].keys;
        keys.clear();
        read_keys(track.objects("keys"), keys, [](const JsonFields& item, PoseKey& key) {
            const std::vector<double> m = item.numbers("pose", 12);
            for (int row = 0; row < 3; ++row) {
                for (int column = 0; column < 3; ++column)
                    key.pose.rotation(row, column) = m[static_cast<std::size_t>(4 * row + column)];
                key.pose.translation[row] = m[static_cast<std::size_t>(4 * row + 3)];
            }
            const Mat3& r = key.pose.rotation;
            if (!((r * r.transpose() - Mat3::Identity()).norm() < 1e-6) || !(r.determinant() > 0))
                item.fail("pose", "its 3x3 part is no rotation", "a rigid transform, 3x4, row by row");
        });
    }
    scene.timeline = std::move(timeline);
}

void ProjectReader::parameters(const JsonFields& entry, Scene& scene) {
    // The method first: it decides what the values that were not edited are.
    if (entry.has("solver.method"))
        set_method(scene.parameters, entry.text("solver.method"));
    for (const auto& [key, value] : entry.json().items()) {
        if (scene.parameters.table().find(key) == nullptr) {
            notes_->push_back("parameter " + key + " is not known and has no effect");
            continue;
        }
        if (key == "solver.method")
            continue;
        try {
            if (value.is_string())
                scene.parameters.set_text(key, value.get<std::string>());
            else
                scene.parameters.set(key, entry.number(key.c_str(), 0.0));
        } catch (const Error& error) {
            throw_error(file_.string() + ", parameters", error.what());
        }
    }
}

} // namespace fascicle::io
