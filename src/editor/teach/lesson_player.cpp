#include "editor/teach/lesson_player.hpp"

#include "editor/features.hpp"
#include "editor/frame_axis.hpp"
#include "fascicle/base/error.hpp"
#include "fascicle/base/parallel.hpp"
#include "fascicle/document/actions/parameter_actions.hpp"
#include "fascicle/solver/parameters.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace fascicle::editor {

namespace {

constexpr double pulse_seconds = 6; ///< that a ring swells and shrinks; then it stands still

struct Opened {
    Scene scene;
    std::unique_ptr<Quiz> quiz;
};

/// How things are drawn: a lesson begins with the standard, and its end gives back the user's, whatever scene is open then.
void take_looks(const EditorState& from, EditorState& to) {
    to.colouring = from.colouring;
    to.wireframe = from.wireframe;
    to.rest_ghost = from.rest_ghost;
    to.attachments = from.attachments;
    to.joint_axis = from.joint_axis;
    to.muscle_opacity = from.muscle_opacity;
    to.bone_opacity = from.bone_opacity;
}

/// Values of metrics count only when they are of the parameters that are set now.
bool run_is_current(const EditorContext& context) {
    return !context.runs.outdated() && context.runs.valid_count() > 0 &&
           context.metrics.current().scene == context.runs.recording()->scene_ptr();
}

} // namespace

struct LessonPlayer::Job {
    Lesson lesson;
    std::future<Opened> result;
    bool done() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
};

LessonPlayer::LessonPlayer() = default;

LessonPlayer::~LessonPlayer() {
    if (control_guard() == &guard_)
        set_control_guard(nullptr);
}

void LessonPlayer::start(const std::string& id) {
    for (const Lesson& lesson : built_in_lessons())
        if (lesson.id == id)
            return start(lesson);
    throw_error("lesson '" + id + "'", "there is none of that name", {}, ErrorKind::usage);
}

void LessonPlayer::start_file(const std::filesystem::path& path) {
    start(read_lesson(path));
}

void LessonPlayer::start(Lesson lesson) {
    check_controls(lesson);
    if (job_ != nullptr)
        given_up_.push_back(std::move(job_));
    leaving_ = false;
    job_ = std::make_unique<Job>();
    job_->lesson = std::move(lesson);
    job_->result = std::async(std::launch::async, [wanted = job_->lesson] {
        SceneRequest request;
        request.embedded = wanted.scene;
        request.threads = std::max(1, hardware_threads() - 1);
        Opened opened{load_scene(request).scene, nullptr};
        if (wanted.quiz)
            opened.quiz = make_quiz(*wanted.quiz, opened.scene);
        return opened;
    });
}

void LessonPlayer::leave() {
    if (job_ != nullptr)
        given_up_.push_back(std::move(job_));
    leaving_ = active() || kept_ != nullptr;
}

void LessonPlayer::go_to(int step) {
    if (active() && step >= 0 && step < static_cast<int>(lesson_->steps.size()))
        wanted_step_ = step;
}

void LessonPlayer::finish_loading() {
    if (job_ != nullptr)
        job_->result.wait();
}

/// The lesson's scene is there: it takes the place of what is open, which is set aside.
void LessonPlayer::open(EditorContext& context) {
    const std::unique_ptr<Job> job = std::move(job_);
    try {
        Opened opened = job->result.get();
        if (context.document.has_uncommitted_edits())
            context.document.discard_edits(); // a drag that the start of the lesson ended
        if (kept_ == nullptr)
            kept_ = std::make_unique<Kept>(Kept{context.document, context.state, context.runs.recording()});
        opened.scene.name = job->lesson.title;
        opening_ = job->lesson;
        opening_quiz_ = std::move(opened.quiz);
        context.features.opener.open_scene({std::move(opened.scene), {}, {}});
    } catch (const std::exception& problem) {
        context.log.add(Severity::error, problem.what());
    }
}

