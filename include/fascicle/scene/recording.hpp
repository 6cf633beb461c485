#pragma once
// What a run produces: immutable frames, appended by the simulation's thread and read by anybody at the same
// time.

#include "fascicle/anatomy/fibre_problem.hpp"
#include "fascicle/scene/scene.hpp"

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>

namespace fascicle {

using PointsPtr = std::shared_ptr<const Points>;

/// What the solver says of one frame. Times are seconds of the frame's solving alone.
struct FrameReport {
    double solve_seconds = 0;
    std::map<std::string, double> stage_seconds; ///< per stage, e.g. "contact"
    std::int64_t contacts = 0;                   ///< contact projections that moved a vertex
    std::int64_t unresolved = 0;                 ///< vertices that contact could not put outside
    std::int64_t non_finite = 0; ///< vertices whose new position was not finite and was refused
    std::int64_t ejected = 0;    ///< vertices that had to be searched a place outside of all bones
    std::int64_t impossible = 0; ///< vertices for which there was none
    std::int64_t samples_held =
        0; ///< points on faces and edges left inside, held by an attachment or another bone
    std::int64_t unconverged = 0; ///< passes that a method which seeks equilibrium ended without it
};

/// One frame of a run. muscle_positions: one array per muscle, vertices in the order of its mesh.
struct Frame {
    int index = 0;
    double angle_rad = 0;
    std::vector<Pose> bone_poses; ///< one per bone, from the rest pose
    std::vector<PointsPtr> muscle_positions;
    FrameReport report;
};

using FibreModelPtr = std::shared_ptr<const FibreModel>;
using FramePtr = std::shared_ptr<const Frame>;

enum class RunState { running, finished, cancelled, failed };

/// Append-only and thread-safe. Frame 0 is rest after clean-up; later frames are measured against its
/// positions.
class Recording {
public:
    explicit Recording(ScenePtr scene) : scene_(std::move(scene)), now_(scene_.get()) {}

    /// Stays valid as long as this recording, also when it is renamed.
    const Scene& scene() const { return *now_.load(std::memory_order_acquire); }
    ScenePtr scene_ptr() const;
    /// A scene that differs in names and in nothing that a run depends on, in the place of the present one.
    void rename(ScenePtr scene);

    /// The attachments in force (resolved from outlines or distance), one list per muscle. Set before frame
    /// 0.
    void set_attachments(std::vector<std::vector<Attachment>> attachments);
    std::vector<std::vector<Attachment>> attachments() const;
    /// The fibres of every muscle, null for one that has none; empty before they are set. Set before frame 0. Where they are in a
    /// frame follows from the muscle's positions: FibreModel::carrier.
    void set_fibres(std::vector<FibreModelPtr> fibres);
    std::vector<FibreModelPtr> fibres() const;
    /// Sentences for the user: what was mended, attached, moved out, assumed.
    void add_note(std::string note);
    std::vector<std::string> notes() const;
    void set_prepare_seconds(double seconds);
    double prepare_seconds() const;
    /// Threads that the run was solved with; 0 when nobody has said.
    void set_threads(int threads) { threads_ = threads; }
    int threads() const { return threads_; }

    void append(FramePtr frame);
    int frame_count() const; ///< frames so far, rest included
    /// Frame k, 0 <= k < frame_count(); null otherwise.
    FramePtr frame(int k) const;
    FramePtr last_frame() const;

    RunState state() const;
    std::string failure() const;
    void finish(RunState state, std::string failure = {});

private:
    ScenePtr scene_;
    std::atomic<const Scene*> now_; ///< is scene_
    std::vector<ScenePtr> former_;  ///< somebody may hold a reference
    mutable std::mutex mutex_;
    std::vector<FramePtr> frames_;
    std::vector<std::vector<Attachment>> attachments_;
    std::vector<FibreModelPtr> fibres_;
    std::vector<std::string> notes_;
    double prepare_seconds_ = 0;
    std::atomic<int> threads_ = 0;
    RunState state_ = RunState::running;
    std::string failure_;
};

using RecordingPtr = std::shared_ptr<Recording>;

} // namespace fascicle
