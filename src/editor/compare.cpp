#include "editor/compare.hpp"

#include "editor/features.hpp"
#include "editor/scene_view.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace fascicle::editor {

namespace {

/// A job compares so many frames, so that new ones and other runs are soon attended to.
constexpr int frames_a_job = 64;

/// The next of 1, 2, 5 times a power of ten that is not below the value.
double round_above(double value) {
    if (!(value > 0))
        return 1;
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0, 10.0})
        if (step * power >= value * (1 - 1e-12))
            return step * power;
    return 10 * power;
}

} // namespace

std::span<const CompareModeRow> compare_modes() {
    static constexpr std::array<CompareModeRow, 4> rows{{
        {CompareMode::side_by_side, "side_by_side", "Side by side", "Side by side",
         "A and B next to each other under one camera."},
        {CompareMode::ghost, "ghost", "Ghost", "Ghost", "B over A, translucent or as its edges."},
        {CompareMode::blink, "blink", "Blink", "Blink",
         "A and B in turn at the same place, by key or by themselves."},
        {CompareMode::difference, "difference", "Difference map", "Difference",
         "A coloured by how far each vertex is from its place in B."},
    }};
    return rows;
}

struct Compare::MetricsJob {
    RecordingPtr recording;
    std::atomic<bool> stop{false};
    std::atomic<double> fraction{0};
    std::future<MetricRows> result;
    bool done() const { return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
};

Compare::Compare() = default;

Compare::~Compare() { // the futures wait
    stop_ = true;
    if (metrics_job_ != nullptr)
        metrics_job_->stop = true;
}

int Compare::number_of(const EditorContext& context, const RecordingPtr& recording) const {
    const KeptRun* kept = context.features.shelf.find(recording);
    return recording == context.runs.recording() || kept == nullptr ? present_run : kept->id;
}

void Compare::swap(const EditorContext& context) {
    if (a_.recording == nullptr || b_.recording == nullptr)
        return;
    const int b = number_of(context, a_.recording);
    choice.a = number_of(context, b_.recording);
    choice.b = b;
}

void Compare::blink() {
    if (choice.mode == CompareMode::blink) {
        choice.shows_b = !choice.shows_b;
    } else {
        choice.mode = CompareMode::blink;
        choice.shows_b = true;
    }
    flip_at_ = now_seconds_ + choice.blink_seconds;
}

std::optional<ShownFrame> Compare::shown() const {
    if (!active())
        return std::nullopt;
    const ComparedRun& run = choice.mode == CompareMode::blink && choice.shows_b ? b_ : a_;
    return ShownFrame{run.frame, run.recording, FrameState::valid};
}

view::ViewSubject Compare::subject(bool second) const {
    const bool of_b = second || (choice.mode == CompareMode::blink && choice.shows_b);
    const ComparedRun& run = of_b ? b_ : a_;
    view::ViewSubject subject{run.recording->scene_ptr(), run.frame, run.recording->frame(0),
                              run.recording->attachments(), run.recording->fibres()};
    if (choice.mode == CompareMode::ghost || choice.mode == CompareMode::difference) {
        subject.compared.resize(subject.scene->muscles.size());
        for (const MatchedMuscle& muscle : match_.muscles)
            subject.compared[static_cast<std::size_t>(muscle.a)] =
                b_.frame->muscle_positions[static_cast<std::size_t>(muscle.b)];
    }
    return subject;
}

void Compare::set_options(view::ViewOptions& options) const {
    if (active(CompareMode::ghost))
        options.compared = choice.wire ? view::Compared::wire : view::Compared::ghost;
    if (active(CompareMode::difference)) {
        options.compared = view::Compared::difference;
        options.difference_scale = difference_scale();
    }
}

view::ColourScale Compare::difference_scale() const {
    view::ColourScale scale{choice.map, choice.low_mm, choice.high_mm};
    if (choice.range_follows) {
        double rms = 0; // a single vertex far away would leave all others dark
        for (const DifferenceSummary& one : summary_)
            rms = std::max(rms, one.rms_mm);
        if (summary_.empty() && now_)
            for (const PointDistance& one : now_->muscles)
                rms = std::max(rms, one.rms_mm);
        scale.low = 0;
        scale.high = round_above(std::max(2 * rms, 0.01)); // noise stays dark
    }
    return scale;
}

SceneView& Compare::second_view(const EditorContext& context) {
    if (second_view_ == nullptr)
        second_view_ = std::make_unique<SceneView>(context.view->best_quality());
    return *second_view_;
}

double Compare::progress() const {
    return frames_.empty() ? 1.0 : std::min(1.0, double(differences_.size()) / double(frames_.size()));
}

void Compare::forget_pair() {
    stop_ = true;
    if (job_.valid())
        job_.wait(); // for less than a frame's comparing
    job_ = {};
    stop_ = false;
    counted_a_ = counted_b_ = -1;
    frames_.clear();
    now_a_ = now_b_ = nullptr;
    now_.reset();
    differences_.clear();
    summary_.clear();
}

void Compare::resolve(const EditorContext& context) {
    RunShelf& shelf = context.features.shelf;
    for (int* number : {&choice.a, &choice.b})
        if (*number > 0 && shelf.find(*number) == nullptr)
            *number = automatic_run;
    shelf.hold({choice.a, choice.b});
    const RecordingPtr present = context.runs.recording();
    const ScenePtr named = present != nullptr ? present->scene_ptr() : nullptr;
    if (Key key{choice.a, choice.b, shelf.version(), present, named}; key != key_)
        key_ = std::move(key);
    else
        return;
    const auto chosen = [&](int number) {
        return number == present_run ? present : number > 0 ? shelf.find(number)->recording : nullptr;
    };
    const auto newest_but = [&](const RecordingPtr& other) -> RecordingPtr {
        for (const KeptRun& run : shelf.runs())
            if (run.recording != other &&
                (other == nullptr || match_runs(run.recording->scene(), other->scene()).comparable()))
                return run.recording;
        return nullptr;
    };
    RecordingPtr a = chosen(choice.a), b = chosen(choice.b);
    if (choice.a == automatic_run)
        a = present != nullptr && present != b ? present : newest_but(b);
    if (choice.b == automatic_run)
        b = newest_but(a);
    const auto name_of = [&](const RecordingPtr& recording) {
        const KeptRun* kept = shelf.find(recording);
        return kept != nullptr ? kept->name : recording == nullptr ? std::string() : "Present run";
    };
    a_ = {a, name_of(a), nullptr, false};
    b_ = {b, name_of(b), nullptr, false};
    match_ = {};
    if (a == nullptr) {
        pair_reason_ = "there is no run yet";
    } else if (b == nullptr) {
        const bool others = std::any_of(shelf.runs().begin(), shelf.runs().end(),
                                        [&](const KeptRun& run) { return run.recording != a; });
        pair_reason_ = others ? "no other run has the same muscles"
                              : "there is no other run yet; change a parameter or load a run folder";
    } else if (a == b) {
        pair_reason_ = "A and B are the same run";
    } else {
        match_ = match_runs(a->scene(), b->scene());
        pair_reason_ = match_.reason;
    }
    if (a != pair_a_ || b != pair_b_) {
        forget_pair();
        pair_a_ = a;
        pair_b_ = b;
    }
}

void Compare::follow_playhead(int playhead) {
    for (ComparedRun* run : {&a_, &b_}) {
        run->frame = run->recording == nullptr ? nullptr : frame_not_after(*run->recording, playhead);
        run->ended = run->frame != nullptr && run->frame->index < playhead;
    }
    if (!reason_.empty() || a_.frame == nullptr || b_.frame == nullptr) {
        now_.reset();
        now_a_ = now_b_ = nullptr;
        return;
    }
    if (now_ && now_a_ == a_.frame && now_b_ == b_.frame)
        return;
    now_a_ = a_.frame;
    now_b_ = b_.frame;
    const int index = now_a_->index;
    const auto known =
        std::lower_bound(differences_.begin(), differences_.end(), index,
                         [](const FrameDifference& frame, int wanted) { return frame.index < wanted; });
    if (now_b_->index == index && known != differences_.end() && known->index == index)
        now_ = *known;
    else
        now_ = frame_difference(*now_a_, *now_b_, match_, millimetres_per_unit(a_.recording->scene().unit));
}

void Compare::compare_frames() {
    if (!reason_.empty())
        return;
    const int na = pair_a_->frame_count(), nb = pair_b_->frame_count();
    if (na != counted_a_ || nb != counted_b_) {
        counted_a_ = na;
        counted_b_ = nb;
        frames_ = common_frames(*pair_a_, *pair_b_);
    }
    if (job_.valid()) {
        if (job_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
            return;
        std::vector<FrameDifference> fresh = job_.get();
        differences_.insert(differences_.end(), std::make_move_iterator(fresh.begin()),
                            std::make_move_iterator(fresh.end()));
        summary_ = summarise(match_, differences_);
    }
    if (differences_.size() < frames_.size())
        job_ = std::async(std::launch::async, [this, a = pair_a_, b = pair_b_, match = match_,
                                               begins = frames_[differences_.size()].index] {
            JobControl control;
            control.cancel = &stop_;
            return run_difference(*a, *b, match, control, begins, frames_a_job);
        });
}

const MetricRows* Compare::metrics_of(const EditorContext& context, const RecordingPtr& recording) const {
    const MetricsWorker& worker = context.metrics;
    if (recording != nullptr && recording == context.runs.recording() &&
        worker.current().scene == recording->scene_ptr())
        return &worker.current().rows;
    for (const auto& [run, rows] : measured_)
        if (run == recording)
            return &rows;
    // The same scene has the same frames, so values of another run of it serve as well.
    if (recording != nullptr)
        for (const MetricValues& values : worker.earlier())
            if (values.scene == recording->scene_ptr() && values.frame_count() >= recording->frame_count())
                return &values.rows;
    return nullptr;
}

std::pair<std::string, double> Compare::measuring() const {
    if (metrics_job_ == nullptr)
        return {{}, 1.0};
    return {metrics_job_->recording == a_.recording ? a_.name : b_.name, metrics_job_->fraction.load()};
}

/// Measures what is not measured yet, one run at a time.
void Compare::measure(const EditorContext& context) {
    std::erase_if(given_up_, [](const std::unique_ptr<MetricsJob>& job) { return job->done(); });
    std::erase_if(measured_, [&](const auto& entry) {
        return context.features.shelf.find(entry.first) == nullptr && entry.first != pair_a_ &&
               entry.first != pair_b_;
    });
    if (metrics_job_ != nullptr && metrics_job_->recording != pair_a_ && metrics_job_->recording != pair_b_) {
        metrics_job_->stop = true;
        given_up_.push_back(std::move(metrics_job_));
    }
    if (metrics_job_ != nullptr && metrics_job_->done()) {
        MetricRows rows;
        try {
            rows = metrics_job_->result.get();
        } catch (const std::exception& problem) {
            context.log.add(Severity::error, problem.what());
        }
        measured_.emplace_back(metrics_job_->recording, std::move(rows));
        metrics_job_ = nullptr;
    }
    if (metrics_wanted_ == 0 || !reason_.empty() || metrics_job_ != nullptr)
        return;
    for (const RecordingPtr& recording : {pair_a_, pair_b_}) {
        // The editor measures the present run by itself, and one under way has more frames to come.
        if (recording == context.runs.recording() || recording->state() == RunState::running ||
            metrics_of(context, recording) != nullptr)
            continue;
        metrics_job_ = std::make_unique<MetricsJob>();
        metrics_job_->recording = recording;
        metrics_job_->result = std::async(std::launch::async, [job = metrics_job_.get()] {
            JobControl control;
            control.cancel = &job->stop;
            control.report = [job](std::string_view, double fraction) { job->fraction = fraction; };
            return measure_run(*job->recording, 1, control);
        });
        return;
    }
}

void Compare::blink_on(double now) {
    now_seconds_ = now;
    if (!active(CompareMode::blink) || !choice.blinks_by_itself) {
        flip_at_ = now + choice.blink_seconds;
        return;
    }
    if (now >= flip_at_) {
        choice.shows_b = !choice.shows_b;
        flip_at_ = now + choice.blink_seconds;
    }
}

void Compare::update(EditorContext& context) {
    resolve(context);
    aside_ = context.state.tool == Tool::paint || context.features.motion.preview() != nullptr;
    reason_ = pair_reason_;
    for (const ComparedRun* run : {&a_, &b_})
        if (reason_.empty() && run->recording->frame_count() == 0)
            reason_ = run->name + " has no frames yet";
    if (choice.mode != CompareMode::off || distances_wanted_ > 0)
        compare_frames();
    follow_playhead(context.playhead());
    measure(context);
    metrics_a_ = metrics_of(context, a_.recording);
    metrics_b_ = metrics_of(context, b_.recording);
    distances_wanted_ = std::max(0, distances_wanted_ - 1);
    metrics_wanted_ = std::max(0, metrics_wanted_ - 1);
    blink_on(context.now);
    // Another colouring was chosen: it would not be seen under the difference map.
    if (choice.mode != last_mode_)
        colouring_ = context.state.colouring;
    if (choice.mode == CompareMode::difference && context.state.colouring != colouring_)
        choice.mode = CompareMode::off;
    last_mode_ = choice.mode;
    if (choice.mode != CompareMode::blink)
        choice.shows_b = false;
}

void Compare::finish() const {
    if (job_.valid())
        job_.wait();
    if (metrics_job_ != nullptr)
        metrics_job_->result.wait();
}

void Compare::document_replaced(EditorContext&) {
    choice.mode = CompareMode::off;
    choice.a = choice.b = automatic_run;
    a_ = b_ = {};
    forget_pair();
    pair_a_ = pair_b_ = nullptr;
    key_ = {};
    measured_.clear();
    metrics_a_ = metrics_b_ = nullptr;
    reason_ = pair_reason_ = "there is no run yet";
}

std::optional<double> Compare::redraw_after() const {
    std::optional<double> next;
    const auto no_later_than = [&](double seconds) { next = std::min(next.value_or(seconds), seconds); };
    if (job_.valid() || metrics_job_ != nullptr || !given_up_.empty())
        no_later_than(1.0 / 25);
    if (active(CompareMode::blink) && choice.blinks_by_itself)
        no_later_than(std::max(0.0, flip_at_ - now_seconds_));
    if (active(CompareMode::side_by_side) && second_view_ != nullptr && second_view_->refinement_pending())
        no_later_than(SceneView::refine_after_seconds / 2);
    return next;
}

} // namespace fascicle::editor