void LessonPlayer::document_replaced(EditorContext& context) {
    if (returning_) {
        returning_ = false;
        end(context);
        give_back(context);
        return;
    }
    if (!opening_) { // something else was opened from within a lesson
        if (!active())
            return;
        end(context);
        if (kept_ != nullptr)
            take_looks(kept_->state, context.state);
        if (kept_ != nullptr && kept_->document.dirty())
            context.log.add(
                Severity::warning,
                kept_->document.scene().name +
                    ", set aside for the lesson, has unsaved changes: Lessons > Back brings it here");
        else
            kept_ = nullptr;
        return;
    }
    lesson_ = std::exchange(opening_, std::nullopt);
    quiz_ = std::move(opening_quiz_);
    done_.assign(lesson_->steps.size(), false);
    furthest_ = 0;
    score_.reset();
    EditorState& state = context.state;
    take_looks(EditorState(), state);
    state.side_panel = "parameters";
    state.bottom_panel = "plots";
    state.layout.show_right = state.layout.show_bottom = state.layout.show_lesson = true;
    enter(context, 0);
}

void LessonPlayer::end(EditorContext& context) {
    lesson_.reset();
    quiz_.reset();
    score_.reset();
    wanted_step_.reset();
    guard_ = {};
    if (control_guard() == &guard_)
        set_control_guard(nullptr);
    context.state.layout.show_lesson = false;
}

/// The view as it was before the lesson; what belongs to the window stays as it is now.
void LessonPlayer::give_back(EditorContext& context) {
    EditorState& state = context.state;
    EditorState before = std::move(kept_->state);
    before.dark = state.dark;
    before.scale = state.scale;
    before.start_scale = state.start_scale;
    before.wants_quit = state.wants_quit;
    before.wants_full_screen = state.wants_full_screen;
    before.wants_picture = state.wants_picture;
    before.playback.playing = false;
    before.layout.show_lesson = false;
    before.layout.lesson = state.layout.lesson;
    state = std::move(before);
    // A run that was over is shown again; one that was under way starts anew by itself.
    if (kept_->recording != nullptr && kept_->recording->state() == RunState::finished)
        context.runs.show(kept_->recording);
    kept_ = nullptr;
}

void LessonPlayer::enter(EditorContext& context, int index) {
    step_ = index;
    furthest_ = std::max(furthest_, index);
    fresh_ = true;
    entered_ = context.now;
    const LessonStep& now = step();
    if (context.document.has_uncommitted_edits())
        context.document.discard_edits();
    ParamSet parameters = context.document.scene().parameters;
    for (const auto& [key, text] : now.parameters)
        if (key == "solver.method")
            set_method(parameters, text);
        else
            parameters.set_text(key, text);
    if (!now.parameters.empty())
        actions::set_parameters(context.document, std::move(parameters), "Lesson: " + now.title);
    apply_view(context, now.view);
    guard_.locked = now.locked;
    guard_.highlighted = now.highlighted;
    if (now.checks.empty())
        done_[static_cast<std::size_t>(index)] = true;
}

void LessonPlayer::score(const EditorContext& context) {
    if (quiz_ != nullptr)
        score_ = score_quiz(*quiz_, context.document.scene());
}

/// The value of a metric that comes nearest to what is wanted, of all muscles and frames.
std::optional<double> LessonPlayer::extreme(const EditorContext& context, const LessonCheck& check) const {
    if (!run_is_current(context))
        return std::nullopt;
    const auto row = static_cast<std::size_t>(metric_index(check.key));
    const MetricValues& values = context.metrics.current();
    std::optional<double> best;
    for (const auto& frame : values.rows)
        for (const std::vector<double>& muscle : frame)
            if (const double value = muscle[row]; std::isfinite(value))
                best = !best ? value : check.below ? std::min(*best, value) : std::max(*best, value);
    return best;
}

