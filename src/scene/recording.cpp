#include "fascicle/scene/recording.hpp"

#include "fascicle/base/assert.hpp"

#include <utility>

namespace fascicle {

ScenePtr Recording::scene_ptr() const {
    const std::lock_guard lock(mutex_);
    return scene_;
}

void Recording::rename(ScenePtr scene) {
    FASCICLE_ASSERT(scene->muscles.size() == scene_->muscles.size() &&
                    scene->bones.size() == scene_->bones.size());
    const std::lock_guard lock(mutex_);
    former_.push_back(std::exchange(scene_, std::move(scene)));
    now_.store(scene_.get(), std::memory_order_release);
}

void Recording::set_attachments(std::vector<std::vector<Attachment>> attachments) {
    const std::lock_guard lock(mutex_);
    attachments_ = std::move(attachments);
}

std::vector<std::vector<Attachment>> Recording::attachments() const {
    const std::lock_guard lock(mutex_);
    return attachments_;
}

void Recording::set_fibres(std::vector<FibreModelPtr> fibres) {
    const std::lock_guard lock(mutex_);
    fibres_ = std::move(fibres);
}

std::vector<FibreModelPtr> Recording::fibres() const {
    const std::lock_guard lock(mutex_);
    return fibres_;
}

void Recording::add_note(std::string note) {
    const std::lock_guard lock(mutex_);
    notes_.push_back(std::move(note));
}

std::vector<std::string> Recording::notes() const {
    const std::lock_guard lock(mutex_);
    return notes_;
}

void Recording::set_prepare_seconds(double seconds) {
    const std::lock_guard lock(mutex_);
    prepare_seconds_ = seconds;
}

double Recording::prepare_seconds() const {
    const std::lock_guard lock(mutex_);
    return prepare_seconds_;
}

void Recording::append(FramePtr frame) {
    FASCICLE_ASSERT(frame != nullptr && frame->muscle_positions.size() == scene().muscles.size() &&
                    frame->bone_poses.size() == scene().bones.size());
    const std::lock_guard lock(mutex_);
    frames_.push_back(std::move(frame));
}

int Recording::frame_count() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(frames_.size());
}

FramePtr Recording::frame(int k) const {
    const std::lock_guard lock(mutex_);
    return k >= 0 && k < static_cast<int>(frames_.size()) ? frames_[static_cast<std::size_t>(k)] : nullptr;
}

FramePtr Recording::last_frame() const {
    const std::lock_guard lock(mutex_);
    return frames_.empty() ? nullptr : frames_.back();
}

RunState Recording::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

std::string Recording::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void Recording::finish(RunState state, std::string failure) {
    const std::lock_guard lock(mutex_);
    state_ = state;
    failure_ = std::move(failure);
}

} // namespace fascicle
