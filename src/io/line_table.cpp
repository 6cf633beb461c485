#include "fascicle/io/line_table.hpp"

#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"
#include "io/own_table.hpp"

#include <numbers>

namespace fascicle {

namespace {

constexpr const char* header = "frame,muscle,angle_deg,length_mm,moment_arm_mm";

} // namespace

void write_line_table(const std::filesystem::path& path, const LineSeries& series) {
    AtomicFile file(path);
    CsvWriter csv(file.stream());
    for (const char* column : {"frame", "muscle", "angle_deg", "length_mm", "moment_arm_mm"})
        csv.text(column);
    for (const std::string& coordinate : series.coordinates)
        csv.text("moment_arm_" + coordinate + "_mm");
    csv.end_row();
    const std::size_t more = series.coordinates.size();
    for (std::size_t k = 0; k < series.frames.size(); ++k)
        for (std::size_t m = 0; m < series.muscles.size(); ++m) {
            csv.integer(series.frames[k]).text(series.muscles[m]);
            csv.number(series.angles_rad[k] * 180.0 / std::numbers::pi);
            csv.number(series.length_mm(k, m)).number(series.moment_arm_mm(k, m));
            for (std::size_t c = 0; c < more; ++c)
                csv.number(series.coordinate_arms_mm[(k * series.muscles.size() + m) * more + c]);
            csv.end_row();
        }
    file.commit();
}

void remove_line_table(const std::filesystem::path& path) {
    io::remove_own_table(path, header);
}

} // namespace fascicle
