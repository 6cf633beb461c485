#pragma once
// Results as JSON and as tables.

#include "reproduce/results.hpp"

namespace fascicle::reproduce {

/// Everything but times: identical for two runs of the same program on the same files.
std::string results_json(const Results& results);
/// Times alone: speed table, seconds of every run, machine's threads.
std::string timings_json(const Results& results);

/// curves.csv, fibre_lengths-<experiment>-<method>.csv, moment_arms.csv, surface_distances.csv, published_program.csv, sensitivity.csv,
/// and speed.csv (times), those that have rows, into a folder.
void write_tables(const Results& results, const std::filesystem::path& folder);

/// Whether a file of this name in the output folder is one of a report's: what an earlier report with more parts left.
bool is_report_file(const std::string& name);

} // namespace fascicle::reproduce