bool LessonPlayer::holds(const EditorContext& context, const LessonCheck& check) const {
    const auto compared = [&](double value) {
        return (!check.below || value < *check.below) && (!check.above || value > *check.above);
    };
    const ParamSet& parameters = context.document.scene().parameters;
    if (check.what == "parameter") {
        if (check.is.empty())
            return compared(parameters.get(check.key));
        ParamSet wanted = parameters;
        wanted.set_text(check.key, check.is);
        return wanted.get(check.key) == parameters.get(check.key);
    }
    if (check.what == "metric") {
        const std::optional<double> value = extreme(context, check);
        return value && compared(*value);
    }
    if (check.what == "playhead") {
        const int frame = context.playhead();
        if (check.key == "frame")
            return compared(frame);
        return compared(std::abs(context.document.scene().timeline.angle_rad(frame)) * 180 /
                        std::numbers::pi);
    }
    if (check.what == "view")
        return view_text(context.state, check.key, check.is) == check.is;
    if (check.what == "run")
        return context.last_frame() > 0 &&
               compared(double(std::max(0, context.runs.valid_count() - 1)) / context.last_frame());
    if (check.what == "fibres") {
        int count = 0;
        if (context.features.fibres.current())
            for (const MuscleFibres& muscle : context.features.fibres.muscles())
                count += muscle.fibres == nullptr ? 0 : muscle.fibres->rest.count;
        return compared(count);
    }
    return score_ && compared(score_->dice()); // quiz
}

std::string LessonPlayer::standing(const EditorContext& context) const {
    for (const LessonCheck& check : step().checks) {
        char text[120];
        if (check.what == "metric") {
            const std::optional<double> value = extreme(context, check);
            const MetricRow& row = metric_table()[static_cast<std::size_t>(metric_index(check.key))];
            if (!value) {
                return "The run is being computed";
            }
            const std::string unit = row.unit == "1" ? "" : " " + row.unit;
            std::snprintf(text, sizeof text, "%s so far: %.3g%s; wanted: %s %.3g%s",
                          check.below ? "Least" : "Most", *value, unit.c_str(),
                          check.below ? "below" : "above", check.below ? *check.below : *check.above,
                          unit.c_str());
            return text;
        }
        if (check.what == "run") {
            std::snprintf(text, sizeof text, "Computed: %.0f of %d frames",
                          double(std::max(0, context.runs.valid_count() - 1)), context.last_frame());
            return text;
        }
    }
    return {};
}

void LessonPlayer::check(EditorContext& context) {
    const std::vector<LessonCheck>& checks = step().checks;
    if (done_[static_cast<std::size_t>(step_)] || checks.empty())
        return;
    if (std::all_of(checks.begin(), checks.end(),
                    [&](const LessonCheck& one) { return holds(context, one); }))
        done_[static_cast<std::size_t>(step_)] = true;
}

void LessonPlayer::update(EditorContext& context) {
    now_ = context.now;
    std::erase_if(given_up_, [](const std::unique_ptr<Job>& job) { return job->done(); });
    if (std::exchange(leaving_, false) && kept_ != nullptr) {
        returning_ = true;
        opening_.reset();
        OpenedScene back;
        back.document = std::make_shared<Document>(kept_->document);
        context.features.opener.open_scene(std::move(back));
        return;
    }
    if (job_ != nullptr && job_->done())
        open(context);
    if (!active())
        return;
    if (wanted_step_)
        enter(context, *std::exchange(wanted_step_, std::nullopt));
    else if (!std::exchange(fresh_, false))
        check(context);
    const double pulsing = now_ - entered_;
    guard_.ring = context.theme.accent;
    guard_.scale = context.scale();
    guard_.swelling =
        pulsing < pulse_seconds ? static_cast<float>(0.5 - 0.5 * std::cos(pulsing * std::numbers::pi)) : 0.0f;
    set_control_guard(&guard_);
}

std::optional<double> LessonPlayer::redraw_after() const {
    if (leaving_ || wanted_step_ || (active() && fresh_))
        return 0.0;
    if (job_ != nullptr || !given_up_.empty())
        return 1.0 / 25;
    if (active() && !guard_.highlighted.empty() && now_ - entered_ < pulse_seconds)
        return 1.0 / 25;
    return std::nullopt;
}

} // namespace fascicle::editor
