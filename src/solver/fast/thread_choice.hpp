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

    /// Frames that are judged together, by the fastest of them: a single slow frame (a new matrix, say) means nothing.
    static constexpr int window = 6;
    static constexpr int stay_windows = 10; ///< how long one thread goes on before the team is tried again
    static constexpr double slow = 1.7;     ///< times the team's best: worth a look at the other way

private:
    bool alone_ = false;
    int frames_ = 0;       ///< in this window
    int windows_ = 0;      ///< since the last switch
    double fastest_ = 0;   ///< of this window, s; 0: none yet
    double best_team_ = 0; ///< fastest frame of the team so far, slowly forgotten; 0: none yet
    double other_ = 0;     ///< fastest of the last window of the way that was left, 0 at the start
};

} // namespace fascicle::solver::fast
