#pragma once
// One export under way: pictures are drawn in small steps by whoever has the GL context, everything else happens on a thread of its
// own.

#include "output/export_kinds.hpp"
#include "output/frame_painter.hpp"

namespace fascicle::output {

/// rows[k][m][r]: frame, muscle, row of metric_table().
using MeasuredRows = std::vector<std::vector<std::vector<double>>>;

/// A picture that is drawn for an export.
struct Shot {
    int place = 0; ///< of the frame in the recording
    PictureLook look;
    std::string title; ///< in the report
    bool sample = false;
};

class ExportJob {
public:
    enum class State { running, done, failed, cancelled };

    /// Starts. measured: what is known of the recording already, for a report; may be null. Error (usage) when the request asks for
    /// frames that are not there.
    ExportJob(ExportRequest request, RecordingPtr recording, PictureLook look,
              std::shared_ptr<const MeasuredRows> measured = nullptr);
    /// Cancels, and waits for the thread: at most as long as a frame takes to measure or to write. The GL context of draw() must be current.
    ~ExportJob();
    ExportJob(const ExportJob&) = delete;
    ExportJob& operator=(const ExportJob&) = delete;

    /// Draws tiles for about `seconds`, at least one, unless the writing thread has enough to do. With the same GL context every time.
    void draw(double seconds);
    /// draw() and wait until it is over; Error with its reason when it failed. cancel: may be null.
    void finish(const std::atomic<bool>* cancel = nullptr,
                const std::function<void(double fraction)>& progress = nullptr);
    void cancel();

    const ExportRequest& request() const { return request_; }
    State state() const;
    std::string error() const;           ///< one line; empty unless failed
    double fraction() const;             ///< done, 0 to 1
    std::string stage() const;           ///< what is being done, a word or two
    int drawn() const { return drawn_; } ///< pictures, samples not counted
    int total() const { return total_; } ///< pictures in all; 0 when none are drawn

private:
    struct Worker;
    void plan(const PictureLook& look);

    ExportRequest request_;
    RecordingPtr recording_;
    std::vector<Shot> shots_;
    std::size_t next_ = 0; ///< of shots_, the one being drawn
    bool begun_ = false;
    int drawn_ = 0, total_ = 0;
    std::unique_ptr<FramePainter> painter_;
    std::unique_ptr<Worker> worker_;
};

} // namespace fascicle::output
