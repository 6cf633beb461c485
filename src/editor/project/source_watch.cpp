#include "editor/project/source_watch.hpp"

#include "editor/features.hpp"

#include "editor/dialogs/dialogs.hpp"
#include "fascicle/base/state_hash.hpp"
#include "fascicle/document/actions/project_actions.hpp"
#include "fascicle/io/files.hpp"
#include "fascicle/io/reload_sources.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>

namespace fascicle::editor {

namespace fs = std::filesystem;

namespace {

std::string hash_of(const std::string& bytes) {
    StateHash hash;
    hash.add_bytes(bytes.data(), bytes.size());
    return hash.hex();
}

} // namespace

SourceWatch::~SourceWatch() = default; // thread and future are waited for

std::optional<SourceWatch::Stamp> SourceWatch::stamp(const std::string& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error))
        return std::nullopt;
    Stamp result;
    result.time = fs::last_write_time(path, error);
    if (!error)
        result.size = fs::file_size(path, error);
    return error ? std::nullopt : std::optional(result);
}

void SourceWatch::project_is(const fs::path& path, const std::string& text) {
    std::error_code error;
    const std::lock_guard lock(mutex_);
    project_ = path.empty() ? std::string() : fs::absolute(path, error).string();
    project_hash_ = hash_of(text);
    std::erase(changed_, project_);
    files_stale_ = true;
}

void SourceWatch::document_replaced(EditorContext&) {
    if (reading_.valid()) // of the scene before: nobody wants it any more
        given_up_.push_back(std::move(reading_));
    wanted_.clear();
    const std::lock_guard lock(mutex_);
    changed_.clear();
    project_.clear();
    files_stale_ = true;
}

/// Files of the scene, with the state that they are in now when they were not followed before.
void SourceWatch::follow(const Scene& scene) {
    std::map<std::string, std::pair<std::string, Stamp>> files;
    const auto add = [&](const std::string& path, const std::string& hash) {
        const auto known = files_.find(path);
        if (known != files_.end() && known->second.first == hash)
            files[path] = known->second;
        else if (const auto now = stamp(path))
            files[path] = {hash, *now};
    };
    for (const MeshSource& source : scene_sources(scene))
        add(source.path, source.hash);
    if (!project_.empty())
        add(project_, project_hash_);
    files_ = std::move(files);
}

void SourceWatch::look() {
    std::map<std::string, std::pair<std::string, Stamp>> files;
    {
        const std::lock_guard lock(mutex_);
        files = files_;
    }
    for (const auto& [path, known] : files) {
        const std::optional<Stamp> now = stamp(path);
        if (!now || *now == known.second)
            continue;
        std::string hash;
        try {
            hash = hash_of(read_file(path));
        } catch (const std::exception&) {
            continue; // gone again, or half written: next time
        }
        const std::lock_guard lock(mutex_);
        const auto it = files_.find(path);
        if (it == files_.end() || it->second != known)
            continue;
        it->second.second = *now;
        if (path == project_ && hash == project_hash_)
            continue; // just saved from here
        if (hash != known.first && std::count(changed_.begin(), changed_.end(), path) == 0)
            changed_.push_back(path);
    }
}

void SourceWatch::start_thread() {
    thread_ = std::jthread([this](const std::stop_token& stop) {
        std::mutex sleep;
        std::condition_variable_any wake;
        std::unique_lock lock(sleep);
        while (!wake.wait_for(lock, stop, std::chrono::seconds(1), [&] { return stop.stop_requested(); }))
            look();
    });
}

void SourceWatch::reload(EditorContext& context, std::vector<std::string> files) {
    wanted_ = std::move(files);
    reading_ = std::async(std::launch::async, [from = context.document.head(), files = wanted_] {
        Reloaded result;
        result.from = from;
        result.scene = reload_sources(*from, files, result.notes);
        return result;
    });
}

void SourceWatch::finish() {
    if (reading_.valid())
        reading_.wait();
}

void SourceWatch::poll_reading(EditorContext& context) {
    if (!reading_.valid() || context.document.has_uncommitted_edits() ||
        reading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    try {
        Reloaded result = reading_.get();
        if (result.from != context.document.head()) { // the scene changed meanwhile
            reload(context, wanted_);
            return;
        }
        for (const std::string& note : result.notes)
            context.log.add(Severity::note, note);
        const std::string what = wanted_.size() == 1 ? fs::path(wanted_[0]).filename().string()
                                                     : std::to_string(wanted_.size()) + " files";
        actions::replace_scene(context.document, std::move(result.scene), "Reload " + what);
    } catch (const std::exception& problem) {
        context.log.add(Severity::error, problem.what());
    }
}

void SourceWatch::update(EditorContext& context) {
    std::erase_if(given_up_, [](const std::future<Reloaded>& old) {
        return old.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    });
    poll_reading(context);
    std::vector<std::string> changed;
    std::string project;
    {
        const std::lock_guard lock(mutex_);
        if (files_stale_ || followed_ != context.document.head()) {
            followed_ = context.document.head();
            files_stale_ = false;
            follow(*followed_);
        }
        if (!thread_.joinable() && !files_.empty())
            start_thread();
        // Not into the middle of a drag, and one question at a time.
        if (!changed_.empty() && !context.document.has_uncommitted_edits() && !reading_.valid() &&
            !context.features.project.saving() && !ImGui::IsAnyMouseDown() &&
            !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) {
            changed.swap(changed_);
            project = project_;
        }
    }
    if (changed.empty())
        return;
    const bool own = std::erase(changed, project) > 0;
    context.dialogs.reload.ask(std::move(changed), own ? fs::path(project) : fs::path());
}

std::optional<double> SourceWatch::redraw_after() const {
    const std::lock_guard lock(mutex_);
    return reading_.valid() || !changed_.empty() ? std::optional<double>(1.0 / 25) : std::nullopt;
}

} // namespace fascicle::editor
