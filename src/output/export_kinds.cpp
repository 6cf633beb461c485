#include "output/export_kinds.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace fascicle::output {
namespace fs = std::filesystem;

std::span<const ExportKindRow> export_kinds() {
    static constexpr std::array<ExportKindRow, 10> rows{{
        {ExportKind::picture,
         "picture",
         "Picture",
         "The shown frame as a PNG, sharper than the screen if you like.",
         ".png",
         {.draws = true, .size = true, .clear = true}},
        {ExportKind::pictures,
         "pictures",
         "Numbered pictures",
         "A PNG for every frame, for slides or a film made elsewhere.",
         "",
         {.draws = true, .frames = true, .size = true, .clear = true, .folder = true}},
        {ExportKind::gif,
         "gif",
         "GIF",
         "A film that repeats for ever and opens anywhere: browsers, slides, mail. 255 colours.",
         ".gif",
         {.draws = true, .frames = true, .speed = true, .size = true}},
        {ExportKind::video,
         "video",
         "Video (mp4)",
         "A film as H.264: small, with all colours. Made by ffmpeg where it is installed.",
         ".mp4",
         {.draws = true, .frames = true, .speed = true, .size = true}},
        {ExportKind::meshes,
         "meshes",
         "Meshes (VTP series)",
         "Muscles and bones of every frame with attachment, depth and edge extension per point, for "
         "ParaView.",
         "",
         {.frames = true, .folder = true}},
        {ExportKind::mesh,
         "mesh",
         "Mesh (OBJ)",
         "Muscles and bones as they lie in the shown frame, one group each, for Blender and others.",
         ".obj",
         {}},
        {ExportKind::fibres,
         "fibres",
         "Fibres",
         "Fibres of every frame as polylines for ParaView, and lengths, strains and moment arms as a table.",
         "",
         {.frames = true, .folder = true}},
        {ExportKind::metrics,
         "metrics",
         "Numbers (CSV)",
         "Every measured quantity, a row per frame and muscle. What was run is in a .json beside it.",
         ".csv",
         {}},
        {ExportKind::run,
         "run",
         "Whole run",
         "What \"fascicle simulate --export vtp\" leaves: tables, meshes, summary. Can be opened and "
         "compared again.",
         "",
         {.folder = true}},
        {ExportKind::report,
         "report",
         "Report (HTML)",
         "One page with pictures, plots and numbers that opens offline and prints well.",
         ".html",
         {.draws = true}},
    }};
    return rows;
}

const ExportKindRow& export_kind(ExportKind kind) {
    return export_kinds()[static_cast<std::size_t>(kind)];
}

fs::path with_extension(fs::path target, ExportKind kind) {
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

int allowed_side(int pixels, ExportKind kind) {
    pixels = std::clamp(pixels, 16, kind == ExportKind::video || kind == ExportKind::gif ? 8192 : 16384);
    return kind == ExportKind::video ? pixels / 2 * 2 : pixels;
}

} // namespace fascicle::output
