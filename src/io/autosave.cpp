#include "fascicle/io/autosave.hpp"

#include "fascicle/base/error.hpp"
#include "fascicle/io/files.hpp"
#include "io/json_fields.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fascicle {
namespace fs = std::filesystem;

namespace {

constexpr const char* lock_name = "lock";

/// Numbered copies of a session, the oldest first.
std::vector<fs::path> copies_in(const fs::path& folder) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".fascicle")
            found.push_back(it->path());
    std::sort(found.begin(), found.end());
    return found;
}

fs::path picture_of(fs::path copy) {
    return copy.replace_extension(".png");
}

/// Whether no living process holds the session's lock.
bool is_left(const fs::path& folder) {
    const int file = ::open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC);
    if (file < 0)
        return errno == ENOENT;
    const bool free = ::flock(file, LOCK_EX | LOCK_NB) == 0;
    ::close(file);
    return free;
}

} // namespace

std::vector<AutosaveSession> crashed_sessions(const fs::path& user_folder) {
    std::vector<AutosaveSession> sessions;
    std::error_code error;
    if (user_folder.empty())
        return sessions;
    for (fs::directory_iterator it(user_folder / "autosave", error), end; !error && it != end;
         it.increment(error)) {
        std::error_code ignored;
        if (!it->is_directory(ignored) || !is_left(it->path()))
            continue;
        AutosaveSession session;
        session.folder = it->path();
        const std::vector<fs::path> copies = copies_in(session.folder);
        struct stat facts = {};
        if (copies.empty() || ::stat(copies.back().c_str(), &facts) != 0) {
            fs::remove_all(session.folder, ignored); // it crashed before its first copy was whole
            continue;
        }
        session.file = copies.back();
        session.copies = static_cast<int>(copies.size());
        session.time = facts.st_mtime;
        session.name = session.file.stem().string();
        if (const fs::path picture = picture_of(session.file); fs::exists(picture, ignored))
            session.picture = picture;
        try {
            const std::string where = (session.folder / "session.json").string();
            const io::Json json = io::parse_json_object(read_file(where, std::size_t{1} << 20), where);
            const io::JsonFields fields(json, where, "");
            session.name = fields.text("name", session.name);
            session.project = fields.text("project");
        } catch (const std::exception&) { // the copies tell enough
        }
        sessions.push_back(std::move(session));
    }
    std::sort(sessions.begin(), sessions.end(), [](const AutosaveSession& a, const AutosaveSession& b) {
        return a.time != b.time ? a.time > b.time : a.folder < b.folder;
    });
    return sessions;
}

void remove_autosaves(const AutosaveSession& session) {
    std::error_code ignored;
    fs::remove_all(session.folder, ignored);
}

AutosaveFolder::~AutosaveFolder() {
    if (lock_ >= 0)
        ::close(lock_);
}

void AutosaveFolder::open() {
    if (lock_ >= 0)
        return;
    std::error_code error;
    const std::string start = std::to_string(std::time(nullptr)) + "-" + std::to_string(::getpid());
    for (int k = 0;; ++k) {
        folder_ = user_folder_ / "autosave" / (start + "-" + std::to_string(k));
        fs::create_directories(folder_.parent_path(), error);
        if (!error && fs::create_directory(folder_, error))
            break;
        if (error)
            throw_error(folder_.string(), "cannot create the folder: " + error.message());
    }
    // A crash between these lines leaves a folder without copies, which the next start removes.
    do
        lock_ = ::open((folder_ / lock_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    while (lock_ < 0 && errno == EINTR);
    if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        const std::string reason = std::strerror(errno);
        if (lock_ >= 0)
            ::close(lock_);
        lock_ = -1;
        fs::remove_all(folder_, error);
        throw_error((folder_ / lock_name).string(), "cannot lock: " + reason);
    }
    const std::string pid = std::to_string(::getpid()) + "\n";
    if (::write(lock_, pid.data(), pid.size()) < 0) // for people who look; the lock itself counts
        return;
}

void AutosaveFolder::write(const Autosave& copy) {
    open();
    char name[32];
    std::snprintf(name, sizeof name, "%06d.fascicle", ++number_);
    const fs::path file = folder_ / name;
    if (copy.picture)
        write_png(picture_of(file), copy.picture->width, copy.picture->height, copy.picture->rgba.data());
    const io::Json session{{"pid", ::getpid()},
                           {"name", copy.scene->name},
                           {"project", copy.project.empty() ? "" : fs::absolute(copy.project).string()}};
    write_file(folder_ / "session.json",
               session.dump(2, ' ', false, io::Json::error_handler_t::replace) + "\n");
    write_project_file(file, *copy.scene, copy.saving);
    const std::vector<fs::path> copies = copies_in(folder_);
    std::error_code ignored;
    for (std::size_t i = 0; i + copies_kept < copies.size(); ++i) {
        fs::remove(copies[i], ignored);
        fs::remove(picture_of(copies[i]), ignored);
    }
}

void AutosaveFolder::clear() {
    std::error_code ignored;
    if (lock_ >= 0) {
        fs::remove_all(folder_, ignored);
        ::close(lock_);
    }
    lock_ = -1;
    folder_.clear();
}

} // namespace fascicle
