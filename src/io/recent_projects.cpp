#include "fascicle/io/recent_projects.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/io/files.hpp"
#include "io/json_fields.hpp"

#include <algorithm>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

fs::path list_path(const fs::path& user_folder) {
    return user_folder / "recent.json";
}

fs::path normal(const fs::path& path) {
    std::error_code error;
    const fs::path full = fs::absolute(path, error);
    return (error ? path : full).lexically_normal();
}

std::int64_t seconds_of(const io::JsonFields& entry) {
    constexpr double most =
        1e15; // 30 million years; what is beyond cannot be a time, nor always be converted
    return static_cast<std::int64_t>(std::clamp(entry.number("time", 0), -most, most));
}

void write_list(const fs::path& user_folder, const std::vector<RecentProject>& projects) {
    io::Json list = io::Json::array();
    for (const RecentProject& p : projects)
        list.push_back({{"path", p.path.string()}, {"name", p.name}, {"time", p.time}});
    write_file(list_path(user_folder),
               io::Json{{"recent", list}}.dump(2, ' ', false, io::Json::error_handler_t::replace) + "\n");
}

void remove_entry(const fs::path& user_folder, std::vector<RecentProject>& projects, const fs::path& path) {
    std::error_code ignored;
    std::erase_if(projects, [&](const RecentProject& p) { return p.path == path; });
    while (projects.size() > recent_projects_kept) {
        fs::remove(recent_picture(user_folder, projects.back().path), ignored);
        projects.pop_back();
    }
}

} // namespace

std::vector<RecentProject> read_recent_projects(const fs::path& user_folder) {
    const fs::path file = list_path(user_folder);
    std::error_code error;
    if (user_folder.empty() || !fs::exists(file, error))
        return {};
    try {
        return parse_recent_projects(read_file(file, std::size_t{1} << 20), file.string());
    } catch (const Error&) {
        return {};
    }
}

std::vector<RecentProject> parse_recent_projects(std::string_view text, const std::string& file) {
    std::vector<RecentProject> projects;
    const io::Json json = io::parse_json_object(text, file);
    for (const io::JsonFields& entry : io::JsonFields(json, file, "").objects("recent"))
        if (const std::string path = entry.text("path"); !path.empty())
            projects.push_back({path, entry.text("name"), seconds_of(entry)});
    projects.resize(std::min(projects.size(), recent_projects_kept));
    return projects;
}

void add_recent_project(const fs::path& user_folder, const RecentProject& project,
                        const std::optional<PngImage>& picture) {
    if (user_folder.empty())
        return;
    std::vector<RecentProject> projects = read_recent_projects(user_folder);
    RecentProject entry = project;
    entry.path = normal(project.path);
    std::erase_if(projects, [&](const RecentProject& p) { return p.path == entry.path; });
    projects.insert(projects.begin(), entry);
    remove_entry(user_folder, projects, {});
    if (picture)
        write_png(recent_picture(user_folder, entry.path), picture->width, picture->height,
                  picture->rgba.data());
    write_list(user_folder, projects);
}

void remove_recent_project(const fs::path& user_folder, const fs::path& path) {
    std::vector<RecentProject> projects = read_recent_projects(user_folder);
    remove_entry(user_folder, projects, path);
    std::error_code ignored;
    fs::remove(recent_picture(user_folder, path), ignored);
    write_list(user_folder, projects);
}

fs::path recent_picture(const fs::path& user_folder, const fs::path& path) {
    const std::string text = normal(path).string();
    StateHash hash;
    hash.add_bytes(text.data(), text.size());
    return user_folder / "pictures" / (hash.hex() + ".png");
}

} // namespace fascicle
