#pragma once
// Plays a lesson: opens its scene beside what is open, takes its reader from step to step, watches what is to be done, and gives
// everything back when it is left. Panels draw it; controls ask its guard.

#include "editor/control_guard.hpp"
#include "editor/feature.hpp"
#include "editor/teach/quiz.hpp"
#include "fascicle/io/lesson_file.hpp"

#include <future>

namespace fascicle::editor {

class LessonPlayer : public Feature {
public:
    LessonPlayer();
    ~LessonPlayer() override;

    /// Begins a built-in lesson, in the next frames; in place of one that is on. Error (usage) for an unknown id.
    void start(const std::string& id);
    /// The same with a user's own; Error as read_lesson, and check_controls().
    void start_file(const std::filesystem::path& path);
    void start(Lesson lesson);
    /// What was open before comes back, as it was looked at. Asks nothing.
    void leave();

    bool active() const { return lesson_.has_value(); }
    bool loading() const { return job_ != nullptr; }
    /// The lesson that is on. Only while active().
    const Lesson& lesson() const { return *lesson_; }
    int step_index() const { return step_; }
    const LessonStep& step() const { return lesson_->steps[static_cast<std::size_t>(step_)]; }
    /// Done stays done, whatever is scrubbed or changed afterwards.
    bool done(int step) const { return done_[static_cast<std::size_t>(step)]; }
    bool on_last_step() const { return step_ + 1 == static_cast<int>(lesson_->steps.size()); }
    int furthest() const { return furthest_; } ///< step that was reached
    /// Steps take effect in the next frame.
    void go_to(int step);
    /// What a number that is watched is now, for the panel; empty when nothing can be said.
    std::string standing(const EditorContext& context) const;

    const Quiz* quiz() const { return quiz_.get(); }
    /// Compares what is painted with the truth, and lets that be seen.
    void score(const EditorContext& context);
    const std::optional<RegionOverlap>& last_score() const { return score_; }

    /// The scene that was open before, while it is kept; null: none.
    const Document* set_aside() const { return kept_ == nullptr ? nullptr : &kept_->document; }
    const ControlGuard& guard() const { return guard_; }
    /// Waits for the lesson's scene; for pictures and tests.
    void finish_loading();

    void update(EditorContext& context) override;
    void document_replaced(EditorContext& context) override;
    std::optional<double> redraw_after() const override;

private:
    struct Job;
    struct Kept { ///< what was there before the lesson
        Document document;
        EditorState state;
        RecordingPtr recording;
    };
    void open(EditorContext& context);
    void enter(EditorContext& context, int step);
    void check(EditorContext& context);
    bool holds(const EditorContext& context, const LessonCheck& check) const;
    std::optional<double> extreme(const EditorContext& context, const LessonCheck& check) const;
    void end(EditorContext& context);
    void give_back(EditorContext& context);

    std::unique_ptr<Job> job_;
    std::vector<std::unique_ptr<Job>> given_up_;
    std::optional<Lesson> lesson_, opening_;
    std::unique_ptr<Quiz> quiz_, opening_quiz_;
    std::unique_ptr<Kept> kept_;
    std::optional<int> wanted_step_;
    int step_ = 0, furthest_ = 0;
    std::vector<bool> done_;
    std::optional<RegionOverlap> score_;
    ControlGuard guard_;
    bool leaving_ = false, returning_ = false;
    bool fresh_ = false; ///< the step began in this frame: runs do not know its parameters yet
    double entered_ = 0, now_ = 0;
};

/// Error naming the lesson and the step when a colouring, panel, side or command that it names does not exist.
void check_controls(const Lesson& lesson);

/// Puts a step's view settings in force.
void apply_view(EditorContext& context, const std::vector<std::pair<std::string, std::string>>& view);
/// What a view setting is now, in the words of the file.
std::string view_text(const EditorState& state, const std::string& key, const std::string& wanted);

} // namespace fascicle::editor
