#include "fascicle/io/settings_file.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/json_fields.hpp"

#include <algorithm>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_bytes = 1 << 20;

} // namespace

Settings read_settings(const fs::path& path) {
    return parse_settings(read_file(path, most_bytes), path.string());
}

Settings parse_settings(std::string_view text, const std::string& file) {
    const io::Json json = io::parse_json_object(text, file);
    Settings settings;
    for (const auto& [key, value] : json.items())
        if (value.is_boolean())
            settings[key] = value.get<bool>();
        else if (value.is_number())
            settings[key] = value.get<double>();
        else if (value.is_string())
            settings[key] = value.get<std::string>();
    return settings;
}

void write_settings(const fs::path& path, const Settings& settings) {
    io::Json json = io::Json::object();
    std::error_code code;
    if (fs::exists(path, code)) {
        try {
            json = io::parse_json_object(read_file(path, most_bytes), path.string());
        } catch (const Error&) {
            json = io::Json::object(); // nothing in it that could be kept
        }
    }
    for (const auto& [key, value] : settings)
        std::visit([&, name = key](const auto& v) { json[name] = v; }, value);
    write_file(path, json.dump(2, ' ', false, io::Json::error_handler_t::replace) + "\n");
}

std::map<std::string, std::vector<std::string>> read_text_lists(const fs::path& path,
                                                                std::vector<std::string>& bad) {
    return parse_text_lists(read_file(path, most_bytes), path.string(), bad);
}

std::map<std::string, std::vector<std::string>>
parse_text_lists(std::string_view text, const std::string& file, std::vector<std::string>& bad) {
    const io::Json json = io::parse_json_object(text, file);
    std::map<std::string, std::vector<std::string>> lists;
    for (const auto& [key, value] : json.items()) {
        std::vector<std::string>& list = lists[key];
        const bool texts = value.is_array() && std::all_of(value.begin(), value.end(),
                                                           [](const io::Json& v) { return v.is_string(); });
        if (!texts)
            bad.push_back(key);
        else
            for (const io::Json& v : value)
                list.push_back(v.get<std::string>());
    }
    return lists;
}

} // namespace fascicle
