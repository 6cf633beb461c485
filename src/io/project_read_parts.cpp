// The parts of a project beside its meshes: attachments, motion, parameters.
#include "fascicle/base/error.hpp"
#include "fascicle/base/pose.hpp"
#include "io/project_json.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace fascicle::io {
namespace {

template <typename Key, typename Add>
void read_keys(const std::vector<JsonFields>& entries, std::vector<Key>& keys, Add add) {
    for (const JsonFields& entry : entries) {
        Key key;
        key.frame = entry.number("frame", 0.0);
        if (!(std::abs(key.frame) <= 3e6))
            entry.fail("frame", "out of range", "-3000000 to 3000000");
        if (!keys.empty() && key.frame <= keys.back().frame)
            entry.fail("frame", "keys are not in ascending order", "ascending frames");
        add(entry, key);
        keys.push_back(key);
    }
}

} // namespace

std::vector<Attachment> ProjectReader::attachments(const JsonFields& entry, const Muscle& muscle,
                                                   const Scene& scene) {
    std::vector<Attachment> out;
    for (const JsonFields& item : entry.objects("attachments")) {
        Attachment a;
        a.kind = kind_of(item);
        const std::string bone_name = item.text("bone");
        if (bone_name.empty()) {
            notes_->push_back(entry.text("name") + ": an attachment without a bone is left out");
            continue;
        }
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
        if (bone_name.empty()) {
            notes_->push_back(entry.text("name") + ": an area without a bone is left out");
            continue;
        }
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
        if (!has_direction(timeline.hinge->axis))
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

void ProjectReader::markers(Scene& scene) {
    for (const JsonFields& entry : fields_.objects("markers")) {
        const Marker marker{entry.integer("frame", -1), entry.text("name")};
        if (marker.frame < 0 || marker.frame > scene.timeline.last_frame)
            entry.fail("frame", "missing or out of range", "0 to last_frame");
        if (!scene.markers.empty() && marker.frame <= scene.markers.back().frame)
            entry.fail("frame", "markers are not in ascending order", "ascending frames");
        scene.markers.push_back(marker);
    }
}

void ProjectReader::parameters(const JsonFields& entry, Scene& scene) {
    const auto naming_the_file = [&](const char* part, const auto& set) {
        try {
            set();
        } catch (const Error& error) {
            throw_error(file_.string() + ", " + part, error.what());
        }
    };
    // The method first: it decides what the values that were not edited are.
    if (entry.has("solver.method")) {
        const std::string method = entry.text("solver.method");
        naming_the_file("parameters", [&] { set_method(scene.parameters, method); });
    }
    if (fields_.has("parameter_defaults")) {
        std::map<std::string, double> defaults;
        const JsonFields given = fields_.object("parameter_defaults");
        for (const ParamRow& row : scene.parameters.table().rows())
            if (row.kind != ParamKind::choice)
                defaults[row.key] = given.number(row.key.c_str(), scene.parameters.default_value(row.key));
        naming_the_file("parameter_defaults", [&] {
            ParamSet checked = scene.parameters; // bring_defaults() takes anything
            for (const auto& [key, value] : defaults)
                checked.set(key, value);
            bring_defaults(scene.parameters, defaults);
        });
    }
    for (const auto& item : entry.json().items()) {
        const std::string& key = item.key();
        if (scene.parameters.table().find(key) == nullptr) {
            notes_->push_back("parameter " + key + " is not known and has no effect");
            continue;
        }
        if (key == "solver.method")
            continue;
        const bool is_text = item.value().is_string();
        const double number = is_text ? 0 : entry.number(key.c_str(), 0.0);
        naming_the_file("parameters", [&] {
            if (is_text)
                scene.parameters.set_text(key, item.value().get<std::string>());
            else
                scene.parameters.set(key, number);
        });
    }
}

} // namespace fascicle::io
