#include "output/staged_files.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/scene/line_muscles.hpp"
#include "fascicle/scene/model_motion.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <map>
#include <set>
#include <unistd.h>
#include <utility>

namespace fascicle::output {
namespace fs = std::filesystem;

namespace {

fs::path resolved(const fs::path& path) {
    std::error_code error;
    const fs::path found = fs::weakly_canonical(path, error);
    return error ? path : found;
}

std::set<fs::path> inputs_of(const Scene& scene) {
    std::set<fs::path> inputs;
    const auto add = [&](const MeshSource& source) {
        if (!source.path.empty())
            inputs.insert(resolved(source.path));
    };
    add(scene.motion_source);
    if (scene.model_motion != nullptr)
        add(scene.model_motion->model_source);
    if (scene.line_muscles != nullptr)
        add(scene.line_muscles->source);
    for (const Bone& bone : scene.bones)
        add(bone.source);
    for (const Muscle& muscle : scene.muscles) {
        add(muscle.source);
        add(muscle.surface_fibres_source);
        add(muscle.fibre_template_source);
        for (const MeshSource& source : muscle.outline_files)
            add(source);
    }
    return inputs;
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

std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->is_regular_file(error))
            files.push_back(it->path().lexically_relative(folder));
    std::sort(files.begin(), files.end());
    return files;
}

[[noreturn]] void fail(const fs::path& path, const std::string& what, const std::error_code& error) {
    throw_error(path.string(), what + " (" + error.message() + ")", "a folder that can be written to");
}

/// The number of a file of that series.
long number_in(const fs::path& file, const SeriesName& name) {
    const std::string text = file.string(); // name.begin has the folder, too
    return std::strtol(
        text.substr(name.begin.size(), text.size() - name.begin.size() - name.end.size()).c_str(), nullptr,
        10);
}

} // namespace

void check_no_input(const fs::path& file, const Scene& scene) {
    if (inputs_of(scene).count(resolved(file)) > 0)
        throw_error(file.string(), "the scene was read from this file", "another name", ErrorKind::usage);
}

StagedFiles::StagedFiles(fs::path folder) {
    static std::atomic<int> counter{0};
    std::error_code error;
    folder_ = fs::absolute(folder, error).lexically_normal();
    if (!folder_.has_filename())
        folder_ = folder_.parent_path(); // "out/" is "out"
    for (fs::path path = folder_; !fs::exists(path, error) && path.has_relative_path();
         path = path.parent_path())
        made_ = path;
    fs::create_directories(folder_, error);
    if (error)
        fail(folder_, "cannot make the folder", error);
    place_ = folder_ / (".fascicle-part-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
    fs::create_directory(place_, error);
    if (error) {
        const fs::path place = std::exchange(place_, {});
        fail(folder_, "cannot write into the folder", error);
    }
}

StagedFiles::~StagedFiles() {
    std::error_code ignored;
    if (!place_.empty())
        fs::remove_all(place_, ignored);
    // A folder that was made for nothing goes again; one that holds anything is left alone.
    for (fs::path path = folder_; !made_.empty() && fs::remove(path, ignored); path = path.parent_path())
        if (path == made_)
            break;
}

void StagedFiles::commit(const Scene& scene) {
    const std::vector<fs::path> files = files_below(place_);
    const std::set<fs::path> inputs = inputs_of(scene);
    std::map<SeriesName, long> last; // number of each series that was written
    std::set<fs::path> folders;
    for (const fs::path& file : files) {
        if (inputs.count(resolved(folder_ / file)) > 0)
            throw_error((folder_ / file).string(), "the scene was read from this file", "another folder",
                        ErrorKind::usage);
        if (const SeriesName name = series_name(file); !name.end.empty())
            last[name] = std::max(last[name], number_in(file, name));
        folders.insert(file.parent_path());
    }
    std::error_code error;
    for (const fs::path& file : files) {
        fs::create_directories((folder_ / file).parent_path(), error);
        if (!error)
            fs::rename(place_ / file, folder_ / file, error);
        if (error)
            fail(folder_ / file, "cannot write the file", error);
        made_.clear();
    }
    for (const fs::path& folder : folders) {
        std::vector<fs::path> stale;
        for (fs::directory_iterator it(folder_ / folder, error), end; !error && it != end;
             it.increment(error)) {
            const fs::path file = folder / it->path().filename();
            // What an earlier, longer series left behind the new one; not what lies before it.
            const SeriesName name = series_name(file);
            const auto found = last.find(name);
            if (found != last.end() && number_in(file, name) > found->second &&
                !std::binary_search(files.begin(), files.end(), file) &&
                inputs.count(resolved(folder_ / file)) == 0)
                stale.push_back(file);
        }
        for (const fs::path& file : stale)
            fs::remove(folder_ / file, error);
    }
}

} // namespace fascicle::output
