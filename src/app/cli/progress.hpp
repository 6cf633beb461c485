#pragma once
// Progress of long work for a person who waits: a bar on a terminal, plain lines in a file or pipe.

#include <iosfwd>
#include <string>

namespace fascicle::app {

struct Progress {
    std::string stage;   ///< e.g. "prepare"
    double fraction = 0; ///< of the stage, 0 to 1
    int done = 0;        ///< frames done of `total`; total 0: the stage does not count frames
    int total = 0;
};

class ProgressDisplay {
public:
    enum class Style { none, lines, bar };

    /// columns: width of the terminal, for the bar.
    ProgressDisplay(std::ostream& out, Style style, int columns = 80);
    /// A bar when standard error is a terminal; otherwise lines on standard output, so that standard error holds
    /// errors alone; nothing when quiet.
    static ProgressDisplay for_user(bool quiet);

    /// May be called as often as one likes: the bar is redrawn at most ten times a second, a line is written when a
    /// stage begins and, where frames are counted, at every tenth of them. `now`: seconds on any steady clock.
    void update(const Progress& progress, double now);
    /// Wipes the bar. To be called before anything else is written to the terminal.
    void finish();

private:
    void draw_bar(const Progress& progress, double now);
    void write_line(const Progress& progress, double now);
    /// "12.3 frames/s, 0:04 left", empty as long as there is nothing to go by.
    std::string rate_text(const Progress& progress, double now) const;

    std::ostream& out_;
    Style style_;
    int columns_;
    std::string stage_;
    double stage_start_ = 0;
    int stage_done_ = 0; ///< frames done when the stage began
    int next_tenth_ = 0;
    double last_drawn_ = 0;
    bool drawn_ = false;
};

/// Minutes and seconds, or hours too: "0:04", "12:30", "1:02:03".
std::string duration_text(double seconds);

} // namespace fascicle::app
