#pragma once
// What `simulate --out DIR` leaves behind. File names, columns and keys are a promise to other programs (docs/cli.md).

#include "fascicle/io/mesh_data.hpp"
#include "fascicle/metrics/fibre_series.hpp"
#include "fascicle/scene/recording.hpp"

#include <filesystem>
#include <functional>
#include <memory>

namespace fascicle {

struct RunOutputOptions {
    bool vtp = false; ///< frames/<muscle>.<frame>.vtp, <muscle>.pvd, bones/<bone>.vtp
    int every =
        1; ///< write every K-th frame as vtp, its fibres, too, and the last always; the tables have every frame
    /// Columns of metrics.csv after frame, muscle and angle_deg: the keys of metric_table(), which
    /// stand in when this is empty.
    std::vector<std::string> metric_columns;
    int threads = 1; ///< for the summary of a recording that does not say how many its run had
    bool list_exports =
        true; ///< what finish() lets others write, in the summary: not where they write down a hash of that
    bool polylines = true; ///< of fibres, where there are some: fibres/<muscle>.<frame>.vtp
};

/// Writes a run into a hidden folder beside the final files, and gives all of them their names at once in finish(), so that the folder
/// holds one complete run at any time: this one or the one before. Without finish() nothing is left. The folder is locked meanwhile
/// (StagedFiles). Errors name the file that could not be written; an input file of the scene is never overwritten.
class RunWriter {
public:
    /// Makes the folder. Error when that fails, another program writes to it, or an output file would be an input of the scene.
    RunWriter(std::filesystem::path folder, ScenePtr scene, RunOutputOptions options);
    ~RunWriter();
    RunWriter(const RunWriter&) = delete;
    RunWriter& operator=(const RunWriter&) = delete;

    /// The attachments in force, one list per muscle: per-point arrays of the frames. Before the first frame.
    void set_attachments(std::vector<std::vector<Attachment>> attachments);

    /// Frames in ascending order, beginning with rest. metrics: one list per muscle, in the order of
    /// metric_columns.
    /// point_arrays: further per-point arrays for the frame's vtp file, one list per muscle, or empty.
    void add_frame(FramePtr frame, const std::vector<std::vector<double>>& metrics,
                   std::vector<std::vector<NamedArray>> point_arrays = {});

    /// Writes tables, series and summary, and gives everything its name. The recording may have ended early: what is done
    /// counts. series: of the muscles that have fibres, by muscle, null for the others (or empty), with the frames added: fibres.csv, the
    /// columns of metrics.csv that the whole run decides, and fibres/<muscle>.<frame>.vtp. Without any series the columns of
    /// fibres are left out. more: writes further files, into the folder that it is given; when it fails the run is kept without
    /// them, and its error is the last word. The summary lists them, so that the next run in this folder removes what is not its own.
    void finish(const Recording& recording, const std::vector<const FibreSeries*>& series = {},
                const std::function<void(const std::filesystem::path&)>& more = {});

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Hash of the positions of all muscles of a frame, in order, as in summary.json.
std::string state_hash(const Frame& frame);

/// Speed of a run: frames a second of solving alone, over the frames after rest; all 0 when there are none.
struct RunSpeed {
    double solve_seconds = 0;
    double fps_median = 0;
    double fps_mean = 0;
};
RunSpeed run_speed(const Recording& recording);

} // namespace fascicle
