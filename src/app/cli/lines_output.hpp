#pragma once
// What `fascicle lines` writes and prints.

#include "fascicle/anatomy/line_measure.hpp"

#include <filesystem>
#include <iosfwd>

namespace fascicle::app {

/// A muscle in a frame.
struct LinesRow {
    double coordinate_value = 0; ///< rad
    LineMeasure line;
    std::optional<StringMeasure> string;
};

struct LinesResult {
    int coordinate = -1;
    std::vector<LinesRow> rows; ///< frame by frame, all muscles of the model each
    std::vector<double> times;  ///< per frame
    std::vector<std::string> notes;
};

/// lines.csv (docs/cli.md).
void write_lines_csv(const std::filesystem::path& folder, const LineModel& model, const LinesResult& result);

/// frames/lines.<frame>.vtp and lines.pvd; with bones frames/strings.<frame>.vtp and strings.pvd. Metres, ground.
void write_lines_vtp(const std::filesystem::path& folder, const LineModel& model, const LinesResult& result);

void print_lines(std::ostream& out, const LineModel& model, const LinesResult& result);

} // namespace fascicle::app
