#include "output/export_kinds.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/io/osim_export.hpp"
#include "output/animation_export.hpp"
#include "output/export_estimates.hpp"
#include "output/export_writers.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace fascicle::output {
namespace fs = std::filesystem;

std::span<const ExportKindRow> export_kinds() {
    static constexpr std::array<ExportKindRow, 17> rows{{
        {"picture",
         "Picture",
         "The shown frame as a PNG, sharper than the screen if you like.",
         ".png",
         "\xEF\x80\xBE",
         nullptr,
         {.draws = true, .one = true, .size = true, .clear = true, .rest = true},
         estimate_picture,
         nullptr},
        {"frames",
         "Numbered pictures",
         "A PNG for every frame, for slides or a film made elsewhere.",
         "",
         "\xEF\x87\x85",
         "pictures",
         {.draws = true, .frames = true, .size = true, .clear = true, .folder = true},
         estimate_frames,
         nullptr},
        {"gif",
         "GIF",
         "A film that repeats for ever and opens anywhere: browsers, slides, mail. 255 colours.",
         ".gif",
         "\xEF\x80\x88",
         "",
         {.draws = true, .frames = true, .speed = true, .size = true},
         estimate_gif,
         nullptr},
        {"video",
         "Video (mp4)",
         "A film as H.264: small, with all colours. Made by ffmpeg where it is installed.",
         ".mp4",
         "\xEF\x80\xBD",
         "",
         {.draws = true, .frames = true, .speed = true, .size = true},
         estimate_video,
         nullptr,
         nullptr,
         reason_against_video},
        {"meshes",
         "Meshes (VTP series)",
         "Muscles and bones of every frame with attachment, depth and edge extension per point, for "
         "ParaView.",
         "",
         "\xEF\x86\xB3",
         "meshes",
         {.frames = true, .folder = true},
         estimate_meshes,
         write_meshes},
        {"mesh",
         "Mesh (OBJ)",
         "Muscles and bones as they lie in the shown frame, one group each, for Blender and others.",
         ".obj",
         "\xEF\x86\xB2",
         nullptr,
         {.one = true},
         estimate_mesh,
         write_mesh},
        {"fibres",
         "Fibres",
         "Fibres of every frame as polylines for ParaView, and lengths, strains and moment arms as a table.",
         "",
         "\xEF\x83\x89",
         "fibre_series",
         {.frames = true, .folder = true},
         estimate_fibres,
         write_fibres,
         reason_against_fibres},
        {"glb",
         "glTF (glb)",
         "Muscles and fibres with a shape for every n-th frame, bones that move, in metres: one file for "
         "Blender, browsers "
         "and slides.",
         ".glb",
         "\xEF\x87\xA0",
         "",
         {.frames = true, .morphs = true, .up = true},
         estimate_glb,
         write_animation},
        {"usda",
         "USD (usda)",
         "Every frame as a time sample: for Omniverse, Houdini, Maya and usdview. A text, and large.",
         ".usda",
         "\xEF\x84\xA6",
         "",
         {.frames = true, .up = true},
         estimate_usda,
         write_animation},
        {"obj",
         "OBJ sequence",
         "An OBJ of every frame with an object for every body, in the scene's unit.",
         "",
         "\xEF\x83\x85",
         "obj",
         {.frames = true, .folder = true, .up = true},
         estimate_obj,
         write_animation},
        {"pc2",
         "Point cache (PC2)",
         "An OBJ of every body, and its moving points beside it, for Blender's Mesh Cache and for Maya.",
         "",
         "\xEF\x82\xA0",
         "pc2",
         {.frames = true, .folder = true, .up = true},
         estimate_cache,
         write_animation},
        {"mdd",
         "Point cache (MDD)",
         "The same as PC2 in the form that LightWave and Houdini read.",
         "",
         "\xEF\x82\xA0",
         "mdd",
         {.frames = true, .folder = true, .up = true},
         estimate_cache,
         write_animation},
        {"osim",
         "OpenSim model",
         "Every fibre as a muscle of an OpenSim model, with the bones, the motion and a report of how near "
         "it is "
         "to the run.",
         ".osim",
         "\xEF\x83\x81",
         "",
         {.up = true},
         estimate_osim,
         write_osim,
         reason_against_osim},
        {"metrics",
         "Numbers (CSV)",
         "Every measured quantity, a row per frame and muscle. What was run is in a .json beside it.",
         ".csv",
         "\xEF\x83\x8E",
         nullptr,
         {},
         estimate_metrics,
         write_metrics},
        {"json",
         "Numbers (JSON)",
         "Every measured quantity of muscles and fibres, and what was run, in one document.",
         ".json",
         "\xEF\x87\x89",
         "metrics.json",
         {},
         estimate_json,
         write_metrics_json},
        {"run",
         "Whole run",
         "What \"fascicle simulate --export vtp\" leaves: tables, meshes, summary. Can be opened and "
         "compared again.",
         "",
         "\xEF\x81\xBB",
         nullptr,
         {.folder = true},
         estimate_run,
         write_run_folder},
        {"report",
         "Report (HTML)",
         "One page with pictures, plots and numbers that opens offline and prints well.",
         ".html",
         "\xEF\x83\xB6",
         "report.html",
         {.draws = true},
         estimate_report,
         nullptr},
    }};
    return rows;
}

const ExportKindRow* find_export_kind(std::string_view key) {
    for (const ExportKindRow& row : export_kinds())
        if (row.key == key)
            return &row;
    return nullptr;
}

const ExportKindRow& export_kind(std::string_view key) {
    const ExportKindRow* row = find_export_kind(key);
    FASCICLE_ASSERT(row != nullptr);
    return *row;
}

fs::path with_extension(fs::path target, std::string_view kind) {
    const std::string wanted = export_kind(kind).extension;
    std::string has = target.extension().string();
    std::transform(has.begin(), has.end(), has.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!wanted.empty() && has != wanted)
        target += wanted;
    return target;
}

fs::path free_name(const fs::path& target) {
    std::error_code error;
    const std::string stem = target.stem().string();
    for (int k = 2; k < 10000; ++k) {
        const fs::path other =
            target.parent_path() / (stem + " " + std::to_string(k) + target.extension().string());
        if (!fs::exists(other, error))
            return other;
    }
    return target;
}

int allowed_side(int pixels, std::string_view kind) {
    pixels = std::clamp(pixels, 16, kind == "video" || kind == "gif" ? 8192 : 16384);
    return kind == "video" ? pixels / 2 * 2 : pixels;
}

} // namespace fascicle::output
