#pragma once
// Names of the files of a run, shared by writer and reader.

#include <filesystem>
#include <string>
#include <string_view>

namespace fascicle::io {

/// frames/<muscle>, the name as file_name_for makes it (base/text.hpp), .<frame, at least 4 digits>.vtp, relative to the run's folder.
std::filesystem::path frame_file(std::string_view muscle, int frame);
std::filesystem::path bone_file(std::string_view bone);
std::filesystem::path series_file(std::string_view muscle);
/// Frame number when the file is a frame of the muscle, else -1.
int frame_of_file(const std::filesystem::path& file, std::string_view muscle);

/// Names of per-point arrays in frames.
inline constexpr const char* attachment_array = "attachment"; ///< 0 none, 1 origin, 2 insertion, 3 not known
inline constexpr const char* attached_to_array = "attached_to"; ///< index of the bone in summary.json, or -1

} // namespace fascicle::io
