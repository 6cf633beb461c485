#include "output/report_film.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/metrics/metric_table.hpp"
#include "fascicle/metrics/muscle_measure.hpp"
#include "output/html_report.hpp"
#include "output/run_pictures.hpp"
#include "output/staged_files.hpp"

#include <ctime>

namespace fascicle::output {

namespace {

constexpr int picture_width = 1080, picture_height = 720;

/// Local time, to the minute.
std::string now_text() {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", &local);
    return text;
}

MeasuredRows measure(const Recording& recording, int count, int threads, const JobControl& control) {
    MeasuredRows rows;
    MetricsEngine engine(recording, threads);
    for (int k = 0; k < count; ++k) {
        control.checkpoint("measuring", double(k) / count);
        rows.push_back(engine.measure(*recording.frame(k)));
    }
    // Numbers that the whole run decides.
    const auto& table = metric_table();
    for (std::size_t m = 0; m < recording.scene().muscles.size(); ++m)
        if (const FibreMeasure* fibres = engine.muscle(static_cast<int>(m)).fibres())
            for (std::size_t r = 0; r < table.size(); ++r)
                for (int k = 0; k < count && table[r].over_run != nullptr; ++k)
                    rows[static_cast<std::size_t>(k)][m][r] = table[r].over_run(fibres->series(), k);
    return rows;
}

} // namespace

std::vector<Shot> report_shots(const Recording& recording, const PictureLook& look) {
    if (recording.frame_count() == 0)
        throw_error("report", "nothing is computed yet", "a run with at least its rest frame");
    PictureLook own = look;
    own.width = picture_width;
    own.height = picture_height;
    own.transparent = false;
    own.line_scale = 1;
    own.options.colouring = view::Colouring::anatomy;
    own.options.selected_bone = own.options.selected_muscle = -1;
    const int last = recording.frame_count() - 1, flexed = most_flexed_frame(recording);
    std::vector<Shot> shots{{0, own, "At rest"}};
    if (flexed > 0)
        shots.push_back({flexed, own, "Furthest from rest"});
    if (last > 0 && last != flexed)
        shots.push_back({last, own, "At the end"});
    if (last > 0) {
        own.options.colouring = view::Colouring::strain;
        shots.push_back({flexed > 0 ? flexed : last, own, strain_title});
    }
    return shots;
}

ReportFilm::ReportFilm(const ExportRequest& request, RecordingPtr recording, std::vector<std::string> titles,
                       std::shared_ptr<const MeasuredRows> measured)
    : request_(request), recording_(std::move(recording)), titles_(std::move(titles)),
      measured_(std::move(measured)) {
    check_no_input(request_.target, recording_->scene());
}

void ReportFilm::add(const render::Image& image, int frame) {
    pictures_.emplace_back(image, frame);
}

void ReportFilm::finish(const JobControl& control) {
    ReportInput input;
    input.recording = recording_;
    input.date = now_text();
    const int count = recording_->frame_count();
    if (measured_ != nullptr && static_cast<int>(measured_->size()) == count)
        input.rows = *measured_;
    else
        input.rows = measure(*recording_, count, request_.threads, control);
    input.furthest = most_flexed_frame(*recording_);
    for (std::size_t i = 0; i < pictures_.size(); ++i)
        input.pictures.push_back({titles_.at(i), pictures_[i].second, std::move(pictures_[i].first)});
    control.checkpoint("writing", 1);
    write_file(request_.target, html_report(input));
}

} // namespace fascicle::output
