// Projects, with the meshes that they carry. Nothing outside is read: a project that names a file other than the one that
// is not there, or an embedded scene (which takes long to make), is passed over.

#include "fascicle/io/project_file.hpp"
#include "fascicle/scene/embedded_scenes.hpp"
#include "fuzz/check.hpp"
#include "fuzz/targets.hpp"
#include "io/json_fields.hpp"

#include <cmath>

namespace fascicle::fuzz {
namespace {

constexpr const char* no_file = "no/such/file.obj";
constexpr const char* project_path = "/nonexistent/fuzz.fascicle";

/// Whether no text of the project could lead outside.
struct InsideOnly : nlohmann::json_sax<io::Json> {
    bool string(string_t& text) override {
        if (is_path && text != no_file)
            return false;
        for (const EmbeddedSceneInfo& info : embedded_scenes())
            if (text == info.name)
                return false;
        return true;
    }
    bool key(string_t& name) override {
        is_path = name == "path";
        return true;
    }
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        damaged = true;
        return false;
    }
    bool is_path = false;
    bool damaged = false; ///< the reader ends there, too, before it looks at anything
};

bool stays_inside(std::string_view bytes) {
    InsideOnly check;
    return io::Json::sax_parse(bytes, &check) || check.damaged;
}

void check_scene(const Scene& scene) {
    for (const Bone& bone : scene.bones)
        FUZZ_CHECK(!bone.name.empty() && bone.mesh != nullptr);
    for (const Muscle& muscle : scene.muscles) {
        FUZZ_CHECK(!muscle.name.empty() && muscle.mesh != nullptr);
        for (const Attachment& a : muscle.attachments) {
            FUZZ_CHECK(a.bone >= 0 && a.bone < static_cast<int>(scene.bones.size()));
            for (const int v : a.vertices)
                FUZZ_CHECK(v >= 0 && v < muscle.mesh->vertex_count());
        }
        for (const AttachmentArea& area : muscle.areas)
            FUZZ_CHECK(area.bone >= 0 && area.bone < static_cast<int>(scene.bones.size()));
    }
    const Timeline& timeline = scene.timeline;
    for (const double frame : {0.0, 0.7, double(timeline.last_frame)}) {
        for (int b = 0; b < static_cast<int>(scene.bones.size()); ++b)
            timeline.bone_pose(b, frame);
        timeline.angle_rad(frame);
    }
    for (const ParamRow& row : scene.parameters.table().rows()) {
        const double value = scene.parameters.get(row.key);
        FUZZ_CHECK(value >= row.minimum && value <= row.maximum);
    }
}

void fuzz_project(std::string_view bytes) {
    if (!stays_inside(bytes))
        return;
    Project project;
    try {
        project = read_project_text(std::string(bytes), project_path);
    } catch (const Error& error) {
        const bool missing = std::string_view(error.what()).find(no_file) != std::string_view::npos;
        check_message(error, missing ? no_file : project_path);
        return;
    }
    check_scene(project.scene);
    // Written with all of its meshes and read again it is the same project.
    const std::string first = project_text(project_path, project.scene, {{}, true});
    const Project back = read_project_text(first, project_path);
    if (project_text(project_path, back.scene, {{}, true}) != first)
        failed("a project that is written and read is the same", __FILE__, __LINE__);
    // What this version does not know survives, and disturbs nothing.
    const std::string kept = project_text(project_path, project.scene, {project.text, true});
    const Project with_unknown = read_project_text(kept, project_path);
    if (project_text(project_path, with_unknown.scene, {{}, true}) != first)
        failed("unknown fields change nothing", __FILE__, __LINE__);
}

} // namespace

std::vector<Target> project_targets() {
    return {
        {"project", fuzz_project, 8 * kB, "project", "project", 400, 4 * MB},
    };
}

} // namespace fascicle::fuzz
