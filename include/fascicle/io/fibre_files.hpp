#pragma once
// The files of fibres: fibres.csv and fibres/<muscle>.<frame>.vtp. Names, columns and arrays are a promise to other
// programs (docs/cli.md).

#include "fascicle/io/mesh_data.hpp"
#include "fascicle/metrics/fibre_series.hpp"

#include <filesystem>

namespace fascicle {

/// Writes fibres.csv: frame, muscle, fibre (from 0), angle_deg (as in metrics.csv), then the keys of fibre_quantities().
/// One row per frame, muscle and fibre, in this order; values that are not defined are nan. All series have the same
/// frames (muscles without fibres have no series). The file is complete or not there; Error when it cannot be written.
void write_fibre_table(const std::filesystem::path& file, const std::vector<const FibreSeries*>& series);

/// Removes a table that write_fibre_table wrote; another file of that name is left alone.
void remove_fibre_table(const std::filesystem::path& path);

/// The polylines of a frame, points in scene units. Per line: fibre_id (from 0) and the keys of fibre_quantities(); per
/// point: stretch (length against rest there) and tangent (3). The series has the frame; `fibres`: its points, the ones
/// that were appended. An array with a value that is not defined is left out: readers of ascii VTP stop at "nan".
MeshData fibre_lines(const FibreSeries& series, int frame, const FibreSet& fibres);
/// The same where there is no series: per line fibre_id and length_mm, per point tangent.
MeshData fibre_lines(const FibreSet& fibres, double unit_mm);

/// fibres/<muscle>.<frame, at least 4 digits>.vtp, relative to a run's folder.
std::filesystem::path fibre_file(std::string_view muscle, int frame);

} // namespace fascicle
