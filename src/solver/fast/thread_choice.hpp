#pragma once
// Whether a frame is better solved by the whole team or by one thread: on a busy machine threads that wait for each other lose more
// than they gain. Results do not depend on the choice, so it may follow the clock.

namespace fascicle::solver::fast {

class ThreadChoice {
public:
    /// For the next frame.
    bool alone() const { return alone_; }
    /// What the last frame took, s.
    void record(double seconds);

    static constexpr int trial_frames =
        4; ///< length of a look at the other way; its first frame does not count
    static constexpr int stay_frames = 60; ///< how long one thread goes on before the team is tried again
    static constexpr double slow = 1.7;    ///< times the team's best: worth a look

private:
    void switch_to(bool alone) {
        alone_ = alone;
        frames_ = 0;
        mean_ = 0;
    }

    bool alone_ = false;
    int frames_ = 0;       ///< since the last switch
    double mean_ = 0;      ///< of recent frames since the switch, s
    double best_team_ = 0; ///< fastest frame of the team so far, slowly forgotten; 0: none yet
    double other_ = 0;     ///< mean of the way that was left at the last switch, 0 at the start
};

} // namespace fascicle::solver::fast
