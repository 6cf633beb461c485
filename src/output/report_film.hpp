#pragma once
// Collects the pictures of a report, measures the run, and writes the page.

#include "output/export_job.hpp"
#include "output/film.hpp"

namespace fascicle::output {

/// The pictures of a report: rest, the frame furthest from it, the end, and the strain where it is furthest; those that there are.
/// Camera, background and visibility as in `look`; size and colouring are the report's.
std::vector<Shot> report_shots(const Recording& recording, const PictureLook& look);

class ReportFilm : public Film {
public:
    /// titles: of the pictures, in order. measured: rows of the frames so far, may be null or too short.
    ReportFilm(const ExportRequest& request, RecordingPtr recording, std::vector<std::string> titles,
               std::shared_ptr<const MeasuredRows> measured);
    void add(const render::Image& image, int frame) override;
    void finish(const JobControl& control) override;

private:
    ExportRequest request_;
    RecordingPtr recording_;
    std::vector<std::string> titles_;
    std::shared_ptr<const MeasuredRows> measured_;
    std::vector<std::pair<render::Image, int>> pictures_;
};

} // namespace fascicle::output
