#pragma once
// Small files of settings: one JSON object of names and values, for what a program remembers of its user.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace fascicle {

using SettingValue = std::variant<bool, double, std::string>;
using Settings = std::map<std::string, SettingValue>;

/// The values of a file; those of other kinds (lists, objects, null) are passed over. Error when it cannot be read, is larger
/// than 1 MB or no JSON object.
Settings read_settings(const std::filesystem::path& path);
/// The same from text in memory; `file` is the name in messages.
Settings parse_settings(std::string_view text, const std::string& file);
/// Puts the values into the file (AtomicFile); what else it has stays, as long as it is a JSON object. Error as write_file().
void write_settings(const std::filesystem::path& path, const Settings& settings);

/// Names with lists of texts, for keys of one's own. A value that is no list of texts becomes an empty list with its name in
/// `bad`. Error as read_settings().
std::map<std::string, std::vector<std::string>> read_text_lists(const std::filesystem::path& path,
                                                                std::vector<std::string>& bad);
std::map<std::string, std::vector<std::string>>
parse_text_lists(std::string_view text, const std::string& file, std::vector<std::string>& bad);

} // namespace fascicle
