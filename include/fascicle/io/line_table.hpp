#pragma once
// lines.csv of a run: lengths and moment arms of line muscles.

#include "fascicle/metrics/line_series.hpp"

#include <filesystem>

namespace fascicle {

/// A row per frame and muscle: frame,muscle,angle_deg,length_mm,moment_arm_mm; arms that are not known are nan.
void write_line_table(const std::filesystem::path& path, const LineSeries& series);

/// Removes a table that write_line_table wrote; another file of that name (such as of `fascicle lines`) is left alone.
void remove_line_table(const std::filesystem::path& path);

} // namespace fascicle
