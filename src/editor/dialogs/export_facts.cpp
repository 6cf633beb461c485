#include "editor/dialogs/export_facts.hpp"

#include "editor/features.hpp"
#include "editor/frame_axis.hpp"
#include "editor/widgets/paint.hpp"
#include "fascicle/io/video_encoder.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace fascicle::editor {

namespace fs = std::filesystem;
using output::ExportKind;

namespace {

/// Looking through $PATH once a second, and when it has changed, is enough.
bool has_encoder() {
    static std::chrono::steady_clock::time_point looked{};
    static std::string looked_in;
    static bool found = false;
    const auto now = std::chrono::steady_clock::now();
    const char* path = std::getenv("PATH");
    const std::string folders = path != nullptr ? path : "";
    if (looked == std::chrono::steady_clock::time_point{} || folders != looked_in ||
        now - looked > std::chrono::seconds(1)) {
        found = !find_video_encoder().empty();
        looked = now;
        looked_in = folders;
    }
    return found;
}

std::string bytes_text(double bytes) {
    char text[40];
    if (bytes < 1e6)
        std::snprintf(text, sizeof text, "%.0f kB", std::max(1.0, bytes / 1e3));
    else if (bytes < 1e9)
        std::snprintf(text, sizeof text, bytes < 1e7 ? "%.1f MB" : "%.0f MB", bytes / 1e6);
    else
        std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
    return text;
}

double vertices_of(const Scene& scene, bool bones) {
    double count = 0;
    for (const Muscle& muscle : scene.muscles)
        count += muscle.mesh->vertex_count();
    for (const Bone& bone : scene.bones)
        count += bones ? bone.mesh->vertex_count() : 0;
    return count;
}

std::string count_text(int count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

} // namespace

std::string reason_against(const EditorContext& context, ExportKind kind) {
    if (context.features.exporter.running())
        return "an export is under way";
    const ShownFrame shown = context.shown();
    if (output::export_kind(kind).traits.draws && context.view == nullptr)
        return "nothing can be drawn here";
    if (kind == ExportKind::picture)
        return {};
    if (shown.frame == nullptr)
        return context.document.scene().muscles.empty() ? "there is no muscle to compute a run for"
                                                        : "no frame is computed yet";
    if (kind == ExportKind::video && !has_encoder())
        return "no ffmpeg is installed that could make one; a GIF or numbered pictures need none";
    if (kind == ExportKind::fibres) {
        const std::vector<FibreModelPtr> fibres = shown.recording->fibres();
        if (std::none_of(fibres.begin(), fibres.end(), [](const FibreModelPtr& f) { return f != nullptr; }))
            return "the run has no fibres; choose a fibre method in the parameters";
    }
    return {};
}

int last_exported_frame(const EditorContext& context) {
    const RecordingPtr recording = context.shown().recording;
    const FramePtr last = recording == nullptr ? nullptr : recording->last_frame();
    return last == nullptr ? 0 : last->index;
}

std::string frames_text(const EditorContext& context) {
    const RecordingPtr recording = context.shown().recording;
    const int last = last_exported_frame(context);
    std::string text = "0 to " + std::to_string(last);
    if (recording != nullptr && recording->state() == RunState::running)
        text += "; the run is still being computed, later frames are left out";
    else if (context.runs.outdated() || recording != context.runs.recording())
        text += "; they are stale: made with other parameters";
    return text;
}

std::string estimate_text(const EditorContext& context, const output::ExportRequest& request, int pictures,
                          int width, int height) {
    const double pixels = double(width) * height * pictures;
    const RecordingPtr recording = context.shown().recording;
    const Scene& scene = context.shown_scene();
    const double frames = recording == nullptr ? 1 : recording->frame_count();
    // Bytes a pixel, a vertex with its triangles, a row: measured on the hip scene.
    switch (request.kind) {
    case ExportKind::picture:
        return "1 picture, about " + bytes_text(pixels * 0.25);
    case ExportKind::pictures:
        return count_text(pictures, "picture", "pictures") + ", about " + bytes_text(pixels * 0.25);
    case ExportKind::gif:
        return count_text(pictures, "picture", "pictures") + ", about " + bytes_text(pixels * 0.05);
    case ExportKind::video:
        return count_text(pictures, "picture", "pictures") + ", about " + bytes_text(pixels * 0.02);
    case ExportKind::meshes: {
        const auto bodies = static_cast<int>(scene.muscles.size() + scene.bones.size());
        return count_text(pictures * bodies, "file", "files") + ", about " +
               bytes_text(vertices_of(scene, true) * pictures * 100);
    }
    case ExportKind::mesh:
        return "1 file, about " + bytes_text(vertices_of(scene, true) * 95);
    case ExportKind::fibres: {
        double points = 0;
        int muscles = 0;
        for (const FibreModelPtr& model :
             recording == nullptr ? std::vector<FibreModelPtr>{} : recording->fibres())
            if (model != nullptr) {
                points += static_cast<double>(model->rest.points.size());
                ++muscles;
            }
        return count_text(pictures * muscles + 1, "file", "files") + ", about " +
               bytes_text(points * pictures * 170);
    }
    case ExportKind::metrics:
        return "1 table of " +
               count_text(static_cast<int>(frames * double(scene.muscles.size())), "row", "rows") +
               ", about " + bytes_text(frames * double(scene.muscles.size()) * 1050);
    case ExportKind::run:
        return "a folder, about " +
               bytes_text(vertices_of(scene, false) * frames * 140 + vertices_of(scene, true) * 90);
    case ExportKind::report:
        return "1 page with 4 pictures, about " + bytes_text(1.2e6);
    }
    return {};
}

std::string speed_text(const EditorContext& context, int pictures, const output::ExportRequest& request) {
    const double seconds = pictures / std::max(0.1, request.fps);
    const double motion = (request.last - request.first) * frame_seconds(context.shown_scene());
    char text[120];
    if (motion > 0 && pictures > 1)
        std::snprintf(text, sizeof text, "pictures/s: %.3g s, %.2g times the speed of the motion", seconds,
                      motion / seconds);
    else
        std::snprintf(text, sizeof text, "pictures/s: %.3g s", seconds);
    return text;
}

std::string replace_warning(const fs::path& target, ExportKind kind) {
    std::error_code error;
    if (!fs::exists(target, error))
        return {};
    const std::string name = target.filename().string();
    const bool is_folder = fs::is_directory(target, error);
    if (output::export_kind(kind).traits.folder)
        return !is_folder ? name + " exists and is a file; a folder is needed."
               : fs::is_empty(target, error)
                   ? ""
                   : name + " exists; files of the same names in it will be replaced.";
    return is_folder ? name + " exists and is a folder; a file is needed."
                     : name + " exists and will be replaced" +
                           (target.extension() == ".csv" &&
                                    fs::exists(fs::path(target).replace_extension(".json"), error)
                                ? ", and the .json beside it."
                                : ".");
}

std::string export_name(const std::string& scene) {
    std::string name;
    for (const char c : scene)
        name += static_cast<unsigned char>(c) >= 128 || std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                        c == '-' || c == '_'
                    ? c
                    : '_';
    return name.empty() ? "scene" : name;
}

std::string elided_front(const std::string& text, float width) {
    if (text_size(text).x <= width)
        return text;
    std::string rest = text;
    while (!rest.empty()) {
        rest.erase(0, 1);
        while (!rest.empty() && (static_cast<unsigned char>(rest[0]) & 0xC0) == 0x80)
            rest.erase(0, 1); // never half a character
        if (text_size("..." + rest).x <= width)
            break;
    }
    return "..." + rest;
}

} // namespace fascicle::editor
