#include "editor/run_manager.hpp"

#include "fascicle/base/assert.hpp"
#include "fascicle/document/actions/timeline_actions.hpp"

#include <algorithm>

namespace fascicle::editor {

bool same_bodies(const Scene& a, const Scene& b) {
    const auto same_mesh = [](const auto& x, const auto& y) { return x.mesh == y.mesh; };
    return std::equal(a.bones.begin(), a.bones.end(), b.bones.begin(), b.bones.end(), same_mesh) &&
           std::equal(a.muscles.begin(), a.muscles.end(), b.muscles.begin(), b.muscles.end(), same_mesh);
}

namespace {

/// Whether a run of one scene is as good as a run of the other: only names differ.
bool same_problem(const Scene& a, const Scene& b) {
    const auto same_muscle = [](const Muscle& x, const Muscle& y) {
        const auto same_attachment = [](const Attachment& p, const Attachment& q) {
            return p.bone == q.bone && p.kind == q.kind && p.vertices == q.vertices;
        };
        const auto same_outline = [](const AttachmentOutline& p, const AttachmentOutline& q) {
            return p.bone == q.bone && p.kind == q.kind && p.points == q.points && p.head == q.head &&
                   p.hole == q.hole;
        };
        return x.attach_automatically == y.attach_automatically && x.attach_to == y.attach_to &&
               x.surface_fibres == y.surface_fibres && x.fibre_template == y.fibre_template &&
               std::equal(x.attachments.begin(), x.attachments.end(), y.attachments.begin(),
                          y.attachments.end(), same_attachment) &&
               std::equal(x.outlines.begin(), x.outlines.end(), y.outlines.begin(), y.outlines.end(),
                          same_outline) &&
               x.areas == y.areas;
    };
    return same_bodies(a, b) && a.unit == b.unit && a.parameters == b.parameters &&
           actions::same_timeline(a.timeline, b.timeline) &&
           std::equal(a.muscles.begin(), a.muscles.end(), b.muscles.begin(), b.muscles.end(), same_muscle);
}

bool same_names(const Scene& a, const Scene& b) {
    const auto same = [](const auto& x, const auto& y) { return x.name == y.name; };
    return std::equal(a.bones.begin(), a.bones.end(), b.bones.begin(), b.bones.end(), same) &&
           std::equal(a.muscles.begin(), a.muscles.end(), b.muscles.begin(), b.muscles.end(), same);
}

int count(const RecordingPtr& recording) {
    return recording == nullptr ? 0 : recording->frame_count();
}

} // namespace

RunManager::RunManager(StartRun start) : start_(std::move(start)) {}

RunManager::~RunManager() {
    if (run_ != nullptr)
        run_->cancel(); // all at once, then wait for each
}

void RunManager::show(RecordingPtr recording) {
    retire();
    recording_ = std::move(recording);
    previous_ = nullptr;
    previous_same_ = false;
    head_ = recording_->scene_ptr();
    outdated_ = stopped_ = false;
}

void RunManager::forget() {
    retire();
    recording_ = previous_ = nullptr;
    previous_same_ = false;
    head_ = nullptr;
    outdated_ = stopped_ = false;
}

void RunManager::retire() {
    if (run_ == nullptr)
        return;
    run_->cancel();
    retired_.push_back(std::move(run_));
}

void RunManager::update(const ScenePtr& head, bool held, double now) {
    now_ = now;
    std::erase_if(retired_, [](const std::unique_ptr<Run>& run) { return run->done(); });
    if (head != head_) {
        head_ = head;
        changed_ = now;
        stopped_ = false;
    }
    const bool first = recording_ == nullptr;
    const bool outdated = first || !same_problem(recording_->scene(), *head_);
    if (outdated && !outdated_)
        changed_ = now;
    outdated_ = outdated || held;
    if (!outdated)
        take_names();
    if (held)
        changed_ = now;
    const bool settled = first || now - changed_ >= settle_seconds;
    // One run at a time: the old one lets go of its threads first.
    if (outdated && !held && settled && !stopped_ && start_ != nullptr && !head_->muscles.empty()) {
        if (run_ != nullptr)
            retire();
        if (retired_.empty())
            begin(now);
    }
}

void RunManager::take_names() {
    for (const RecordingPtr& recording : {recording_, previous_same_ ? previous_ : nullptr})
        if (recording != nullptr && !same_names(recording->scene(), *head_))
            recording->rename(head_);
}

void RunManager::begin(double now) {
    if (recording_ != nullptr) {
        const bool older_is_longer =
            previous_ != nullptr && count(previous_) > count(recording_) &&
            same_bodies(previous_->scene(), *head_) &&
            (!same_problem(recording_->scene(), *head_) || same_problem(previous_->scene(), *head_));
        if (!older_is_longer)
            previous_ = recording_;
    }
    previous_same_ = previous_ != nullptr && same_problem(previous_->scene(), *head_);
    run_ = start_(head_);
    recording_ = run_->recording();
    started_ = now;
    outdated_ = false;
}

void RunManager::restart() {
    if (start_ == nullptr || head_ == nullptr || head_->muscles.empty())
        return;
    retire();
    stopped_ = false;
    begin(now_);
}

void RunManager::compute_on() {
    if (!running() && !outdated_ && recording_ != nullptr && retired_.empty() &&
        recording_->state() == RunState::cancelled)
        restart();
}

void RunManager::cancel() {
    stopped_ = true;
    if (run_ != nullptr)
        run_->cancel();
}

bool RunManager::running() const {
    return run_ != nullptr && !run_->done();
}

std::pair<std::string, double> RunManager::progress() const {
    return run_ == nullptr ? std::pair<std::string, double>{} : run_->progress();
}

ShownFrame RunManager::at(int k) const {
    if (k < valid_count()) {
        const RecordingPtr& source = k < count(recording_) ? recording_ : previous_;
        return {source->frame(k), source, FrameState::valid};
    }
    for (const RecordingPtr& candidate : {recording_, previous_})
        if (k < count(candidate) && same_bodies(candidate->scene(), *head_))
            return {candidate->frame(k), candidate, FrameState::stale};
    return {};
}

ShownFrame RunManager::at_or_before(int k) const {
    const int last = std::min(k, available_count() - 1);
    return last < 0 ? ShownFrame{} : at(last);
}

int RunManager::valid_count() const {
    return outdated_ ? 0 : std::max(count(recording_), previous_same_ ? count(previous_) : 0);
}

int RunManager::available_count() const {
    int result = valid_count();
    for (const RecordingPtr& candidate : {recording_, previous_})
        if (candidate != nullptr && same_bodies(candidate->scene(), *head_))
            result = std::max(result, count(candidate));
    return result;
}

} // namespace fascicle::editor
