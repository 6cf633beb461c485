#include "editor/dialogs/export_facts.hpp"

#include "editor/features.hpp"
#include "editor/frame_axis.hpp"
#include "editor/widgets/paint.hpp"

#include <cctype>
#include <cstdio>

namespace fascicle::editor {

namespace fs = std::filesystem;

std::string reason_against(const EditorContext& context, std::string_view kind) {
    if (context.features.exporter.running())
        return "an export is under way";
    const ShownFrame shown = context.shown();
    const output::ExportKindRow& row = output::export_kind(kind);
    if (row.traits.draws && context.view == nullptr)
        return "nothing can be drawn here";
    if (row.traits.rest)
        return {};
    if (shown.frame == nullptr)
        return context.document.scene().muscles.empty() ? "there is no muscle to compute a run for"
                                                        : "no frame is computed yet";
    if (row.reason_here != nullptr)
        if (std::string reason = row.reason_here(); !reason.empty())
            return reason;
    if (row.reason_against != nullptr)
        return row.reason_against(*shown.recording);
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
    const output::ExportPlan plan{context.shown_scene(), context.shown().recording.get(), request, pictures,
                                  double(width) * height * pictures};
    return output::export_kind(request.kind).estimate(plan);
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

std::string replace_warning(const fs::path& target, std::string_view kind) {
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
