#include "fascicle/io/staged_files.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <list>
#include <map>
#include <unistd.h>
#include <utility>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

constexpr const char* summary = "summary.json";

fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path found = fs::weakly_canonical(path, error);
    return error ? path : found;
}

/// "hip_0012.png": begin and end around the number of at least four digits, empty begin when it is none.
struct SeriesName {
    std::string begin, end;
    auto operator<=>(const SeriesName&) const = default;
};
SeriesName series_name(const fs::path& file) {
    const std::string name = file.filename().string(), end = file.extension().string();
    const std::string stem = name.substr(0, name.size() - end.size());
    const auto text_end = stem.find_last_not_of("0123456789");
    if (text_end == std::string::npos || stem.size() - text_end - 1 < 4)
        return {};
    return {(file.parent_path() / stem.substr(0, text_end + 1)).string(), end};
}

/// The number of a file of that series.
long number_in(const fs::path& file, const SeriesName& name) {
    const std::string text = file.string(); // name.begin has the folder, too
    return std::strtol(
        text.substr(name.begin.size(), text.size() - name.begin.size() - name.end.size()).c_str(), nullptr,
        10);
}

/// Sorted, but the summary last.
std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->is_regular_file(error))
            files.push_back(it->path().lexically_relative(folder));
    std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
        return std::pair(a == summary, a) < std::pair(b == summary, b);
    });
    return files;
}

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::error_code& error) {
    throw_error(shown_path(path), what + ": " + error.message());
}

fs::path without_slash(const fs::path& folder) {
    std::error_code error;
    const fs::path path = fs::absolute(folder, error).lexically_normal();
    return path.has_filename() ? path : path.parent_path(); // "out/" is "out"
}

/// Hidden folders of programs that are no longer there.
void remove_orphans(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (!name.starts_with(hidden_folder))
            continue;
        char* rest = nullptr;
        const long pid = std::strtol(name.c_str() + std::strlen(hidden_folder), &rest, 10);
        if (pid > 0 && *rest == '-' && ::kill(static_cast<pid_t>(pid), 0) != 0 && errno == ESRCH)
            found.push_back(it->path());
    }
    for (const fs::path& path : found)
        fs::remove_all(path, error);
}

/// Moves that are taken back unless they are kept.
class Moves {
public:
    Moves() = default;
    Moves(const Moves&) = delete;
    Moves& operator=(const Moves&) = delete;
    ~Moves() {
        std::error_code ignored;
        for (; !done_.empty(); done_.pop_back())
            fs::rename(done_.back().second, done_.back().first, ignored);
    }
    std::error_code move(const fs::path& from, const fs::path& to) {
        std::error_code error;
        fs::rename(from, to, error);
        if (!error)
            done_.emplace_back(from, to);
        return error;
    }
    void keep() { done_.clear(); }

private:
    std::vector<std::pair<fs::path, fs::path>> done_;
};

/// What lies before the new numbers of a series is somebody's; what lies behind them is of an earlier, longer one.
void remove_longer_series(const fs::path& folder, const std::vector<fs::path>& files,
                          const std::set<fs::path>& inputs) {
    std::map<SeriesName, long> last; // number of each series that was written
    std::set<fs::path> folders;
    for (const fs::path& file : files) {
        if (const SeriesName name = series_name(file); !name.end.empty())
            last[name] = std::max(last[name], number_in(file, name));
        folders.insert(file.parent_path());
    }
    std::vector<fs::path> stale;
    std::error_code error;
    for (const fs::path& part : folders)
        for (fs::directory_iterator it(folder / part, error), end; !error && it != end; it.increment(error)) {
            const fs::path file = part / it->path().filename();
            const SeriesName name = series_name(file);
            const auto found = last.find(name);
            if (found != last.end() && number_in(file, name) > found->second &&
                inputs.count(resolved(folder / file)) == 0)
                stale.push_back(file);
        }
    for (const fs::path& file : stale)
        fs::remove(folder / file, error);
}

} // namespace

void check_no_input(const fs::path& file, const Scene& scene) {
    for (const fs::path& input : inputs_of(scene))
        if (resolved(input) == resolved(file))
            throw_error(file.string(), "the scene was read from this file", "another name", ErrorKind::usage);
}

StagedFiles::StagedFiles(fs::path folder, Use use)
    : folder_(without_slash(folder)), use_(use), made_(folder_) {
    static std::atomic<int> counter{0};
    if (use == Use::alone)
        lock_.emplace(folder_);
    remove_orphans(folder_);
    place_ = folder_ / (hidden_folder + std::to_string(::getpid()) + "-" + std::to_string(counter++));
    std::error_code error;
    if (!fs::create_directory(place_, error) && !error)
        error = std::make_error_code(std::errc::file_exists);
    if (error) {
        place_.clear();
        fail(folder_, "cannot write into the folder", error);
    }
}

StagedFiles::~StagedFiles() {
    std::error_code ignored;
    if (!place_.empty())
        fs::remove_all(place_, ignored);
}

void StagedFiles::commit(const Scene& scene) {
    commit(inputs_of(scene));
}

void StagedFiles::commit(const std::set<fs::path>& inputs) {
    const std::vector<fs::path> files = files_below(place_);
    std::set<fs::path> kept;
    for (const fs::path& input : inputs)
        kept.insert(resolved(input));
    std::error_code error;
    for (const fs::path& file : files) {
        if (kept.count(resolved(folder_ / file)) > 0)
            throw_error((folder_ / file).string(), "the scene was read from this file", "another folder",
                        ErrorKind::usage);
        for (fs::path part = file.parent_path(); !part.empty(); part = part.parent_path())
            if (fs::is_symlink(folder_ / part, error))
                throw_error((folder_ / part).string(), "cannot write: is a link to another folder",
                            "a folder");
    }
    move(files);
    if (use_ == Use::alone)
        remove_longer_series(folder_, files, kept);
}

void StagedFiles::move(const std::vector<fs::path>& files) {
    // Taken back in the other order: first files, then the folders that were made for them.
    std::list<MadeFolders> folders;
    Moves moves;
    const fs::path old = place_ / ".old";
    std::error_code error;
    fs::create_directory(old, error);
    if (error)
        fail(folder_, "cannot write into the folder", error);
    int number = 0;
    const auto put_away = [&](const fs::path& file) {
        const fs::file_status status = fs::symlink_status(folder_ / file, error);
        if (fs::is_directory(status))
            throw_error((folder_ / file).string(), "cannot write: is a folder", "another output folder");
        if (fs::exists(status))
            if ((error = moves.move(folder_ / file, old / std::to_string(number++))))
                fail(folder_ / file, "cannot replace the file", error);
    };
    if (!files.empty() && files.back() == summary) // a folder half way between two runs is none
        put_away(summary);
    for (const fs::path& file : files) {
        folders.emplace_back((folder_ / file).parent_path());
        put_away(file);
        if ((error = moves.move(place_ / file, folder_ / file)))
            fail(folder_ / file, "cannot write the file", error);
    }
    moves.keep();
    for (MadeFolders& folder : folders)
        folder.keep();
    made_.keep();
}

} // namespace fascicle
