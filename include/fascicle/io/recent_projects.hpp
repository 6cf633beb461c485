#pragma once
// Projects that were opened or saved lately: recent.json in the user's folder, with a small picture of each.

#include "fascicle/io/png.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fascicle {

struct RecentProject {
    std::filesystem::path path; ///< absolute
    std::string name;           ///< of the scene
    std::int64_t time = 0;      ///< when it was opened or saved last, seconds since 1970
    bool operator==(const RecentProject&) const = default;
};

inline constexpr std::size_t recent_projects_kept = 12;

/// The latest first; files that are not there any more are listed too. A damaged list is an empty one.
std::vector<RecentProject> read_recent_projects(const std::filesystem::path& user_folder);
/// The same from the text of a recent.json. Error naming `file` and the field when it is damaged.
std::vector<RecentProject> parse_recent_projects(std::string_view text, const std::string& file);
/// Puts it in front (or moves it there). A picture replaces the one that there was. Error when it cannot be written.
void add_recent_project(const std::filesystem::path& user_folder, const RecentProject& project,
                        const std::optional<PngImage>& picture = {});
/// From the list, with its picture; the project's file stays.
void remove_recent_project(const std::filesystem::path& user_folder, const std::filesystem::path& path);
/// Where the picture of a project is, or would be.
std::filesystem::path recent_picture(const std::filesystem::path& user_folder,
                                     const std::filesystem::path& path);

} // namespace fascicle
