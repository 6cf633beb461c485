#pragma once
// ParaView's file of a series of files over time (.pvd).

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fascicle {

/// Time in seconds and file of each step, files relative to the .pvd file. The file is complete or not there; Error naming it when it
/// cannot be written.
void write_series_file(const std::filesystem::path& path,
                       const std::vector<std::pair<double, std::string>>& series);

/// The steps of a series file, in its order; parts, groups and names are passed over. Nothing is opened. Error naming file and line.
std::vector<std::pair<double, std::string>> parse_series(std::string_view bytes, const std::string& file);
bool looks_like_series(std::string_view bytes);

} // namespace fascicle
