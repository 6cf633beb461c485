#pragma once
// Films and reports of a run at a terminal.

#include "app/cli/frame_range.hpp"
#include "app/cli/progress.hpp"
#include "output/data_export.hpp"
#include "output/run_pictures.hpp"

namespace fascicle::app {

struct FilmOptions {
    FrameRange range;
    double fps = 25;
    bool transparent = false;
    std::filesystem::path out; ///< a folder, or a .gif or .mp4 file

    /// By the name of `out`. Error (usage) for another extension, and for a speed or a transparency that it cannot have.
    std::string kind() const;
};

/// Draws the frames and writes them. SIGINT and SIGTERM end it with an Error; nothing is left then.
void write_film(const FilmOptions& options, const RecordingPtr& recording,
                const output::PictureOptions& picture, ProgressDisplay& progress);

/// An export that is drawn, seen from where most of muscles and motion is. As above.
void write_drawn(const output::ExportRequest& request, const RecordingPtr& recording,
                 ProgressDisplay& progress);

/// The HTML report, with pictures from where most of muscles and motion is seen.
void write_report(const std::filesystem::path& out, const RecordingPtr& recording, int threads,
                  ProgressDisplay& progress);

} // namespace fascicle::app
