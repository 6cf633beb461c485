#pragma once
// What a run can be written as, in one table: the dialog and the command line find it here. A new kind is a row.

#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/recording.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace fascicle::output {

/// Which options a kind has.
struct ExportTraits {
    bool draws = false;  ///< pictures are drawn for it, with a GL context
    bool one = false;    ///< of a single frame
    bool frames = false; ///< first, last, step
    bool speed = false;  ///< pictures a second
    bool size = false;   ///< width, height
    bool clear = false;  ///< transparent background
    bool folder = false; ///< the target is a folder
    bool morphs = false; ///< at most so many shapes of the frames
    bool up = false;     ///< which axis of the scene points up
    bool rest = false;   ///< needs no computed frame
};

/// What is to be written, and how.
struct ExportRequest {
    std::string kind = "picture"; ///< key of a row
    std::filesystem::path target; ///< file or folder
    int frame = 0;                ///< of a single picture or mesh
    int first = 0, last = 0,
        step = 1;           ///< frame numbers of a series; last also counts when it does not fall on a step
    double fps = 25;        ///< pictures a second of films, over 0; GIF at most 50
    bool dither = true;     ///< GIF: pattern against steps between colours
    int morph_targets = 64; ///< at most, 1 or more: shapes beside the first
    char up = 'z';          ///< axis of the scene that points up: 'y' or 'z'
    int threads = 1;        ///< for measuring
    /// Takes sentences for the user about what was written, when there is something to say; null: nobody asks. Not read before the
    /// export is done.
    std::shared_ptr<std::vector<std::string>> told;
};

/// What an estimate goes by. recording: null before any run.
struct ExportPlan {
    const Scene& scene;
    const Recording* recording;
    const ExportRequest& request;
    int frames;    ///< pictures or frames that are chosen
    double pixels; ///< of all pictures together
};

struct ExportKindRow {
    const char* key;       ///< stable, for `--export`, tests and settings
    const char* label;     ///< in the interface
    const char* help;      ///< a sentence or two
    const char* extension; ///< of the target, with its dot; empty for a folder
    const char* icon;      ///< Font Awesome 4.7, UTF-8
    /// Name of the file or folder that `simulate --export KEY` writes into a run's folder; empty: the scene's name with the extension;
    /// null: `simulate` does not offer it, since its folder holds as much.
    const char* in_run;
    ExportTraits traits;
    /// Number of files and size, for a reader.
    std::string (*estimate)(const ExportPlan& plan);
    /// Writes it; null for what is drawn (film.hpp). The recording does not grow meanwhile and has a frame. Error naming the file, Cancelled.
    /// Either all files are there afterwards, or none is new. For any thread.
    void (*write)(const ExportRequest& request, const Recording& recording, const JobControl& control);
    /// Why this recording cannot be written so, as the end of a sentence; empty when it can. Null: any can.
    std::string (*reason_against)(const Recording& recording) = nullptr;
    /// Why this machine cannot write it. Null: any can.
    std::string (*reason_here)() = nullptr;
};

/// In the order in which they are offered.
std::span<const ExportKindRow> export_kinds();
/// The row with the key, which must be there.
const ExportKindRow& export_kind(std::string_view key);
/// The same, null when there is none.
const ExportKindRow* find_export_kind(std::string_view key);

/// The target with the extension that the kind wants; folders as they are.
std::filesystem::path with_extension(std::filesystem::path target, std::string_view kind);
/// Another name beside a target that nothing has yet: "hip 2.gif", "hip 3.gif".
std::filesystem::path free_name(const std::filesystem::path& target);
/// Width or height that the kind can have: films need even ones.
int allowed_side(int pixels, std::string_view kind);

} // namespace fascicle::output
