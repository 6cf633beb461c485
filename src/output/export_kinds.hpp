#pragma once
// What a run can be written as, in one table: the dialog and the command line find it here.

#include <filesystem>
#include <span>
#include <string>

namespace fascicle::output {

enum class ExportKind { picture, pictures, gif, video, meshes, mesh, fibres, metrics, run, report };

/// Which options a kind has.
struct ExportTraits {
    bool draws = false;  ///< pictures are drawn for it, with a GL context
    bool frames = false; ///< first, last, step
    bool speed = false;  ///< pictures a second
    bool size = false;   ///< width, height
    bool clear = false;  ///< transparent background
    bool folder = false; ///< the target is a folder
};

struct ExportKindRow {
    ExportKind kind;
    const char* key;       ///< stable, for tests and settings
    const char* label;     ///< in the interface
    const char* help;      ///< a sentence or two
    const char* extension; ///< of the target, with its dot; empty for a folder
    ExportTraits traits;
};

/// In the order of ExportKind.
std::span<const ExportKindRow> export_kinds();
const ExportKindRow& export_kind(ExportKind kind);

/// What is to be written, and how.
struct ExportRequest {
    ExportKind kind = ExportKind::picture;
    std::filesystem::path target; ///< file or folder
    int frame = 0;                ///< of a single picture or mesh
    int first = 0, last = 0,
        step = 1;       ///< frame numbers of a series; last also counts when it does not fall on a step
    double fps = 25;    ///< pictures a second of films, over 0; GIF at most 50
    bool dither = true; ///< GIF: pattern against steps between colours
    int threads = 1;    ///< for measuring
};

/// The target with the extension that the kind wants; folders as they are.
std::filesystem::path with_extension(std::filesystem::path target, ExportKind kind);
/// Another name beside a target that nothing has yet: "hip 2.gif", "hip 3.gif".
std::filesystem::path free_name(const std::filesystem::path& target);
/// Width or height that the kind can have: films need even ones.
int allowed_side(int pixels, ExportKind kind);

} // namespace fascicle::output
