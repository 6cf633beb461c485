#pragma once
// Two runs on one playhead: which, how they are shown, and how far they are apart.

#include "editor/run_shelf.hpp"
#include "fascicle/metrics/run_difference.hpp"
#include "view/build_draw_list.hpp"

#include <future>

namespace fascicle::editor {

enum class CompareMode { off, side_by_side, ghost, blink, difference };

struct CompareModeRow {
    CompareMode mode;
    const char* key;         ///< in widgets' names
    const char* label;       ///< in the interface
    const char* short_label; ///< where there is little room
    const char* help;        ///< one sentence
};
/// Those that show something, in the order of the interface.
std::span<const CompareModeRow> compare_modes();

/// Stands for RunShelf's numbers: by itself the present run is A and the newest other one B.
inline constexpr int automatic_run = 0, present_run = -1;

/// What a person chose; the rest follows from it.
struct CompareChoice {
    CompareMode mode = CompareMode::off;
    int a = automatic_run, b = automatic_run; ///< RunShelf's numbers, or one of the above
    bool wire = false;                        ///< ghost: B as edges instead of a translucent surface
    bool shows_b = false;                     ///< blink
    bool blinks_by_itself = false;
    double blink_seconds = 0.7; ///< a picture stays for this long, 0.2 to 3
    view::ColourMap map = view::ColourMap::viridis;
    double low_mm = 0, high_mm = 5; ///< colours of the difference map, low < high
    bool range_follows = true;      ///< low 0, high a round number above twice the rms distance
};

/// One of the two runs at the playhead.
struct ComparedRun {
    RecordingPtr recording; ///< null: there is none
    std::string name;
    FramePtr frame;     ///< the last one not after the playhead, null before the first
    bool ended = false; ///< it has no frame at the playhead
};

class Compare : public Feature {
public:
    Compare();
    ~Compare() override;

    CompareChoice choice; ///< may be written by panels and commands

    /// Whether the view shows a comparison now.
    bool active() const { return choice.mode != CompareMode::off && reason_.empty() && !aside_; }
    bool active(CompareMode mode) const { return choice.mode == mode && active(); }
    /// The view shows the document: areas are painted, or the motion is dragged. Numbers go on.
    bool aside() const { return aside_; }
    /// Why A and B cannot be compared, one line; empty when they can.
    const std::string& reason() const { return reason_; }
    const ComparedRun& a() const { return a_; }
    const ComparedRun& b() const { return b_; }
    const RunMatch& match() const { return match_; }
    void swap(const EditorContext& context);
    /// B on or off; begins to compare when need be.
    void blink();

    /// What stands for the document's run in the view; nothing while not active.
    std::optional<ShownFrame> shown() const;
    /// The picture's subject; second: the right one of two side by side. Only while active.
    view::ViewSubject subject(bool second = false) const;
    void set_options(view::ViewOptions& options) const;
    view::ColourScale difference_scale() const;
    /// Draws the right one of two pictures. Needs context.view.
    SceneView& second_view(const EditorContext& context);
    /// Pictures of it that wait to be drawn better.
    SceneView* second_view() const { return second_view_.get(); }

    /// Common frames of A and B that are there so far.
    const std::vector<FramePair>& frames() const { return frames_; }
    /// Distances at the playhead's frames, once for each pair; null while there are none.
    const FrameDifference* at_playhead() const { return now_ ? &*now_ : nullptr; }
    /// Of the common frames compared so far, in their order, and over all of them by muscle.
    const std::vector<FrameDifference>& differences() const { return differences_; }
    const std::vector<DifferenceSummary>& summary() const { return summary_; }
    double progress() const; ///< 1: every common frame is compared

    /// To be called by what shows numbers, in every frame: distances, or metrics of both runs, too.
    void want_distances() { distances_wanted_ = 2; }
    void want_metrics() { metrics_wanted_ = 2; }
    /// Values of A and B measured so far, null when there are none yet. Valid in the frame in which they are asked for.
    const MetricRows* metrics_a() const { return metrics_a_; }
    const MetricRows* metrics_b() const { return metrics_b_; }
    /// Name of the run that is being measured and its share done; empty when none is.
    std::pair<std::string, double> measuring() const;
    /// Waits for what is being computed; the next update() takes it over and goes on. For pictures and tests.
    void finish() const;
    bool busy() const { return job_.valid() || metrics_job_ != nullptr; }

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    struct MetricsJob;
    /// What resolve() depends on.
    struct Key {
        int a = 0, b = 0, shelf = -1;
        RecordingPtr present;
        ScenePtr named; ///< its scene: muscles may be renamed
        bool operator==(const Key&) const = default;
    };
    void resolve(const EditorContext& context);
    void follow_playhead(int playhead);
    void compare_frames();
    void measure(const EditorContext& context);
    const MetricRows* metrics_of(const EditorContext& context, const RecordingPtr& recording) const;
    void blink_on(double now);
    void forget_pair();
    int number_of(const EditorContext& context, const RecordingPtr& recording) const;

    std::string reason_ = "there is no run yet", pair_reason_ = reason_;
    bool aside_ = false;
    Key key_;
    ComparedRun a_, b_;
    RunMatch match_;
    RecordingPtr pair_a_, pair_b_; ///< that what follows is about
    int counted_a_ = -1, counted_b_ = -1;
    std::vector<FramePair> frames_;
    FramePtr now_a_, now_b_;
    std::optional<FrameDifference> now_;
    std::vector<FrameDifference> differences_;
    std::vector<DifferenceSummary> summary_;
    std::future<std::vector<FrameDifference>> job_;
    std::atomic<bool> stop_{false};

    int distances_wanted_ = 0, metrics_wanted_ = 0; ///< for so many more frames
    const MetricRows* metrics_a_ = nullptr;
    const MetricRows* metrics_b_ = nullptr;
    std::unique_ptr<MetricsJob> metrics_job_;
    std::vector<std::unique_ptr<MetricsJob>> given_up_;         ///< told to stop, waited for without blocking
    std::vector<std::pair<RecordingPtr, MetricRows>> measured_; ///< empty rows: measuring failed

    std::unique_ptr<SceneView> second_view_;
    view::Colouring colouring_ = view::Colouring::anatomy; ///< when the difference map came on
    CompareMode last_mode_ = CompareMode::off;
    double flip_at_ = 0, now_seconds_ = 0;
};

} // namespace fascicle::editor
