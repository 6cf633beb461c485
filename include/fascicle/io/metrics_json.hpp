#pragma once
// The tables of a run as one JSON document.

#include <filesystem>
#include <string>

namespace fascicle {

/// From a folder that RunWriter left: {"format": "fascicle metrics", "version": 1, "run": summary.json, "metrics": [row, ...], "fibres":
/// [row, ...]}. A row is an object with the columns of metrics.csv (fibres.csv) as keys; numbers that are not finite are null. "fibres" is
/// left out where there are none. Error naming the file that is missing or bad.
std::string metrics_json(const std::filesystem::path& run);

} // namespace fascicle
