#pragma once
// A run as one HTML page: pictures, plots, numbers. Needs no other file, no script and no network.

#include "fascicle/scene/recording.hpp"
#include "render/draw_list.hpp"

namespace fascicle::output {

inline constexpr const char* strain_title = "Strain";

struct ReportPicture {
    std::string title;
    int frame = 0;
    render::Image image;
};

struct ReportInput {
    RecordingPtr recording;
    std::vector<std::vector<std::vector<double>>> rows; ///< by frame, muscle, row of metric_table()
    int furthest = 0;                                   ///< place of the frame furthest from rest
    std::vector<ReportPicture> pictures;
    std::string date; ///< as it is shown
};

/// The page, UTF-8. Names are escaped; numbers have a dot in every locale. Light or dark as the reader's system is.
std::string html_report(const ReportInput& input);

} // namespace fascicle::output
