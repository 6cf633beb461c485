#pragma once
// A folder that RunWriter left (with vtp frames), read back: for drawing it, comparing it, going through it.

#include "fascicle/base/job_control.hpp"
#include "fascicle/scene/recording.hpp"

#include <filesystem>
#include <functional>
#include <map>

namespace fascicle {

/// Whether the path is a folder with a summary.json in it.
bool is_run_folder(const std::filesystem::path& path);

/// Where the files of a run come from. Paths begin with the folder.
struct RunFiles {
    std::function<std::string(const std::filesystem::path&)> read; ///< Error when there is none
    std::function<bool(const std::filesystem::path&)> exists;
    static RunFiles on_disk();
};

/// The scene comes from the folder alone: muscles from their rest frames, bones from bones/, attachments from the frames'
/// arrays, angles, poses and times of solving from the tables, notes from the summary. Its timeline has the angles and moves no bone, and its
/// sources are only named.
class RunReader {
public:
    /// Reads everything but the frames' positions. Error naming the file for what is missing or bad.
    explicit RunReader(std::filesystem::path folder, RunFiles files = RunFiles::on_disk());

    ScenePtr scene() const { return scene_; }
    /// Attachments in force, one list per muscle.
    const std::vector<std::vector<Attachment>>& attachments() const { return attachments_; }
    /// Fibres, one a muscle, null for one that has none: their rest from fibres/, bound to the surface there anew.
    const std::vector<FibreModelPtr>& fibres() const { return fibres_; }
    /// Numbers of the frames that have files, ascending, beginning with 0.
    const std::vector<int>& frames() const { return frames_; }
    /// Error when the frame has no files, with the nearest that has.
    FramePtr read_frame(int frame) const;
    /// All frames as a finished recording.
    RecordingPtr read_recording(const JobControl& control = {}) const;

private:
    int place_of(int frame) const;
    void read_summary();
    void read_motion();
    void read_angles();
    void read_rest();

    std::filesystem::path folder_;
    RunFiles files_;
    ScenePtr scene_;
    std::vector<std::vector<Attachment>> attachments_;
    std::vector<FibreModelPtr> fibres_;
    std::vector<int> frames_;
    std::vector<std::vector<Pose>> poses_; ///< by place in frames_, then bone
    std::map<int, double> angles_;         ///< rad, by number of the frame: all that metrics.csv has
    std::vector<double> solve_seconds_;    ///< by place in frames_
    std::vector<std::string> notes_;       ///< that the run left
    int threads_ = 0;
    double prepare_seconds_ = 0;
};

} // namespace fascicle
