#include "solver/fast/thread_choice.hpp"

#include <algorithm>

namespace fascicle::solver::fast {

void ThreadChoice::record(double seconds) {
    if (++frames_ > 1) // the first one has cold caches and sleeping threads
        fastest_ = fastest_ == 0.0 ? seconds : std::min(fastest_, seconds);
    if (frames_ < window)
        return;
    if (!alone_)
        best_team_ = best_team_ == 0.0 ? fastest_ : std::min(fastest_, best_team_ * 1.01);
    ++windows_;
    const bool worse = windows_ == 1 && other_ > 0.0 && fastest_ > other_;
    const bool look = alone_ ? windows_ >= stay_windows : fastest_ > slow * best_team_;
    if (worse || look) {
        other_ = fastest_;
        alone_ = !alone_;
        windows_ = 0;
    }
    frames_ = 0;
    fastest_ = 0.0;
}

} // namespace fascicle::solver::fast
