#include "solver/fast/thread_choice.hpp"

#include <algorithm>

namespace fascicle::solver::fast {

void ThreadChoice::record(double seconds) {
    ++frames_;
    if (frames_ == 1) // caches and sleeping threads: not typical
        return;
    mean_ = frames_ == 2 ? seconds : mean_ + 0.2 * (seconds - mean_);
    if (!alone_)
        best_team_ = best_team_ == 0.0 ? seconds : std::min(seconds, best_team_ * 1.002);
    if (frames_ < trial_frames)
        return;
    const bool worse = other_ > 0.0 && mean_ > other_;
    const bool look = alone_ ? frames_ >= stay_frames : mean_ > slow * best_team_;
    if (frames_ == trial_frames ? worse : look) {
        other_ = mean_;
        switch_to(!alone_);
    }
}

} // namespace fascicle::solver::fast
