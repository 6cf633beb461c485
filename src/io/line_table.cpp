#include "fascicle/io/line_table.hpp"

#include "fascicle/io/csv.hpp"
#include "fascicle/io/files.hpp"

#include <numbers>

namespace fascicle {

namespace {

constexpr const char* header = "frame,muscle,angle_deg,length_mm,moment_arm_mm";

} // namespace

void write_line_table(const std::filesystem::path& path, const LineSeries& series) {
    AtomicFile file(path);
    CsvWriter csv(file.stream());
    file.stream() << header << '\n';
    for (std::size_t k = 0; k < series.frames.size(); ++k)
        for (std::size_t m = 0; m < series.muscles.size(); ++m) {
            csv.integer(series.frames[k]).text(series.muscles[m]);
            csv.number(series.angles_rad[k] * 180.0 / std::numbers::pi);
            csv.number(series.length_mm(k, m)).number(series.moment_arm_mm(k, m));
            csv.end_row();
        }
    file.commit();
}

void remove_line_table(const std::filesystem::path& path) {
    const std::string start = std::string(header) + '\n';
    if (read_head(path, start.size()) != start)
        return;
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

} // namespace fascicle
